// Materials and snapshots that are dragged onto the viewport and the Scene dock.
#include "app/editor/panel/SceneModel.h"
#include "app/editor/panel/ScenePanel.h"
#include "app/editor/panel/SnapshotsPanel.h"
#include "app/editor/viewport/DropTarget.h"
#include "app/editor/wall/OwnValueControls.h"
#include "core/document/Snapshot.h"
#include "core/edit/EditSession.h"
#include "tests/app/wall/WallFixture.h"

#include <QDragEnterEvent>
#include <QDropEvent>
#include <QListWidget>
#include <QMimeData>
#include <QTreeView>
#include <gmock/gmock.h>

namespace patina::editor {
namespace {

using Data = std::unique_ptr<QMimeData>;

class ElementDropTest : public WallWindow {
  protected:
    static SceneModel& scene() {
        return static_cast<SceneModel&>(*window->findChild<ScenePanel*>()->tree()->model());
    }
    static Id materialNamed(const char* name) {
        const auto found = std::ranges::find(document().materials, name, &Material::name);
        return found != document().materials.end() ? found->id : 0;
    }
    // What a drag that begins on the material's row carries.
    static Data draggedMaterial(const char* name) {
        const QModelIndex row = scene().indexOf({Scope::Material, materialNamed(name)});
        EXPECT_TRUE(scene().flags(row).testFlag(Qt::ItemIsDragEnabled));
        return Data(scene().mimeData({row}));
    }
    static Data draggedSnapshots(const std::vector<Id>& ids) {
        auto data = std::make_unique<QMimeData>();
        setDraggedElements(*data, controller().session(), {CellElement::Snapshot, ids});
        return data;
    }
    // What the window says while it is held there; then it is let go.
    static QStringList drop(const QMimeData& data, const QPoint& position, bool taken = true) {
        const QPoint at = viewport().mapTo(window.get(), position);
        QDragEnterEvent enter(window->rect().topLeft(), Qt::CopyAction, &data, Qt::LeftButton, {});
        QApplication::sendEvent(window.get(), &enter);
        EXPECT_TRUE(enter.isAccepted());
        QDragMoveEvent move(at, Qt::CopyAction, &data, Qt::LeftButton, {});
        QApplication::sendEvent(window.get(), &move);
        EXPECT_EQ(move.isAccepted(), taken);
        const QStringList lines = viewport().findChild<DropHint*>()->lines();
        QDropEvent event(QPointF(at), Qt::CopyAction, &data, Qt::LeftButton, {});
        QApplication::sendEvent(window.get(), &event);
        EXPECT_EQ(event.isAccepted(), taken);
        EXPECT_TRUE(viewport().findChild<DropHint*>()->lines().isEmpty());
        EXPECT_TRUE(isSettled());
        return lines;
    }
    static Id coverOf(std::size_t cell) {
        const Result<Document> shown = documentOf(document(), wall().cells()[cell].cell);
        return shown ? shown->meshes.front().material : 0;
    }
};

TEST_F(ElementDropTest, AMaterialIsShownInTheCellItIsDroppedOnto) {
    key(Qt::Key_F3); // three materials
    ASSERT_TRUE(isSettled());
    const Id before = coverOf(0);
    const QImage shown = pictureOf(0);
    const QStringList lines = drop(*draggedMaterial("Gold"), centreOf(0));
    ASSERT_EQ(lines.size(), 1);
    EXPECT_THAT(lines[0].toStdString(), testing::HasSubstr("Show Gold in the cell"));
    EXPECT_EQ(coverOf(0), materialNamed("Gold"));
    EXPECT_NE(pictureOf(0), shown);
    EXPECT_EQ(document().meshes.front().material, before) << "the scene is as it was";
    EXPECT_EQ(undoCount(), steps) << "looking is no edit";
    EXPECT_EQ(wall().current(), 0u);

    // Another one by the list, and linked again.
    auto& controls = *window->findChild<OwnValueControls*>();
    ASSERT_TRUE(eventually([&] { return find<QComboBox>(controls, QStringLiteral("Material")); }));
    auto* box = find<QComboBox>(controls, QStringLiteral("Material"));
    EXPECT_EQ(box->currentText(), QStringLiteral("Gold"));
    keepPicture("element-drop.png");
    const int clay = box->findText(QStringLiteral("Clay"));
    box->setCurrentIndex(clay);
    Q_EMIT box->activated(clay);
    EXPECT_EQ(coverOf(0), materialNamed("Clay"));
    QTest::mouseClick(find<QToolButton>(controls, QStringLiteral("Link Material")), Qt::LeftButton);
    EXPECT_EQ(coverOf(0), before);
    EXPECT_FALSE(controls.isVisible());

    // Removed from the scene, the cell says so.
    drop(*draggedMaterial("Gold"), centreOf(2));
    controller().removeMaterial(materialNamed("Gold"));
    ASSERT_TRUE(isSettled());
    controller().undoStack().undo();
    ASSERT_TRUE(isSettled());
    EXPECT_EQ(coverOf(2), materialNamed("Gold"));
}

TEST_F(ElementDropTest, SnapshotsGoToTheCellsThatFollow) {
    const Id dark = controller().session().keepSnapshot("Dark", nullptr);
    controller().setParameter(*findParameter("view.exposureEv"), {Scope::View, 0}, 2.0f);
    const Id bright = controller().session().keepSnapshot("Bright", nullptr);
    controller().setParameter(*findParameter("view.exposureEv"), {Scope::View, 0}, 0.0f);
    WallPlan plan;
    plan.columns.compared = Compared::Materials;
    wall().setPlan(plan);
    wall().setOn(true);
    ASSERT_TRUE(isSettled());
    const QStringList lines = drop(*draggedSnapshots({bright, dark}), centreOf(1));
    EXPECT_EQ(lines.size(), 2);
    const auto exposureOf = [](std::size_t cell) {
        return documentOf(document(), wall().cells()[cell].cell)->view.exposureEv;
    };
    EXPECT_FLOAT_EQ(exposureOf(0), 0.0f);
    EXPECT_FLOAT_EQ(exposureOf(1), 2.0f);
    EXPECT_FLOAT_EQ(exposureOf(2), 0.0f);
    EXPECT_EQ(wall().cells()[2].own.element(CellElement::Snapshot), dark);

    // A third has no cell: said, not dropped in silence.
    EXPECT_THAT(drop(*draggedSnapshots({bright, dark, bright}), centreOf(1)).last().toStdString(),
                testing::HasSubstr("no cells for the other 1"));
    wall().setOn(false);
    controller().session().removeSnapshot(bright);
    EXPECT_EQ(documentOf(document(), {0, {}, {}, bright}).error().message,
              "the snapshot of this cell was removed; choose another one");
}

TEST_F(ElementDropTest, OntoThePictureAMaterialCoversTheMeshUnderThePointer) {
    ASSERT_TRUE(isSettled());
    const QPoint middle = viewport().rect().center();
    ASSERT_NE(viewport().meshAt(middle), 0u);
    const QStringList lines = drop(*draggedMaterial("Gold"), middle);
    ASSERT_EQ(lines.size(), 1);
    EXPECT_THAT(lines[0].toStdString(), testing::HasSubstr("with Gold"));
    EXPECT_EQ(document().mesh(viewport().meshAt(middle))->material, materialNamed("Gold"));
    EXPECT_EQ(undoCount(), steps + 1);

    // Beside all meshes: not taken, and said what to do.
    const QStringList missed = drop(*draggedMaterial("Clay"), QPoint(3, 3), false);
    ASSERT_EQ(missed.size(), 1);
    EXPECT_THAT(missed[0].toStdString(), testing::HasSubstr("Drop it on a mesh"));
    EXPECT_EQ(undoCount(), steps + 1);
}

TEST_F(ElementDropTest, OntoThePictureASnapshotIsRestored) {
    const Id kept = controller().session().keepSnapshot("Kept", nullptr);
    controller().setParameter(*findParameter("view.exposureEv"), {Scope::View, 0}, 2.0f);
    EXPECT_EQ(drop(*draggedSnapshots({kept}), viewport().rect().center()),
              QStringList{QStringLiteral("Restore Kept")});
    EXPECT_FLOAT_EQ(document().view.exposureEv, 0.0f);
    drop(*draggedSnapshots({kept, kept}), viewport().rect().center(), false);
}

TEST_F(ElementDropTest, OntoAMeshInTheListAMaterialCoversIt) {
    const Id mesh = document().meshes.front().id;
    const QModelIndex row = scene().indexOf({Scope::Mesh, mesh});
    EXPECT_TRUE(scene().flags(row).testFlag(Qt::ItemIsDropEnabled));
    const Data gold = draggedMaterial("Gold");
    ASSERT_TRUE(scene().canDropMimeData(gold.get(), Qt::CopyAction, -1, -1, row));
    EXPECT_FALSE(scene().canDropMimeData(
        gold.get(), Qt::CopyAction, -1, -1,
        scene().indexOf({Scope::Material, document().materials.front().id})));
    EXPECT_TRUE(scene().dropMimeData(gold.get(), Qt::CopyAction, -1, -1, row));
    EXPECT_EQ(document().mesh(mesh)->material, materialNamed("Gold"));
    EXPECT_EQ(undoCount(), steps + 1);
}

TEST_F(ElementDropTest, WhatIsNoLongerThereIsNotTaken) {
    const Data gold = draggedMaterial("Gold");
    EXPECT_TRUE(draggedElements(*gold, controller().session()));
    controller().removeMaterial(materialNamed("Gold"));
    EXPECT_FALSE(draggedElements(*gold, controller().session()));
    QMimeData broken; // from whoever
    broken.setData(QLatin1String(kElementsMime), QByteArray("nonsense"));
    EXPECT_FALSE(draggedElements(broken, controller().session()));
}

} // namespace
} // namespace patina::editor
