// Panels and document together, by real events on the widgets of the window.

#include "tests/app/editor/PanelFixture.h"

#include "app/editor/panel/ModelPanel.h"
#include "app/editor/panel/SceneModel.h"
#include "app/editor/panel/ScenePanel.h"
#include "app/editor/widget/ColorButton.h"
#include "app/editor/widget/ColorPicker.h"
#include "app/editor/widget/FurnacePlot.h"
#include "app/editor/widget/NumberField.h"
#include "app/editor/widget/RowLabel.h"
#include "app/editor/widget/SkyGallery.h"
#include "app/editor/widget/Slider.h"
#include "core/edit/EditSession.h"

#include <QComboBox>
#include <QDockWidget>
#include <QLineEdit>
#include <QPushButton>
#include <QToolButton>
#include <QTreeView>

namespace patina::editor {
namespace {

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
