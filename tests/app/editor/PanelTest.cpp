// Panels and document together, by real events on the widgets of the window.

#include "core/light/Light.h"
#include "core/material/Material.h"
#include "tests/app/editor/EditorFixture.h"
#include "tests/support/Events.h"

#include "app/editor/panel/LightsPanel.h"
#include "app/editor/panel/MaterialPanel.h"
#include "app/editor/panel/ModelPanel.h"
#include "app/editor/panel/ParameterList.h"
#include "app/editor/panel/SceneModel.h"
#include "app/editor/panel/ScenePanel.h"
#include "app/editor/viewport/DropTarget.h"
#include "app/editor/widget/ColorButton.h"
#include "app/editor/widget/ColorPicker.h"
#include "app/editor/widget/FurnacePlot.h"
#include "app/editor/widget/MapSlotWidget.h"
#include "app/editor/widget/NumberField.h"
#include "app/editor/widget/RowLabel.h"
#include "app/editor/widget/SkyGallery.h"
#include "app/editor/widget/Slider.h"
#include "core/edit/EditSession.h"
#include "core/io/ImageIO.h"
#include "core/light/Lights.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QDockWidget>
#include <QDropEvent>
#include <QLabel>
#include <QLineEdit>
#include <QMimeData>
#include <QPushButton>
#include <QToolButton>
#include <QTreeView>
#include <QTreeWidget>

