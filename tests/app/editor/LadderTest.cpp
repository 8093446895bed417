// The Lighting Ladder dock by real events: methods are drawn, measured, compared and used.
#include "app/editor/ladder/LadderModel.h"
#include "app/editor/ladder/LadderPanel.h"
#include "app/editor/ladder/LadderPicture.h"
#include "core/document/ViewChoices.h"
#include "core/edit/Edit.h"
#include "core/edit/EditSession.h"
#include "core/library/Meshes.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "tests/app/editor/EditorFixture.h"
#include "tests/support/Events.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QPushButton>
#include <QTableView>

namespace patina::editor {
namespace {

// Rows.
constexpr std::size_t kNoL = 0, kIbl = 2, kOcclusion = 3, kShadowed = 5, kPath = 9;

// A rough ball in uniform light, whose traced picture is certain soon.
class LadderTest : public EditorTest {
  protected:
    void SetUp() override {
        EditorTest::SetUp();
        controller().openScene(QStringLiteral("builtin:sphere"));
        ASSERT_TRUE(settled(*session));
        // Few vertices and elements to bake for.
        controller().editStructure(QStringLiteral("Coarse"), [](Document& document) {
            document.meshes[0].mesh =
                library::makePart("Ball", library::makeSphere(48, 24), {}).mesh;
        });
        controller().addEnvironment(QStringLiteral("builtin:white"),
                                    DocumentController::EnvironmentUse::Light);
        ASSERT_TRUE(settled(*session));
        window->resize(1440, 900);
        // The ladder's pictures have the viewport's shape; a narrow one has few pixels to trace.
        window->viewport().setFixedSize(64, 96);
        auto* dock = window->findChild<QDockWidget*>(QStringLiteral("ladder"));
        if (!dock->isVisible())
            window->actions().ladder->trigger();
        ASSERT_TRUE(eventually([dock] { return dock->isVisible(); }));
        ASSERT_EQ(panel().shown(), nullptr) << "that of another scene went with it";
        box("Live").setChecked(false);
    }
    static LadderPanel& panel() { return *window->findChild<LadderPanel*>(); }
    static QCheckBox& box(const char* name) {
        return *find<QCheckBox>(panel(), QString::fromLatin1(name));
    }
    static QPushButton& button(const char* name) {
        return *panel().findChild<QPushButton*>(QString::fromLatin1(name));
    }
    static void press(const char* name) { QTest::mouseClick(&button(name), Qt::LeftButton); }
    static bool isDone() {
        return eventually(
            [] { return !panel().isRunning() && panel().shown() && panel().shown()->isDone(); });
    }
    static const LadderStep& step(std::size_t row) { return panel().shown()->steps[row]; }
    static double flip(std::size_t row) { return step(row).score.value().flip; }
    static std::string text(std::size_t row, int column) {
        return panel()
            .table()
            .model()
            ->index(static_cast<int>(row), column)
            .data()
            .toString()
            .toStdString();
    }
    static void choose(std::size_t row) {
        QTableView& table = panel().table();
        const QModelIndex index = table.model()->index(static_cast<int>(row), 0);
        table.scrollTo(index);
        QTest::mouseClick(table.viewport(), Qt::LeftButton, Qt::NoModifier,
                          table.visualRect(index).center());
    }
    static void make(float roughness) {
        controller().setParameter(parameter("material.perceptualRoughness"),
                                  {Scope::Material, document().materials[0].id}, roughness);
    }
    // Of what was measured: the button for the closest method, while another one lights the scene.
    static void lightByTheClosest() {
        QPushButton& closest = button("ladderUseClosest");
        ASSERT_TRUE(eventually([&] { return closest.isVisible(); }));
        const auto best = closestStep(panel().shown()->steps, document());
        ASSERT_TRUE(best.has_value());
        for (std::size_t row = 0; row < kPath; ++row)
            EXPECT_LE(flip(*best), flip(row));
        EXPECT_LT(flip(*best), 0.3 * flip(kNoL));
        const double change = 100.0 * (flip(*best) / flip(kNoL) - 1.0);
        EXPECT_EQ(closest.text(), QStringLiteral("%1: FLIP %2 %")
                                      .arg(QString::fromStdString(step(*best).label))
                                      .arg(change, 0, 'f', 0));
        press("ladderUseClosest");
        EXPECT_EQ(stepInUse(panel().shown()->steps, document()), best);
        EXPECT_EQ(document().view.lighting, step(*best).lighting);
        EXPECT_FALSE(closest.isVisible()) << "the scene is lit so";
        controller().undoStack().undo();
        EXPECT_EQ(document().view.lighting, LightingMode::Cosine);
        EXPECT_TRUE(closest.isVisible());
        make(0.3f);
        EXPECT_FALSE(closest.isVisible()) << "measured of another state";
    }
};

TEST_F(LadderTest, EveryMethodIsDrawnMeasuredComparedAndUsed) {
    controller().setParameter(parameter("view.lighting"), {Scope::View, 0},
                              static_cast<int>(LightingMode::Cosine));
    press("ladderStart");
    EXPECT_FALSE(button("ladderUseClosest").isVisible()) << "nothing is measured yet";
    ASSERT_TRUE(isDone());
    const LadderShown& shown = *panel().shown();
    ASSERT_EQ(shown.steps.size(), 10u);
    for (std::size_t i = 0; i < shown.steps.size(); ++i) {
        EXPECT_EQ(shown.steps[i].whyNot, "") << i;
        EXPECT_FALSE(shown.steps[i].picture.isNull()) << i;
        EXPECT_EQ(shown.steps[i].score.has_value(), i != kPath) << i;
        EXPECT_EQ(shown.steps[i].milliseconds > 0.0, i != kPath) << i;
    }
    EXPECT_LE(shown.noise, 0.01);
    // A ball alone hides nothing from itself; uniform light has no direction.
    EXPECT_LT(flip(kIbl), 0.3 * flip(kNoL));
    EXPECT_NEAR(flip(kOcclusion), flip(kIbl), 0.01);
    EXPECT_GT(shown.steps[kShadowed].bakeSeconds, 0.0);
    EXPECT_EQ(text(kNoL, LadderModel::Flip), flipText(flip(kNoL)).toStdString());
    EXPECT_NE(text(kShadowed, LadderModel::Bake), "");
    EXPECT_EQ(text(kIbl, LadderModel::Bake), "");

    // Two of them on both sides of the line, then their errors.
    choose(kNoL);
    LadderPicture& picture = panel().picture();
    EXPECT_EQ(picture.left().picture, step(kNoL).picture);
    EXPECT_EQ(picture.right().picture, step(kPath).picture);
    auto* other = find<QComboBox>(panel(), QStringLiteral("Compare with"));
    other->setCurrentIndex(static_cast<int>(kIbl));
    EXPECT_EQ(picture.right().picture, step(kIbl).picture);
    find<QComboBox>(panel(), QStringLiteral("Show"))->setCurrentIndex(2);
    EXPECT_EQ(picture.left().picture, step(kNoL).visible);
    find<QComboBox>(panel(), QStringLiteral("Show"))->setCurrentIndex(0);
    const QPoint middle = picture.rect().center();
    QTest::mouseClick(&picture, Qt::LeftButton, Qt::NoModifier, middle);
    EXPECT_NEAR(picture.line(), 0.5, 0.02);
    QTest::keyClick(&picture, Qt::Key_Right);
    EXPECT_NEAR(picture.line(), 0.55, 0.02);

    // Used in the scene: the bake comes with it, and undo takes the light back.
    EXPECT_FALSE(hasTransfer(document()));
    choose(kShadowed);
    press("ladderUse");
    EXPECT_EQ(document().view.lighting, LightingMode::Shadowed);
    EXPECT_TRUE(hasTransfer(document()));
    controller().undoStack().undo();
    EXPECT_EQ(document().view.lighting, LightingMode::Cosine);
    EXPECT_FALSE(panel().isOfEarlierState()) << "how it is lit does not count";
    choose(kPath);
    press("ladderUse");
    EXPECT_TRUE(session->paths.isOn());
    session->paths.setOn(false);

    lightByTheClosest();
}

TEST_F(LadderTest, AnEditMakesItStaleAndLiveStartsItAgainWithTheBakesThatItHas) {
    press("ladderStart");
    ASSERT_TRUE(isDone());
    const LadderShownPtr before = panel().shown();
    make(0.2f);
    EXPECT_TRUE(panel().isOfEarlierState());
    EXPECT_FALSE(panel().isRunning());
    QTest::mouseClick(&box("Live"), Qt::LeftButton, Qt::NoModifier,
                      QPoint(8, box("Live").height() / 2));
    EXPECT_TRUE(panel().isRunning());
    ASSERT_TRUE(isDone());
    ASSERT_TRUE(eventually([] { return !panel().isOfEarlierState(); }));
    EXPECT_NE(step(kIbl).picture, before->steps[kIbl].picture);
    EXPECT_EQ(step(kShadowed).bake, before->steps[kShadowed].bake) << "it was baked once";
    make(0.6f);
    EXPECT_TRUE(eventually([] { return panel().isRunning(); })) << "by itself";
    press("ladderStart"); // Cancel
    EXPECT_FALSE(panel().isRunning());
    EXPECT_TRUE(eventually([] { return session->jobs.runningCount() == 0; }));
    box("Live").setChecked(false);
}

} // namespace
} // namespace patina::editor
