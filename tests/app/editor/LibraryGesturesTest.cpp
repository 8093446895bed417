// What pointer and keys do in the Library dock beyond choosing, by real events: environments that
// fade into each other, that are previewed, and that are rotated in their thumbnails.
#include "app/editor/library/EnvironmentPreview.h"
#include "app/editor/library/LibraryDelegate.h"
#include "app/editor/library/LibraryModel.h"
#include "app/editor/library/LibraryPanel.h"
#include "app/editor/library/LibraryView.h"
#include "app/editor/library/PreviewBadge.h"
#include "core/document/Document.h"
#include "core/document/Snapshot.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "tests/app/editor/EditorFixture.h"
#include "tests/support/Events.h"

#include <QDir>
#include <QMenu>
#include <QScrollBar>
#include <QSettings>
#include <QSignalSpy>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace patina::editor {
namespace {

// Mean difference of two pictures' channels, in 8-bit steps.
double meanDifference(const QImage& a, const QImage& b) {
    EXPECT_EQ(a.size(), b.size());
    double sum = 0.0;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x) {
            const QRgb p = a.pixel(x, y), q = b.pixel(x, y);
            sum += std::abs(qRed(p) - qRed(q)) + std::abs(qGreen(p) - qGreen(q)) +
                   std::abs(qBlue(p) - qBlue(q));
        }
    return sum / (3.0 * a.width() * a.height());
}

QImage meanOf(const QImage& a, const QImage& b) {
    QImage mean(a.size(), QImage::Format_RGB32);
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x) {
            const QRgb p = a.pixel(x, y), q = b.pixel(x, y);
            mean.setPixel(x, y,
                          qRgb((qRed(p) + qRed(q)) / 2, (qGreen(p) + qGreen(q)) / 2,
                               (qBlue(p) + qBlue(q)) / 2));
        }
    return mean;
}

