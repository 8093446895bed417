// Shift with Page Up and Page Down in the viewport, by real keys: the scene's models, one at a
// time.
#include "core/document/Document.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "tests/app/editor/EditorFixture.h"
#include "tests/support/Events.h"

#include <QStatusBar>
#include <QTreeView>
#include <algorithm>

namespace patina::editor {
namespace {

using ::testing::ElementsAre;

class ModelStepsTest : public EditorTest {
  protected:
    void SetUp() override {
        EditorTest::SetUp();
        window->viewport().setFixedSize(200, 160);
        controller().openScene(QStringLiteral("builtin:sphere"));
        ASSERT_TRUE(settled(*session));
        window->activateWindow();
        ASSERT_TRUE(QTest::qWaitForWindowActive(window.get(), 30'000));
        window->viewport().setFocus();
    }
    static void add(const char* model) {
        controller().addModel(QString::fromLatin1(model));
        ASSERT_TRUE(settled(*session));
    }
    static void next() {
        QTest::keyClick(&window->viewport(), Qt::Key_PageDown, Qt::ShiftModifier);
    }
    static void previous() {
        QTest::keyClick(&window->viewport(), Qt::Key_PageUp, Qt::ShiftModifier);
    }
    static std::string says() { return window->statusBar()->currentMessage().toStdString(); }
    static std::vector<bool> visible() {
        std::vector<bool> result;
        for (const MeshInstance& mesh : document().meshes)
            result.push_back(mesh.visible);
        return result;
    }
};

TEST_F(ModelStepsTest, OneModelIsShownAtATimeAndAfterTheLastAll) {
    add("builtin:torus-knot");
    add("builtin:plane");
    ASSERT_EQ(document().meshes.size(), 3u);
    const int steps = undoCount();
    next();
    EXPECT_THAT(visible(), ElementsAre(true, false, false));
    EXPECT_EQ(says(), "1 of 3: Sphere (Esc shows all)");
    next();
    EXPECT_THAT(visible(), ElementsAre(false, true, false));
    EXPECT_EQ(says(), "2 of 3: Torus Knot (Esc shows all)");
    EXPECT_EQ(undoCount(), steps + 1) << "a walk is one step";
    next();
    EXPECT_THAT(visible(), ElementsAre(false, false, true));
    next();
    EXPECT_THAT(visible(), ElementsAre(true, true, true));
    EXPECT_EQ(says(), "All 3 models");
    EXPECT_EQ(undoCount(), steps) << "and none when all are shown again";
    previous();
    EXPECT_THAT(visible(), ElementsAre(false, false, true));
    controller().undoStack().undo();
    EXPECT_THAT(visible(), ElementsAre(true, true, true));
    next(); // from the beginning
    EXPECT_THAT(visible(), ElementsAre(true, false, false));
}

TEST_F(ModelStepsTest, EscShowsAllThatWereShown) {
    add("builtin:torus-knot");
    add("builtin:plane");
    controller().setMeshVisible(document().meshes[1].id, false);
    const int steps = undoCount();
    next();
    EXPECT_EQ(says(), "1 of 2: Sphere (Esc shows all)") << "what is hidden is no part of the walk";
    next();
    EXPECT_THAT(visible(), ElementsAre(false, false, true));
    QTest::keyClick(&window->viewport(), Qt::Key_Escape);
    EXPECT_THAT(visible(), ElementsAre(true, false, true));
    EXPECT_EQ(says(), "All 2 models");
    EXPECT_EQ(undoCount(), steps);
    // What is edited meanwhile stays, and Esc has nothing to do with it.
    next();
    controller().setMeshVisible(document().meshes[1].id, true);
    QTest::keyClick(&window->viewport(), Qt::Key_Escape);
    EXPECT_THAT(visible(), ElementsAre(true, true, false));
}

TEST_F(ModelStepsTest, AModelAloneIsSteppedThroughByItsMeshesOrSaysThatThereIsNone) {
    next();
    EXPECT_EQ(says(), "Sphere is the only model of the scene that is visible");
    EXPECT_THAT(visible(), ElementsAre(true));
    controller().openScene(QStringLiteral("builtin:shader-ball"));
    ASSERT_TRUE(settled(*session));
    const std::size_t parts = document().meshes.size();
    ASSERT_GT(parts, 1u);
    const int steps = undoCount();
    window->viewport().setFocus();
    next();
    EXPECT_EQ(std::ranges::count(visible(), true), 1);
    EXPECT_EQ(says(), "1 of " + std::to_string(parts) + ": " + document().meshes[0].name +
                          " (Esc shows all)");
    QTest::keyClick(&window->viewport(), Qt::Key_Escape);
    EXPECT_EQ(undoCount(), steps);
    // Elsewhere the keys are somebody else's.
    auto* tree = window->findChild<QTreeView*>();
    tree->setFocus();
    QTest::keyClick(tree, Qt::Key_PageDown, Qt::ShiftModifier);
    EXPECT_EQ(std::ranges::count(visible(), true), static_cast<std::ptrdiff_t>(parts));
}

} // namespace
} // namespace patina::editor
