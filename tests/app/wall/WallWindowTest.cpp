// The wall in the real window, by real keys and mouse: what it compares, which cell is current or
// enlarged, edits, the way back. PATINA_SCREENSHOTS keeps pictures.
#include "app/editor/viewport/ViewLegend.h"
#include "app/editor/viewport/ViewState.h"
#include "app/editor/wall/WallBar.h"
#include "app/editor/widget/NumberField.h"
#include "core/document/ViewChoices.h"
#include "core/edit/EditSession.h"
#include "tests/app/wall/WallFixture.h"

#include <QPushButton>

namespace patina::editor {
namespace {

using ::testing::HasSubstr;

class WallWindowTest : public WallWindow {
  protected:
    static QMenu& menuOf(const char* button) {
        QMenu* menu = find<QToolButton>(*window, QLatin1String(button))->menu();
        Q_EMIT menu->aboutToShow();
        return *menu;
    }
    static QAction* action(const QMenu& menu, const char* text) {
        for (QAction* action : menu.actions())
            if (action->text() == QLatin1String(text))
                return action;
        return nullptr;
    }
    // Of what the viewport shows, over the middle of a cell.
    static double brightness(std::size_t cell) {
        const QImage shown = viewport().grabFramebuffer();
        const QRect place = placeOf(cell);
        double sum = 0.0;
        int count = 0;
        for (int y = place.top(); y < place.bottom(); ++y)
            for (int x = place.left(); x < place.right(); ++x, ++count)
                sum += qGray(shown.pixel(x, y));
        return sum / count;
    }
    static std::vector<std::string> columns() {
        std::vector<std::string> captions;
        for (const WallEntry& entry : wall().wall().columns.entries)
            captions.push_back(entry.caption);
        return captions;
    }
};

TEST_F(WallWindowTest, F3ComparesWhatTheSceneHasAndEscReturns) {
    ASSERT_TRUE(isSettled());
    const QImage before = viewport().grabFramebuffer();
    EXPECT_FALSE(overlay().isVisible());
    const quint64 revision = controller().revision();
    key(Qt::Key_F3);
    ASSERT_TRUE(wall().isOn());
    EXPECT_TRUE(overlay().isVisible());
    EXPECT_TRUE(window->findChild<WallBar*>()->isVisible());
    EXPECT_TRUE(window->actions().wall->isChecked());
    EXPECT_EQ(wall().plan().columns.compared, Compared::Materials);
    EXPECT_EQ(wall().cells().size(), 3u);
    ASSERT_TRUE(isSettled());
    EXPECT_NE(pictureOf(0), pictureOf(1));
    EXPECT_NE(pictureOf(1), pictureOf(2));
    keepPicture("wall.png");
    key(Qt::Key_Escape);
    EXPECT_FALSE(wall().isOn());
    EXPECT_FALSE(overlay().isVisible());
    ASSERT_TRUE(isSettled());
    EXPECT_EQ(viewport().grabFramebuffer(), before) << "one picture, as it was";
    EXPECT_EQ(controller().revision(), revision) << "looking changes nothing";
}

// Each cell is the picture that the viewport shows of the scene with that material.
TEST_F(WallWindowTest, ACellIsThePictureOfItsScene) {
    key(Qt::Key_F3);
    click(1);
    ASSERT_EQ(wall().current(), 1u);
    key(Qt::Key_Return);
    ASSERT_EQ(wall().enlarged(), 1u);
    ASSERT_TRUE(isSettled());
    const QImage cell = pictureOf(1);
    key(Qt::Key_Escape);
    EXPECT_FALSE(wall().enlarged());
    EXPECT_TRUE(wall().isOn()) << "one step at a time";
    const QSize size = cell.size();
    key(Qt::Key_Escape);
    for (const MeshInstance& mesh : std::vector(document().meshes))
        controller().assignMaterial(mesh.id, document().materials[1].id);
    viewport().setOverlaysVisible(false);
    viewport().setFixedSize(size);
    ASSERT_TRUE(isSettled());
    const QImage single = viewport().grabFramebuffer();
    ASSERT_EQ(single.size(), size);
    int worst = 0;
    for (int y = 0; y < size.height(); ++y)
        for (int x = 0; x < size.width(); ++x)
            worst = std::max(worst, std::abs(qGray(single.pixel(x, y)) - qGray(cell.pixel(x, y))));
    EXPECT_LE(worst, 1);
    viewport().setOverlaysVisible(true);
}

TEST_F(WallWindowTest, AnEditShowsInTheCellsThatHaveIt) {
    key(Qt::Key_F3);
    ASSERT_TRUE(isSettled());
    const QImage gold = pictureOf(1), clay = pictureOf(2);
    controller().setParameter(parameter("material.baseColor"),
                              {Scope::Material, document().materials[2].id},
                              glm::vec3(0.9f, 0.1f, 0.1f));
    ASSERT_TRUE(isSettled());
    EXPECT_NE(pictureOf(2), clay);
    EXPECT_EQ(pictureOf(1), gold) << "as fine as it was";
    controller().undoStack().undo();
    ASSERT_TRUE(isSettled());
    EXPECT_EQ(pictureOf(2), clay);
    controller().removeMaterial(document().materials[2].id);
    EXPECT_EQ(wall().cells().size(), 2u) << "what is gone is not shown";
    controller().undoStack().undo();
    EXPECT_EQ(wall().cells().size(), 3u);
}

TEST_F(WallWindowTest, ColumnsAndRowsAreChosen) {
    key(Qt::Key_F3);
    choose("Rows", "Tone Curves");
    EXPECT_TRUE(wall().wall().isTable());
    EXPECT_EQ(wall().wall().width, 3u);
    QMenu& curves = menuOf("Shown in rows");
    action(curves, "AgX")->trigger();
    const std::size_t rows = wall().wall().height;
    EXPECT_EQ(action(menuOf("Shown in rows"), "AgX")->isChecked(), false);
    action(menuOf("Shown in rows"), "Show All")->trigger();
    EXPECT_EQ(wall().wall().height, rows + 1);
    choose("Rows", "Nothing");
    EXPECT_FALSE(wall().wall().isTable());
    choose("Columns", "Nothing");
    EXPECT_THAT(wall().problem().toStdString(), HasSubstr("Choose what"));
    ASSERT_TRUE(isSettled());
    keepPicture("wall-nothing.png");
    choose("Columns", "Lighting Modes");
    action(menuOf("Shown in columns"), "Radiosity")->trigger(); // whose solution takes long
    EXPECT_TRUE(wall().problem().isEmpty());
    ASSERT_TRUE(isSettled());
    for (std::size_t i = 0; i < wall().cells().size(); ++i)
        EXPECT_TRUE(wall().text(i).isEmpty()) << i << " has its picture";
    EXPECT_NE(pictureOf(0), pictureOf(1));
}

TEST_F(WallWindowTest, BuiltInEnvironmentsAreOfferedAsColumns) {
    key(Qt::Key_F3);
    choose("Columns", "Environments");
    ASSERT_EQ(columns().size(), 1u);
    const Id shown = document().mix.first;
    const int steps = undoCount();
    QMenu* add = action(menuOf("Shown in columns"), "Add Environment")->menu();
    action(*add, "Sunset")->trigger();
    ASSERT_TRUE(eventually([] { return columns().size() == 2u; }));
    EXPECT_EQ(document().mix.first, shown) << "the scene's light stays";
    add = action(menuOf("Shown in columns"), "Add Environment")->menu();
    for (const QAction* offered : add->actions())
        EXPECT_NE(offered->text(), QStringLiteral("Sunset")) << "it is there already";
    ASSERT_TRUE(isSettled());
    EXPECT_NE(pictureOf(0), pictureOf(1));
    EXPECT_EQ(undoCount(), steps + 1);
    controller().undoStack().undo();
    EXPECT_EQ(columns().size(), 1u);
}

TEST_F(WallWindowTest, ValuesOfAParameterAreCompared) {
    key(Qt::Key_F3);
    choose("Columns", "Values");
    EXPECT_EQ(columns().size(), 5u) << "roughness of all materials";
    QMenu& parameters = menuOf("Parameter of columns");
    QMenu* environment = action(parameters, "Environment")->menu();
    action(*environment, "Brightness")->trigger();
    EXPECT_EQ(wall().wall().columns.title, "Brightness");
    auto* count = find<NumberField>(*window, QStringLiteral("Number of values of columns"));
    count->setFocus();
    QTest::keyClicks(count, QStringLiteral("3"));
    QTest::keyClick(count, Qt::Key_Return);
    auto* from = find<NumberField>(*window, QStringLiteral("First value of columns"));
    from->setFocus();
    QTest::keyClicks(from, QStringLiteral("-2"));
    QTest::keyClick(from, Qt::Key_Return);
    EXPECT_EQ(columns().size(), 3u);
    ASSERT_TRUE(isSettled());
    EXPECT_LT(brightness(0), brightness(1));
    EXPECT_LT(brightness(1), brightness(2));
    keepPicture("wall-values.png");
}

TEST_F(WallWindowTest, TheCurrentCellMovesWithTheArrows) {
    key(Qt::Key_F3);
    choose("Rows", "Tone Curves");
    key(Qt::Key_Right);
    EXPECT_EQ(wall().current(), 0u) << "the first one, before any was chosen";
    key(Qt::Key_Right);
    EXPECT_EQ(wall().current(), 1u);
    key(Qt::Key_Down);
    EXPECT_EQ(wall().current(), 4u);
    key(Qt::Key_Left);
    key(Qt::Key_Left);
    EXPECT_EQ(wall().current(), 3u) << "it stays on the wall";
    key(Qt::Key_Up);
    key(Qt::Key_Up);
    EXPECT_EQ(wall().current(), 0u);
    QTest::mouseDClick(&viewport(), Qt::LeftButton, Qt::NoModifier, centreOf(4));
    EXPECT_EQ(wall().enlarged(), 4u);
    QTest::mouseDClick(&viewport(), Qt::LeftButton, Qt::NoModifier, {180, 120});
    EXPECT_FALSE(wall().enlarged());
}

TEST_F(WallWindowTest, ACellBecomesTheSceneInOneStep) {
    key(Qt::Key_F3);
    auto* use = find<QPushButton>(*window, QStringLiteral("Use in Scene"));
    EXPECT_FALSE(use->isEnabled());
    click(1);
    EXPECT_TRUE(use->isEnabled());
    test::handleEvents(); // it has its place
    QTest::mouseClick(use, Qt::LeftButton);
    EXPECT_EQ(document().meshes[0].material, document().materials[1].id);
    EXPECT_EQ(undoCount(), steps + 1);
    controller().undoStack().undo();
    EXPECT_EQ(document().meshes[0].material, document().materials[0].id);
}

// Environments beside each other, and one that is generated for a cell alone.
TEST_F(WallWindowTest, EnvironmentsArePreparedInTheBackground) {
    controller().addEnvironment(QStringLiteral("builtin:night"),
                                DocumentController::EnvironmentUse::Light);
    ASSERT_TRUE(settled(*session));
    key(Qt::Key_F3);
    EXPECT_TRUE(wall().wall().isTable());
    EXPECT_EQ(wall().wall().width, 2u);
    ASSERT_TRUE(isSettled());
    EXPECT_NE(pictureOf(0), pictureOf(1));
    EXPECT_TRUE(wall().text(0).isEmpty());
    // Its colours are those of the scene in that light.
    const QImage other = pictureOf(0);
    controller().lightWith(document().environments[0].id);
    ASSERT_TRUE(isSettled());
    EXPECT_EQ(pictureOf(0), other);
    keepPicture("wall-environments.png");
}

TEST_F(WallWindowTest, AnotherSceneEndsTheWall) {
    key(Qt::Key_F3);
    click(0);
    controller().newDocument();
    ASSERT_TRUE(settled(*session));
    EXPECT_FALSE(wall().isOn());
    key(Qt::Key_F3);
    EXPECT_FALSE(wall().current());
    EXPECT_EQ(wall().plan(), defaultWallPlan(document()));
}

TEST_F(WallWindowTest, ASplitIsOfOnePicture) {
    session->views.toggleSplit();
    key(Qt::Key_F3);
    EXPECT_FALSE(session->views.settings().split);
    EXPECT_TRUE(wall().isOn());
    key(Qt::Key_V);
    EXPECT_TRUE(session->views.settings().split);
    EXPECT_FALSE(wall().isOn());
}

TEST_F(WallWindowTest, CaptionsAndCellsFillTheViewport) {
    key(Qt::Key_F3);
    choose("Rows", "Tone Curves");
    for (const QSize size : {QSize(360, 240), QSize(701, 455)}) {
        const WallLayout layout = WallLayout::of(wall(), size, viewport().fontMetrics());
        QRegion covered;
        for (const QRect& cell : layout.cells) {
            EXPECT_TRUE(QRect(QPoint(), size).contains(cell));
            EXPECT_FALSE(covered.intersects(cell)) << "cells overlap";
            covered += cell;
        }
        EXPECT_EQ(covered.boundingRect().bottomRight(),
                  QPoint(size.width() - 1, size.height() - 1));
        for (const WallLayout::Caption& caption : layout.captions)
            EXPECT_FALSE(covered.intersects(caption.place)) << caption.text.toStdString();
        EXPECT_EQ(layout.cellAt(layout.cells[3].center()), 3u);
        EXPECT_FALSE(layout.cellAt({1.0, 1.0}));
    }
}

// A legend would hide the first cells: only one that the colours need to be read stays.
TEST_F(WallWindowTest, TheLegendOfAViewLeavesTheCellsFree) {
    const auto legend = [] {
        return window->findChild<ViewLegend*>(QStringLiteral("legend"))->isVisible();
    };
    session->views.show(shading::kViewCosineLight);
    EXPECT_TRUE(legend());
    key(Qt::Key_F3);
    EXPECT_FALSE(legend()) << "it says a name alone";
    wall().enlarge(1);
    EXPECT_TRUE(legend());
    wall().enlarge(std::nullopt);
    session->views.show(shading::kViewNoL);
    EXPECT_TRUE(legend()) << "it has the scale";
}

} // namespace
} // namespace patina::editor
