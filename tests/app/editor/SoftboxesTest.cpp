// Softboxes by real events: dragged, resized and rolled in the lat-long view, listed, arranged in
// rigs.
#include "tests/app/editor/EnvironmentPanelFixture.h"

#include "core/library/SoftboxRigs.h"

#include <QListWidget>
#include <QMenu>

namespace patina::editor {
namespace {

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

} // namespace
} // namespace patina::editor
