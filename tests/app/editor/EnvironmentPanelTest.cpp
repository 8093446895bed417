// The Environment dock by real events: kinds, the lat-long view with its sun and softboxes.

#include "core/document/ViewChoices.h"
#include "tests/app/editor/EditorFixture.h"

#include "app/editor/panel/EnvironmentList.h"
#include "app/editor/panel/EnvironmentPanel.h"
#include "app/editor/panel/ParameterList.h"
#include "app/editor/panel/SoftboxList.h"
#include "app/editor/widget/LatLongView.h"
#include "app/editor/widget/RecentSkies.h"
#include "app/editor/widget/SkyGallery.h"
#include "core/base/InputFile.h"
#include "core/edit/EditSession.h"
#include "core/library/SoftboxRigs.h"
#include "core/light/BrightSources.h"
#include "core/light/GeneratedEnvironment.h"
#include "core/light/LatLongGrid.h"
#include "core/light/Light.h"
#include "core/scene/EnvironmentSave.h"

#include <QFile>
#include <QListWidget>
#include <QMenu>
#include <QPushButton>
#include <QToolButton>
#include <cmath>

namespace patina::editor {
namespace {

// The panel in a window of its own: a viewport would draw each step and filter its light, which
// takes long and shows nothing of the panel.
struct EnvironmentPanelTest : EditorTest {
    static void SetUpTestSuite() {
        session = std::make_unique<Session>();
        alone = std::make_unique<EnvironmentPanel>(session->controller, session->thumbnails);
        alone->resize(400, 700);
        alone->show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(alone.get(), 60'000));
    }
    static void TearDownTestSuite() {
        alone.reset();
        session.reset();
    }
    static EnvironmentPanel& panel() { return *alone; }
    static LatLongView& view() { return *panel().view(); }
    static const Environment& environment() { return document().environment(); }
    static const Softbox& softbox(std::size_t index) { return environment().softboxes.at(index); }

    void SetUp() override {
        EditorTest::SetUp();
        ASSERT_TRUE(view().isVisible());
    }
    static void choose(const char* kind) {
        auto* button = find<QToolButton>(panel(), QStringLiteral("Environment kind %1").arg(kind));
        ASSERT_NE(button, nullptr);
        QTest::mouseClick(button, Qt::LeftButton);
        EXPECT_TRUE(button->isChecked());
        QApplication::processEvents();
    }
    // One softbox alone, selected.
    static Id chooseOneSoftbox(const Softbox& softbox) {
        choose("Softboxes");
        Id id = 0;
        controller().editStructure(QStringLiteral("one"), [&](Document& edited) {
            edited.environment().softboxes.clear();
            id = patina::addSoftbox(edited, softbox);
        });
        panel().softboxes()->select(id);
        controller().undoStack().clear();
        QApplication::processEvents();
        return id;
    }
    static QString tr(const char* text) { return QString::fromUtf8(text); }
    static QPoint pointOf(double azimuthDeg, double elevationDeg) {
        return view().map().point(directionFromAngles(azimuthDeg, elevationDeg)).toPoint();
    }
    static QPoint handlePoint(SoftboxHandle wanted) {
        for (const auto& [handle, point] : handlesOf(softbox(0), view().map()))
            if (handle == wanted)
                return point.toPoint();
        ADD_FAILURE() << "no such handle";
        return {};
    }
    static void press(QPoint point, Qt::KeyboardModifiers keys = {}) {
        QTest::mousePress(&view(), Qt::LeftButton, keys, point);
    }
    static void moveTo(QPoint point, Qt::KeyboardModifiers keys = {}) {
        QMouseEvent move(QEvent::MouseMove, point, view().mapToGlobal(QPointF(point)), Qt::NoButton,
                         Qt::LeftButton, keys);
        QApplication::sendEvent(&view(), &move);
    }
    static void release(QPoint point) { QTest::mouseRelease(&view(), Qt::LeftButton, {}, point); }
    static void drag(QPoint from, QPoint to, Qt::KeyboardModifiers keys = {}) {
        press(from, keys);
        for (int step = 1; step <= 8; ++step)
            moveTo(from + (to - from) * step / 8, keys);
        release(to);
    }
    // Radiance of the environment's image, green.
    static float radiance(double azimuthDeg, double elevationDeg) {
        const Image& image = *environment().image;
        const glm::dvec3 d = directionFromAngles(azimuthDeg, elevationDeg);
        const double u = 0.5 + std::atan2(d.x, -d.z) / 6.283185307179586;
        const double v = std::acos(d.y) / 3.141592653589793;
        return image
            .linear(static_cast<int>(u * image.width()) % image.width(),
                    std::min(static_cast<int>(v * image.height()), image.height() - 1))
            .g;
    }
    static double degreesPerPixel() { return 360.0 / view().map().area().width(); }

    static inline std::unique_ptr<EnvironmentPanel> alone;
};

Softbox plainBox(float azimuthDeg, float elevationDeg) {
    Softbox softbox;
    softbox.name = "Key";
    softbox.azimuthDeg = azimuthDeg;
    softbox.elevationDeg = elevationDeg;
    softbox.intensity = 10.0f;
    return softbox;
}

TEST_F(EnvironmentPanelTest, KindsChangeTheImageAndComeBack) {
    const ImagePtr studio = environment().image;
    choose("Sky");
    EXPECT_EQ(environment().kind, EnvironmentKind::Sky);
    EXPECT_NE(environment().image, studio);
    EXPECT_EQ(undoCount(), 1);
    EXPECT_FALSE(panel().gallery()->isVisible());
    choose("Softboxes");
    EXPECT_EQ(environment().softboxes.size(), library::softboxRigs().front().softboxes.size());
    EXPECT_EQ(undoCount(), 2); // kind and rig are one step
    choose("Image");
    EXPECT_EQ(environment().image, studio);
    EXPECT_TRUE(panel().gallery()->isVisible());
    controller().undoStack().undo();
    EXPECT_EQ(environment().kind, EnvironmentKind::Softboxes);
    controller().undoStack().undo();
    EXPECT_EQ(environment().kind, EnvironmentKind::Sky);
    EXPECT_TRUE(environment().softboxes.empty());
    controller().undoStack().undo();
    EXPECT_EQ(environment().image, studio);
    // An image chosen by name ends the sky, in one step.
    choose("Sky");
    controller().setEnvironment(QStringLiteral("builtin:white"));
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(environment().kind, EnvironmentKind::Image);
    EXPECT_EQ(environment().image->linear(0, 0).g, 1.0f);
    controller().undoStack().undo();
    EXPECT_EQ(environment().kind, EnvironmentKind::Sky);
    EXPECT_GT(radiance(environment().sky.sunAzimuthDeg, environment().sky.sunElevationDeg), 100.0f);
}

TEST_F(EnvironmentPanelTest, DraggingASoftboxMovesItsLight) {
    chooseOneSoftbox(plainBox(180, 0)); // the seam of the view
    ASSERT_TRUE(eventually([] { return environment().image->width() == 2 * kEnvironmentHeight; }));
    EXPECT_NEAR(radiance(180, 0), 10.02f, 0.05f);
    const ImagePtr before = environment().image;
    const QImage shown = view().grab().toImage();

    const QPoint from = pointOf(180, 0), way(-60, -20);
    press(from);
    moveTo(from + way / 2);
    // A draft at once, while the button is down.
    EXPECT_EQ(environment().image->height(), kDraftEnvironmentHeight);
    EXPECT_NE(environment().image, before);
    moveTo(from + way);
    release(from + way);
    const float azimuth = softbox(0).azimuthDeg, elevation = softbox(0).elevationDeg;
    const double expected = 180.0 + 60 * degreesPerPixel() - 360.0;
    EXPECT_NEAR(azimuth, expected, 0.01); // to the left azimuth grows
    EXPECT_NEAR(elevation, 20 * 180.0 / view().map().area().height(), 0.01);
    EXPECT_NEAR(radiance(azimuth, elevation), 10.02f, 0.05f);
    EXPECT_LT(radiance(180, 0), 0.1f);
    EXPECT_EQ(undoCount(), 1);
    EXPECT_NE(view().grab().toImage(), shown);
    // The full picture follows by itself, is no step of its own, and moves nothing.
    ASSERT_TRUE(eventually([] { return environment().image->width() == 2 * kEnvironmentHeight; }));
    EXPECT_EQ(undoCount(), 1);
    EXPECT_NEAR(radiance(azimuth, elevation), 10.02f, 0.05f);

    controller().undoStack().undo();
    EXPECT_EQ(softbox(0).azimuthDeg, 180.0f);
    EXPECT_EQ(softbox(0).elevationDeg, 0.0f);
    EXPECT_EQ(*environment().image, *before);
    controller().undoStack().redo();
    EXPECT_EQ(softbox(0).azimuthDeg, azimuth);
    EXPECT_LT(radiance(180, 0), 0.1f);
}

TEST_F(EnvironmentPanelTest, TheEnvironmentKeepsItsShapeInADockOfAnyWidth) {
    choose("Softboxes"); // longer than the dock is high
    for (const int width : {311, 520, 400}) {
        alone->resize(width, 700);
        QApplication::processEvents();
        ASSERT_TRUE(eventually([] { return view().width() <= 2 * view().height() + 1; })) << width;
        EXPECT_GE(view().width(), width - 60);
        EXPECT_NEAR(view().height(), view().width() / 2.0, 8.5) << width;
    }
}

TEST_F(EnvironmentPanelTest, EscapeCancelsADrag) {
    chooseOneSoftbox(plainBox(150, 10));
    const QPoint from = pointOf(150, 10);
    press(from);
    moveTo(from + QPoint(30, 10));
    moveTo(from + QPoint(60, 10));
    ASSERT_NE(softbox(0).azimuthDeg, 150.0f);
    QTest::keyClick(&view(), Qt::Key_Escape);
    EXPECT_EQ(softbox(0).azimuthDeg, 150.0f);
    EXPECT_EQ(softbox(0).elevationDeg, 10.0f);
    EXPECT_EQ(undoCount(), 0);
    moveTo(from + QPoint(80, 10)); // what follows belongs to nothing
    release(from + QPoint(80, 10));
    EXPECT_EQ(softbox(0).azimuthDeg, 150.0f);
    EXPECT_EQ(undoCount(), 0);
}

TEST_F(EnvironmentPanelTest, AClickThatTremblesMovesNothing) {
    chooseOneSoftbox(plainBox(150, 10));
    const QPoint from = pointOf(150, 10);
    press(from);
    moveTo(from + QPoint(1, 1));
    release(from + QPoint(1, 1));
    EXPECT_EQ(undoCount(), 0);
    EXPECT_EQ(panel().softboxes()->selected(), softbox(0).id);
    // Beside it: nothing is selected any more.
    press(pointOf(0, -60));
    release(pointOf(0, -60));
    EXPECT_EQ(panel().softboxes()->selected(), 0u);
}

TEST_F(EnvironmentPanelTest, HandlesResizeAboutTheMiddle) {
    Softbox softboxBefore = plainBox(180, 0);
    softboxBefore.widthDeg = softboxBefore.heightDeg = 60;
    chooseOneSoftbox(softboxBefore);
    const QPoint right = handlePoint(SoftboxHandle::Right);
    drag(right, right + QPoint(12, 0));
    // On the horizon azimuths are angles: each side grows by 12 pixels.
    EXPECT_NEAR(softbox(0).widthDeg, 60 + 24 * degreesPerPixel(), 1.6);
    EXPECT_EQ(softbox(0).heightDeg, 60.0f);
    EXPECT_EQ(softbox(0).azimuthDeg, 180.0f);
    EXPECT_EQ(undoCount(), 1);
    controller().undoStack().undo();
    EXPECT_EQ(softbox(0).widthDeg, 60.0f);

    const QPoint corner = handlePoint(SoftboxHandle::BottomLeft);
    drag(corner, corner + QPoint(-10, 4), Qt::ShiftModifier); // in shape
    EXPECT_GT(softbox(0).widthDeg, 65.0f);
    EXPECT_FLOAT_EQ(softbox(0).heightDeg, softbox(0).widthDeg);
    controller().undoStack().undo();

    // Through the middle and beyond: as small as it gets, never inside out.
    drag(right, right + QPoint(-90, 0));
    EXPECT_FLOAT_EQ(softbox(0).widthDeg, 0.5f);
}

TEST_F(EnvironmentPanelTest, TheRoundHandleRolls) {
    Softbox flat = plainBox(180, 0);
    flat.widthDeg = 50;
    flat.heightDeg = 30;
    chooseOneSoftbox(flat);
    const QPoint top = handlePoint(SoftboxHandle::Roll), middle = pointOf(180, 0);
    const int radius = middle.y() - top.y();
    drag(top, middle - QPoint(radius, 0)); // from above to the left: counter-clockwise
    EXPECT_NEAR(softbox(0).rollDeg, 90.0f, 2.5f);
    controller().undoStack().undo();
    EXPECT_EQ(softbox(0).rollDeg, 0.0f);
    drag(top, middle + QPoint(radius, -radius), Qt::ShiftModifier); // snaps
    EXPECT_FLOAT_EQ(softbox(0).rollDeg, -45.0f);
}

TEST_F(EnvironmentPanelTest, ASoftboxCrossesTheSeam) {
    chooseOneSoftbox(plainBox(170, 0)); // a little right of the left end
    const QPoint from = pointOf(170, 0);
    const auto pixels = static_cast<int>(std::lround(25 / degreesPerPixel()));
    drag(from, from - QPoint(pixels, 0));
    EXPECT_NEAR(softbox(0).azimuthDeg, 170 + pixels * degreesPerPixel() - 360, 0.01);
    // It is drawn, and can be taken, on both sides.
    controller().setParameter(parameter("softbox.azimuthDeg"), {Scope::Softbox, softbox(0).id},
                              180.0f);
    const QRectF area = view().map().area();
    for (const double x : {area.left() + 6, area.right() - 6}) {
        panel().softboxes()->select(0);
        const QPoint point = QPointF(x, area.center().y() - 4).toPoint();
        press(point);
        release(point);
        EXPECT_EQ(panel().softboxes()->selected(), softbox(0).id) << x;
    }
}

TEST_F(EnvironmentPanelTest, SoftboxesAreAddedRemovedAndNudgedInPlace) {
    chooseOneSoftbox(plainBox(180, 0));
    const QPoint empty = pointOf(-90, 45);
    QTest::mouseDClick(&view(), Qt::LeftButton, {}, empty);
    ASSERT_EQ(environment().softboxes.size(), 2u);
    EXPECT_NEAR(softbox(1).azimuthDeg, -90, degreesPerPixel());
    EXPECT_NEAR(softbox(1).elevationDeg, 45, degreesPerPixel());
    EXPECT_EQ(softbox(1).name, "Softbox");
    EXPECT_EQ(panel().softboxes()->selected(), softbox(1).id);
    EXPECT_EQ(panel().softboxes()->list()->count(), 2);
    EXPECT_EQ(undoCount(), 1);

    const float azimuth = softbox(1).azimuthDeg;
    view().setFocus();
    for (int i = 0; i < 3; ++i)
        QTest::keyClick(&view(), Qt::Key_Right);
    QTest::keyClick(&view(), Qt::Key_Right, Qt::ControlModifier);
    EXPECT_NEAR(softbox(1).azimuthDeg, azimuth - 13, 1e-3);
    EXPECT_EQ(undoCount(), 2); // quick steps are one

    QTest::keyClick(&view(), Qt::Key_Delete);
    EXPECT_EQ(environment().softboxes.size(), 1u);
    EXPECT_EQ(panel().softboxes()->selected(), softbox(0).id); // the neighbour
    controller().undoStack().undo();
    ASSERT_EQ(environment().softboxes.size(), 2u);
    EXPECT_NEAR(softbox(1).azimuthDeg, azimuth - 13, 1e-3);
}

TEST_F(EnvironmentPanelTest, TheListSwitchesRenamesAndDuplicates) {
    chooseOneSoftbox(plainBox(180, 0));
    QListWidget& list = *panel().softboxes()->list();
    list.item(0)->setCheckState(Qt::Unchecked);
    EXPECT_FALSE(softbox(0).enabled);
    EXPECT_LT(radiance(180, 0), 0.1f);
    list.item(0)->setCheckState(Qt::Checked);
    EXPECT_GT(radiance(180, 0), 9.0f);
    list.item(0)->setText(QStringLiteral("Window"));
    EXPECT_EQ(softbox(0).name, "Window");
    find<QToolButton>(panel(), QStringLiteral("Duplicate the softbox"))->click();
    ASSERT_EQ(environment().softboxes.size(), 2u);
    EXPECT_EQ(softbox(1).name, "Window 2");
    EXPECT_NE(softbox(1).azimuthDeg, softbox(0).azimuthDeg);
    EXPECT_EQ(panel().softboxes()->selected(), softbox(1).id);
    find<QToolButton>(panel(), QStringLiteral("Remove the softbox"))->click();
    EXPECT_EQ(environment().softboxes.size(), 1u);
}

TEST_F(EnvironmentPanelTest, RigsReplaceWhatIsThere) {
    chooseOneSoftbox(plainBox(180, 0));
    QToolButton* rigs = nullptr;
    for (QToolButton* button : panel().findChildren<QToolButton*>())
        if (button->text() == QStringLiteral("Rigs"))
            rigs = button;
    ASSERT_NE(rigs, nullptr);
    ASSERT_EQ(rigs->menu()->actions().size(), static_cast<int>(library::softboxRigs().size()));
    for (int i = 0; i < rigs->menu()->actions().size(); ++i) {
        const library::SoftboxRig& rig = library::softboxRigs()[static_cast<std::size_t>(i)];
        rigs->menu()->actions()[i]->trigger();
        ASSERT_EQ(environment().softboxes.size(), rig.softboxes.size());
        EXPECT_EQ(softbox(0).name, rig.softboxes[0].name);
        EXPECT_GT(radiance(rig.softboxes[0].azimuthDeg, rig.softboxes[0].elevationDeg), 0.5f);
    }
    EXPECT_EQ(undoCount(), rigs->menu()->actions().size());
    while (controller().undoStack().canUndo())
        controller().undoStack().undo();
    EXPECT_EQ(softbox(0).name, "Key");
    EXPECT_EQ(environment().softboxes.size(), 1u);
}

TEST_F(EnvironmentPanelTest, TheSunIsDraggedAndSet) {
    choose("Sky");
    const Sky before = environment().sky;
    const QPoint from = pointOf(before.sunAzimuthDeg, before.sunElevationDeg);
    drag(from + QPoint(2, 1), from + QPoint(42, -9)); // taken beside its middle it does not jump
    const Sky dragged = environment().sky;
    EXPECT_NEAR(dragged.sunAzimuthDeg, before.sunAzimuthDeg - 40 * degreesPerPixel(), 0.01);
    EXPECT_NEAR(dragged.sunElevationDeg,
                before.sunElevationDeg + 10 * 180.0 / view().map().area().height(), 0.01);
    EXPECT_EQ(undoCount(), 2); // the kind and the drag
    EXPECT_GT(radiance(dragged.sunAzimuthDeg, dragged.sunElevationDeg), 100.0f);
    controller().undoStack().undo();
    EXPECT_EQ(environment().sky, before);
    EXPECT_LT(radiance(dragged.sunAzimuthDeg, dragged.sunElevationDeg), 50.0f);

    // A click elsewhere brings it there; below the horizon it stays on it.
    const QPoint elsewhere = pointOf(-120, 50);
    press(elsewhere);
    release(elsewhere);
    EXPECT_NEAR(environment().sky.sunAzimuthDeg, -120, degreesPerPixel());
    EXPECT_NEAR(environment().sky.sunElevationDeg, 50, degreesPerPixel());
    press(pointOf(90, -30));
    release(pointOf(90, -30));
    EXPECT_EQ(environment().sky.sunElevationDeg, 0.0f);
    QTest::keyClick(&view(), Qt::Key_Up, Qt::ControlModifier);
    EXPECT_EQ(environment().sky.sunElevationDeg, 10.0f);
}

TEST_F(EnvironmentPanelTest, AnImageIsTurned) {
    const auto width = view().map().area().width();
    const QPoint from = view().rect().center();
    const auto quarter = static_cast<int>(width / 4);
    drag(from, from + QPoint(quarter, 0));
    // What was in the middle (behind, 180°) has gone to the right (90°): clockwise from above.
    EXPECT_NEAR(environment().rotationDeg, -quarter * 360.0 / width, 0.01);
    EXPECT_EQ(undoCount(), 1);
    EXPECT_NEAR(view().map().shift(), quarter, 0.01);
    controller().undoStack().undo();
    EXPECT_EQ(environment().rotationDeg, 0.0f);
}

TEST_F(EnvironmentPanelTest, WhatIsTurnedIsDraggedWhereItIsSeen) {
    const Id id = chooseOneSoftbox(plainBox(0, 0)); // the front is in the middle
    controller().setParameter(parameter("environment.rotationDeg"), {Scope::Environment, 0}, 70.0f);
    const QRectF area = view().map().area();
    const QPoint seen = pointOf(0, 0);
    EXPECT_NEAR(seen.x(), area.center().x() - 70 / degreesPerPixel(), 1.0);
    panel().softboxes()->select(0);
    drag(seen, seen + QPoint(20, 0));
    EXPECT_EQ(panel().softboxes()->selected(), id);
    EXPECT_NEAR(softbox(0).azimuthDeg, -20 * degreesPerPixel(), 0.01);
}

TEST_F(EnvironmentPanelTest, RowsFollowTheKindAndTheBackground) {
    ParameterList* list = nullptr;
    for (ParameterList* candidate : panel().findChildren<ParameterList*>())
        if (candidate->row("environment.background"))
            list = candidate;
    ASSERT_NE(list, nullptr);
    const auto hidden = [&](const char* id) { return list->row(id)->isHidden(); };
    EXPECT_TRUE(hidden("environment.skyTurbidity"));
    EXPECT_TRUE(hidden("environment.softboxAmbient"));
    choose("Sky");
    EXPECT_FALSE(hidden("environment.skyTurbidity"));
    choose("Softboxes");
    EXPECT_TRUE(hidden("environment.skyTurbidity"));
    EXPECT_FALSE(hidden("environment.softboxAmbient"));
    for (const auto& [mode, blur, color] : {std::tuple{BackgroundMode::Environment, true, true},
                                            {BackgroundMode::Blurred, false, true},
                                            {BackgroundMode::Color, true, false},
                                            {BackgroundMode::Off, true, true}}) {
        controller().setParameter(parameter("environment.background"), {Scope::Environment, 0},
                                  static_cast<int>(mode));
        EXPECT_EQ(hidden("environment.backgroundBlur"), blur);
        EXPECT_EQ(hidden("environment.backgroundColor"), color);
    }
}

// An HDR that was dropped or chosen can be had again by a click, in this session and in later ones.
TEST_F(EnvironmentPanelTest, EnvironmentsFromFilesJoinTheGallery) {
    const QString file = folder.filePath(QStringLiteral("my street.hdr"));
    const auto written = saveEnvironment(
        controller().worker(), environment(),
        EnvironmentSaveSettings{file.toStdString(), EnvironmentLayout::LatLong, 64, false});
    ASSERT_TRUE(written.ok()) << written.error().text();
    const auto button = [&](QWidget& gallery) {
        return find<QToolButton>(gallery, QStringLiteral("Environment my street"));
    };
    auto& gallery = *panel().findChild<SkyGallery*>();
    EXPECT_EQ(button(gallery), nullptr);
    controller().addFiles({file});
    ASSERT_TRUE(settled(*session));
    ASSERT_NE(button(gallery), nullptr);
    EXPECT_TRUE(button(gallery)->isChecked());

    controller().setEnvironment(QStringLiteral("builtin:studio"));
    ASSERT_TRUE(settled(*session));
    EXPECT_FALSE(button(gallery)->isChecked());
    QTest::mouseClick(button(gallery), Qt::LeftButton);
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(environment().source, file.toStdString());
    EXPECT_EQ(gallery.findChildren<QToolButton*>().count(button(gallery)), 1);

    // The picture is made in the background; the next session has both.
    EXPECT_TRUE(eventually([&] { return !skyPicture(file).isNull(); }));
    SkyGallery next;
    ASSERT_NE(button(next), nullptr);
    QFile::remove(file);
    SkyGallery without;
    EXPECT_EQ(button(without), nullptr) << "the file is gone";
}

} // namespace
// Several environments: the list appears with the second, a click lights the scene with another.
TEST_F(EnvironmentPanelTest, TheSceneHoldsSeveralEnvironments) {
    EnvironmentList& environments = *panel().findChild<EnvironmentList*>();
    QListWidget& list = *environments.list();
    const auto add = [&](const char* what) {
        auto* button = find<QToolButton>(environments,
                                         tr("Add an environment that the scene can be lit with"));
        for (QAction* action : button->menu()->actions())
            if (action->text().remove(QLatin1Char('&')) == tr(what)) {
                action->trigger();
                return eventually([] { return !controller().tasks().busy(); });
            }
        return false;
    };
    auto* remove = find<QToolButton>(environments, tr("Remove the environment"));
    auto* duplicate = find<QToolButton>(environments, tr("Duplicate the environment"));
    EXPECT_TRUE(list.isHidden());
    EXPECT_FALSE(remove->isEnabled());
    const Environment before = environment();

    ASSERT_TRUE(add("Night"));
    ASSERT_FALSE(list.isHidden());
    ASSERT_EQ(list.count(), 2);
    EXPECT_EQ(list.currentRow(), 1);
    EXPECT_EQ(list.item(1)->text(), tr("Night"));
    EXPECT_EQ(environment().source, "builtin:night");
    ASSERT_TRUE(add("Sky"));
    EXPECT_EQ(environment().kind, EnvironmentKind::Sky);
    EXPECT_NE(environment().image, nullptr) << "a draft at once";
    EXPECT_TRUE(eventually([] { return environment().image->height() == kEnvironmentHeight; }))
        << "then the full picture";
    const ImagePtr sky = environment().image;
    if (const QString shots = qEnvironmentVariable("PATINA_SCREENSHOTS"); !shots.isEmpty())
        panel().grab().save(shots + QStringLiteral("/environment-list.png"));

    // What is edited is the current one's.
    view().setFocus();
    QTest::keyClick(&view(), Qt::Key_Right);
    EXPECT_NE(environment().sky, Sky()) << "the sun moved";
    EXPECT_TRUE(eventually([&] {
        return environment().image != sky && environment().image->height() == kEnvironmentHeight;
    }));
    const Sky moved = environment().sky;
    choose("Image");
    EXPECT_EQ(environment().source, "builtin:night") << "what lit the scene when it was added";
    EXPECT_EQ(environment().image, environment().fileImage);
    ASSERT_NE(environment().image, nullptr);
    controller().undoStack().undo();
    QTest::mouseClick(list.viewport(), Qt::LeftButton, {},
                      list.visualItemRect(list.item(0)).center());
    EXPECT_EQ(environment(), before);
    EXPECT_EQ(controller().undoStack().undoText(), tr("Light with %1").arg(list.item(0)->text()));
    EXPECT_EQ(document().environments[2].sky, moved);

    // Its name: typed, then taken away again.
    controller().rename({Scope::Environment, before.id}, tr("Cold light"));
    EXPECT_EQ(list.item(0)->text(), tr("Cold light"));
    list.item(0)->setText({});
    EXPECT_EQ(document().environment().name, "");
    EXPECT_EQ(list.item(0)->text(), EnvironmentList::titleOf(before));

    // The same picture is not added twice.
    const int steps = controller().undoStack().count();
    ASSERT_TRUE(add("Night"));
    EXPECT_EQ(list.count(), 3);
    EXPECT_EQ(environment().source, "builtin:night");
    EXPECT_EQ(controller().undoStack().count(), steps + 1);

    QTest::mouseClick(duplicate, Qt::LeftButton);
    EXPECT_EQ(list.count(), 4);
    EXPECT_EQ(list.currentRow(), 2);
    EXPECT_NE(list.item(2)->text(), list.item(1)->text());
    for (int left = 3; left >= 1; --left) {
        QTest::mouseClick(remove, Qt::LeftButton);
        EXPECT_EQ(list.count(), left);
    }
    EXPECT_FALSE(remove->isEnabled());
    EXPECT_TRUE(list.isHidden());
    while (controller().undoStack().canUndo())
        controller().undoStack().undo();
    EXPECT_EQ(document().environments.size(), 1u);
    EXPECT_EQ(environment(), before);
    EXPECT_TRUE(list.isHidden());
}

TEST_F(EnvironmentPanelTest, AMissingFileIsSaid) {
    const QListWidget& list = *panel().findChild<EnvironmentList*>()->list();
    const QImage shown = view().grab().toImage();
    controller().editStructure(QStringLiteral("lose it"), [](Document& edited) {
        Environment lost = edited.environment();
        lost.id = edited.takeId();
        lost.source = "/lost/night.hdr";
        lost.problem = kNoSuchFile;
        edited.mix.first = lost.id;
        edited.environments.push_back(std::move(lost));
    });
    QApplication::processEvents();
    const QString said = QStringLiteral("night.hdr is missing; a neutral grey stands in");
    ASSERT_EQ(list.count(), 2);
    EXPECT_EQ(list.item(1)->toolTip(), said);
    EXPECT_NE(list.item(0)->toolTip(), said);
    EXPECT_NE(view().grab().toImage(), shown);
    EXPECT_TRUE(
        eventually([&] { return list.geometry().bottom() < list.parentWidget()->height(); }));
    if (const QString shots = qEnvironmentVariable("PATINA_SCREENSHOTS"); !shots.isEmpty())
        panel().grab().save(shots + QStringLiteral("/environment-missing.png"));
    controller().undoStack().undo();
    EXPECT_EQ(list.count(), 1);
}

// Its full picture is still under way when it is removed.
TEST_F(EnvironmentPanelTest, AnEnvironmentIsRemovedWhileItsPictureIsMade) {
    const Id studio = document().mix.first;
    controller().addEnvironment(EnvironmentKind::Sky);
    const Id sky = document().mix.first;
    controller().addEnvironment(EnvironmentKind::Softboxes);
    const Id boxes = document().mix.first;
    QTest::qWait(260); // the full picture of the softboxes has begun
    controller().removeEnvironment(boxes);
    EXPECT_EQ(document().mix.first, sky);
    const auto isFull = [](Id id) {
        const ImagePtr& image = document().environment(id)->image;
        return image && image->height() == kEnvironmentHeight;
    };
    EXPECT_TRUE(eventually([&] { return isFull(sky); })) << "the other one is still made";
    controller().removeEnvironment(sky);
    EXPECT_EQ(document().mix.first, studio);
    controller().undoStack().undo();
    controller().undoStack().undo();
    EXPECT_EQ(document().mix.first, boxes);
    EXPECT_TRUE(eventually([&] { return isFull(boxes); }));
}

// A picture that is read when its environment is no longer the one that lights goes where it was
// asked for.
TEST_F(EnvironmentPanelTest, AReadPictureGoesToTheEnvironmentItWasAskedFor) {
    const Id studio = document().mix.first;
    controller().addEnvironment(EnvironmentKind::Sky);
    const Id sky = document().mix.first;
    controller().lightWith(studio);
    controller().setEnvironment(QStringLiteral("builtin:night"));
    controller().lightWith(sky);
    ASSERT_TRUE(eventually([] { return !controller().tasks().busy(); }));
    EXPECT_EQ(document().environment(studio)->source, "builtin:night");
    EXPECT_EQ(document().environment(sky)->kind, EnvironmentKind::Sky);
}

// The brightest source of the image becomes a light, in one step, and the picture loses it.
TEST_F(EnvironmentPanelTest, TheSunIsExtracted) {
    controller().setEnvironment(QStringLiteral("builtin:clear-sky"));
    ASSERT_TRUE(eventually([] {
        return !controller().tasks().busy() && environment().source == "builtin:clear-sky";
    }));
    const Document before = document();
    const int steps = undoCount();
    auto* extract = find<QPushButton>(panel(), tr("Extract Sun"));
    ASSERT_NE(extract, nullptr);
    extract->click();
    ASSERT_TRUE(eventually([] { return !document().lights.empty(); }));
    EXPECT_EQ(undoCount(), steps + 1);
    EXPECT_EQ(environment().removedSources, 1);
    const BrightSources found = extractBrightSources(*environment().fileImage, 1);
    EXPECT_EQ(document().lights[0].intensity, lightOf(found.sources[0], environment()).intensity);
    EXPECT_TRUE(eventually([&] { return *environment().image == found.picture; }))
        << "a draft at once, then the full picture";
    controller().undoStack().undo();
    EXPECT_EQ(document(), before);
    EXPECT_EQ(environment().image, environment().fileImage);
    controller().undoStack().redo();
    EXPECT_EQ(environment().removedSources, 1);

    // Another image has its own.
    controller().setEnvironment(QStringLiteral("builtin:white"));
    ASSERT_TRUE(eventually([] { return environment().source == "builtin:white"; }));
    EXPECT_EQ(environment().removedSources, 0);
    const std::size_t lights = document().lights.size();
    extract->click();
    ASSERT_TRUE(eventually([] { return !controller().tasks().busy(); }));
    EXPECT_EQ(document().lights.size(), lights) << "nothing stands out from a white sky";
}

} // namespace patina::editor
