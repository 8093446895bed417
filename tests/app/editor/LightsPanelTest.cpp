// The list of lights and the rows of the light that is selected in it.
#include "core/light/Light.h"
#include "tests/app/editor/PanelFixture.h"
#include "tests/support/Events.h"

#include "app/editor/panel/LightsPanel.h"
#include "app/editor/widget/NumberField.h"
#include "core/light/Lights.h"

#include <QCheckBox>
#include <QDir>
#include <QDockWidget>
#include <QToolButton>
#include <QTreeWidget>
#include <glm/geometric.hpp>

namespace patina::editor {
namespace {

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

} // namespace
} // namespace patina::editor
