// Looking at the terms of shading in the real window, by real keys and mouse: keys, menu, legend,
// strip, split.

#include "app/editor/ViewActions.h"
#include "app/editor/viewport/SplitHandle.h"
#include "app/editor/viewport/ViewFeed.h"
#include "app/editor/viewport/ViewGate.h"
#include "app/editor/viewport/ViewLegend.h"
#include "app/editor/viewport/ViewState.h"
#include "app/editor/viewport/ViewStrip.h"
#include "app/editor/viewport/ViewThumb.h"
#include "app/editor/widget/ColorScale.h"
#include "app/editor/widget/NumberField.h"
#include "app/editor/widget/Slider.h"
#include "core/light/Light.h"
#include "core/light/Lights.h"
#include "core/material/Material.h"
#include "tests/app/editor/EditorFixture.h"
#include "tests/support/Events.h"
#include "tests/support/Keys.h"

#include <QComboBox>
#include <QDir>
#include <QElapsedTimer>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QTabBar>
#include <QToolButton>
#include <algorithm>
#include <cstdio>

namespace patina::editor {
namespace {

using namespace shading;
using ::testing::HasSubstr;

class ViewsWindowTest : public EditorTest {
  protected:
    void SetUp() override {
        EditorTest::SetUp();
        window->viewport().setFixedSize(355, 300); // software OpenGL pays for each pixel
        session->views.setMode(render::ViewMode::Raw);
        session->views.set({});
        window->activateWindow();
        ASSERT_TRUE(QTest::qWaitForWindowActive(window.get(), 30'000));
        viewport().setFocus();
    }
    static ViewportWidget& viewport() { return window->viewport(); }
    static ViewState& views() { return session->views; }
    static ViewKind shown() { return views().shown(); }
    static void key(int code, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
        QTest::keyClick(&viewport(), static_cast<Qt::Key>(code), modifiers);
    }
    static ViewLegend& legend(const char* name = "legend") {
        return *window->findChild<ViewLegend*>(QLatin1String(name));
    }
    static ViewStrip& strip() { return *window->findChild<ViewStrip*>(); }
    static ViewThumb& thumb(ViewKind kind) {
        const auto thumbs = strip().findChildren<ViewThumb*>();
        return **std::find_if(thumbs.begin(), thumbs.end(),
                              [&](const ViewThumb* thumb) { return thumb->kind() == kind; });
    }
    static std::string legendText(const char* name = "legend") {
        QString text;
        for (const QLabel* label : legend(name).findChildren<QLabel*>())
            text += label->text() + QLatin1Char('\n');
        return text.toStdString();
    }
    static bool rested() {
        const QSize full = viewport().size() * viewport().devicePixelRatioF();
        return eventually([&] { return viewport().frameSize() == full; });
    }
    // A frame of what is asked for is on the screen.
    static bool frameCame() {
        bool came = false;
        const auto connection =
            QObject::connect(&viewport(), &ViewportWidget::frameRendered, &viewport(),
                             [&] { came = !viewport().waitsForPrograms(); });
        viewport().update();
        const bool ok = eventually([&] { return came; });
        QObject::disconnect(connection);
        return ok;
    }
    static void keepPicture(const char* name) {
        const QString pictures = qEnvironmentVariable("PATINA_SCREENSHOTS");
        if (pictures.isEmpty())
            return;
        ASSERT_TRUE(QDir().mkpath(pictures));
        EXPECT_TRUE(window->grab().save(QDir(pictures).filePath(QLatin1String(name))));
    }
    static void drag(QWidget& widget, QPoint from, QPoint to,
                     Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
        QTest::mousePress(&widget, Qt::LeftButton, Qt::NoModifier, from);
        for (int i = 1; i <= 4; ++i) {
            QMouseEvent move(QEvent::MouseMove, from + (to - from) * i / 4,
                             widget.mapToGlobal(from + (to - from) * i / 4), Qt::NoButton,
                             Qt::LeftButton, modifiers);
            QApplication::sendEvent(&widget, &move);
        }
        QTest::mouseRelease(&widget, Qt::LeftButton, Qt::NoModifier, to);
    }
};

// --- Keys ------------------------------------------------------------------------------------

TEST_F(ViewsWindowTest, NumberKeysGoThroughTheirGroupAndBack) {
    key(Qt::Key_3);
    EXPECT_EQ(shown(), kViewShadingNormal);
    key(Qt::Key_3);
    EXPECT_EQ(shown(), kViewGeometricNormal);
    key(Qt::Key_3, Qt::ShiftModifier);
    key(Qt::Key_3, Qt::ShiftModifier);
    EXPECT_EQ(shown(), kViewFlat) << "round the end";
    key(Qt::Key_6);
    EXPECT_EQ(shown(), kViewIrradiance);
    key(Qt::Key_3);
    EXPECT_EQ(shown(), kViewFlat) << "where the group was left";
    key(Qt::Key_1);
    EXPECT_EQ(shown(), kViewLuminance);
    EXPECT_EQ(undoCount(), 0);
    EXPECT_FALSE(controller().isModified());
}

TEST_F(ViewsWindowTest, ZeroReturnsToThePictureAndGoesBack) {
    key(Qt::Key_B);
    EXPECT_EQ(shown(), kViewBaseColor);
    key(Qt::Key_0);
    EXPECT_EQ(shown(), kViewFinal);
    key(Qt::Key_0);
    EXPECT_EQ(shown(), kViewBaseColor);
}

TEST_F(ViewsWindowTest, TheLightingGroupMixesDiffuseLightAndReflections) {
    strip().setFolded(false);
    auto* slider = strip().findChild<Slider*>();
    ASSERT_NE(slider, nullptr);
    key(Qt::Key_B);
    EXPECT_TRUE(eventually([&] { return !slider->isVisible(); })) << "no concern of materials";
    key(Qt::Key_7);
    ASSERT_TRUE(eventually([&] { return slider->isVisible(); }));
    EXPECT_THAT(slider->toolTip().toStdString(), HasSubstr("reflections alone"));
    const float before = document().view.reflectionMix;
    QTest::mouseClick(slider, Qt::LeftButton, {}, {1, slider->height() / 2});
    EXPECT_LT(document().view.reflectionMix, 0.1f);
    EXPECT_EQ(undoCount(), 1);
    const QString shown = strip().findChild<NumberField*>()->text();
    controller().undoStack().undo();
    EXPECT_EQ(document().view.reflectionMix, before);
    EXPECT_NE(strip().findChild<NumberField*>()->text(), shown);
    keepPicture("lighting-strip.png");
    strip().setFolded(true);
    EXPECT_FALSE(slider->isVisible());
    strip().setFolded(false);
}

TEST_F(ViewsWindowTest, EveryLetterShowsItsView) {
    int letters = 0;
    for (const ViewInfo& info : patina::views()) {
        const QString letter = ViewActions::keyOf(info.kind);
        if (letter.isEmpty())
            continue;
        ++letters;
        EXPECT_FALSE(QStringLiteral("WASDQEFG").contains(letter)) << info.id;
        key(QKeySequence(letter)[0].key());
        EXPECT_EQ(shown(), info.kind) << info.id;
    }
    EXPECT_GE(letters, 10);
}

TEST_F(ViewsWindowTest, NoTwoActionsShareAKey) {
    QList<QKeySequence> keys;
    for (const auto& actions : {window->actions().all(), window->looks().all()})
        for (const QAction* action : actions)
            keys += action->shortcuts();
    for (const QKeySequence& sequence : keys)
        EXPECT_EQ(keys.count(sequence), 1) << sequence.toString().toStdString();
}

TEST_F(ViewsWindowTest, AKeyThatIsHeldPeeks) {
    key(Qt::Key_B);
    test::pressKey(viewport(), 100'000, Qt::Key_N, QStringLiteral("n"));
    EXPECT_EQ(shown(), kViewShadingNormal) << "at once";
    test::handleEvents();
    EXPECT_EQ(shown(), kViewShadingNormal);
    test::releaseKey(viewport(), 100'000 + ViewActions::kPeekMs + 1, Qt::Key_N,
                     QStringLiteral("n"));
    EXPECT_EQ(shown(), kViewBaseColor);
    // Zero, too.
    test::pressKey(viewport(), 200'000, Qt::Key_0, QStringLiteral("0"));
    EXPECT_EQ(shown(), kViewFinal);
    test::releaseKey(viewport(), 200'000 + ViewActions::kPeekMs + 1, Qt::Key_0,
                     QStringLiteral("0"));
    EXPECT_EQ(shown(), kViewBaseColor);
}

// Behind a slow frame a tap is still a tap, and holding is holding: the keys' own times count.
TEST_F(ViewsWindowTest, ATapIsATapHoweverLateItIsHandled) {
    key(Qt::Key_B);
    test::pressKey(viewport(), 100'000, Qt::Key_N, QStringLiteral("n"));
    EXPECT_EQ(shown(), kViewShadingNormal);
    QTest::qSleep(ViewActions::kPeekMs + 100); // the program is busy: a clock of its own says held
    test::releaseKey(viewport(), 100'060, Qt::Key_N, QStringLiteral("n"));
    EXPECT_EQ(shown(), kViewShadingNormal) << "tapped";

    test::pressKey(viewport(), 200'000, Qt::Key_B, QStringLiteral("b"));
    EXPECT_EQ(shown(), kViewBaseColor);
    test::releaseKey(viewport(), 200'000 + ViewActions::kPeekMs + 1, Qt::Key_B,
                     QStringLiteral("b"));
    EXPECT_EQ(shown(), kViewShadingNormal) << "held, although both were handled at once";
}

TEST_F(ViewsWindowTest, KeysBelongToTheFieldThatIsTypedInto) {
    auto* roughness = find<NumberField>(*window, QStringLiteral("Roughness"));
    ASSERT_NE(roughness, nullptr);
    roughness->setFocus();
    QTest::keyClicks(roughness, QStringLiteral("0.25"));
    QTest::keyClick(roughness, Qt::Key_Return);
    EXPECT_EQ(shown(), kViewFinal);
    EXPECT_EQ(selectedMaterial().perceptualRoughness, 0.25f);
}

TEST_F(ViewsWindowTest, FlyingKeepsItsLetters) {
    QTest::mousePress(&viewport(), Qt::RightButton, Qt::NoModifier, {200, 200});
    key(Qt::Key_B);
    QTest::mouseRelease(&viewport(), Qt::RightButton, Qt::NoModifier, {200, 200});
    EXPECT_EQ(shown(), kViewFinal);
}

// --- Menu ------------------------------------------------------------------------------------

TEST_F(ViewsWindowTest, TheMenuHasEveryViewOnceAndMarksTheOneThatIsShown) {
    QMenu menu;
    window->looks().fillMenu(menu);
    QList<QAction*> found;
    for (const QMenu* submenu : menu.findChildren<QMenu*>())
        for (QAction* action : submenu->actions())
            if (action->objectName().startsWith(QStringLiteral("view.")))
                found << action;
    EXPECT_EQ(found.size(), kViewCount);
    window->looks().view(kViewDfgScale)->trigger();
    EXPECT_EQ(shown(), kViewDfgScale);
    for (const QAction* action : found) {
        EXPECT_EQ(action->isChecked(), action == window->looks().view(kViewDfgScale));
        EXPECT_FALSE(action->statusTip().isEmpty());
    }
}

// --- Legend ----------------------------------------------------------------------------------

TEST_F(ViewsWindowTest, TheLegendNamesTheViewAndLeavesThePictureAlone) {
    EXPECT_FALSE(legend().isVisible());
    key(Qt::Key_Z);
    ASSERT_TRUE(legend().isVisible());
    EXPECT_THAT(legendText(), HasSubstr("Depth"));
    EXPECT_THAT(legendText(), HasSubstr("m\n"));
    EXPECT_TRUE(viewport().rect().contains(legend().geometry()));
    key(Qt::Key_0);
    EXPECT_FALSE(legend().isVisible());
}

TEST_F(ViewsWindowTest, AnAutomaticRangeFollowsThePictureUntilItIsLocked) {
    key(Qt::Key_Z);
    ASSERT_TRUE(rested() && frameCame());
    const auto* scale = legend().findChild<ColorScale*>();
    ASSERT_NE(scale, nullptr);
    const Camera camera = document().view.camera;
    const auto distance = static_cast<double>(camera.distance);
    EXPECT_GT(scale->min(), 0.3 * distance);
    EXPECT_LT(scale->max(), 3.0 * distance);

    auto* automatic = find<QToolButton>(legend(), QStringLiteral("Automatic range"));
    EXPECT_TRUE(automatic->isChecked());
    auto* max = find<NumberField>(legend(), QStringLiteral("Largest value"));
    max->setFocus();
    QTest::keyClicks(max, QStringLiteral("50"));
    QTest::keyClick(max, Qt::Key_Return);
    ASSERT_TRUE(views().settings().shown.range.has_value());
    EXPECT_EQ(views().settings().shown.range->max, 50.0f);
    EXPECT_FALSE(automatic->isChecked());
    EXPECT_TRUE(window->looks().lockRange->isChecked());
    // Another view has a range of its own, and this one keeps its.
    key(Qt::Key_M);
    EXPECT_FALSE(views().settings().shown.range.has_value());
    key(Qt::Key_Z);
    EXPECT_EQ(views().settings().shown.range->max, 50.0f);
    QTest::mouseClick(find<QToolButton>(legend(), QStringLiteral("Automatic range")),
                      Qt::LeftButton);
    EXPECT_FALSE(views().settings().shown.range.has_value());
}

TEST_F(ViewsWindowTest, DraggingTheScaleLocksTheRangeAndADoubleClickGivesItBack) {
    key(Qt::Key_M);
    auto* scale = legend().findChild<ColorScale*>();
    ASSERT_NE(scale, nullptr);
    EXPECT_EQ(scale->max(), 1.0);
    const int y = 5;
    drag(*scale, {scale->width() - 20, y}, {scale->width() - 60, y});
    ASSERT_TRUE(views().settings().shown.range.has_value());
    EXPECT_EQ(views().settings().shown.range->min, 0.0f);
    EXPECT_GT(views().settings().shown.range->max, 1.1f);
    QTest::mouseDClick(scale, Qt::LeftButton, Qt::NoModifier, {scale->width() / 2, y});
    EXPECT_FALSE(views().settings().shown.range.has_value());
    EXPECT_EQ(scale->max(), 1.0);
    EXPECT_EQ(document().view.camera.yawDeg, Camera{}.yawDeg) << "no orbit below the legend";
}

TEST_F(ViewsWindowTest, ContributionsAreAWishThatOtherViewsOutlive) {
    key(Qt::Key_M);
    QTest::mouseClick(find<QToolButton>(legend(), QStringLiteral("Contribution")), Qt::LeftButton);
    EXPECT_EQ(views().settings().shown.mode, render::ViewMode::Contribution);
    EXPECT_THAT(legendText(), HasSubstr(std::string(viewInfo(kViewMetallic).contribution)));
    key(Qt::Key_Z);
    EXPECT_EQ(views().settings().shown.mode, render::ViewMode::Raw) << "depth has none";
    key(Qt::Key_M);
    EXPECT_EQ(views().settings().shown.mode, render::ViewMode::Contribution);
    key(Qt::Key_C);
    EXPECT_EQ(views().settings().shown.mode, render::ViewMode::Raw);
}

TEST_F(ViewsWindowTest, AViewThatDoesNotApplySaysWhyAndIsNoBlackPicture) {
    key(Qt::Key_0);
    key(Qt::Key_L); // direct light
    EXPECT_THAT(legendText(), HasSubstr("No light is on"));
    EXPECT_EQ(legend().findChild<ColorScale*>(), nullptr);
    ASSERT_TRUE(rested() && frameCame());
    const QImage picture = viewport().grabFramebuffer();
    EXPECT_GT(qGray(picture.pixel(picture.rect().center())), 5);
    // The next step is a button.
    auto* add = find<QPushButton>(legend(), QStringLiteral("Add a light"));
    ASSERT_NE(add, nullptr);
    QTest::mouseClick(add, Qt::LeftButton);
    EXPECT_EQ(document().lights.size(), 1u);
    EXPECT_THAT(legendText(), Not(HasSubstr("No light is on")));
    EXPECT_EQ(legend().findChild<QPushButton*>(QStringLiteral("legendRemedy")), nullptr);
}

// Needs a bake with bounces: the button bakes it, and then the view is there.
TEST_F(ViewsWindowTest, AViewWithoutItsBakeOffersToBakeIt) {
    views().show(kViewInterreflectedLight);
    EXPECT_THAT(legendText(), HasSubstr("bounces"));
    auto* bake = find<QPushButton>(legend(), QStringLiteral("Bake with bounces"));
    ASSERT_NE(bake, nullptr);
    EXPECT_EQ(session->jobs.runningCount(), 0);
    QTest::mouseClick(bake, Qt::LeftButton);
    ASSERT_TRUE(eventually([] { return session->jobs.runningCount() > 0; }));
    session->jobs.cancelAll();
    EXPECT_TRUE(eventually([] { return session->jobs.runningCount() == 0; }));
}

TEST_F(ViewsWindowTest, FactorsAreComputedForTheLightThatIsChosen) {
    const Id id = controller().addLight(LightType::Point);
    views().show(kViewD);
    auto* box = find<QComboBox>(legend(), QStringLiteral("Light of the factors"));
    ASSERT_NE(box, nullptr);
    EXPECT_EQ(box->currentIndex(), 0);
    ASSERT_EQ(box->count(), 2);
    box->setFocus();
    QTest::keyClick(box, Qt::Key_Down);
    EXPECT_EQ(views().settings().light, id);
    controller().undoStack().undo(); // the light is gone
    EXPECT_EQ(views().settings().light, Id{0});
    EXPECT_EQ(find<QComboBox>(legend(), QStringLiteral("Light of the factors"))->count(), 1);
}

TEST_F(ViewsWindowTest, InvalidPixelsBlinkOnlyWhileTheyAreLookedAt) {
    ASSERT_TRUE(rested());
    views().show(kViewInvalid);
    EXPECT_THAT(legendText(), HasSubstr("Not a number"));
    int frames = 0;
    const auto counting = QObject::connect(&viewport(), &ViewportWidget::frameRendered, &viewport(),
                                           [&] { ++frames; });
    EXPECT_TRUE(eventually([&] { return frames >= 4; }));
    views().show(kViewFinal);
    // What was under way comes to rest; then nothing to wait for is left: three turns of a blink.
    ASSERT_TRUE(eventually([] { return viewport().isSettled(); }));
    frames = 0;
    QTest::qWait(1050);
    EXPECT_EQ(frames, 0);
    QObject::disconnect(counting);
}

// --- Strip -----------------------------------------------------------------------------------

TEST_F(ViewsWindowTest, TheStripShowsThumbnailsAndAClickShowsTheView) {
    strip().setFolded(false);
    auto* groups = strip().findChild<QTabBar*>(QStringLiteral("viewGroups"));
    QTest::mouseClick(groups, Qt::LeftButton, Qt::NoModifier, groups->tabRect(1).center());
    ASSERT_TRUE(thumb(kViewBaseColor).isVisible());
    EXPECT_FALSE(thumb(kViewDepth).isVisible());
    ASSERT_TRUE(eventually([] { return !thumb(kViewBaseColor).picture().isNull(); }));
    EXPECT_EQ(thumb(kViewBaseColor).picture().size(),
              ViewThumb::kPicture * viewport().devicePixelRatioF());
    QTest::mouseClick(&thumb(kViewBaseColor), Qt::LeftButton);
    EXPECT_EQ(shown(), kViewBaseColor);
    EXPECT_FALSE(views().settings().split);
    // A key that shows another group brings its thumbnails.
    key(Qt::Key_Z);
    EXPECT_TRUE(thumb(kViewDepth).isVisible());
    EXPECT_EQ(groups->currentIndex(), 2);
}

TEST_F(ViewsWindowTest, ThumbnailsFollowTheMaterial) {
    strip().setFolded(false);
    views().show(kViewBaseColor);
    const auto picture = [] { return thumb(kViewBaseColor).picture(); };
    ASSERT_TRUE(eventually([&] { return !picture().isNull(); }));
    const QImage before = picture();
    controller().setParameter(*findParameter("material.baseColor"),
                              {Scope::Material, selectedMaterial().id},
                              glm::vec3(0.9f, 0.1f, 0.1f));
    EXPECT_TRUE(eventually([&] { return picture() != before; }));
}

// A picture without a term is drawn by other programs. Thumbnails that kept the last picture's
// terms until those are compiled would keep them for good: nothing is edited when the picture
// comes.
TEST_F(ViewsWindowTest, ThumbnailsHaveTheChosenTermsWhileThePictureWaits) {
    ViewState chosen;
    ViewFeed feed(controller());
    ViewGate gate(controller()); // it knows no programs yet
    feed.setViews(chosen);
    EXPECT_EQ(feed.beginFrame(gate), chosen.settings());
    ASSERT_FALSE(gate.waiting()) << "the first frame is drawn in any case";
    chosen.edit([](render::ViewSettings& settings) { settings.terms[0] = false; });
    EXPECT_TRUE(feed.beginFrame(gate).terms[0]);
    ASSERT_TRUE(gate.waiting());
    EXPECT_FALSE(feed.chosen().terms[0]);
    // When they are there, the picture is as chosen, too.
    ASSERT_TRUE(eventually([&] { return feed.beginFrame(gate) == chosen.settings(); }));
}

TEST_F(ViewsWindowTest, AFoldedStripDrawsNothing) {
    strip().setFolded(false);
    views().show(kViewBaseColor);
    ASSERT_TRUE(rested());
    key(Qt::Key_T);
    EXPECT_TRUE(strip().isFolded());
    test::handleEvents();
    int passes = 0;
    const auto counting = QObject::connect(&viewport().sheets(), &SheetScheduler::passDrawn,
                                           &viewport(), [&] { ++passes; });
    viewport().sheets().invalidate();
    ASSERT_TRUE(frameCame() && eventually([] { return viewport().isSettled(); }));
    EXPECT_EQ(passes, 0);
    QTest::mouseClick(strip().findChild<QToolButton*>(QStringLiteral("foldViews")), Qt::LeftButton);
    EXPECT_FALSE(strip().isFolded());
    EXPECT_TRUE(eventually([&] { return passes > 0; }));
    QObject::disconnect(counting);
}

TEST_F(ViewsWindowTest, NoThumbnailIsDrawnWhileTheHandMoves) {
    strip().setFolded(false);
    views().show(kViewBaseColor);
    ASSERT_TRUE(rested());
    int passes = 0;
    const auto counting = QObject::connect(&viewport().sheets(), &SheetScheduler::passDrawn,
                                           &viewport(), [&] { ++passes; });
    const QPoint from = viewport().rect().center() + QPoint(60, 60);
    QTest::mousePress(&viewport(), Qt::LeftButton, Qt::NoModifier, from);
    QTest::mouseMove(&viewport(), from + QPoint(10, 0));
    passes = 0;
    for (int i = 0; i < 12; ++i) {
        QTest::mouseMove(&viewport(), from + QPoint(12 + i, 0));
        ASSERT_TRUE(frameCame());
    }
    EXPECT_EQ(passes, 0);
    QTest::mouseRelease(&viewport(), Qt::LeftButton, Qt::NoModifier, from);
    EXPECT_TRUE(eventually([&] { return passes > 0; })) << "from the new side, at rest";
    QObject::disconnect(counting);
}

TEST_F(ViewsWindowTest, ADoubleClickPutsTheViewOnTheOtherSide) {
    strip().setFolded(false);
    views().show(kViewBaseColor);
    QTest::mouseClick(&thumb(kViewMetallic), Qt::LeftButton);
    QTest::mouseDClick(&thumb(kViewMetallic), Qt::LeftButton);
    ASSERT_TRUE(views().settings().split.has_value());
    EXPECT_EQ(views().settings().split->other.kind, kViewMetallic);
    EXPECT_EQ(shown(), kViewBaseColor) << "as before the first of the clicks";
}

// --- Split -----------------------------------------------------------------------------------

TEST_F(ViewsWindowTest, ASplitIsDraggedTurnedAndTakenAway) {
    key(Qt::Key_B);
    key(Qt::Key_V);
    ASSERT_TRUE(views().settings().split.has_value());
    EXPECT_EQ(views().settings().split->other.kind, kViewFinal);
    const auto line = [] { return SplitLine(*views().settings().split, viewport().size()); };
    const float yaw = document().view.camera.yawDeg;

    const QPoint center = line().center.toPoint();
    drag(viewport(), center, center + QPoint(80, 30));
    EXPECT_NEAR(line().center.x(), center.x() + 80, 1.5);
    EXPECT_NEAR(line().center.y(), center.y() + 30, 1.5);
    // Anywhere along the line.
    const QPoint far(line().center.toPoint().x() + 2, viewport().height() - 20);
    drag(viewport(), far, far - QPoint(40, 0));
    EXPECT_NEAR(line().center.x(), center.x() + 40, 2.5);

    drag(viewport(), line().ring().toPoint(), line().center.toPoint() + QPoint(90, 1));
    EXPECT_NEAR(views().settings().split->angleDeg, 90.0f, 2.0f);
    drag(viewport(), line().ring().toPoint(), line().center.toPoint() + QPoint(60, -70),
         Qt::ShiftModifier);
    EXPECT_FLOAT_EQ(views().settings().split->angleDeg, 45.0f);
    EXPECT_EQ(document().view.camera.yawDeg, yaw) << "the camera stays";

    // Esc takes a drag back, and then the split away.
    const render::ViewSplit before = *views().settings().split;
    QTest::mousePress(&viewport(), Qt::LeftButton, Qt::NoModifier, line().center.toPoint());
    QTest::mouseMove(&viewport(), line().center.toPoint() + QPoint(30, 30));
    EXPECT_NE(views().settings().split->position, before.position);
    key(Qt::Key_Escape);
    EXPECT_EQ(*views().settings().split, before);
    QTest::mouseRelease(&viewport(), Qt::LeftButton, Qt::NoModifier, line().center.toPoint());
    key(Qt::Key_Escape);
    EXPECT_FALSE(views().settings().split);
    drag(viewport(), center, center + QPoint(80, 0));
    EXPECT_NE(document().view.camera.yawDeg, yaw) << "the hand has its drags again";
}

TEST_F(ViewsWindowTest, EachSideShowsItsViewAndHasItsLegend) {
    views().show(kViewBaseColor);
    views().showOther(kViewShadingNormal);
    ASSERT_TRUE(rested() && frameCame());
    EXPECT_TRUE(legend().isVisible());
    EXPECT_TRUE(legend("legendOther").isVisible());
    EXPECT_THAT(legendText("legendOther"), HasSubstr("Shading Normal"));
    EXPECT_LT(legend().x(), legend("legendOther").x());
    const QImage both = viewport().grabFramebuffer();
    views().edit([](render::ViewSettings& settings) { settings.split->angleDeg = 180.0f; });
    EXPECT_GT(legend().x(), legend("legendOther").x()) << "legends lie on the sides of their views";
    ASSERT_TRUE(rested() && frameCame());
    const QImage turned = viewport().grabFramebuffer();
    views().edit([](render::ViewSettings& settings) { settings.split.reset(); });
    ASSERT_TRUE(rested() && frameCame());
    const QImage whole = viewport().grabFramebuffer();
    // Near the middle, where the model is.
    const QPoint left(whole.width() / 2 - 12, whole.height() / 2);
    const QPoint right(whole.width() / 2 + 12, whole.height() / 2);
    EXPECT_EQ(both.pixel(left), whole.pixel(left));
    EXPECT_NE(both.pixel(right), whole.pixel(right));
    EXPECT_EQ(turned.pixel(right), whole.pixel(right));
    EXPECT_NE(turned.pixel(left), whole.pixel(left));
}

// --- What is compiled, and pictures ------------------------------------------------------------

// Views in the document's light share their programs: when one has been shown, the very next frame
// shows any other.
TEST_F(ViewsWindowTest, WhatIsCompiledIsShownAtOnce) {
    views().show(kViewNoV);
    ASSERT_TRUE(rested() && frameCame());
    int frames = 0, waiting = 0;
    QObject here;
    QObject::connect(&viewport(), &ViewportWidget::frameRendered, &here, [&] {
        ++frames;
        waiting += viewport().waitsForPrograms() ? 1 : 0;
    });
    const LightingMode own = document().view.lighting;
    for (const ViewInfo& info : patina::views()) {
        if (lightingOf(info.kind, own) != own)
            continue;
        frames = 0;
        window->looks().view(info.kind)->trigger();
        EXPECT_EQ(shown(), info.kind);
        viewport().update(); // also of what is shown already
        ASSERT_TRUE(eventually([&] { return frames > 0; })) << info.id;
        EXPECT_EQ(waiting, 0) << info.id;
        EXPECT_FALSE(views().preparing()) << info.id;
    }
}

TEST_F(ViewsWindowTest, WhatTheStripCosts) {
    strip().setFolded(false);
    views().show(kViewFinal);
    ASSERT_TRUE(rested());
    double frameMs = 0;
    const auto timing = QObject::connect(&viewport(), &ViewportWidget::frameRendered, &viewport(),
                                         [&](double ms) { frameMs = ms; });
    ASSERT_TRUE(frameCame() && frameCame()); // the first one may wait for the compiler
    double passMs = 0;
    int passes = 0, drawn = 0;
    bool all = false;
    SheetScheduler& sheets = viewport().sheets();
    const auto counting =
        QObject::connect(&sheets, &SheetScheduler::passDrawn, &viewport(), [&](int n, double ms) {
            ++passes;
            drawn += n;
            passMs += ms;
        });
    const auto ending =
        QObject::connect(&sheets, &SheetScheduler::allDrawn, &viewport(), [&] { all = true; });
    QElapsedTimer clock;
    clock.start();
    sheets.invalidate();
    ASSERT_TRUE(eventually([&] { return all; }));
    std::printf("[ figures  ] %d thumbnails in %d passes: %.1f ms, spread over %lld ms; a frame at "
                "rest takes %.1f ms\n",
                drawn, passes, passMs, static_cast<long long>(clock.elapsed()), frameMs);
    EXPECT_GT(drawn, 0);
    for (const auto& connection : {timing, counting, ending})
        QObject::disconnect(connection);
}

TEST_F(ViewsWindowTest, Pictures) {
    strip().setFolded(false);
    bool drawn = false;
    const auto drawing = QObject::connect(&viewport().sheets(), &SheetScheduler::allDrawn,
                                          &viewport(), [&] { drawn = true; });
    const auto keep = [&](const char* name) {
        drawn = false;
        // A busy machine takes its time over the programs of so many views.
        ASSERT_TRUE(rested() && QTest::qWaitFor([&] { return drawn; }, 240'000));
        keepPicture(name);
    };
    views().show(kViewD);
    keep("views-d.png");
    views().show(kViewEmissive);
    keep("views-why.png");
    views().show(kViewLuminance);
    views().showOther(kViewTexelDensity);
    keep("views-split.png");
    QObject::disconnect(drawing);
}

// The last of these tests: what it begins ends with the window.
TEST_F(ViewsWindowTest, AtRestTheDriverCompilesWhatMayBeLookedAtNext) {
    ASSERT_TRUE(
        eventually([] { return viewport().isSettled() && !viewport().compilesPrograms(); }));
    viewport().setCompilesAhead(true);
    EXPECT_TRUE(viewport().compilesPrograms()) << "other lighting modes have not been shown";
    viewport().setCompilesAhead(false);
}

} // namespace
} // namespace patina::editor
