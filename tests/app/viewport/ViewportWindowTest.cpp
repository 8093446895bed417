// The viewport and the bakes, driven by real mouse and key events in the real window.

#include "app/editor/job/JobManager.h"
#include "core/document/ViewChoices.h"
#include "core/light/Light.h"
#include "core/light/Lights.h"
#include "render/scene/LightGizmo.h"
#include "tests/app/editor/EditorFixture.h"
#include "tests/support/Events.h"

#include <QComboBox>
#include <QDir>
#include <QLabel>
#include <QLocale>
#include <QPushButton>
#include <algorithm>
#include <cstdio>

namespace patina::editor {
namespace {

class ViewportWindowTest : public EditorTest {
  protected:
    static ViewportWidget& viewport() { return window->viewport(); }
    // Shortcuts belong to the active window; without a window manager nobody else activates it.
    static void activate() {
        window->activateWindow();
        ASSERT_TRUE(QTest::qWaitForWindowActive(window.get(), 30'000));
        viewport().setFocus();
    }
    static QPoint center() { return viewport().rect().center(); }
    static const Camera& camera() { return document().view.camera; }

    static void drag(Qt::MouseButton button, Qt::KeyboardModifiers modifiers, QPoint by,
                     int steps = 8) {
        QTest::mousePress(&viewport(), button, modifiers, center());
        for (int i = 1; i <= steps; ++i)
            QTest::mouseMove(&viewport(), center() + by * i / steps);
        QTest::mouseRelease(&viewport(), button, modifiers, center() + by);
    }

    // The Bake dock's button of that name.
    static QPushButton& button(const char* name) {
        return *window->findChild<QPushButton*>(QLatin1String(name));
    }
    static bool bakeRuns() { return session->jobs.runningCount() > 0; }
    static bool hasPrt() {
        return std::any_of(document().bakes.begin(), document().bakes.end(),
                           [](const auto& bake) { return bake->kind == BakeKind::PrtVertex; });
    }
    static QString bakeStatus() {
        const auto* label = window->findChild<QLabel*>(QStringLiteral("bakeStatus"));
        return label ? label->text() : QString();
    }
    static void openSphere() { // quickly baked
        controller().openScene(QStringLiteral("builtin:sphere"));
        ASSERT_TRUE(settled(*session));
    }
    static void openKnot() {
        controller().openScene(QStringLiteral("builtin:torus-knot"));
        ASSERT_TRUE(settled(*session));
        ASSERT_GT(document().triangleCount(), 90'000u);
    }
};

TEST_F(ViewportWindowTest, DraggingMovesTheCameraAndIsNoUndoStep) {
    const Camera before = camera();
    drag(Qt::LeftButton, Qt::NoModifier, {60, 20});
    EXPECT_NE(camera().yawDeg, before.yawDeg);
    EXPECT_EQ(camera().target, before.target);
    const Camera orbited = camera();
    drag(Qt::MiddleButton, Qt::NoModifier, {30, 10});
    EXPECT_NE(camera().target, orbited.target);
    EXPECT_EQ(camera().yawDeg, orbited.yawDeg);
    const Camera panned = camera();
    drag(Qt::RightButton, Qt::NoModifier, {40, 0});
    EXPECT_LT(glm::length(camera().position() - panned.position()), 1e-3f);
    EXPECT_NE(camera().yawDeg, panned.yawDeg);
    EXPECT_EQ(undoCount(), 0);
    EXPECT_FALSE(controller().isModified());

    activate();
    QTest::keyClick(&viewport(), Qt::Key_Home);
    EXPECT_EQ(camera().yawDeg, Camera{}.yawDeg);
    EXPECT_LT(glm::length(camera().target - document().bounds().center()), 1e-3f);
}

TEST_F(ViewportWindowTest, FlyingNeedsTheRightButtonAndLettersStayShortcutsOtherwise) {
    activate();
    const Camera before = camera();
    QTest::keyPress(&viewport(), Qt::Key_W);
    QTest::qWait(60); // nothing to wait for: it shows that nothing comes
    QTest::keyRelease(&viewport(), Qt::Key_W);
    EXPECT_EQ(camera(), before);

    QTest::mousePress(&viewport(), Qt::RightButton, Qt::NoModifier, center());
    QTest::keyPress(&viewport(), Qt::Key_W);
    EXPECT_TRUE(eventually([&] { return camera().position() != before.position(); }));
    QTest::keyRelease(&viewport(), Qt::Key_W);
    QTest::mouseRelease(&viewport(), Qt::RightButton, Qt::NoModifier, center());
    const glm::vec3 moved = camera().position() - before.position();
    EXPECT_GT(glm::dot(glm::normalize(moved), before.forward()), 0.99f);
    const Camera after = camera();
    QTest::qWait(60); // nothing to wait for: it shows that nothing comes
    EXPECT_EQ(camera(), after) << "the camera stops with the key";
}

TEST_F(ViewportWindowTest, ShiftRightDragTurnsTheEnvironmentInOneUndoStep) {
    drag(Qt::RightButton, Qt::ShiftModifier, {50, 0});
    EXPECT_GT(document().environment().rotationDeg, 5.0f);
    EXPECT_EQ(undoCount(), 1);
    controller().undoStack().undo();
    EXPECT_EQ(document().environment().rotationDeg, 0.0f);
}

// --- Lights, by real events ---

class LightGizmoWindowTest : public ViewportWindowTest {
  protected:
    // A light of the type, selected, in the middle of what the camera sees.
    static Id addLight(LightType type) {
        activate();
        QTest::keyClick(&viewport(), Qt::Key_Home);
        const Id id = controller().addLight(type);
        session->selection.selectLight(id);
        Light light = *document().light(id);
        if (hasPosition(type))
            light.position = document().bounds().center();
        controller().changeLight(light, 0, QStringLiteral("Place"));
        return id;
    }
    static render::GizmoView view() {
        const auto width = static_cast<float>(viewport().width());
        const auto height = static_cast<float>(viewport().height());
        return {camera().projectionMatrix(width / height, document().bounds()) *
                    camera().viewMatrix(),
                {width, height},
                std::max(1.0f, height / 1000.0f)};
    }
    static QPoint at(const glm::vec2& pixel) {
        return {static_cast<int>(std::lround(pixel.x)),
                viewport().height() - static_cast<int>(std::lround(pixel.y))};
    }
    static render::LightGizmo gizmo(Id id) {
        return render::lightGizmo(document(), *document().light(id), document().bounds(), view(),
                                  true);
    }
    static glm::vec2 handle(Id id, render::GizmoHandle handle) {
        for (const render::GizmoPoint& point : gizmo(id).handles)
            if (point.handle == handle)
                return point.at;
        ADD_FAILURE() << "no such handle";
        return {};
    }
    static void keepPicture(const char* name) {
        const QString folder = qEnvironmentVariable("PATINA_SCREENSHOTS");
        if (folder.isEmpty())
            return;
        ASSERT_TRUE(QDir().mkpath(folder));
        EXPECT_TRUE(window->grab().save(QDir(folder).filePath(QLatin1String(name))));
    }
    static void dragFrom(QPoint from, QPoint by, bool release = true) {
        QTest::mousePress(&viewport(), Qt::LeftButton, {}, from);
        for (int i = 1; i <= 8; ++i)
            QTest::mouseMove(&viewport(), from + by * i / 8);
        if (release)
            QTest::mouseRelease(&viewport(), Qt::LeftButton, {}, from + by);
    }
};

TEST_F(LightGizmoWindowTest, AMarkIsDraggedInThePlaneOfThePictureInOneStep) {
    const Id id = addLight(LightType::Point);
    const glm::vec3 before = document().light(id)->position;
    const Camera seen = camera();
    const int steps = undoCount();
    const glm::vec2 mark = gizmo(id).mark;
    dragFrom(at(mark), {80, -40});
    const glm::vec3 moved = document().light(id)->position - before;
    EXPECT_GT(glm::dot(moved, seen.right()), 0.0f);
    EXPECT_GT(glm::dot(moved, seen.up()), 0.0f);
    EXPECT_NEAR(glm::dot(moved, seen.forward()), 0.0f, 1e-4f * glm::length(moved));
    // It follows the pointer.
    EXPECT_LT(glm::distance(gizmo(id).mark, mark + glm::vec2(80, 40)), 6.0f);
    EXPECT_EQ(camera(), seen);
    EXPECT_EQ(undoCount(), steps + 1);
    EXPECT_EQ(session->selection.light(), id);
    keepPicture("light-dragged.png");
    controller().undoStack().undo();
    EXPECT_EQ(document().light(id)->position, before);
}

TEST_F(LightGizmoWindowTest, AnAxisMovesAlongItselfAlone) {
    const Id id = addLight(LightType::Sphere);
    for (const auto& [axis, k] : {std::pair{render::GizmoHandle::AxisX, 0},
                                  {render::GizmoHandle::AxisY, 1},
                                  {render::GizmoHandle::AxisZ, 2}}) {
        const glm::vec3 before = document().light(id)->position;
        const glm::vec2 end = handle(id, axis), along = end - gizmo(id).mark;
        if (glm::length(along) < 20.0f)
            continue; // seen end on
        const glm::vec2 by = 60.0f * glm::normalize(along);
        dragFrom(at(end), {static_cast<int>(by.x), static_cast<int>(-by.y)});
        const glm::vec3 moved = document().light(id)->position - before;
        EXPECT_GT(moved[k], 0.0f);
        EXPECT_EQ(moved[(k + 1) % 3], 0.0f);
        EXPECT_EQ(moved[(k + 2) % 3], 0.0f);
    }
}

TEST_F(LightGizmoWindowTest, TheAimHandleTurnsASpotWhereItStands) {
    const Id id = addLight(LightType::Spot);
    const Light before = *document().light(id);
    const glm::vec2 end = handle(id, render::GizmoHandle::Aim);
    dragFrom(at(end), {70, 10});
    const Light after = *document().light(id);
    EXPECT_EQ(after.position, before.position);
    EXPECT_LT(glm::dot(after.directionToLight(), before.directionToLight()), 0.999f);
    // It is brighter to the right than before.
    EXPECT_LT(glm::dot(after.directionToLight(), camera().right()),
              glm::dot(before.directionToLight(), camera().right()));
}

TEST_F(LightGizmoWindowTest, EscTakesADragBackAndLeavesNoStep) {
    for (const LightType type : {LightType::Rectangle, LightType::Directional}) {
        const Id id = addLight(type);
        const Light before = *document().light(id);
        const int steps = undoCount();
        const QPoint mark = at(gizmo(id).mark);
        dragFrom(mark, {50, 30}, false);
        EXPECT_NE(*document().light(id), before);
        QTest::keyClick(&viewport(), Qt::Key_Escape);
        EXPECT_EQ(*document().light(id), before);
        EXPECT_EQ(undoCount(), steps);
        QTest::mouseMove(&viewport(), mark + QPoint(90, 60)); // the button is still down
        QTest::mouseRelease(&viewport(), Qt::LeftButton, {}, mark + QPoint(90, 60));
        EXPECT_EQ(*document().light(id), before);
    }
}

TEST_F(LightGizmoWindowTest, CtrlRightDragTurnsTheSelectedLightOrElseTheEnvironment) {
    const Id id = addLight(LightType::Directional);
    const Light before = *document().light(id);
    const Camera seen = camera();
    const int steps = undoCount();
    drag(Qt::RightButton, Qt::ControlModifier, {50, -20});
    EXPECT_GT(document().light(id)->azimuthDeg, before.azimuthDeg + 5.0f);
    EXPECT_GT(document().light(id)->elevationDeg, before.elevationDeg);
    EXPECT_EQ(document().environment().rotationDeg, 0.0f);
    EXPECT_EQ(undoCount(), steps + 1);
    EXPECT_EQ(camera(), seen);
    keepPicture("light-turned.png");

    session->selection.selectLight(0);
    const Light turned = *document().light(id);
    drag(Qt::RightButton, Qt::ControlModifier, {50, 0});
    EXPECT_EQ(*document().light(id), turned);
    EXPECT_GT(document().environment().rotationDeg, 5.0f);
    EXPECT_EQ(undoCount(), steps + 2);
}

TEST_F(LightGizmoWindowTest, AClickSelectsALightAndOneOnNothingLetsItGo) {
    const Id first = addLight(LightType::Point);
    const Id second = controller().addLight(LightType::Spot);
    session->selection.selectLight(second);
    QTest::mouseClick(&viewport(), Qt::LeftButton, {}, at(gizmo(first).mark));
    EXPECT_EQ(session->selection.light(), first);
    QTest::mouseClick(&viewport(), Qt::LeftButton, {}, {4, 4}); // the sky
    EXPECT_EQ(session->selection.light(), 0u);
    // With overlays off there is nothing to take hold of.
    viewport().setOverlaysVisible(false);
    QTest::mouseClick(&viewport(), Qt::LeftButton, {}, at(gizmo(first).mark));
    EXPECT_EQ(session->selection.light(), 0u);
    viewport().setOverlaysVisible(true);
}

TEST_F(ViewportWindowTest, AClickSelectsWhatIsUnderThePointer) {
    activate();
    QTest::keyClick(&viewport(), Qt::Key_Home);
    session->selection.selectMesh(0);
    viewport().grab(); // a frame to pick from
    QTest::mouseClick(&viewport(), Qt::LeftButton, Qt::NoModifier, center());
    EXPECT_NE(session->selection.mesh(), 0u);
    QTest::mouseClick(&viewport(), Qt::LeftButton, Qt::NoModifier, QPoint(3, 3));
    EXPECT_EQ(session->selection.mesh(), 0u) << "a click on the sky selects nothing";
}

TEST_F(ViewportWindowTest, OrbitingGoesOnWhileABakeRunsAndCancelLeavesNothing) {
    openKnot();
    window->findChild<QComboBox*>(QStringLiteral("bakeSamples"))
        ->setCurrentText(QLocale().toString(4096)); // long enough to be in the way
    QTest::mouseClick(&button("bakeStart"), Qt::LeftButton);
    ASSERT_TRUE(bakeRuns());
    EXPECT_EQ(document().view.lighting, LightingMode::Prt);
    ASSERT_TRUE(eventually([&] { return session->jobs.jobs().back().progress.workDone > 0; }));

    int frames = 0;
    const auto counting = QObject::connect(&viewport(), &ViewportWidget::frameRendered, &viewport(),
                                           [&] { ++frames; });
    const float yaw = camera().yawDeg;
    QTest::mousePress(&viewport(), Qt::LeftButton, Qt::NoModifier, center());
    for (int i = 1; i <= 20; ++i) {
        const int before = frames;
        QTest::mouseMove(&viewport(), center() + QPoint(4 * i, 0));
        ASSERT_TRUE(eventually([&] { return frames > before; })) << i;
    }
    QTest::mouseRelease(&viewport(), Qt::LeftButton, Qt::NoModifier, center());
    QObject::disconnect(counting);
    EXPECT_NE(camera().yawDeg, yaw);
    EXPECT_TRUE(bakeRuns());

    QTest::mouseClick(&button("bakeCancel"), Qt::LeftButton);
    ASSERT_TRUE(eventually([&] { return !bakeRuns(); }));
    EXPECT_FALSE(hasPrt());
    EXPECT_EQ(session->jobs.jobs().back().state, JobState::Cancelled);
    EXPECT_EQ(session->bakes.preview(), nullptr);
}

TEST_F(ViewportWindowTest, ABakeIsAttachedUndoneAndGoesStaleWithTheGeometry) {
    openSphere();
    window->findChild<QComboBox*>(QStringLiteral("bakeSamples"))
        ->setCurrentText(QLocale().toString(32));
    QTest::mouseClick(&button("bakeStart"), Qt::LeftButton);
    ASSERT_TRUE(eventually([&] { return !bakeRuns() && hasPrt(); }));
    EXPECT_TRUE(bakeStatus().contains(QStringLiteral("Up to date"))) << bakeStatus().toStdString();
    EXPECT_TRUE(button("lightingPrt").isChecked());

    // Light and material edits leave transfer valid; hiding a mesh does not.
    const Id mesh = document().meshes.front().id;
    controller().setParameter(*findParameter("environment.rotationDeg"),
                              Target{Scope::Environment, 0}, 30.0f);
    EXPECT_TRUE(bakeStatus().contains(QStringLiteral("Up to date")));
    controller().setParameter(*findParameter("mesh.visible"), Target{Scope::Mesh, mesh}, false);
    test::handleEvents(); // the rows are made anew
    EXPECT_TRUE(bakeStatus().contains(QStringLiteral("Stale"))) << bakeStatus().toStdString();
    controller().undoStack().undo();
    test::handleEvents();
    EXPECT_TRUE(bakeStatus().contains(QStringLiteral("Up to date")));

    QTest::mouseClick(&button("lightingIbl"), Qt::LeftButton);
    EXPECT_EQ(document().view.lighting, LightingMode::Ibl);

    // Saved with the project and there again after opening it.
    const QString file = folder.filePath(QStringLiteral("ball.patina"));
    bool saved = false;
    controller().saveAs(file, [&](bool ok) { saved = ok; });
    ASSERT_TRUE(eventually([&] { return saved; }));
    const auto before = document().bakes.front()->vertices;
    controller().newDocument();
    ASSERT_TRUE(settled(*session));
    ASSERT_FALSE(hasPrt());
    controller().openScene(file);
    ASSERT_TRUE(settled(*session));
    ASSERT_TRUE(hasPrt());
    EXPECT_EQ(document().bakes.front()->vertices, before);
}

TEST_F(ViewportWindowTest, StoppingKeepsACompletePass) {
    openSphere();
    window->findChild<QComboBox*>(QStringLiteral("bakeSamples"))
        ->setCurrentText(QLocale().toString(4096));
    QTest::mouseClick(&button("bakeStart"), Qt::LeftButton);
    ASSERT_TRUE(eventually([&] { return session->jobs.jobs().back().progress.workDone > 0; }));
    QTest::mouseClick(&button("bakeStop"), Qt::LeftButton);
    ASSERT_TRUE(eventually([&] { return !bakeRuns(); }));
    ASSERT_TRUE(hasPrt());
    EXPECT_GE(document().bakes.front()->samplesDone, 32);
    EXPECT_LT(document().bakes.front()->samplesDone, 4096);
    EXPECT_EQ(session->jobs.jobs().back().state, JobState::Stopped);
}

} // namespace
} // namespace patina::editor
