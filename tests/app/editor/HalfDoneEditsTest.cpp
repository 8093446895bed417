// What happens to a number, name or colour that is half typed when the dock comes to show something
// else: nothing. It neither ends the program nor reaches another element.

#include "core/light/Light.h"
#include "core/material/Material.h"
#include "tests/app/editor/EditorFixture.h"

#include "app/editor/panel/LightsPanel.h"
#include "app/editor/panel/SoftboxList.h"
#include "app/editor/viewport/ViewLegend.h"
#include "app/editor/viewport/ViewState.h"
#include "app/editor/viewport/ViewStrip.h"
#include "app/editor/viewport/ViewThumb.h"
#include "app/editor/widget/ColorButton.h"
#include "app/editor/widget/ColorPicker.h"
#include "app/editor/widget/EditControl.h"
#include "app/editor/widget/MapSlotWidget.h"
#include "app/editor/widget/NumberField.h"
#include "app/editor/widget/Slider.h"
#include "core/edit/EditSession.h"

#include <QDockWidget>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QListWidget>
#include <QPointer>
#include <QSignalSpy>
#include <QToolButton>
#include <QTreeView>
#include <QTreeWidget>
#include <algorithm>
#include <functional>

namespace patina::editor {
namespace {

using namespace shading;

struct HalfDoneEdits : EditorTest {
    void SetUp() override {
        EditorTest::SetUp();
        session->views.setMode(render::ViewMode::Raw);
        session->views.set({});
        window->activateWindow();
        ASSERT_TRUE(QTest::qWaitForWindowActive(window.get(), 30'000));
        first = session->selection.material();
        second = controller().duplicateMaterial(first);
        panel = controller().addLight(LightType::Rectangle);
        sun = controller().addLight(LightType::Directional);
    }
    static QDockWidget& dock(const char* name) {
        auto* dock = window->findChild<QDockWidget*>(QLatin1String(name));
        EXPECT_NE(dock, nullptr) << name;
        dock->show();
        dock->raise();
        EXPECT_TRUE(eventually([&] { return dock->widget()->isVisible(); })) << name;
        return *dock;
    }
    template <class Widget>
    static QList<Widget*> shownIn(const QWidget& parent) {
        QList<Widget*> shown;
        for (Widget* widget : parent.findChildren<Widget*>())
            if (widget->isVisible() && widget->isEnabled())
                shown << widget;
        return shown;
    }
    static void typeHalf(NumberField& field) {
        QTest::mouseClick(&field, Qt::LeftButton, {}, QPoint(10, field.height() / 2));
        QTest::keyClicks(&field, QStringLiteral("0.37"));
        EXPECT_TRUE(field.isEditing()) << field.accessibleName().toStdString();
    }
    // Half types into each field below `root`, and half drags each slider; `change` shows something
    // else, `back` what was there before. Nothing may come of it.
    static int halfEditAll(QWidget& root, const std::function<void()>& change,
                           const std::function<void()>& back) {
        int fields = 0;
        const auto expectNothing = [&](const QWidget& control) {
            const Document before = document();
            const int steps = undoCount();
            change();
            window->viewport().setFocus(); // the field loses the keyboard, if it still has it
            EXPECT_EQ(undoCount(), steps) << control.accessibleName().toStdString();
            EXPECT_EQ(document(), before) << control.accessibleName().toStdString();
            back();
            ++fields;
        };
        for (NumberField* field : shownIn<NumberField>(root)) {
            if (!field->isVisible() || !field->isEnabled())
                continue;
            typeHalf(*field);
            expectNothing(*field);
            EXPECT_FALSE(field->isEditing()) << field->accessibleName().toStdString();
        }
        for (Slider* slider : shownIn<Slider>(root)) {
            const QPoint handle(slider->handleX(), slider->height() / 2);
            QTest::mousePress(slider, Qt::LeftButton, {}, handle);
            const Document before = document();
            change();
            QMouseEvent move(QEvent::MouseMove, handle + QPoint(-9, 0),
                             slider->mapToGlobal(handle + QPoint(-9, 0)), Qt::NoButton,
                             Qt::LeftButton, {});
            QApplication::sendEvent(slider, &move);
            EXPECT_EQ(document(), before) << slider->accessibleName().toStdString();
            QTest::mouseRelease(slider, Qt::LeftButton, {}, handle);
            back();
        }
        for (ColorButton* button : shownIn<ColorButton>(root)) {
            button->click();
            auto* picker = button->findChild<ColorPicker*>();
            EXPECT_TRUE(picker->isVisible());
            auto* hex = find<QLineEdit>(*picker, QStringLiteral("sRGB colour as a hexadecimal "
                                                                "number"));
            hex->setFocus();
            hex->selectAll();
            QTest::keyClicks(hex, QStringLiteral("#123456"));
            expectNothing(*button);
            EXPECT_FALSE(picker->isVisible());
        }
        return fields;
    }
    Id first = 0, second = 0, panel = 0, sun = 0;
};

TEST_F(HalfDoneEdits, ALegendThatIsReplacedReportsNothing) {
    session->views.show(kViewPerceptualRoughness);
    auto* legend = window->findChild<ViewLegend*>(QStringLiteral("legend"));
    ASSERT_TRUE(legend->isVisible());
    for (const char* end : {"Smallest value", "Largest value"}) {
        session->views.show(kViewPerceptualRoughness);
        typeHalf(*find<NumberField>(*legend, QLatin1String(end)));
        session->views.show(kViewMetallic); // by a key or a job: nobody clicked
        EXPECT_EQ(session->views.settings().shown.range, std::nullopt);
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
        session->views.show(kViewPerceptualRoughness);
        EXPECT_EQ(session->views.settings().shown.range, std::nullopt);
    }
}

TEST_F(HalfDoneEdits, AClickOnAnotherTileTakesTheNumberForTheViewItWasTypedFor) {
    session->views.show(kViewPerceptualRoughness);
    auto* legend = window->findChild<ViewLegend*>(QStringLiteral("legend"));
    typeHalf(*find<NumberField>(*legend, QStringLiteral("Largest value")));
    const auto thumbs = window->findChild<ViewStrip*>()->findChildren<ViewThumb*>();
    ViewThumb* metallic = *std::find_if(thumbs.begin(), thumbs.end(), [](const ViewThumb* thumb) {
        return thumb->kind() == kViewMetallic;
    });
    QTest::mouseClick(metallic, Qt::LeftButton, {}, metallic->rect().center());
    EXPECT_EQ(session->views.shown(), kViewMetallic);
    EXPECT_EQ(session->views.settings().shown.range, std::nullopt);
    session->views.show(kViewPerceptualRoughness);
    ASSERT_TRUE(session->views.settings().shown.range);
    EXPECT_FLOAT_EQ(session->views.settings().shown.range->max, 0.37f);
    session->views.setRange(kViewPerceptualRoughness, std::nullopt);
}

TEST_F(HalfDoneEdits, TheKeyboardStaysWithTheControlThatTakesThePlace) {
    session->views.show(kViewPerceptualRoughness);
    auto* legend = window->findChild<ViewLegend*>(QStringLiteral("legend"));
    auto* field = find<NumberField>(*legend, QStringLiteral("Largest value"));
    typeHalf(*field);
    session->views.show(kViewMetallic);
    auto* focus = qobject_cast<NumberField*>(QApplication::focusWidget());
    ASSERT_NE(focus, nullptr);
    EXPECT_NE(focus, field);
    EXPECT_EQ(focus->accessibleName(), QStringLiteral("Largest value"));
    EXPECT_FALSE(focus->isEditing()) << "keys of views still work";
}

// The document's edit that was typed before Ctrl+S belongs to what is saved.
TEST_F(HalfDoneEdits, AShortcutTakesTheNumberFirst) {
    auto* field = find<NumberField>(*dock("material").widget(), QStringLiteral("Roughness"));
    typeHalf(*field);
    QTest::keyClick(field, Qt::Key_F5); // a view's
    EXPECT_NE(session->views.shown(), kViewFinal);
    EXPECT_FALSE(field->isEditing());
    EXPECT_FLOAT_EQ(selectedMaterial().perceptualRoughness, 0.37f);
}

TEST_F(HalfDoneEdits, OtherElementsGetNothing) {
    session->selection.selectMaterial(first);
    EXPECT_GE(halfEditAll(
                  *dock("material").widget(), [&] { session->selection.selectMaterial(second); },
                  [&] { session->selection.selectMaterial(first); }),
              7);
    for (const Id light : {panel, sun}) {
        session->selection.selectLight(light);
        EXPECT_GE(halfEditAll(
                      *dock("lights").widget(),
                      [&] { session->selection.selectLight(light == panel ? sun : panel); },
                      [&] { session->selection.selectLight(light); }),
                  5);
    }
    controller().setEnvironmentKind(EnvironmentKind::Softboxes);
    auto* softboxes = window->findChild<SoftboxList*>();
    const Id one = document().environment().softboxes.at(0).id;
    const Id other = controller().duplicateSoftbox(one);
    softboxes->select(one);
    dock("environment");
    EXPECT_GE(halfEditAll(
                  *softboxes, [&] { softboxes->select(other); }, [&] { softboxes->select(one); }),
              5);
}

TEST_F(HalfDoneEdits, TilingOfOneMapIsNotThatOfTheNext) {
    session->selection.selectMaterial(first);
    controller().applyLibraryMaterial(first, QStringLiteral("worn-painted-metal"));
    ASSERT_TRUE(settled(*session));
    ASSERT_TRUE(selectedMaterial().perceptualRoughnessMap.assigned());
    MapSlotWidget* slot = nullptr;
    for (MapSlotWidget* each : dock("material").widget()->findChildren<MapSlotWidget*>())
        if (each->accessibleName() == QStringLiteral("Roughness map"))
            slot = each;
    ASSERT_NE(slot, nullptr);
    find<QToolButton>(*slot, QStringLiteral("Tiling of Roughness map"))->click();
    const auto fields = shownIn<NumberField>(*slot);
    ASSERT_EQ(fields.size(), 5);
    const Document before = document();
    for (NumberField* field : fields) {
        typeHalf(*field);
        controller().clearMap(parameter("material.roughness.map"), {Scope::Material, first});
        window->viewport().setFocus();
        EXPECT_FALSE(selectedMaterial().perceptualRoughnessMap.assigned());
        EXPECT_EQ(selectedMaterial().perceptualRoughnessMap.uvScale, glm::vec2(1.0f));
        controller().undoStack().undo();
        EXPECT_EQ(document(), before) << field->accessibleName().toStdString();
        find<QToolButton>(*slot, QStringLiteral("Tiling of Roughness map"))->setChecked(true);
    }
}

// Numbers mean other elements in another document.
TEST_F(HalfDoneEdits, ASceneThatIsOpenedGetsNothing) {
    controller().addEnvironment(QStringLiteral("builtin:sunset"),
                                DocumentController::EnvironmentUse::FadeTo);
    ASSERT_TRUE(settled(*session));
    int fields = 0;
    for (const char* name : {"material", "lights", "environment", "view", "model", "mixer"}) {
        NumberField* before = nullptr;
        // Of each dock the first and the last field; the test above has them all.
        for (const bool last : {false, true}) {
            const auto shown = shownIn<NumberField>(*dock(name).widget());
            if (shown.isEmpty() || (last ? shown.back() : shown.front()) == before)
                continue;
            const QPointer<NumberField> field = last ? shown.back() : shown.front();
            before = field;
            typeHalf(*field);
            const std::string fieldName = field->accessibleName().toStdString();
            controller().newDocument();
            ASSERT_TRUE(settled(*session));
            window->viewport().setFocus();
            EXPECT_EQ(undoCount(), 0) << name << ": " << fieldName;
            EXPECT_FALSE(field && field->isEditing()) << name << ": " << fieldName;
            controller().addLight(LightType::Spot);
            session->selection.selectLight(document().lights.back().id);
            ++fields;
        }
    }
    EXPECT_GE(fields, 8);
}

TEST_F(HalfDoneEdits, AChannelThatGoesReportsNothing) {
    dock("mixer");
    auto* gain = find<NumberField>(*window, QStringLiteral("Gain of Sun in EV"));
    ASSERT_NE(gain, nullptr);
    typeHalf(*gain);
    controller().undoStack().undo(); // the sun was added last
    const int steps = controller().undoStack().index();
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    EXPECT_EQ(find<NumberField>(*window, QStringLiteral("Gain of Sun in EV")), nullptr);
    EXPECT_EQ(controller().undoStack().index(), steps);
    for (const Light& light : document().lights)
        EXPECT_EQ(light.gainEv, 0.0f) << light.name;
}

// --- Names -----------------------------------------------------------------------------------

TEST_F(HalfDoneEdits, ANameStaysWithItsLight) {
    dock("lights");
    QTreeWidget* list = window->findChild<LightsPanel*>()->list();
    const Id spot = controller().addLight(LightType::Spot);
    session->selection.selectLight(sun);
    list->setFocus();
    QTest::keyClick(list, Qt::Key_F2);
    auto* editor = list->viewport()->findChild<QLineEdit*>();
    ASSERT_NE(editor, nullptr);
    QTest::keyClicks(editor, QStringLiteral("Key"));
    // A light above it goes, and all below move up by a row.
    controller().removeLight(panel);
    EXPECT_EQ(list->viewport()->findChild<QLineEdit*>(), editor);
    EXPECT_EQ(editor->text(), QStringLiteral("Key"));
    QTest::keyClick(editor, Qt::Key_Return);
    EXPECT_TRUE(eventually([&] { return document().light(sun)->name == "Key"; }));
    EXPECT_EQ(document().light(spot)->name, "Spot");
}

TEST_F(HalfDoneEdits, ANameGoesWithItsLightAndItsScene) {
    dock("lights");
    QTreeWidget* list = window->findChild<LightsPanel*>()->list();
    const auto halfName = [&](Id light) {
        session->selection.selectLight(light);
        list->setFocus();
        QTest::keyClick(list, Qt::Key_F2);
        QTest::keyClicks(list->viewport()->findChild<QLineEdit*>(), QStringLiteral("Key"));
    };
    halfName(panel);
    controller().removeLight(panel);
    window->viewport().setFocus();
    for (const Light& light : document().lights)
        EXPECT_NE(light.name, "Key");
    halfName(sun);
    controller().newDocument();
    ASSERT_TRUE(settled(*session));
    window->viewport().setFocus();
    EXPECT_EQ(undoCount(), 0);
}

TEST_F(HalfDoneEdits, ANameInTheTreeOrOfASoftboxStaysWithItsElement) {
    auto* tree = dock("scene").widget()->findChild<QTreeView*>();
    ASSERT_NE(tree, nullptr);
    session->selection.selectMaterial(second);
    tree->setFocus();
    const QModelIndex materials = tree->model()->index(1, 0);
    tree->setCurrentIndex(tree->model()->index(1, 0, materials));
    QTest::keyClick(tree, Qt::Key_F2);
    auto* editor = tree->viewport()->findChild<QLineEdit*>();
    ASSERT_NE(editor, nullptr);
    QTest::keyClicks(editor, QStringLiteral("Key"));
    controller().removeMaterial(first);
    window->viewport().setFocus();
    for (const Material& material : document().materials)
        EXPECT_NE(material.name, "Key");

    controller().setEnvironmentKind(EnvironmentKind::Softboxes);
    dock("environment");
    auto* softboxes = window->findChild<SoftboxList*>();
    const Id one = document().environment().softboxes.at(0).id;
    const Id other = controller().duplicateSoftbox(one);
    softboxes->select(other);
    QListWidget* list = softboxes->list();
    list->setFocus();
    QTest::keyClick(list, Qt::Key_F2);
    editor = list->viewport()->findChild<QLineEdit*>();
    ASSERT_NE(editor, nullptr);
    QTest::keyClicks(editor, QStringLiteral("Half"));
    controller().removeSoftbox(one);
    EXPECT_EQ(list->viewport()->findChild<QLineEdit*>(), editor);
    QTest::keyClick(editor, Qt::Key_Return);
    EXPECT_TRUE(eventually([&] { return document().softbox(other)->name == "Half"; }));
}

// --- The two ends of an edit -----------------------------------------------------------------

TEST(EditControlTest, WhatIsRetiredIsSilentHiddenAndGone) {
    QWidget desk;
    auto* row = new QHBoxLayout(&desk);
    auto* body = new QWidget;
    auto* layout = new QHBoxLayout(body);
    auto* number = new NumberField({});
    auto* text = new QLineEdit;
    layout->addWidget(number);
    layout->addWidget(text);
    row->addWidget(body);
    desk.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&desk));
    desk.activateWindow();
    ASSERT_TRUE(QTest::qWaitForWindowActive(&desk));
    const QSignalSpy edited(number, &NumberField::edited);
    const QSignalSpy finished(text, &QLineEdit::editingFinished);
    const QSignalSpy destroyed(body, &QObject::destroyed);
    QTest::mouseClick(number, Qt::LeftButton, {}, {5, 5});
    QTest::keyClicks(number, QStringLiteral("0.4"));
    retire(body);
    EXPECT_FALSE(body->isVisible());
    EXPECT_EQ(row->count(), 0);
    EXPECT_EQ(edited.count(), 0);
    EXPECT_EQ(finished.count(), 0);
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    EXPECT_EQ(destroyed.count(), 1);
}

} // namespace
} // namespace patina::editor
