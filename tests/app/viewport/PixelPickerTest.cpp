// When the pixel picker inspects: between frames, and inside the frame that is there then.
#include "app/editor/viewport/PixelPicker.h"

#include "app/editor/Session.h"
#include "app/editor/document/DocumentController.h"
#include "app/editor/viewport/PixelProbe.h"

#include <QTest>
#include <QWidget>
#include <gtest/gtest.h>
#include <vector>

namespace patina::editor {
namespace {

// A pin that waits for its program: the frame that brings the program has other pixels than the one
// that was clicked.
TEST(PixelPicker, APinThatWaitedIsOfTheNewFrame) {
    Session session;
    QWidget viewport;
    viewport.resize(400, 300);
    PixelPicker picker(session.controller, viewport);
    picker.setProbe(session.probe);
    bool drawing = false;
    std::vector<QPoint> inspected;
    picker.setInspect([&](const QPoint& pixel) {
        EXPECT_FALSE(drawing);
        inspected.push_back(pixel);
        return Result<render::Inspection>(render::Inspection());
    });

    picker.frameDrawn({400, 300}, false);
    picker.setReady(false);
    picker.pinAt({390.0, 290.0});
    EXPECT_TRUE(inspected.empty());

    drawing = true; // what the viewport does at the end of a frame, here one of half the size
    picker.setReady(true);
    picker.frameDrawn({200, 150}, true);
    drawing = false;
    ASSERT_TRUE(QTest::qWaitFor([&] { return !inspected.empty(); }, 30'000));
    EXPECT_EQ(inspected.front(), QPoint(195, 145));
}

} // namespace
} // namespace patina::editor
