// Moving, rotating and scaling a mesh by the handles in the viewport, and keys for what is
// selected.
#include "app/editor/panel/LightsPanel.h"
#include "app/editor/panel/ScenePanel.h"
#include "app/editor/viewport/WidgetGizmoView.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "render/scene/MeshGizmo.h"
#include "tests/app/editor/EditorFixture.h"
#include "tests/support/Events.h"

#include <QCheckBox>
#include <QToolButton>
#include <QTreeView>
#include <QTreeWidget>

namespace patina::editor {
namespace {

class MeshHandlesTest : public EditorTest {
  protected:
    static ViewportWidget& viewport() { return window->viewport(); }
    static void activate() {
        window->activateWindow();
        ASSERT_TRUE(QTest::qWaitForWindowActive(window.get(), 30'000));
        viewport().setFocus();
    }
    // The start scene's mesh with its handles.
    static Id selectMesh() {
        activate();
        QTest::keyClick(&viewport(), Qt::Key_Home);
        const Id id = document().meshes.front().id;
        session->selection.selectMesh(id);
        if (!window->actions().placeHandles->isChecked())
            QTest::keyClick(&viewport(), Qt::Key_M, Qt::ShiftModifier);
        EXPECT_TRUE(window->actions().placeHandles->isChecked());
        return id;
    }
    static render::MeshHandles handles(Id id) {
        const MeshInstance& mesh = *document().mesh(id);
        render::MeshHandles result;
        result.pivot = mesh.mesh->bounds().transformed(mesh.placement.matrix()).center();
        result.axes = mesh.placement.axes();
        return result;
    }
    static QPoint at(Id id, render::GizmoHandle wanted) {
        for (const render::GizmoPoint& handle :
             render::meshGizmo(handles(id), gizmoViewOf(viewport(), document())).handles)
            if (handle.handle == wanted)
                return {static_cast<int>(std::lround(handle.at.x)),
                        viewport().height() - static_cast<int>(std::lround(handle.at.y))};
        ADD_FAILURE() << "no such handle";
        return {};
    }
    static void drag(QPoint from, QPoint by, Qt::KeyboardModifiers modifiers = {},
                     bool release = true) {
        QTest::mousePress(&viewport(), Qt::LeftButton, {}, from);
        for (int i = 1; i <= 6; ++i)
            moveMouse(from + by * i / 6, modifiers);
        if (release)
            QTest::mouseRelease(&viewport(), Qt::LeftButton, modifiers, from + by);
    }
    // QTest::mouseMove() knows no keys.
    static void moveMouse(QPoint to, Qt::KeyboardModifiers modifiers) {
        QMouseEvent event(QEvent::MouseMove, QPointF(to), QPointF(viewport().mapToGlobal(to)),
                          Qt::NoButton, Qt::LeftButton, modifiers);
        QCoreApplication::sendEvent(&viewport(), &event);
    }
    static const Placement& placed(Id id) { return document().mesh(id)->placement; }
};

TEST_F(MeshHandlesTest, HandlesMoveRotateAndScaleInOneStepEach) {
    const Id id = selectMesh();
    const Camera seen = document().view.camera;
    const Placement before = placed(id);
    drag(at(id, render::GizmoHandle::AxisX), {60, 0});
    const glm::vec3 moved = placed(id).position() - before.position();
    EXPECT_GT(moved.x, 0.0f);
    EXPECT_EQ(moved.y, 0.0f);
    EXPECT_EQ(moved.z, 0.0f);
    EXPECT_EQ(undoCount(), 1);
    EXPECT_EQ(document().view.camera, seen) << "the camera stays";
    const QString name = QString::fromStdString(document().mesh(id)->name);
    EXPECT_EQ(controller().undoStack().undoText(), QStringLiteral("Move %1").arg(name));

    drag(at(id, render::GizmoHandle::ScaleAll), {50, -50});
    EXPECT_GT(placed(id).scale().x, 1.2f);
    EXPECT_FLOAT_EQ(placed(id).scale().x, placed(id).scale().y);
    EXPECT_EQ(undoCount(), 2);

    // On a ring, away from the knobs.
    const render::GizmoView view = gizmoViewOf(viewport(), document());
    QPoint on, by;
    for (const render::GizmoLine& line : render::meshGizmo(handles(id), view).lines) {
        const glm::vec2 middle = 0.5f * (line.from + line.to);
        if (line.handle == render::GizmoHandle::RotateY &&
            render::pickMeshGizmo(handles(id), view, glm::round(middle)) == line.handle) {
            on = {static_cast<int>(std::round(middle.x)),
                  viewport().height() - static_cast<int>(std::round(middle.y))};
            const glm::vec2 along = 60.0f * glm::normalize(line.to - line.from);
            by = {static_cast<int>(along.x), -static_cast<int>(along.y)};
        }
    }
    ASSERT_FALSE(on.isNull());
    drag(on, by, Qt::ControlModifier);
    const glm::vec3 angles = placed(id).rotationDeg();
    EXPECT_NE(angles.y, 0.0f);
    EXPECT_NEAR(angles.y, 15.0f * std::round(angles.y / 15.0f), 1e-3f) << "Ctrl snaps";
    EXPECT_EQ(undoCount(), 3);
    for (int i = 0; i < 3; ++i)
        controller().undoStack().undo();
    EXPECT_EQ(placed(id), before);
}

TEST_F(MeshHandlesTest, EscTakesADragBack) {
    const Id id = selectMesh();
    const Placement before = placed(id);
    const QPoint knob = at(id, render::GizmoHandle::AxisY);
    drag(knob, {0, -50}, {}, false);
    EXPECT_NE(placed(id), before);
    QTest::keyClick(&viewport(), Qt::Key_Escape);
    EXPECT_EQ(placed(id), before);
    EXPECT_EQ(undoCount(), 0);
    QTest::mouseRelease(&viewport(), Qt::LeftButton, {}, knob);
    EXPECT_EQ(placed(id), before);
}

TEST_F(MeshHandlesTest, WithoutTheToolADragOrbits) {
    const Id id = selectMesh();
    const QPoint knob = at(id, render::GizmoHandle::AxisX);
    window->actions().placeHandles->trigger();
    const Camera seen = document().view.camera;
    drag(knob, {40, 0});
    EXPECT_NE(document().view.camera.yawDeg, seen.yawDeg);
    EXPECT_TRUE(placed(id).isAsRead());
}

TEST_F(MeshHandlesTest, TheMeshDropsToTheGroundAndIsPutBack) {
    const Id id = selectMesh();
    const Placement before = placed(id);
    controller().setParameter(parameter("mesh.position"), {Scope::Mesh, id}, glm::vec3(0, 7, 0));
    QTest::keyClick(&viewport(), Qt::Key_End);
    EXPECT_NEAR(exactBounds(document(), std::span(&id, 1)).min.y, 0.0f, 1e-5f);
    EXPECT_EQ(undoCount(), 2);
    window->actions().backInPlace->trigger();
    EXPECT_EQ(placed(id), before);
}

TEST_F(MeshHandlesTest, KeysRemoveAndDuplicateWhatWasSelectedLast) {
    const Id id = selectMesh();
    const std::size_t meshes = document().meshes.size();
    QTest::keyClick(&viewport(), Qt::Key_D, Qt::ControlModifier);
    ASSERT_EQ(document().meshes.size(), meshes + 1);
    const Id copy = session->selection.mesh();
    EXPECT_NE(copy, id);
    QTest::keyClick(&viewport(), Qt::Key_Delete);
    EXPECT_EQ(document().mesh(copy), nullptr);
    EXPECT_EQ(document().meshes.size(), meshes);

    const Id light = controller().addLight(LightType::Point);
    session->selection.selectLight(light);
    QTest::keyClick(&viewport(), Qt::Key_D, Qt::ControlModifier);
    EXPECT_EQ(document().lights.size(), 2u);
    QTest::keyClick(&viewport(), Qt::Key_Delete);
    QTest::keyClick(&viewport(), Qt::Key_Delete);
    EXPECT_TRUE(document().lights.empty());

    // In the list a material, of which the last one stays; in the viewport none.
    QTreeView* tree = window->findChild<ScenePanel*>()->tree();
    const Id material = controller().addMaterial();
    session->selection.selectMaterial(material);
    QTest::keyClick(&viewport(), Qt::Key_Delete);
    EXPECT_NE(document().material(material), nullptr);
    tree->setFocus();
    QTest::keyClick(tree, Qt::Key_Delete);
    EXPECT_EQ(document().material(material), nullptr);
    for (int i = 0; i < 3; ++i)
        QTest::keyClick(tree, Qt::Key_Delete);
    EXPECT_GE(document().materials.size(), 1u);
}

TEST_F(MeshHandlesTest, TheSceneDockShowsWhereTheMeshStands) {
    const Id id = selectMesh();
    auto* panel = window->findChild<ScenePanel*>();
    auto* whole = panel->findChild<QCheckBox*>();
    ASSERT_NE(whole, nullptr);
    EXPECT_TRUE(whole->isVisibleTo(panel));
    EXPECT_TRUE(whole->isEnabled());
    whole->setChecked(true);
    EXPECT_EQ(session->selection.placedMeshes().size(), document().meshes.size());
    whole->setChecked(false);
    EXPECT_EQ(session->selection.placedMeshes(), std::vector<Id>{id});
    session->selection.selectMesh(0);
    EXPECT_FALSE(whole->isVisibleTo(panel));
    session->selection.selectMesh(id);
    EXPECT_TRUE(whole->isVisibleTo(panel));
}

} // namespace
} // namespace patina::editor