namespace patina::editor {
namespace {

struct PanelTest : EditorTest {
    static ParameterRow& row(std::string_view id) {
        ParameterRow* found = nullptr;
        for (ParameterList* list : window->findChildren<ParameterList*>())
            if (ParameterRow* candidate = list->row(id))
                found = candidate;
        EXPECT_NE(found, nullptr) << id;
        return *found;
    }
    template <class Widget>
    static Widget& in(std::string_view id) {
        auto* widget = row(id).findChild<Widget*>();
        EXPECT_NE(widget, nullptr) << id;
        return *widget;
    }
    static void drag(QWidget& widget, QPoint from, std::initializer_list<int> way) {
        QTest::mousePress(&widget, Qt::LeftButton, {}, from);
        for (const int pixels : way)
            QTest::mouseMove(&widget, from + QPoint(pixels, 0));
        QTest::mouseRelease(&widget, Qt::LeftButton, {}, from + QPoint(*(way.end() - 1), 0));
    }
    static void drop(QWidget& widget, const QString& file) {
        QMimeData data;
        data.setUrls({QUrl::fromLocalFile(file)});
        QDragEnterEvent enter(widget.rect().center(), Qt::CopyAction, &data, Qt::LeftButton, {});
        QApplication::sendEvent(&widget, &enter);
        EXPECT_TRUE(enter.isAccepted());
        QDropEvent event(QPointF(widget.rect().center()), Qt::CopyAction, &data, Qt::LeftButton,
                         {});
        QApplication::sendEvent(&widget, &event);
        EXPECT_TRUE(event.isAccepted());
    }
    QString writeImage(const QString& name) {
        Image image(8, 8, 3, PixelType::U8, ColorEncoding::Srgb);
        std::fill(image.u8().begin(), image.u8().end(), std::uint8_t{77});
        const QString file = folder.filePath(name);
        EXPECT_TRUE(saveImage(session->worker, image, file.toStdString()).ok());
        return file;
    }
    static constexpr const char* kRough = "material.perceptualRoughness";
    static float roughness() { return selectedMaterial().perceptualRoughness; }
};

TEST_F(PanelTest, ScrubbingRoughnessIsOneUndoStep) {
    const float before = roughness();
    drag(in<NumberField>(kRough), {30, 12}, {-20, -40, -60, -90});
    EXPECT_NEAR(roughness(), before - 0.3f, 0.002f);
    EXPECT_EQ(undoCount(), 1);
    window->actions().undo->trigger();
    EXPECT_EQ(roughness(), before);
    EXPECT_EQ(in<NumberField>(kRough).value(), before);
    window->actions().redo->trigger();
    EXPECT_NEAR(in<NumberField>(kRough).value(), before - 0.3f, 0.002f);
}

TEST_F(PanelTest, AScrubThatReturnsLeavesNoStep) {
    const float before = roughness();
    drag(in<NumberField>(kRough), {30, 12}, {-20, -70, -5, 0});
    EXPECT_EQ(roughness(), before);
    EXPECT_EQ(undoCount(), 0);
    EXPECT_FALSE(controller().isModified());
}

TEST_F(PanelTest, TwoScrubsAreTwoSteps) {
    drag(in<NumberField>(kRough), {30, 12}, {-20, -40});
    drag(in<NumberField>(kRough), {30, 12}, {-20, -40});
    EXPECT_EQ(undoCount(), 2);
}

TEST_F(PanelTest, TheSliderIsOneStepToo) {
    Slider& slider = in<Slider>(kRough);
    const float before = roughness();
    drag(slider, {slider.handleX(), 12}, {-10, -25, -30});
    EXPECT_LT(roughness(), before);
    EXPECT_EQ(undoCount(), 1);
    EXPECT_EQ(in<NumberField>(kRough).value(), roughness());
}

TEST_F(PanelTest, TypingSetsTheValueAndClamps) {
    NumberField& field = in<NumberField>(kRough);
    QTest::mouseClick(&field, Qt::LeftButton, {}, {20, 12});
    QTest::keyClicks(&field, QStringLiteral("0.25"));
    QTest::keyClick(&field, Qt::Key_Return);
    EXPECT_EQ(roughness(), 0.25f);
    QTest::mouseClick(&field, Qt::LeftButton, {}, {20, 12});
    QTest::keyClicks(&field, QStringLiteral("4"));
    QTest::keyClick(&field, Qt::Key_Return);
    EXPECT_EQ(roughness(), 1.0f);
    EXPECT_EQ(field.text().toStdString(), "1.00");
    EXPECT_EQ(undoCount(), 2);
}

TEST_F(PanelTest, ADoubleClickOnTheLabelResets) {
    const Target target{Scope::Material, selectedMaterial().id};
    controller().clearMap(parameter("material.roughness.map"), target);
    controller().setParameter(parameter(kRough), target, 0.9f);
    QTest::mouseDClick(&in<RowLabel>(kRough), Qt::LeftButton);
    EXPECT_EQ(roughness(), Material{}.perceptualRoughness);
    EXPECT_EQ(undoCount(), 3);
}

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

TEST_F(PanelTest, RowsShowTheSelectedMaterialOnly) {
    const Material& first = document().materials.front();
    const Material& last = document().materials.back();
    ASSERT_NE(first.id, last.id);
    session->selection.selectMaterial(first.id);
    controller().setParameter(parameter(kRough), {Scope::Material, first.id}, 0.21f);
    EXPECT_FLOAT_EQ(in<NumberField>(kRough).value(), 0.21f);
    controller().setParameter(parameter(kRough), {Scope::Material, last.id}, 0.87f);
    EXPECT_FLOAT_EQ(in<NumberField>(kRough).value(), 0.21f);
    session->selection.selectMaterial(last.id);
    EXPECT_FLOAT_EQ(in<NumberField>(kRough).value(), 0.87f);
    EXPECT_EQ(find<QComboBox>(*window, QStringLiteral("Material"))->currentText().toStdString(),
              last.name);
}

TEST_F(PanelTest, EveryParameterOfAPanelHasARow) {
    for (const ParameterInfo& info : parameters()) {
        if (info.scope == Scope::Mesh || info.type == ParameterType::Text ||
            info.type == ParameterType::Reference || info.id == "environment.kind" ||
            info.id == "environment.image" || info.id == "light.enabled" ||
            info.id == "light.solo" || info.id == "softbox.enabled")
            continue; // in the tree, the lists, the gallery and the buttons
        ParameterRow& found = row(info.id);
        EXPECT_EQ(&found.info(), findParameter(info.id));
    }
}

TEST_F(PanelTest, RowsThatMakeNoSenseAreHidden) {
    const Target target{Scope::Material, selectedMaterial().id};
    EXPECT_TRUE(row("material.alphaCutoff").isHidden());
    QComboBox& mode = in<QComboBox>("material.alphaMode");
    mode.setCurrentIndex(static_cast<int>(AlphaMode::Mask));
    Q_EMIT mode.activated(mode.currentIndex());
    EXPECT_EQ(selectedMaterial().alphaMode, AlphaMode::Mask);
    EXPECT_FALSE(row("material.alphaCutoff").isHidden());
    controller().undoStack().undo();
    EXPECT_TRUE(row("material.alphaCutoff").isHidden());
    EXPECT_EQ(mode.currentIndex(), 0);
    EXPECT_EQ(target.id, selectedMaterial().id);
}

TEST_F(PanelTest, ADragInThePickerIsOneStepAndItsValuesAreLinear) {
    auto& button = in<ColorButton>("material.baseColor");
    button.click();
    ColorPicker* picker = button.picker();
    ASSERT_TRUE(eventually([&] { return picker->isVisible(); }));
    auto* square = picker->findChild<SaturationValueSquare*>();
    drag(*square, {20, 80}, {30, 60, 90});
    EXPECT_EQ(undoCount(), 1);
    auto* hex = picker->findChild<QLineEdit*>(QString(), Qt::FindDirectChildrenOnly);
    ASSERT_NE(hex, nullptr);
    hex->selectAll();
    QTest::keyClicks(hex, QStringLiteral("#808080"));
    QTest::keyClick(hex, Qt::Key_Return);
    EXPECT_EQ(undoCount(), 2);
    EXPECT_NEAR(selectedMaterial().baseColor.x, 0.2158605f, 1e-5);
    picker->hide();
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

// The new row is painted before the frame that may have to be compiled for.
TEST_F(PanelTest, ANewLightIsInTheListBeforeItIsInThePicture) {
    auto& lights = *window->findChild<LightsPanel*>();
    auto* list = lights.findChild<QTreeWidget*>();
    for (QWidget* dock = &lights; dock; dock = dock->parentWidget())
        if (auto* docked = qobject_cast<QDockWidget*>(dock))
            docked->raise();
    ASSERT_TRUE(eventually([&] { return list->isVisible() || lights.isVisible(); }));
    ViewportWidget& viewport = window->viewport();
    ASSERT_TRUE(eventually([&] { // nothing else is drawn
        return viewport.frameSize() == viewport.size() * viewport.devicePixelRatioF();
    }));
    QStringList order;
    struct Painted : QObject {
        QStringList& order;
        explicit Painted(QStringList& o)
            : order(o) {}
        bool eventFilter(QObject*, QEvent* event) override {
            if (event->type() == QEvent::Paint)
                order << QStringLiteral("list");
            return false;
        }
    } painted(order);
    list->viewport()->installEventFilter(&painted);
    const auto frames = QObject::connect(&viewport, &ViewportWidget::frameRendered,
                                         [&] { order << QStringLiteral("frame"); });
    QTest::mouseClick(find<QToolButton>(lights, QStringLiteral("Add a rectangle light")),
                      Qt::LeftButton);
    ASSERT_EQ(document().lights.size(), 1u);
    order.clear();
    ASSERT_TRUE(eventually([&] { return order.contains(QStringLiteral("frame")); }));
    QObject::disconnect(frames);
    list->viewport()->removeEventFilter(&painted);
    EXPECT_EQ(order.front(), QStringLiteral("list")) << order.join(QLatin1Char(' ')).toStdString();
    // A second one stands beside it, and both are seen.
    QTest::mouseClick(find<QToolButton>(lights, QStringLiteral("Add a rectangle light")),
                      Qt::LeftButton);
    ASSERT_EQ(document().lights.size(), 2u);
    EXPECT_GT(glm::length(document().lights[1].position - document().lights[0].position), 0.1f);
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

TEST_F(PanelTest, TheTreeShowsRenamesHidesAndSelects) {
    QTreeView* tree = window->findChild<ScenePanel*>()->tree();
    auto* model = qobject_cast<SceneModel*>(tree->model());
    ASSERT_NE(model, nullptr);
    ASSERT_EQ(model->rowCount(model->branchIndex(SceneModel::Meshes)),
              static_cast<int>(document().meshes.size()));
    const Id mesh = document().meshes[1].id;
    const QModelIndex index = model->indexOf({Scope::Mesh, mesh});
    tree->setCurrentIndex(index);
    EXPECT_EQ(session->selection.mesh(), mesh);
    EXPECT_EQ(session->selection.material(), document().mesh(mesh)->material);

    const QRect eye = tree->visualRect(index.siblingAtColumn(SceneModel::MarkColumn));
    QTest::mouseClick(tree->viewport(), Qt::LeftButton, {}, eye.center());
    EXPECT_FALSE(document().mesh(mesh)->visible);
    EXPECT_EQ(controller().undoStack().undoText().toStdString(),
              "Hide " + document().mesh(mesh)->name);
    QTest::mouseClick(tree->viewport(), Qt::LeftButton, {}, eye.center());
    EXPECT_TRUE(document().mesh(mesh)->visible);

    tree->setCurrentIndex(index);
    tree->edit(index);
    auto* editor = tree->viewport()->findChild<QLineEdit*>();
    ASSERT_NE(editor, nullptr);
    editor->setText(QStringLiteral("Handle"));
    QTest::keyClick(editor, Qt::Key_Return);
    EXPECT_TRUE(eventually([&] { return document().mesh(mesh)->name == "Handle"; }));
    EXPECT_EQ(model->data(index, Qt::DisplayRole).toString(), QStringLiteral("Handle"));
}

TEST_F(PanelTest, LightsAreAddedSwitchedRenamedAndRemoved) {
    auto* panel = window->findChild<LightsPanel*>();
    const std::size_t before = document().lights.size();
    find<QToolButton>(*panel, QStringLiteral("Add a point light"))->click();
    ASSERT_EQ(document().lights.size(), before + 1);
    const Id id = document().lights.back().id;
    EXPECT_EQ(session->selection.light(), id);
    EXPECT_FALSE(row("light.position").isHidden());
    EXPECT_TRUE(row("light.azimuthDeg").isHidden());

    QTreeWidget* list = panel->list();
    QTreeWidgetItem* item = list->topLevelItem(list->topLevelItemCount() - 1);
    item->setCheckState(0, Qt::Unchecked);
    EXPECT_FALSE(document().light(id)->enabled);
    item->setText(0, QStringLiteral("Lamp"));
    EXPECT_EQ(document().light(id)->name, "Lamp");
    EXPECT_FALSE(document().light(id)->enabled);
    EXPECT_EQ(undoCount(), 3);

    find<QToolButton>(*panel, QStringLiteral("Add a directional light"))->click();
    EXPECT_TRUE(row("light.position").isHidden());
    EXPECT_FALSE(row("light.azimuthDeg").isHidden());
    find<QToolButton>(*panel, QStringLiteral("Remove the selected light"))->click();
    EXPECT_EQ(document().lights.size(), before + 1);
    while (controller().undoStack().canUndo())
        controller().undoStack().undo();
    EXPECT_EQ(document().lights.size(), before);
    EXPECT_EQ(list->topLevelItemCount(), static_cast<int>(before));
}

TEST_F(PanelTest, LightsOfEveryTypeShowTheirOwnRowsAndUnits) {
    auto* panel = window->findChild<LightsPanel*>();
    QTreeWidget* list = panel->list();
    const struct {
        const char* button;
        LightType type;
        const char* unit;
        const char* shown;
        const char* hidden;
    } kinds[] = {
        {"Add a spot light", LightType::Spot, "cd", "light.outerConeDeg", "light.radius"},
        {"Add a sphere light", LightType::Sphere, "nit", "light.radius", "light.range"},
        {"Add a rectangle light", LightType::Rectangle, "nit", "light.width", "light.castsShadow"},
        {"Add a directional light", LightType::Directional, "lx", "light.castsShadow",
         "light.position"}};
    auto* intensity = row("light.intensity").findChild<NumberField*>();
    for (const auto& kind : kinds) {
        find<QToolButton>(*panel, QString::fromLatin1(kind.button))->click();
        EXPECT_EQ(document().lights.back().type, kind.type);
        EXPECT_TRUE(intensity->text().endsWith(QString::fromLatin1(kind.unit)))
            << intensity->text().toStdString();
        EXPECT_FALSE(row(kind.shown).isHidden()) << kind.shown;
        EXPECT_TRUE(row(kind.hidden).isHidden()) << kind.hidden;
    }
    // Rows that a switch turns off stay where they are, so that a second click meets the switch.
    window->findChild<QDockWidget*>(QStringLiteral("lights"))->raise();
    EXPECT_FALSE(row("light.temperatureK").isEnabled());
    EXPECT_TRUE(row("light.color").isEnabled());
    QCheckBox& temperature = in<QCheckBox>("light.usesTemperature");
    ASSERT_TRUE(eventually([&] { return temperature.isVisible(); }));
    test::handleEvents(); // the layout of the rows
    const QPoint place = temperature.mapTo(window.get(), QPoint());
    QTest::mouseClick(&temperature, Qt::LeftButton, {}, {8, 12});
    test::handleEvents();
    EXPECT_TRUE(document().light(session->selection.light())->usesTemperature);
    EXPECT_EQ(temperature.mapTo(window.get(), QPoint()), place);
    EXPECT_TRUE(row("light.temperatureK").isEnabled());
    EXPECT_FALSE(row("light.temperatureK").isHidden());
    EXPECT_FALSE(row("light.color").isEnabled());
    EXPECT_FALSE(row("light.color").isHidden());

    const QString pictures = qEnvironmentVariable("PATINA_SCREENSHOTS", folder.path());
    list->setCurrentItem(list->topLevelItem(list->topLevelItemCount() - 4)); // the spot
    window->findChild<QDockWidget*>(QStringLiteral("lights"))->raise();
    ASSERT_TRUE(QDir().mkpath(pictures));
    EXPECT_TRUE(window->grab().save(QDir(pictures).filePath(QStringLiteral("lights-panel.png"))));
}

TEST_F(PanelTest, SoloAndDuplicateAreInTheList) {
    auto* panel = window->findChild<LightsPanel*>();
    find<QToolButton>(*panel, QStringLiteral("Add a point light"))->click();
    const Id id = session->selection.light();
    QTreeWidget* list = panel->list();
    list->topLevelItem(list->topLevelItemCount() - 1)->setCheckState(1, Qt::Checked);
    EXPECT_TRUE(document().light(id)->solo);
    EXPECT_TRUE(document().light(id)->enabled);
    const std::size_t before = document().lights.size();
    find<QToolButton>(*panel, QStringLiteral("Duplicate the selected light"))->click();
    ASSERT_EQ(document().lights.size(), before + 1);
    EXPECT_NE(session->selection.light(), id);
    EXPECT_TRUE(document().light(session->selection.light())->solo);
    controller().undoStack().undo();
    controller().undoStack().undo();
    EXPECT_FALSE(document().light(id)->solo);
    EXPECT_EQ(list->topLevelItem(list->topLevelItemCount() - 1)->checkState(1), Qt::Unchecked);
}

TEST_F(PanelTest, SwitchingALightsTypeKeepsWhatItDoesAndIsOneStep) {
    auto* panel = window->findChild<LightsPanel*>();
    find<QToolButton>(*panel, QStringLiteral("Add a directional light"))->click();
    const Id id = session->selection.light();
    const Light before = *document().light(id);
    const int steps = undoCount();
    controller().setParameter(parameter("light.type"), {Scope::Light, id},
                              static_cast<int>(LightType::Spot));
    const Light after = *document().light(id);
    EXPECT_EQ(after.type, LightType::Spot);
    const glm::vec3 center = document().bounds().center();
    EXPECT_NEAR(illuminanceAt(after, center), before.intensity, 1e-3f * before.intensity);
    EXPECT_EQ(undoCount(), steps + 1);
    controller().undoStack().undo();
    EXPECT_EQ(*document().light(id), before); // to the bit
    controller().undoStack().redo();
    EXPECT_EQ(*document().light(id), after);
}

TEST_F(PanelTest, TheGalleryLightsTheScene) {
    auto* gallery = window->findChild<SkyGallery*>();
    auto* sunset = find<QToolButton>(*gallery, QStringLiteral("Environment Sunset"));
    ASSERT_NE(sunset, nullptr);
    EXPECT_FALSE(sunset->isChecked());
    sunset->click();
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(document().environment().source, "builtin:sunset");
    EXPECT_TRUE(sunset->isChecked());
    EXPECT_EQ(undoCount(), 1);
    controller().undoStack().undo();
    EXPECT_FALSE(sunset->isChecked());
}

TEST_F(PanelTest, TheLibraryChangesTheLookAndKeepsTheName) {
    const std::string name = selectedMaterial().name;
    controller().applyLibraryMaterial(selectedMaterial().id, QStringLiteral("gold"));
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(selectedMaterial().name, name);
    EXPECT_EQ(selectedMaterial().metallic, 1.0f);
    EXPECT_EQ(undoCount(), 1);
}

TEST_F(PanelTest, TheModelPanelOffersWhatApplies) {
    // Rows that would do nothing are hidden, and come with their choice.
    EXPECT_TRUE(row("model.ior").isHidden());
    EXPECT_TRUE(row("model.conductorN").isHidden());
    EXPECT_TRUE(row("material.diffuseRoughness").isHidden());
    auto& fresnel = in<QComboBox>("model.fresnel");
    fresnel.setCurrentIndex(static_cast<int>(Fresnel::Dielectric));
    Q_EMIT fresnel.activated(fresnel.currentIndex());
    EXPECT_EQ(document().model.fresnel, Fresnel::Dielectric);
    EXPECT_FALSE(row("model.ior").isHidden());
    EXPECT_TRUE(row("model.f90").isHidden());
    EXPECT_TRUE(row("model.conductorK").isHidden());
    auto& diffuse = in<QComboBox>("model.diffuse");
    diffuse.setCurrentIndex(static_cast<int>(Diffuse::Eon));
    Q_EMIT diffuse.activated(diffuse.currentIndex());
    EXPECT_FALSE(row("material.diffuseRoughness").isHidden());
    EXPECT_EQ(undoCount(), 2);
}

TEST_F(PanelTest, AModelPresetIsOneUndoStepAndKeepsTheNumbers) {
    auto* panel = window->findChild<ModelPanel*>();
    ASSERT_NE(panel, nullptr);
    window->findChild<QDockWidget*>(QStringLiteral("model"))->raise();
    const auto button = [&](const char* text) {
        for (QPushButton* each : panel->findChildren<QPushButton*>())
            if (each->text() == QLatin1String(text))
                return each;
        return static_cast<QPushButton*>(nullptr);
    };
    ASSERT_NE(button("Unreal Engine 4"), nullptr);
    EXPECT_TRUE(button("Patina")->isChecked());
    controller().setParameter(parameter("model.ior"), {Scope::Model, 0}, 1.33f);
    auto* furnace = panel->findChild<FurnacePlot*>();
    EXPECT_NEAR(furnace->returned(1.0f), 1.0f, 1e-4f);

    QTest::mouseClick(button("Unreal Engine 4"), Qt::LeftButton);
    EXPECT_EQ(document().model.visibility, Visibility::SchlickDirect);
    EXPECT_EQ(document().model.lobeDirection, LobeDirection::Mirror);
    EXPECT_FALSE(document().model.multiScatter);
    EXPECT_EQ(document().model.ior, 1.33f);
    EXPECT_TRUE(button("Unreal Engine 4")->isChecked());
    EXPECT_FALSE(button("Patina")->isChecked());
    // 2 ∫ E mu dmu of GGX with Schlick's k = alpha / 2 at roughness 0.5 and 1.
    EXPECT_NEAR(furnace->returned(0.5f), 0.8017f, 0.003f);
    EXPECT_NEAR(furnace->returned(1.0f), 0.3766f, 0.01f);
    QTest::mouseClick(button("Unreal Engine 4"), Qt::LeftButton); // again: nothing to do
    EXPECT_TRUE(button("Unreal Engine 4")->isChecked());
    EXPECT_EQ(undoCount(), 2);
    window->actions().undo->trigger();
    EXPECT_EQ(document().model.visibility, Visibility::SmithCorrelated);
    EXPECT_TRUE(button("Patina")->isChecked());

    // Metals by name, when there are exact conductors.
    EXPECT_TRUE(button("Copper")->parentWidget()->isHidden());
    controller().setParameter(parameter("model.fresnel"), {Scope::Model, 0},
                              static_cast<int>(Fresnel::Conductor));
    EXPECT_FALSE(button("Copper")->parentWidget()->isHidden());
    button("Copper")->click();
    EXPECT_NEAR(document().model.conductorN.y, 1.116f, 1e-4f);
    EXPECT_TRUE(button("Copper")->isChecked());
}

} // namespace
} // namespace patina::editor
