// When the pixel picker inspects: between frames, and inside the frame that is there then.
#include "app/editor/viewport/PixelPicker.h"

#include "app/editor/Session.h"
#include "app/editor/document/DocumentController.h"
#include "app/editor/viewport/PixelProbe.h"
#include "app/editor/viewport/ScheduleTimer.h"

#include <QTest>
#include <QWidget>
#include <algorithm>
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
    FrameSchedule schedule;
    ScheduleTimer turns(schedule);
    PixelPicker picker(session.controller, viewport, schedule);
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

// A pixel of a coarse frame is several of the window's: its middle lies up to half of that beside
// the click. The finer frames that follow bring the pin to where it was clicked.
TEST(PixelPicker, APinOfACoarseFrameIsSetAgainInAFinerOne) {
    Session session;
    Document document;
    auto mesh = std::make_shared<Mesh>();
    mesh->positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}};
    mesh->indices = {0, 1, 2};
    MeshInstance instance;
    instance.id = 7;
    instance.mesh = mesh;
    document.meshes.push_back(instance);
    session.controller.session().replace(document);
    QWidget viewport;
    viewport.resize(400, 300);
    FrameSchedule schedule;
    ScheduleTimer turns(schedule);
    PixelPicker picker(session.controller, viewport, schedule);
    picker.setProbe(session.probe);
    QSize frame;
    Id hit = 7;
    std::vector<QPoint> inspected;
    // A wall: where the middle of the pixel is, in widths of the picture.
    picker.setInspect([&](const QPoint& pixel) {
        inspected.push_back(pixel);
        render::Inspection there;
        there.mesh = hit;
        there.width = frame.width();
        there.height = frame.height();
        there.values[shading::kRecordPosition] = {
            (static_cast<float>(pixel.x()) + 0.5f) / static_cast<float>(frame.width()),
            (static_cast<float>(pixel.y()) + 0.5f) / static_cast<float>(frame.height()), 0.0f,
            1.0f};
        return Result<render::Inspection>(there);
    });
    const auto draw = [&](const QSize& size) {
        frame = size;
        inspected.clear();
        picker.frameDrawn(size, false);
        // A pin is looked at in each frame while its numbers are wanted.
        ASSERT_TRUE(QTest::qWaitFor([&] { return !inspected.empty(); }, 30'000));
    };
    const auto looked = [&](const QPoint& at) {
        return std::find(inspected.begin(), inspected.end(), at) != inspected.end();
    };
    session.probe.addListener();

    frame = {50, 38};
    picker.frameDrawn(frame, false);
    picker.pinAt({201.0, 99.0});
    EXPECT_TRUE(looked({25, 12})); // its middle is 3 pixels of the window beside the click
    draw({400, 300});
    EXPECT_TRUE(looked({201, 99}));
    draw({400, 300}); // no finer than the last
    EXPECT_FALSE(looked({201, 99}));

    picker.pinAt({10.0, 10.0}); // with the finest, for good
    draw({50, 38});
    draw({400, 300});
    EXPECT_FALSE(looked({10, 10}));

    draw({50, 38}); // beside the silhouette the finer pixel shows another mesh: the pin stays
    picker.pinAt({201.0, 99.0});
    hit = 8;
    draw({400, 300});
    EXPECT_TRUE(session.probe.pin().has_value());
    EXPECT_EQ(session.probe.pin()->mesh, 7u);
}

} // namespace
} // namespace patina::editor
