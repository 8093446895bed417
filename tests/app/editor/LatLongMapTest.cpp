// The geometry under the lat-long view.

#include "app/editor/widget/LatLongMap.h"
#include "app/editor/job/UiTasks.h"
#include "app/editor/viewport/IblUpdater.h"
#include "core/light/LatLongGrid.h"

#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <numbers>

namespace patina::editor {
namespace {

const QRectF kArea(10, 20, 360, 180); // a pixel is a degree

TEST(LatLongMap, PointsAndDirectionsAreInverse) {
    for (const double rotation : {0.0, 70.0, -170.0}) {
        const LatLongMap map(kArea, rotation, 180.0);
        for (double x = 10.5; x < 370; x += 31)
            for (double y = 21; y < 200; y += 29) {
                const QPointF back = map.point(map.direction({x, y}));
                EXPECT_NEAR(back.x(), x, 1e-6);
                EXPECT_NEAR(back.y(), y, 1e-6);
            }
    }
    // The middle is behind the model (-Z), to the right of it lies +X: as in the file.
    const LatLongMap map(kArea, 0.0, 180.0);
    EXPECT_NEAR(glm::length(map.direction({190, 110}) - glm::dvec3(0, 0, -1)), 0.0, 1e-9);
    EXPECT_NEAR(glm::length(map.direction({280, 110}) - glm::dvec3(1, 0, 0)), 0.0, 1e-9);
    EXPECT_NEAR(map.direction({55, 20}).y, 1.0, 1e-9);
    // Turned by 90° counter-clockwise from above, what was at -Z stands at -X: left of the middle.
    EXPECT_NEAR(LatLongMap(kArea, 90.0, 180.0).point({0, 0, -1}).x(), 100.0, 1e-6);
    EXPECT_NEAR(LatLongMap(kArea, 90.0, 180.0).shift(), 270.0, 1e-9);
    // With the front in the middle.
    EXPECT_NEAR(LatLongMap(kArea, 0.0, 0.0).point({0, 0, 1}).x(), 190.0, 1e-6);
    EXPECT_NEAR(LatLongMap(kArea, 0.0, 0.0).shift(), 180.0, 1e-9);
}

TEST(LatLongMap, OutlinesAreWholeOnBothSidesOfTheSeam) {
    Softbox softbox;
    softbox.azimuthDeg = 0; // the seam
    softbox.elevationDeg = 0;
    softbox.widthDeg = 40;
    const LatLongMap map(kArea, 0.0, 180.0);
    const QPainterPath outline = map.outline(SoftboxShape(softbox));
    for (const double x : {12.0, 28.0, 352.0, 368.0})
        EXPECT_TRUE(outline.contains(QPointF(x, 110))) << x;
    for (const double x : {35.0, 190.0, 345.0})
        EXPECT_FALSE(outline.contains(QPointF(x, 110))) << x;
}

TEST(LatLongMap, HandlesLieOnTheSides) {
    Softbox softbox;
    softbox.azimuthDeg = 180;
    softbox.elevationDeg = 0;
    softbox.widthDeg = 60;
    softbox.heightDeg = 50;
    const LatLongMap map(kArea, 0.0, 180.0);
    const auto handles = handlesOf(softbox, map);
    EXPECT_EQ(handles.size(), 9u);
    EXPECT_EQ(handleAt(softbox, map, {190 + 30, 110}), SoftboxHandle::Right);
    EXPECT_EQ(handleAt(softbox, map, {190 - 30, 110}), SoftboxHandle::Left);
    EXPECT_EQ(handleAt(softbox, map, {190, 110 - 25}), SoftboxHandle::Top);
    EXPECT_EQ(handleAt(softbox, map, {190, 110 - 43}), SoftboxHandle::Roll);
    EXPECT_EQ(handleAt(softbox, map, {190, 110}), SoftboxHandle::None);
    softbox.widthDeg = softbox.heightDeg = 20; // no room in the middle of the sides
    EXPECT_EQ(handlesOf(softbox, map).size(), 5u);
}

TEST(LatLongMap, ADraggedEdgeFollowsTheMouse) {
    Softbox start;
    start.azimuthDeg = 30;
    start.elevationDeg = 50;
    start.widthDeg = 40;
    start.heightDeg = 30;
    start.rollDeg = 25;
    const LatLongMap map(kArea, 40.0, 0.0);
    for (const auto& [handle, point] : handlesOf(start, map)) {
        if (handle == SoftboxHandle::Roll)
            continue;
        const QPointF to = point + QPointF(5, -4);
        const Softbox dragged = draggedSoftbox(start, handle, map, point, to, false);
        EXPECT_EQ(dragged.azimuthDeg, start.azimuthDeg);
        const SoftboxShape shape(dragged);
        const auto local = shape.local(map.direction(to));
        ASSERT_TRUE(local.has_value());
        // The mouse is on the edge that was taken.
        const double x = std::abs(std::abs(local->x) - shape.half().x);
        const double y = std::abs(std::abs(local->y) - shape.half().y);
        EXPECT_LT(std::min(x, y), 1e-6);
    }
    // The far side of the sphere: as large as it gets.
    const Softbox huge =
        draggedSoftbox(start, SoftboxHandle::Right, map, handlesOf(start, map)[0].point,
                       map.point(-SoftboxShape(start).axis()), false);
    EXPECT_EQ(huge.widthDeg, 170.0f);
}

ImagePtr evenEnvironment(float radiance) {
    Image image(32, 16, 3, PixelType::F32, ColorEncoding::Linear);
    std::fill(image.f32().begin(), image.f32().end(), radiance);
    return std::make_shared<const Image>(std::move(image));
}

// Requests faster than the work: light keeps coming, and the last one wins.
TEST(IblUpdater, ADragIsNotStarved) {
    QTemporaryDir cache;
    TaskRunner runner(postToThisThread());
    PreparedLights prepared{cache.path().toStdString()};
    IblUpdater updater{runner, prepared};
    std::vector<float> lights;
    int side = 0;
    QObject::connect(&updater, &IblUpdater::ready, &updater, [&] {
        const EnvironmentTexelsPtr texels = updater.take();
        lights.push_back(texels->radianceSh[0].x / std::sqrt(4.0f * std::numbers::pi_v<float>));
        side = texels->side;
    });
    for (const float radiance : {1.0f, 2.0f, 3.0f, 4.0f})
        updater.request(evenEnvironment(radiance));
    ASSERT_TRUE(QTest::qWaitFor(
        [&] {
            return !lights.empty() && std::abs(lights.back() - 4.0f) < 0.01f &&
                   side == IblSettings{}.cubeSize;
        },
        60'000));
    EXPECT_NEAR(lights.front(), 1.0f, 0.01f); // the first was not thrown away
    for (const float light : lights)
        EXPECT_TRUE(std::abs(light - 1.0f) < 0.01f || std::abs(light - 4.0f) < 0.01f) << light;
}

} // namespace
} // namespace patina::editor