class LibraryGesturesTest : public EditorTest {
  protected:
    void SetUp() override {
        preview().end();
        EditorTest::SetUp();
        viewport().setFixedSize(200, 160);
        viewport().setAddsSlowFrames(true); // pictures are compared, on busy machines too
        if (!window->actions().library->isChecked())
            window->actions().library->trigger();
        ASSERT_TRUE(eventually([] { return view().isVisible() && !library().busy(); }));
        window->activateWindow();
        ASSERT_TRUE(QTest::qWaitForWindowActive(window.get(), 30'000));
        QObject::connect(&viewport(), &ViewportWidget::frameRendered, &receiver,
                         [this](double, PictureState now) {
                             ++frames;
                             state = now;
                         });
        stopClock();
        ASSERT_TRUE(isSettled());
    }
    void TearDown() override {
        leave();
        viewport().fade().end();
        viewport().fade().setClock({});
        preview().setWanted(true);
        window->actions().fadeEnvironments->setChecked(true);
        viewport().setStyleSheet({});
    }

    static EnvironmentLibrary& library() { return EditorTest::session->library; }
    static EnvironmentPreview& preview() { return EditorTest::session->preview; }
    static ViewportWidget& viewport() { return window->viewport(); }
    static PictureFade& fade() { return viewport().fade(); }
    static LibraryPanel& panel() { return *window->findChild<LibraryPanel*>(); }
    static LibraryView& view() { return panel().view(); }
    static PreviewBadge& badge() { return *viewport().findChild<PreviewBadge*>(); }
    static std::string lit() { return document().environment().source; }
    static bool isSettled() {
        return eventually([] { return viewport().isSettled(); });
    }
    static QModelIndex item(const char* title) {
        for (int i = 0; i < view().model()->rowCount(); ++i)
            if (const QModelIndex index = view().model()->index(i, 0);
                index.data().toString() == QLatin1String(title)) {
                view().scrollTo(index);
                test::handleEvents();
                return index;
            }
        ADD_FAILURE() << title << " is not in the grid";
        return {};
    }

    // --- Fades
    void stopClock() {
        fade().setClock([this] { return milliseconds; });
    }
    // The new picture is there in full, below the old one, whose clock stands: nothing else is
    // awaited than that it moves.
    bool newIsRefined() {
        return eventually([this] {
            return fade().isOn() && !fade().waits() && state == PictureState::Refined &&
                   viewport().awaited() == Awaited::Fade;
        });
    }
    bool moreFrames(int count) {
        const int before = frames;
        return eventually([&] { return frames >= before + count; });
    }
    void pageDown() {
        viewport().setFocus();
        state = PictureState::Moving; // what was drawn before does not count
        QTest::keyClick(&viewport(), Qt::Key_PageDown);
    }

    // --- Pointer
    static void hoverAt(const QPoint& at) {
        QMouseEvent move(QEvent::MouseMove, at, view().viewport()->mapToGlobal(at), Qt::NoButton,
                         Qt::NoButton, Qt::NoModifier);
        QApplication::sendEvent(view().viewport(), &move);
    }
    static void hover(const char* title) { hoverAt(view().visualRect(item(title)).center()); }
    static void leave() {
        QEvent event(QEvent::Leave);
        QApplication::sendEvent(view().viewport(), &event);
    }
    static bool isPreviewed() {
        return eventually([] { return badge().isVisible(); });
    }
    // In place of the document's picture, as fine as it gets.
    bool isPreviewRefined() {
        if (!eventually([] { return viewport().previews(); }))
            return false;
        state = PictureState::Moving;
        return eventually([this] {
            milliseconds += PictureFade::kFadeMs;
            return !fade().isOn() && state == PictureState::Refined;
        });
    }
    static void drag(const QPoint& from, int pixels, Qt::KeyboardModifiers keys = Qt::NoModifier) {
        QWidget* grid = view().viewport();
        QTest::mousePress(grid, Qt::LeftButton, keys, from);
        for (int step = 1; step <= 4; ++step) {
            const QPoint at = from + QPoint(pixels * step / 4, 0);
            QMouseEvent move(QEvent::MouseMove, at, grid->mapToGlobal(at), Qt::NoButton,
                             Qt::LeftButton, keys);
            QApplication::sendEvent(grid, &move);
        }
    }
    static void drop(const QPoint& at) {
        QTest::mouseRelease(view().viewport(), Qt::LeftButton, {}, at);
    }
    static float rotation() { return document().environment().rotationDeg; }

    qint64 milliseconds = 0; // of the fade's clock
    int frames = 0;
    PictureState state = PictureState::Moving;
    QObject receiver; // connections end with the test
};

// --- Fades -------------------------------------------------------------------------------------

TEST_F(LibraryGesturesTest, AStepFadesFromTheOldPictureToTheNew) {
    const QImage before = viewport().grabFramebuffer();
    pageDown();
    ASSERT_TRUE(newIsRefined());
    EXPECT_EQ(lit(), "builtin:sunset");
    EXPECT_LT(meanDifference(viewport().grabFramebuffer(), before), 1.0)
        << "it begins with what was shown";
    milliseconds = PictureFade::kFadeMs / 2;
    const QImage middle = viewport().grabFramebuffer();
    milliseconds = PictureFade::kFadeMs;
    ASSERT_TRUE(isSettled()) << "it ends";
    const QImage after = viewport().grabFramebuffer();
    EXPECT_GT(meanDifference(before, after), 5.0);
    EXPECT_LT(meanDifference(middle, meanOf(before, after)), 1.5)
        << "from the old one " << meanDifference(middle, before) << ", from the new one "
        << meanDifference(middle, after) << ", these two " << meanDifference(before, after);
    EXPECT_EQ(undoCount(), 1);
}

TEST_F(LibraryGesturesTest, AFadeDrawsNothingOfTheSceneAgain) {
    pageDown();
    ASSERT_TRUE(newIsRefined());
    const auto scenes = viewport().counts().scenes;
    for (int step = 0; step < 6; ++step) {
        milliseconds += PictureFade::kFadeMs / 8;
        ASSERT_TRUE(moreFrames(1));
    }
    ASSERT_TRUE(fade().isOn());
    EXPECT_EQ(viewport().counts().scenes, scenes);
    EXPECT_GT(scenes, 0u) << "they are counted";
}

// Whatever is animated, as often as it likes: the picture that is awaited is drawn and shown.
TEST_F(LibraryGesturesTest, ANewPictureIsCompletedWhileAnAnimationGoesOn) {
    int reads = 0; // of a clock that never stands, and never comes to the end
    fade().setClock([&]() -> qint64 { return reads++ == 0 ? 0 : 50 + 100 * (reads % 2); });
    pageDown();
    // Up to the last slice of the last frame that is added: all but the fade's own end.
    int since = 0; // frames that showed nothing but the fade's next step
    std::uint64_t scenes = viewport().counts().scenes;
    ASSERT_TRUE(eventually([&] {
        if (std::exchange(scenes, viewport().counts().scenes) != scenes)
            since = frames;
        return fade().isOn() && !fade().waits() && state == PictureState::Refined &&
               EditorTest::session->ibl.finished() && frames > since + 20;
    }));
    EXPECT_EQ(lit(), "builtin:sunset");
    EXPECT_TRUE(fade().isOn());
    fade().end(); // before its clock
    fade().setClock({});
}

// A fade whose clock stands has nothing new to show.
TEST_F(LibraryGesturesTest, NothingIsPaintedWhereNoClockHasMoved) {
    pageDown();
    ASSERT_TRUE(newIsRefined());
    milliseconds += PictureFade::kFadeMs / 2;
    ASSERT_TRUE(moreFrames(1));
    ASSERT_TRUE(newIsRefined());
    const int before = frames;
    int turns = 0; // of the same schedule, at a slower pace than the fade's
    FrameSchedule::Animation other(viewport().schedule(), 20.0, [&] {
        ++turns;
        return false;
    });
    other.start();
    ASSERT_TRUE(eventually([&] { return turns == 10; }));
    EXPECT_EQ(frames, before);
    EXPECT_TRUE(fade().isOn());
}

TEST_F(LibraryGesturesTest, ASecondStepFadesFromWhatIsShown) {
    const QImage before = viewport().grabFramebuffer();
    pageDown();
    ASSERT_TRUE(newIsRefined());
    milliseconds = PictureFade::kFadeMs / 2;
    const QImage middle = viewport().grabFramebuffer();
    QSignalSpy arrived(&library(), &EnvironmentLibrary::arrived);
    pageDown();
    ASSERT_TRUE(eventually([&] { return !arrived.isEmpty(); }));
    EXPECT_EQ(lit(), "builtin:white");
    ASSERT_TRUE(newIsRefined());
    const QImage begin = viewport().grabFramebuffer();
    EXPECT_LT(meanDifference(begin, middle), 1.0);
    EXPECT_GT(meanDifference(begin, before), 2.0);
    EXPECT_EQ(undoCount(), 1);
}

TEST_F(LibraryGesturesTest, WhatIsReadFromTheViewportHasNoFade) {
    const QSize size(40, 32);
    const QImage before = viewport().smallPicture(size);
    pageDown();
    ASSERT_TRUE(newIsRefined());
    const QImage during = viewport().smallPicture(size); // while the old one covers all of it
    milliseconds = PictureFade::kFadeMs;
    ASSERT_TRUE(isSettled());
    const QImage after = viewport().smallPicture(size);
    EXPECT_GT(meanDifference(before, after), 5.0);
    EXPECT_LT(meanDifference(during, after), 1.0);
}

TEST_F(LibraryGesturesTest, EditsAndTheCameraEndAFade) {
    pageDown();
    ASSERT_TRUE(newIsRefined());
    controller().setMeshVisible(document().meshes.front().id, false);
    EXPECT_FALSE(fade().isOn());
    ASSERT_TRUE(isSettled());
    pageDown();
    ASSERT_TRUE(newIsRefined());
    QTest::mousePress(&viewport(), Qt::LeftButton, {}, QPoint(60, 60));
    QTest::mouseMove(&viewport(), QPoint(100, 80));
    QTest::mouseRelease(&viewport(), Qt::LeftButton, {}, QPoint(100, 80));
    EXPECT_TRUE(eventually([] { return !fade().isOn(); }));
}

TEST_F(LibraryGesturesTest, FadesAreSwitchedOffByTheMenuAndWhereNothingIsAnimated) {
    QSignalSpy arrived(&library(), &EnvironmentLibrary::arrived);
    window->actions().fadeEnvironments->trigger();
    EXPECT_FALSE(QSettings().value(QStringLiteral("viewport/fadeBetweenEnvironments")).toBool());
    pageDown();
    ASSERT_TRUE(eventually([&] { return arrived.size() == 1; }));
    EXPECT_FALSE(fade().isOn());
    window->actions().fadeEnvironments->trigger();
    EXPECT_TRUE(QSettings().value(QStringLiteral("viewport/fadeBetweenEnvironments")).toBool());
    ASSERT_TRUE(isSettled());
    // As styles say that animations are not wanted.
    viewport().setStyleSheet(QStringLiteral("* { widget-animation-duration: 0 }"));
    pageDown();
    ASSERT_TRUE(eventually([&] { return arrived.size() == 2; }));
    EXPECT_FALSE(fade().isOn());
}

TEST_F(LibraryGesturesTest, ArrowKeysInTheGridStepAsOneUndoStep) {
    view().setFocus();
    view().setCurrentIndex(item("Night"));
    EXPECT_EQ(lit(), "builtin:studio") << "to choose is not to use";
    QTest::keyClick(&view(), Qt::Key_Right);
    ASSERT_TRUE(eventually([] { return lit() == "builtin:overcast"; }));
    EXPECT_TRUE(fade().isOn());
    QTest::keyClick(&view(), Qt::Key_Left);
    ASSERT_TRUE(eventually([] { return lit() == "builtin:night"; }));
    EXPECT_EQ(undoCount(), 1);
    QTest::keyClick(&view(), Qt::Key_Right, Qt::ControlModifier);
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(lit(), "builtin:night");
    controller().undoStack().undo();
    EXPECT_EQ(lit(), "builtin:studio");
}

// --- Previews ----------------------------------------------------------------------------------

TEST_F(LibraryGesturesTest, APreviewIsShownAndLeavesNoTrace) {
    const Document before = document();
    const auto revision = controller().revision();
    const QImage shown = viewport().grabFramebuffer();
    const QImage small = viewport().smallPicture({40, 32});
    milliseconds = 0;
    hover("Sunset");
    ASSERT_TRUE(isPreviewed());
    EXPECT_EQ(badge().text(), QStringLiteral("Preview: Sunset"));
    EXPECT_TRUE(viewport().rect().contains(badge().geometry()));
    ASSERT_TRUE(isPreviewRefined());
    EXPECT_GT(meanDifference(viewport().grabFramebuffer(), shown), 5.0);
    EXPECT_LT(meanDifference(viewport().smallPicture({40, 32}), small), 0.5)
        << "that is of the document";
    EXPECT_EQ(controller().revision(), revision);
    EXPECT_EQ(document(), before);
    EXPECT_EQ(undoCount(), 0);

    const auto scenes = viewport().counts().scenes;
    leave();
    EXPECT_FALSE(preview().isOn());
    EXPECT_FALSE(badge().isVisible());
    ASSERT_TRUE(eventually([this] {
        milliseconds += 10 * PictureFade::kFadeMs;
        return viewport().isSettled();
    }));
    EXPECT_EQ(viewport().counts().scenes, scenes) << "the picture of the document has waited";
    EXPECT_EQ(viewport().grabFramebuffer(), shown);
    EXPECT_EQ(document(), before);
}

TEST_F(LibraryGesturesTest, EscScrollingAndAnotherItemEndAPreview) {
    hover("Sunset");
    ASSERT_TRUE(isPreviewed());
    QTest::keyClick(&view(), Qt::Key_Escape);
    EXPECT_FALSE(preview().isOn());
    EXPECT_FALSE(badge().isVisible());
    hover("Clear Sky");
    ASSERT_TRUE(isPreviewed());
    EXPECT_EQ(badge().text(), QStringLiteral("Preview: Clear Sky"));
    hover("Night");
    EXPECT_FALSE(preview().isOn()) << "it is another one's turn";
    ASSERT_TRUE(isPreviewed());
    EXPECT_EQ(badge().text(), QStringLiteral("Preview: Night"));
    Q_EMIT view().verticalScrollBar()->valueChanged(view().verticalScrollBar()->value());
    EXPECT_FALSE(preview().isOn());
    EXPECT_EQ(lit(), "builtin:studio");
    EXPECT_EQ(undoCount(), 0);
}

TEST_F(LibraryGesturesTest, WhatLightsTheSceneIsNotPreviewedAndNoneIsWhileSwitchedOff) {
    hover("Studio");
    QTest::qWait(400); // longer than the pointer rests before one begins
    EXPECT_FALSE(preview().isOn());
    const QPoint at = view().visualRect(item("Night")).center();
    QContextMenuEvent event(QContextMenuEvent::Mouse, at, view().viewport()->mapToGlobal(at));
    QApplication::sendEvent(view().viewport(), &event);
    auto* menu = panel().findChild<QMenu*>(QStringLiteral("libraryMenu"));
    ASSERT_NE(menu, nullptr);
    QAction* hovers = menu->actions().back();
    ASSERT_EQ(hovers->text(), QStringLiteral("&Preview on Hover"));
    EXPECT_TRUE(hovers->isChecked());
    hovers->trigger();
    menu->close();
    test::handleEvents();
    EXPECT_FALSE(QSettings().value(QStringLiteral("library/previewOnHover")).toBool());
    hover("Sunset");
    QTest::qWait(400);
    EXPECT_FALSE(preview().isOn());
    preview().setWanted(true);
    leave();
    hover("Sunset");
    EXPECT_TRUE(isPreviewed());
}

TEST_F(LibraryGesturesTest, ASnapshotTakenDuringAPreviewShowsTheDocument) {
    const auto keep = [] { return window->actions().keepSnapshot->trigger(); };
    keep();
    ASSERT_EQ(document().snapshots.size(), 1u);
    ASSERT_TRUE(isSettled());
    hover("Sunset");
    ASSERT_TRUE(isPreviewed());
    ASSERT_TRUE(isPreviewRefined());
    keep();
    ASSERT_EQ(document().snapshots.size(), 2u);
    EXPECT_FALSE(preview().isOn()) << "an edit ends it";
    ASSERT_TRUE(document().snapshots[0].picture && document().snapshots[1].picture);
    EXPECT_EQ(*document().snapshots[0].picture, *document().snapshots[1].picture);
}

TEST_F(LibraryGesturesTest, APreviewThatIsUsedStaysUntilItLightsTheScene) {
    hover("Sunset");
    ASSERT_TRUE(isPreviewed());
    const QPoint at = view().visualRect(item("Sunset")).center();
    QTest::mouseClick(view().viewport(), Qt::LeftButton, {}, at);
    EXPECT_TRUE(preview().isOn()) << "to choose is not to leave";
    QTest::mouseDClick(view().viewport(), Qt::LeftButton, {}, at);
    ASSERT_TRUE(eventually([] { return lit() == "builtin:sunset"; }));
    EXPECT_FALSE(preview().isOn());
    EXPECT_EQ(undoCount(), 1);
    milliseconds += 10 * PictureFade::kFadeMs;
    EXPECT_TRUE(eventually([this] {
        milliseconds += PictureFade::kFadeMs;
        return viewport().isSettled();
    }));
}

TEST_F(LibraryGesturesTest, AStepToAnotherEnvironmentEndsAPreview) {
    hover("Night");
    ASSERT_TRUE(isPreviewed());
    pageDown();
    EXPECT_FALSE(preview().isOn());
    EXPECT_TRUE(eventually([] { return lit() == "builtin:sunset"; }));
}

TEST_F(LibraryGesturesTest, PreparedPreviewsKeepToTheBudgetOfTheCache) {
    for (const char* title : {"Sunset", "Clear Sky", "Night", "Overcast", "White"}) {
        hover(title);
        ASSERT_TRUE(isPreviewed());
        ASSERT_TRUE(isPreviewRefined());
        EXPECT_LE(EditorTest::session->lights.bytes(), PreparedLights::kDefaultBudget);
    }
}

TEST_F(LibraryGesturesTest, InAWallTheCurrentCellShowsThePreview) {
    WallState& wall = EditorTest::session->wall;
    wall.setOn(true);
    ASSERT_TRUE(isSettled());
    hover("Sunset");
    ASSERT_TRUE(isPreviewed());
    EXPECT_EQ(badge().text(), QStringLiteral("No preview: click a cell to see it there"));
    leave();
    wall.setCurrent(0);
    ASSERT_TRUE(isSettled());
    const QImage before = viewport().grabFramebuffer();
    const QRect cell = viewport().previewArea();
    ASSERT_LT(cell.width(), viewport().width());
    hover("Clear Sky");
    ASSERT_TRUE(isPreviewed());
    EXPECT_EQ(badge().text(), QStringLiteral("Preview: Clear Sky"));
    ASSERT_TRUE(eventually([&] {
        return meanDifference(viewport().grabFramebuffer().copy(cell), before.copy(cell)) > 3.0;
    }));
    EXPECT_FALSE(viewport().wallPainter().sheetCells(100).has_value()) << "it is in no file";
    EXPECT_TRUE(viewport().smallPicture({40, 32}).isNull());
    leave();
    ASSERT_TRUE(isSettled());
    EXPECT_LT(meanDifference(viewport().grabFramebuffer(), before), 0.5);
    EXPECT_EQ(undoCount(), 0);
    wall.setOn(false);
}

// --- Rotation ----------------------------------------------------------------------------------

TEST_F(LibraryGesturesTest, TheHandleOfTheCurrentThumbnailRotatesAsOneStep) {
    view().scrollToTop(); // as another test left it, and as the list is laid out anew
    QCoreApplication::processEvents();
    const QRect place = view().visualRect(item("Studio"));
    const QRect picture = LibraryDelegate::pictureRect(place);
    const QImage before = view().viewport()->grab().toImage();
    const QPoint from = LibraryDelegate::turnRect(place).center();
    drag(from, 32); // a quarter of the picture
    EXPECT_FLOAT_EQ(rotation(), -90.0f);
    EXPECT_EQ(document().environment().source, "builtin:studio");
    drop(from + QPoint(32, 0));
    EXPECT_EQ(undoCount(), 1);
    EXPECT_FLOAT_EQ(item("Studio").data(LibraryModel::RotationRole).toFloat(), -90.0f);
    EXPECT_FALSE(item("Night").data(LibraryModel::RotationRole).isValid());

    // The picture has followed the pointer, around its edge.
    ASSERT_EQ(view().visualRect(item("Studio")), place);
    const QImage after = view().viewport()->grab().toImage();
    for (int x = 4; x < picture.width() - 4; ++x) {
        const int y = picture.top() + picture.height() / 2 - 8; // above the handle, below the star
        const int source = (x - 32 + picture.width()) % picture.width();
        if (source < 4 || source >= picture.width() - 4 || x >= picture.width() - 30 ||
            source >= picture.width() - 30)
            continue; // rounded corners; the star
        EXPECT_NEAR(qGreen(after.pixel(picture.left() + x, y)),
                    qGreen(before.pixel(picture.left() + source, y)), 2)
            << x;
    }
    drag(from, 16, Qt::ShiftModifier); // another drag, another step
    drop(from + QPoint(16, 0));
    EXPECT_FLOAT_EQ(rotation(), -135.0f);
    EXPECT_EQ(undoCount(), 2);
    controller().undoStack().undo();
    EXPECT_FLOAT_EQ(rotation(), -90.0f);
    controller().undoStack().undo();
    EXPECT_FLOAT_EQ(rotation(), 0.0f);
}

TEST_F(LibraryGesturesTest, ShiftDragRotatesAnywhereInThePictureAndEscTakesItBack) {
    const QPoint from =
        LibraryDelegate::pictureRect(view().visualRect(item("Studio"))).topLeft() + QPoint(10, 10);
    drag(from, -16, Qt::ShiftModifier);
    EXPECT_FLOAT_EQ(rotation(), 45.0f);
    QTest::keyClick(&view(), Qt::Key_Escape);
    EXPECT_FLOAT_EQ(rotation(), 0.0f);
    drop(from);
    EXPECT_EQ(undoCount(), 0);
    // Others are not rotated: what is lit by them is not there.
    const QPoint other = LibraryDelegate::turnRect(view().visualRect(item("Night"))).center();
    QTest::mouseClick(view().viewport(), Qt::LeftButton, Qt::ShiftModifier, other);
    EXPECT_FLOAT_EQ(rotation(), 0.0f);
    EXPECT_EQ(view().currentSource(), QStringLiteral("builtin:night"));
}

TEST_F(LibraryGesturesTest, ShiftWithArrowKeysRotatesAsOneStep) {
    view().setFocus();
    view().setCurrentIndex(item("Studio"));
    for (int i = 0; i < 3; ++i)
        QTest::keyClick(&view(), Qt::Key_Left, Qt::ShiftModifier);
    EXPECT_FLOAT_EQ(rotation(), 15.0f);
    EXPECT_EQ(undoCount(), 1);
    EXPECT_EQ(lit(), "builtin:studio");
    EXPECT_EQ(view().currentSource(), QStringLiteral("builtin:studio"));
    QTest::keyClick(&view(), Qt::Key_Right, Qt::ShiftModifier);
    EXPECT_FLOAT_EQ(rotation(), 10.0f);
    EXPECT_EQ(undoCount(), 1);
}

} // namespace
} // namespace patina::editor
