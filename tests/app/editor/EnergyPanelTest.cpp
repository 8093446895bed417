// The Energy dock: its numbers follow the material, its button turns compensation on as one undo
// step, its warnings name what is wrong, and the furnace never touches the document.
#include "app/editor/panel/EnergyPanel.h"
#include "app/editor/panel/FurnaceControls.h"
#include "app/editor/style/Style.h"
#include "app/editor/widget/ColorButton.h"
#include "app/editor/widget/ColumnsLayout.h"
#include "app/editor/widget/EnergyBars.h"
#include "app/editor/widget/EnergyMap.h"
#include "app/editor/widget/EnergyPlot.h"
#include "app/editor/widget/NumberField.h"
#include "core/edit/EditSession.h"
#include "core/material/Material.h"
#include "tests/app/editor/EditorFixture.h"

#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>
#include <QToolButton>

namespace patina::editor {
namespace {

// The panel on its own: a viewport would redraw its picture after each edit, for nobody.
class EnergyTest : public ::testing::Test {
  protected:
    static void SetUpTestSuite() {
        session = std::make_unique<Session>();
        panel =
            std::make_unique<EnergyPanel>(session->controller, session->selection, session->views);
        panel->resize(800, 300);
        panel->show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(panel.get(), 60'000));
    }
    static void TearDownTestSuite() {
        panel.reset();
        session.reset();
    }
    void SetUp() override {
        controller().newDocument();
        ASSERT_TRUE(settled(*session));
        session->views.set({});
        panel->setAngle(45.0);
        // White metal without maps, the material whose losses are tabulated.
        session->selection.selectMaterial(controller().addMaterial());
        set("material.baseColor", glm::vec3(1.0f));
        set("material.metallic", 1.0f);
        set("material.perceptualRoughness", 0.75f);
    }

    static DocumentController& controller() { return session->controller; }
    static const Document& document() { return session->controller.document(); }
    static int undoCount() { return session->controller.undoStack().count(); }
    static const Material& selectedMaterial() {
        return *document().material(session->selection.material());
    }

    void set(const char* id, const ParameterValue& value) {
        const ParameterInfo& info = parameter(id);
        const Id element = info.scope == Scope::Material ? session->selection.material() : 0;
        controller().setParameter(info, {info.scope, element}, value);
    }
    // The study is that of the document as it is.
    [[nodiscard]] bool current() const {
        return eventually([&] {
            return panel->study() && panel->study()->model == document().model &&
                   panel->study()->surface.mean.perceptualRoughness ==
                       selectedMaterial().perceptualRoughness &&
                   panel->study()->surface.mean.baseColor == selectedMaterial().baseColor &&
                   panel->study()->NoV == cosineOfAngle(static_cast<float>(panel->angleDeg()));
        });
    }
    [[nodiscard]] QString ledger() const {
        return find<QLabel>(*panel, QStringLiteral("Energy ledger"))->text();
    }
    [[nodiscard]] QPushButton* compensate() const {
        for (QPushButton* each : panel->findChildren<QPushButton*>())
            if (each->text().endsWith(QStringLiteral("Compensation")))
                return each;
        return nullptr;
    }
    [[nodiscard]] QStringList faults() const {
        QStringList texts;
        for (const QLabel* label : panel->findChildren<QLabel*>(QStringLiteral("energyFault")))
            texts << label->text();
        return texts;
    }

    static std::unique_ptr<Session> session;
    static std::unique_ptr<EnergyPanel> panel;
};

std::unique_ptr<Session> EnergyTest::session;
std::unique_ptr<EnergyPanel> EnergyTest::panel;

// Eavg of GGX with correlated Smith is 0.6562 at roughness 0.75 (2 ∫ E mu dmu), its largest loss
// 1 - E = 0.3731 at normal incidence.
TEST_F(EnergyTest, SaysWhatIsLostAndTheButtonBringsItBack) {
    set("model.multiScatter", false);
    ASSERT_TRUE(current());
    EXPECT_EQ(ledger().toStdString(), "The specular lobe loses 34.4 % at roughness 0.75, 37.3 % at "
                                      "0°: turn on compensation to get it back.");
    const auto* bars = panel->findChild<EnergyBars*>();
    EXPECT_EQ(bars->accessibleDescription().toStdString(),
              "Highlight 65.6 %, Diffuse 0.0 %, Kept by colour 0.0 %, Lost 34.4 %");
    const int before = undoCount();
    ASSERT_EQ(compensate()->text(), QStringLiteral("Turn On Compensation"));
    QTest::mouseClick(compensate(), Qt::LeftButton);
    EXPECT_TRUE(document().model.multiScatter);
    EXPECT_EQ(undoCount(), before + 1);
    ASSERT_TRUE(current());
    EXPECT_EQ(ledger().toStdString(), "Compensation gives back the 34.4 % that the specular lobe "
                                      "would lose at roughness 0.75, 37.3 % at 0°.");
    EXPECT_EQ(bars->accessibleDescription().toStdString(),
              "Highlight 100.0 %, Diffuse 0.0 %, Kept by colour 0.0 %, Lost 0.0 %");
    EXPECT_EQ(compensate()->text(), QStringLiteral("Turn Off Compensation"));
    controller().undoStack().undo();
    EXPECT_FALSE(document().model.multiScatter);
    ASSERT_TRUE(current());
    EXPECT_TRUE(ledger().startsWith(QStringLiteral("The specular lobe loses 34.4 %")));
}

TEST_F(EnergyTest, FollowsADraggedRoughnessAndKeepsTheNewest) {
    set("model.multiScatter", false);
    const DragSession drag = controller().newDragSession();
    for (int i = 1; i <= 40; ++i)
        controller().setParameter(parameter("material.perceptualRoughness"),
                                  {Scope::Material, session->selection.material()},
                                  static_cast<float>(i) / 40.0f, drag);
    ASSERT_TRUE(current());
    // 1 - Eavg = 0.5909 at roughness 1, and 1 - E = ln 2 straight on.
    EXPECT_TRUE(ledger().contains(QStringLiteral("59.1 % at roughness 1.00, 69.3 % at 0°")))
        << ledger().toStdString();
    const auto plots = panel->findChildren<EnergyPlot*>();
    ASSERT_EQ(plots.size(), 2);
    // By angle: 1 - 0.549306 at 60° and roughness 1.
    const EnergyPlot* byAngle = plots[1];
    EXPECT_NEAR(plotPoint(byAngle->curves()[0].points, 60.0).y(), 45.0694, 0.05);
    EXPECT_NEAR(plotPoint(byAngle->curves()[1].points, 60.0).y(), 100.0, 0.05);
    EXPECT_NEAR(plotPoint(byAngle->curves()[2].points, 60.0).y(), 45.0694, 0.05); // lights
}

TEST_F(EnergyTest, ThePressedAngleIsThatOfTheOtherCurve) {
    set("model.multiScatter", false);
    const int before = undoCount();
    ASSERT_TRUE(current());
    auto* map = panel->findChild<EnergyMap*>();
    QTest::mouseClick(map, Qt::LeftButton, {}, map->position(0.3, 60.0).toPoint());
    EXPECT_NEAR(panel->angleDeg(), 60.0, 1.0);
    panel->setAngle(60.0);
    ASSERT_TRUE(current());
    // 1 - 0.336824 at roughness 0.75, 1 - 0.142737 at 0.5, N·V = 0.5.
    const EnergyPlot* byRoughness = panel->findChildren<EnergyPlot*>()[0];
    EXPECT_NEAR(plotPoint(byRoughness->curves()[0].points, 0.75).y(), 66.3176, 0.05);
    EXPECT_NEAR(plotPoint(byRoughness->curves()[0].points, 0.5).y(), 85.7263, 0.05);
    EXPECT_NEAR(map->valueAt(0.75, 60.0), 0.663, 0.005);

    auto* byAngle = panel->findChildren<EnergyPlot*>()[1];
    QTest::mouseClick(byAngle, Qt::LeftButton, {}, byAngle->position(30.0, 50.0).toPoint());
    EXPECT_NEAR(panel->angleDeg(), 30.0, 1.0);
    auto* field = find<NumberField>(*panel, QStringLiteral("Angle of view"));
    EXPECT_EQ(field->value(), panel->angleDeg());
    EXPECT_EQ(undoCount(), before); // looking is no edit
}

TEST_F(EnergyTest, ChannelsAreWeighedApart) {
    set("material.baseColor", glm::vec3(1.0f, 0.5f, 0.2f));
    set("model.multiScatter", false);
    ASSERT_TRUE(current());
    auto* channel = find<QComboBox>(*panel, QStringLiteral("Channel of the energy"));
    QStringList texts;
    for (int i = 0; i < channel->count(); ++i) {
        channel->setCurrentIndex(i);
        texts << ledger();
    }
    texts.removeDuplicates();
    EXPECT_EQ(texts.size(), 4);
    channel->setCurrentIndex(1);
    EXPECT_TRUE(ledger().contains(QStringLiteral("34.4 %")));
    channel->setCurrentIndex(0);
}

TEST_F(EnergyTest, WarnsWhereLightIsMadeAndNamesThePlace) {
    EXPECT_TRUE(current());
    EXPECT_TRUE(faults().isEmpty());
    set("model.distribution", static_cast<int>(Distribution::BlinnPhong));
    set("model.multiScatter", false);
    set("material.baseColor", glm::vec3(0.2f, 1.0f, 0.3f));
    set("material.perceptualRoughness", 1.0f);
    ASSERT_TRUE(current());
    ASSERT_EQ(faults().size(), 1);
    EXPECT_TRUE(faults().front().startsWith(
        QStringLiteral("Makes light: 162.1 % of what lights send comes back in green, at 89° and "
                       "roughness 1.00.")))
        << faults().front().toStdString();
    QTest::mouseClick(compensate(), Qt::LeftButton);
    ASSERT_TRUE(current());
    EXPECT_TRUE(faults().isEmpty());
}

TEST_F(EnergyTest, LightsThatDisagreeGetSmithsVisibility) {
    set("model.visibility", static_cast<int>(Visibility::SchlickDirect));
    set("material.perceptualRoughness", 0.2f);
    ASSERT_TRUE(current());
    ASSERT_EQ(faults().size(), 1);
    EXPECT_TRUE(faults().front().startsWith(QStringLiteral("Lights return ")));
    QPushButton* fix = nullptr;
    for (QPushButton* each : panel->findChildren<QPushButton*>())
        if (each->text() == QStringLiteral("Use Smith's Visibility"))
            fix = each;
    ASSERT_NE(fix, nullptr);
    const int before = undoCount();
    QTest::mouseClick(fix, Qt::LeftButton);
    EXPECT_EQ(document().model.visibility, Visibility::SmithCorrelated);
    EXPECT_EQ(undoCount(), before + 1);
    ASSERT_TRUE(current());
    EXPECT_TRUE(faults().isEmpty());
}

TEST_F(EnergyTest, MaterialsThatShineAreNamed) {
    set("material.emissive", glm::vec3(1.0f));
    ASSERT_TRUE(current());
    ASSERT_TRUE(eventually([&] { return faults().size() == 1; }));
    EXPECT_TRUE(faults().front().contains(QStringLiteral("light of its own")));
}

TEST_F(EnergyTest, TheFurnaceIsOneClickAndNoEdit) {
    const int before = undoCount();
    const Document untouched = document();
    auto* furnace = find<QToolButton>(*panel, QStringLiteral("Furnace"));
    auto* energy = find<QToolButton>(*panel, QStringLiteral("Furnace View"));
    QTest::mouseClick(furnace, Qt::LeftButton);
    ASSERT_TRUE(session->views.settings().furnace);
    EXPECT_EQ(*session->views.settings().furnace, glm::vec3(1.0f));
    // A coloured one, brighter.
    Q_EMIT find<ColorButton>(*panel, QStringLiteral("Furnace colour"))->edited({1.0f, 0.5f, 0.25f});
    Q_EMIT find<NumberField>(*panel, QStringLiteral("Furnace intensity"))->edited(2.0);
    EXPECT_EQ(*session->views.settings().furnace, glm::vec3(2.0f, 1.0f, 0.5f));
    QTest::mouseClick(energy, Qt::LeftButton);
    EXPECT_EQ(session->views.settings().shown.kind, shading::kViewFurnace);
    QTest::mouseClick(energy, Qt::LeftButton);
    EXPECT_EQ(session->views.settings().shown.kind, shading::kViewFinal);
    QTest::mouseClick(furnace, Qt::LeftButton);
    EXPECT_FALSE(session->views.settings().furnace);
    EXPECT_EQ(undoCount(), before);
    EXPECT_EQ(document(), untouched);
    // The buttons follow whoever else changes the view.
    session->views.edit([](render::ViewSettings& s) { s.furnace = glm::vec3(1.0f); });
    EXPECT_TRUE(furnace->isChecked());
    EXPECT_EQ(find<NumberField>(*panel, QStringLiteral("Furnace intensity"))->value(), 1.0);
}

// ---- In the window ----

class EnergyDockTest : public EditorTest {};

TEST_F(EnergyDockTest, OpensBelowTheViewportWithRoomAndFollowsADraggedSlider) {
    auto* dock = window->findChild<QDockWidget*>(QStringLiteral("energy"));
    ASSERT_NE(dock, nullptr);
    EXPECT_FALSE(dock->isVisible());
    QApplication::setActiveWindow(window.get()); // there is no window manager
    window->viewport().setFocus();
    QTest::keyClick(&window->viewport(), Qt::Key_4, Qt::ControlModifier);
    ASSERT_TRUE(dock->isVisible());
    EXPECT_EQ(window->dockWidgetArea(dock), Qt::BottomDockWidgetArea);
    EXPECT_TRUE(eventually([&] { return dock->height() > 200; })) << dock->height();

    auto* panel = window->findChild<EnergyPanel*>();
    session->selection.selectMaterial(controller().addMaterial());
    auto* field = find<NumberField>(*window, QStringLiteral("Roughness"));
    ASSERT_NE(field, nullptr);
    ASSERT_TRUE(eventually([&] { return panel->study().has_value(); }));
    const QPoint centre = field->rect().center();
    QTest::mousePress(field, Qt::LeftButton, {}, centre);
    for (int x = 10; x <= 90; x += 20)
        QTest::mouseMove(field, centre + QPoint(x, 0));
    QTest::mouseRelease(field, Qt::LeftButton, {}, centre + QPoint(90, 0));
    EXPECT_GT(selectedMaterial().perceptualRoughness, 0.55f);
    EXPECT_TRUE(eventually([&] {
        return panel->study()->surface.mean.perceptualRoughness ==
               selectedMaterial().perceptualRoughness;
    }));

    // The furnace by its key: looking is no edit.
    const int before = undoCount();
    QTest::keyClick(&window->viewport(), Qt::Key_F, Qt::ShiftModifier);
    EXPECT_EQ(session->views.settings().furnace, glm::vec3(1.0f));
    EXPECT_TRUE(find<QToolButton>(*panel, QStringLiteral("Furnace"))->isChecked());
    QTest::keyClick(&window->viewport(), Qt::Key_F, Qt::ShiftModifier);
    EXPECT_FALSE(session->views.settings().furnace);
    EXPECT_FALSE(window->actions().furnace->isChecked());
    EXPECT_EQ(undoCount(), before);
    QTest::keyClick(&window->viewport(), Qt::Key_4, Qt::ControlModifier);
    EXPECT_FALSE(dock->isVisible());
}

// ---- The layout that reflows ----

TEST(ColumnsLayoutTest, ItemsStandSideBySideWhileThereIsRoom) {
    QWidget parent;
    // A display's answer to an earlier size could arrive after a later one.
    parent.setAttribute(Qt::WA_DontShowOnScreen);
    auto* layout = new ColumnsLayout(10, &parent);
    std::vector<QWidget*> items;
    for (int i = 0; i < 3; ++i) {
        auto* item = new QWidget;
        item->setMinimumSize(100, 40);
        QSizePolicy policy(QSizePolicy::Expanding, QSizePolicy::Expanding);
        policy.setHorizontalStretch(i == 0 ? 2 : 1);
        item->setSizePolicy(policy);
        layout->addWidget(item);
        items.push_back(item);
    }
    parent.resize(400, 200);
    parent.show();
    EXPECT_EQ(items[0]->geometry(), QRect(0, 0, 140, 200)); // 80 left: half of it
    EXPECT_EQ(items[1]->geometry(), QRect(150, 0, 120, 200));
    EXPECT_EQ(items[2]->geometry(), QRect(280, 0, 120, 200));
    parent.resize(300, 210); // two side by side, one below
    QApplication::processEvents();
    EXPECT_EQ(items[1]->y(), 0);
    EXPECT_EQ(items[2]->geometry(), QRect(0, 110, 300, 100));
    parent.resize(100, 140);
    QApplication::processEvents();
    EXPECT_EQ(items[2]->geometry(), QRect(0, 100, 100, 40));
    EXPECT_EQ(layout->heightForWidth(100), 140);
    items[1]->hide();
    EXPECT_EQ(layout->heightForWidth(100), 90);
}

} // namespace
} // namespace patina::editor
