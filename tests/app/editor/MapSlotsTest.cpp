// Images dropped on map slots and on the window, and what slots show of their maps.
#include "tests/app/editor/PanelFixture.h"

#include "app/editor/panel/SceneModel.h"
#include "app/editor/panel/ScenePanel.h"
#include "app/editor/viewport/DropTarget.h"
#include "app/editor/widget/MapSlotWidget.h"
#include "app/editor/widget/NumberField.h"
#include "app/editor/widget/RowLabel.h"

#include <QFile>
#include <QLabel>
#include <QToolButton>
#include <QTreeView>

namespace patina::editor {
namespace {

// A map multiplies its number: 0 would switch a metallic map off, 0.5 halve the roughness painted.
TEST_F(PanelTest, ADoubleClickOnTheLabelOfAMapShowsTheMapAsItIs) {
    const Target target{Scope::Material, selectedMaterial().id};
    controller().applyLibraryMaterial(target.id, QStringLiteral("worn-painted-metal"));
    ASSERT_TRUE(settled(*session));
    ASSERT_TRUE(selectedMaterial().metallicMap.assigned());
    for (const char* id : {"material.metallic", kRough, "material.baseColor"}) {
        const ParameterInfo& info = parameter(id);
        const bool color = info.type == ParameterType::Color;
        controller().setParameter(info, target,
                                  color ? ParameterValue(glm::vec3(0.2f)) : ParameterValue(0.3f));
        QTest::mouseDClick(&in<RowLabel>(id), Qt::LeftButton);
        EXPECT_EQ(info.get(document(), target.id),
                  color ? ParameterValue(glm::vec3(1.0f)) : ParameterValue(1.0f))
            << id;
        EXPECT_TRUE(in<RowLabel>(id).isAtDefault()) << id;
    }
    controller().clearMap(parameter("material.metallic.map"), target);
    EXPECT_FALSE(in<RowLabel>("material.metallic").isAtDefault());
    QTest::mouseDClick(&in<RowLabel>("material.metallic"), Qt::LeftButton);
    EXPECT_EQ(selectedMaterial().metallic, 0.0f);
}

TEST_F(PanelTest, AnImageDroppedOnAMapSlotGoesThere) {
    const QString file = writeImage(QStringLiteral("rough.png"));
    drop(in<MapSlotWidget>("material.perceptualRoughness.map"), file);
    ASSERT_TRUE(settled(*session));
    const MapSlot& slot = selectedMaterial().perceptualRoughnessMap;
    EXPECT_EQ(slot.source, file.toStdString());
    ASSERT_NE(slot.image, nullptr);
    EXPECT_EQ(slot.image->encoding(), ColorEncoding::Data);
    EXPECT_EQ(undoCount(), 1);
    find<QToolButton>(row("material.perceptualRoughness.map"),
                      QStringLiteral("Remove Roughness map"))
        ->click();
    EXPECT_FALSE(selectedMaterial().perceptualRoughnessMap.assigned());
}

TEST_F(PanelTest, AnImageDroppedElsewhereBecomesTheBaseColour) {
    const QString file = writeImage(QStringLiteral("color.png"));
    drop(*window, file);
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(selectedMaterial().baseColorMap.source, file.toStdString());
    ASSERT_NE(selectedMaterial().baseColorMap.image, nullptr);
    EXPECT_EQ(selectedMaterial().baseColorMap.image->encoding(), ColorEncoding::Srgb);
}

// Five maps of a model in one go: each to its slot, shown before they are let go, one undo step.
TEST_F(PanelTest, ImagesDroppedTogetherGoByTheirNames) {
    selectMaterialWithoutMaps();
    QList<QUrl> urls;
    for (const char* name : {"monkey_color.png", "monkey_metallic.png", "monkey_roughness.png",
                             "monkey_normal.png", "monkey_ao.png", "notes.png"})
        urls << QUrl::fromLocalFile(writeImage(QString::fromLatin1(name)));
    QMimeData data;
    data.setUrls(urls);
    QWidget& viewport = *window->findChild<ViewportWidget*>();
    auto* hint = viewport.findChild<DropHint*>();
    ASSERT_NE(hint, nullptr);
    EXPECT_TRUE(hint->lines().isEmpty());
    QDragEnterEvent enter(window->rect().center(), Qt::CopyAction, &data, Qt::LeftButton, {});
    QApplication::sendEvent(window.get(), &enter);
    EXPECT_TRUE(enter.isAccepted());
    EXPECT_FALSE(hint->isHidden()) << "the target is lit";
    const std::string said = hint->lines().join(QLatin1Char('\n')).toStdString();
    EXPECT_THAT(said, ::testing::HasSubstr("“" + selectedMaterial().name + "”"));
    for (const char* line :
         {"Base colour map ← monkey_color.png", "Metallic map ← monkey_metallic.png",
          "Roughness map ← monkey_roughness.png", "Normal map ← monkey_normal.png",
          "Occlusion map ← monkey_ao.png"})
        EXPECT_THAT(said, ::testing::HasSubstr(line));
    EXPECT_THAT(said, ::testing::HasSubstr("notes.png")) << "what is left out is said, too";
    if (const QString pictures = qEnvironmentVariable("PATINA_SCREENSHOTS"); !pictures.isEmpty()) {
        ASSERT_TRUE(QDir().mkpath(pictures));
        EXPECT_TRUE(window->grab().save(QDir(pictures).filePath(QStringLiteral("drop-hint.png"))));
    }
    QDropEvent event(QPointF(window->rect().center()), Qt::CopyAction, &data, Qt::LeftButton, {});
    QApplication::sendEvent(window.get(), &event);
    EXPECT_TRUE(hint->isHidden());
    ASSERT_TRUE(settled(*session));
    const Material& m = selectedMaterial();
    EXPECT_EQ(m.baseColorMap.source, urls[0].toLocalFile().toStdString());
    EXPECT_EQ(m.metallicMap.source, urls[1].toLocalFile().toStdString());
    EXPECT_EQ(m.perceptualRoughnessMap.source, urls[2].toLocalFile().toStdString());
    EXPECT_EQ(m.normalMap.source, urls[3].toLocalFile().toStdString());
    EXPECT_EQ(m.occlusionMap.source, urls[4].toLocalFile().toStdString());
    for (const MapSlot* slot : {&m.baseColorMap, &m.metallicMap, &m.perceptualRoughnessMap,
                                &m.normalMap, &m.occlusionMap})
        EXPECT_NE(slot->image, nullptr) << slot->source;
    EXPECT_EQ(m.metallic, 1.0f) << "a map comes with its factor";
    EXPECT_EQ(m.normalMap.image->encoding(), ColorEncoding::Data);
    ASSERT_EQ(undoCount(), 1);
    controller().undoStack().undo();
    for (const MapSlot* slot : {&m.baseColorMap, &m.metallicMap, &m.perceptualRoughnessMap,
                                &m.normalMap, &m.occlusionMap})
        EXPECT_FALSE(slot->assigned());
}

// A slot takes one image; several are none of its business, and the window has them.
TEST_F(PanelTest, SeveralImagesOverASlotGoByTheirNames) {
    selectMaterialWithoutMaps();
    QMimeData data;
    data.setUrls({QUrl::fromLocalFile(writeImage(QStringLiteral("a_normal.png"))),
                  QUrl::fromLocalFile(writeImage(QStringLiteral("a_rough.png")))});
    auto& slot = in<MapSlotWidget>("material.baseColor.map");
    const auto* hint = window->findChild<DropHint*>();
    QDragEnterEvent enter(slot.rect().center(), Qt::CopyAction, &data, Qt::LeftButton, {});
    QApplication::sendEvent(&slot, &enter);
    EXPECT_TRUE(enter.isAccepted());
    EXPECT_FALSE(hint->isHidden()) << "the window took them";
    QDropEvent event(QPointF(slot.rect().center()), Qt::CopyAction, &data, Qt::LeftButton, {});
    QApplication::sendEvent(&slot, &event);
    EXPECT_TRUE(hint->isHidden());
    ASSERT_TRUE(settled(*session));
    EXPECT_FALSE(selectedMaterial().baseColorMap.assigned());
    EXPECT_TRUE(selectedMaterial().normalMap.assigned());
    EXPECT_TRUE(selectedMaterial().perceptualRoughnessMap.assigned());
    EXPECT_EQ(undoCount(), 1);
}

// Images that could not be read are marked where they are missed, by what is wrong with them.
TEST_F(PanelTest, SlotsAndMaterialsSayWhichImagesCouldNotBeRead) {
    const Id before = session->selection.material();
    const QString model = folder.filePath(QStringLiteral("m.obj"));
    const auto write = [&](const char* name, const char* text) {
        QFile file(folder.filePath(QLatin1String(name)));
        ASSERT_TRUE(file.open(QIODevice::WriteOnly));
        file.write(text);
    };
    write("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
                   "usemtl Cloth\nf 1/1 2/2 3/3\n");
    write("m.mtl", "newmtl Cloth\nKd 0.5 0.5 0.5\nmap_Kd gone.png\nnorm empty.png\n");
    write("empty.png", "");
    std::vector<UserNotice> notices;
    const auto listening =
        QObject::connect(&controller(), &DocumentController::noticed,
                         [&](const UserNotice& notice) { notices.push_back(notice); });
    controller().openScene(model);
    ASSERT_TRUE(settled(*session));
    QObject::disconnect(listening);
    ASSERT_EQ(notices.size(), 1u);
    EXPECT_EQ(notices[0].kind, NoticeKind::Warning);
    EXPECT_THAT(notices[0].text.toStdString(), ::testing::HasSubstr("1 are missing and 1 damaged"));
    for (const char* file : {"gone.png", "empty.png"})
        EXPECT_EQ(notices[0].details.filter(QLatin1String(file)).size(), 1) << file << ": once";
    const auto facts = [](const char* id) {
        QStringList texts;
        for (const QLabel* label : in<MapSlotWidget>(id).findChildren<QLabel*>())
            texts << label->text();
        return texts.join(QLatin1Char(' ')).toStdString();
    };
    ASSERT_EQ(selectedMaterial().name, "Cloth");
    QApplication::processEvents();
    EXPECT_THAT(facts("material.baseColor.map"), ::testing::HasSubstr("missing"));
    EXPECT_THAT(facts("material.normalStrength.map"), ::testing::HasSubstr("damaged"));
    const QAbstractItemModel* list = window->findChild<ScenePanel*>()->tree()->model();
    const QModelIndex material = list->index(0, 0, list->index(1, 0));
    EXPECT_THAT(material.data(Qt::ToolTipRole).toString().toStdString(),
                ::testing::AllOf(::testing::HasSubstr("Base colour map is missing: gone.png"),
                                 ::testing::HasSubstr("Normal map is damaged: empty.png")));
    EXPECT_THAT(material.data(Qt::AccessibleDescriptionRole).toString().toStdString(),
                ::testing::HasSubstr("damaged"));
    const QModelIndex mark = material.siblingAtColumn(SceneModel::MarkColumn);
    EXPECT_FALSE(mark.data(Qt::DecorationRole).value<QIcon>().isNull());
    EXPECT_THAT(mark.data(Qt::ToolTipRole).toString().toStdString(),
                ::testing::HasSubstr("Base colour map is missing: gone.png"));
    // The next test begins as the first one did: ids are those of the scene.
    controller().newDocument();
    ASSERT_TRUE(settled(*session));
    session->selection.selectMaterial(before);
}

TEST_F(PanelTest, TilingIsEditedPerMap) {
    selectMaterialWithoutMaps();
    const Target target{Scope::Material, selectedMaterial().id};
    controller().setMap(parameter("material.baseColor.map"), target,
                        QStringLiteral("builtin:wood/baseColor"));
    ASSERT_TRUE(settled(*session));
    const int steps = undoCount();
    auto& slot = in<MapSlotWidget>("material.baseColor.map");
    find<QToolButton>(slot, QStringLiteral("Tiling of Base colour map"))->click();
    auto* scale = find<NumberField>(slot, QStringLiteral("Base colour map: Scale U"));
    ASSERT_NE(scale, nullptr);
    QTest::mouseClick(scale, Qt::LeftButton, {}, {20, 12});
    QTest::keyClicks(scale, QStringLiteral("3"));
    QTest::keyClick(scale, Qt::Key_Return);
    EXPECT_EQ(selectedMaterial().baseColorMap.uvScale.x, 3.0f);
    EXPECT_EQ(selectedMaterial().baseColorMap.uvScale.y, 1.0f);
    EXPECT_EQ(undoCount(), steps + 1);
}

} // namespace
} // namespace patina::editor
