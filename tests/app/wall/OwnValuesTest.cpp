// Values that a cell of the wall has of its own.
#include "app/editor/wall/OwnValueControls.h"
#include "app/editor/widget/NumberField.h"
#include "tests/app/wall/WallFixture.h"

namespace patina::editor {
namespace {

class OwnValueControlsTest : public WallWindow {
  protected:
    void SetUp() override {
        WallWindow::SetUp();
        key(Qt::Key_F3); // three materials
        ASSERT_TRUE(isSettled());
    }
    static OwnValueControls& controls() { return *window->findChild<OwnValueControls*>(); }
    // Picks "Submenu", "Entry" of the button's menu.
    static void pick(const char* submenu, const char* entry) {
        QMenu* menu = controls().button()->menu();
        Q_EMIT menu->aboutToShow();
        for (QAction* group : menu->actions())
            if (group->menu() != nullptr && group->text() == QLatin1String(submenu))
                for (QAction* action : group->menu()->actions())
                    if (action->text() == QLatin1String(entry))
                        return action->trigger();
        FAIL() << submenu << ", " << entry << ": no such entry";
    }
    static NumberField* field(const char* name) {
        for (NumberField* number : controls().findChildren<NumberField*>())
            if (number->accessibleName() == QLatin1String(name) && number->isVisible())
                return number;
        return nullptr;
    }
};

TEST_F(OwnValueControlsTest, AnUnlinkedRotationIsOneCellsAlone) {
    EXPECT_FALSE(controls().button()->isEnabled()) << "no cell is current";
    EXPECT_FALSE(controls().isVisible());
    const std::array before{pictureOf(0), pictureOf(1), pictureOf(2)};
    click(1);
    EXPECT_TRUE(controls().button()->isEnabled());
    pick("Environment", "Rotation");
    ASSERT_NE(field("Rotation"), nullptr);
    ASSERT_TRUE(isSettled());
    const QImage same = pictureOf(1); // the row of values has taken its height
    field("Rotation")->setFocus();
    field("Rotation")->selectAll();
    QTest::keyClicks(field("Rotation"), QStringLiteral("120"));
    QTest::keyClick(field("Rotation"), Qt::Key_Return);
    ASSERT_TRUE(isSettled());
    EXPECT_NE(pictureOf(1), same);
    EXPECT_EQ(wall().cells()[1].own.values.size(), 1u);
    EXPECT_FLOAT_EQ(document().environment().rotationDeg, 0.0f) << "the scene's is as it was";
    EXPECT_EQ(undoCount(), steps) << "looking is no edit";
    keepPicture("wall-own-value.png");

    // The scene's rotation reaches the others, not this one.
    const std::array turned{pictureOf(0), pictureOf(1)};
    controller().setParameter(*findParameter("environment.rotationDeg"), {Scope::Environment, 0},
                              60.0f);
    ASSERT_TRUE(isSettled());
    EXPECT_NE(pictureOf(0), turned[0]);
    EXPECT_EQ(pictureOf(1), turned[1]);

    // Another cell shows none; back here it is still there.
    click(0);
    EXPECT_FALSE(controls().isVisible());
    click(1);
    ASSERT_TRUE(eventually([] { return field("Rotation") != nullptr; }));
    auto* link = find<QToolButton>(controls(), QStringLiteral("Link Rotation"));
    ASSERT_NE(link, nullptr);
    QTest::mouseClick(link, Qt::LeftButton);
    EXPECT_FALSE(controls().isVisible());
    EXPECT_TRUE(wall().cells()[1].own.isEmpty());
}

TEST_F(OwnValueControlsTest, WhatACellHasOfItsOwnIsUsedInTheScene) {
    click(2);
    pick("Camera", "Exposure");
    wall().setOwnValue({{Scope::View, 0}, findParameter("view.exposureEv"), 1.5f});
    wall().useInScene();
    EXPECT_FLOAT_EQ(document().view.exposureEv, 1.5f);
    EXPECT_EQ(undoCount(), steps + 1);
}

} // namespace
} // namespace patina::editor
