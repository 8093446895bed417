// The camera's thin lens against closed forms.
#include "core/trace/path/PathTracer.h"
#include "core/trace/whitted/WhittedTracer.h"
#include "tests/core/trace/TraceBall.h"

#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

namespace patina {
namespace {

constexpr int kSide = 64;
constexpr float kDistance = 4.0f, kBallRadius = 0.02f;

TraceScene glowingPoint() {
    TraceInputs inputs;
    Material& material = inputs.materials.emplace_back();
    material.emissive = glm::vec3(1.0f);
    inputs.meshes = {{1, test::ball(16), glm::scale(glm::mat4(1.0f), glm::vec3(kBallRadius)), 0}};
    Result<TraceScene> scene = TraceScene::build(inputs, {});
    EXPECT_TRUE(scene.ok());
    return *std::move(scene);
}

TraceView lookAtPoint(float focusDistance) {
    TraceView view;
    view.width = view.height = kSide;
    view.camera.yawDeg = view.camera.pitchDeg = 0.0f;
    view.camera.distance = kDistance;
    view.camera.fovDeg = 20.0f;
    view.camera.lens = {true, 0.13f, focusDistance};
    return view;
}

// Pixels that a length at distance 1 covers.
double pixelsAtOne(const Camera& camera) {
    return 0.5 * kSide / std::tan(0.5 * glm::radians(static_cast<double>(camera.fovDeg)));
}

// Of the light in a picture, about its middle: mean square distance in pixels, and sum.
struct Spread {
    double square = 0.0, sum = 0.0;
};
Spread spreadOf(const Film& film) {
    const Image picture = film.radiance();
    Spread spread;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const double right = x + 0.5 - 0.5 * kSide, down = y + 0.5 - 0.5 * kSide;
            const auto light = static_cast<double>(picture.sample(x, y, 1));
            spread.sum += light;
            spread.square += light * (right * right + down * down);
        }
    spread.square /= spread.sum;
    return spread;
}

// A disc's mean square distance from its middle is half its radius squared, a pixel's 1/6, and
// those of what is folded with each other add up.
double blurRadius(const Spread& spread, const Camera& camera) {
    const double ball = static_cast<double>(kBallRadius / kDistance) * pixelsAtOne(camera);
    return std::sqrt(std::max(0.0, 2.0 * (spread.square - 1.0 / 6.0) - ball * ball));
}

Film pathsOf(const TraceScene& scene, const TraceView& view, std::uint32_t samples) {
    Film film(view.width, view.height);
    EXPECT_TRUE(tracePaths(scene, view, {}, film, 0, samples, {}).ok());
    return film;
}

} // namespace

TEST(Lens, ApertureFollowsFromFStopAndFieldOfView) {
    Camera camera;
    camera.fovDeg = 2.0f * glm::degrees(std::atan(12.0f / 50.0f)); // a 50 mm lens at full frame
    camera.lens = {true, 2.0f, 1.0f};
    EXPECT_NEAR(camera.focalLength(), 0.05f, 1e-6f);
    EXPECT_NEAR(camera.lensRadius(), 0.0125f, 1e-6f);
    camera.lens.depthOfField = false;
    EXPECT_EQ(camera.lensRadius(), 0.0f);
}

// The circle of confusion: a point at d, in focus at F, becomes a disc of radius R |1/F - 1/d| in
// a picture at distance 1 of the lens of radius R (Potmesil & Chakravarty 1981, by similar
// triangles).
TEST(Lens, BlursAPointToTheCircleOfConfusion) {
    const TraceScene scene = glowingPoint();
    for (const float focus : {2.0f, 3.0f, 12.0f}) {
        const TraceView view = lookAtPoint(focus);
        const double expected = static_cast<double>(view.camera.lensRadius() *
                                                    std::abs(1.0f / focus - 1.0f / kDistance)) *
                                pixelsAtOne(view.camera);
        ASSERT_GT(expected, 3.0);
        ASSERT_LT(expected, 0.45 * kSide);
        const double paths = blurRadius(spreadOf(pathsOf(scene, view, 512)), view.camera);
        EXPECT_NEAR(paths / expected, 1.0, 0.015) << focus;
        Film film(kSide, kSide);
        WhittedSettings settings;
        settings.depthOfField = true;
        ASSERT_TRUE(traceWhitted(scene, view, settings, film, 0, 512, {}).ok());
        EXPECT_NEAR(blurRadius(spreadOf(film), view.camera) / expected, 1.0, 0.015) << focus;
    }
}

TEST(Lens, IsSharpInThePlaneInFocusAndKeepsTheLight) {
    const TraceScene scene = glowingPoint();
    TraceView view = lookAtPoint(kDistance);
    const Spread focused = spreadOf(pathsOf(scene, view, 1024));
    view.camera.lens.depthOfField = false;
    const Spread pinhole = spreadOf(pathsOf(scene, view, 1024));
    EXPECT_NEAR(focused.square, pinhole.square, 0.02);
    EXPECT_NEAR(focused.sum / pinhole.sum, 1.0, 0.01);
    const Spread blurred = spreadOf(pathsOf(scene, lookAtPoint(2.0f), 2048));
    EXPECT_NEAR(blurred.sum / pinhole.sum, 1.0, 0.02);
}

TEST(Lens, APinholesPictureHasTheSameBytesWhateverTheLensWouldBe) {
    const TraceScene scene = glowingPoint();
    TraceView view = lookAtPoint(2.0f);
    const Film blurred = pathsOf(scene, view, 16);
    view.camera.lens.depthOfField = false;
    const Film off = pathsOf(scene, view, 16);
    view.camera.lens = {};
    EXPECT_EQ(off.radiance(), pathsOf(scene, view, 16).radiance());
    EXPECT_FALSE(off.radiance() == blurred.radiance());
    // The classical tracer looks through the lens only where it is told to.
    const TraceView lens = lookAtPoint(2.0f);
    Film through(kSide, kSide), pinhole(kSide, kSide);
    ASSERT_TRUE(traceWhitted(scene, lens, {}, through, 0, 1, {}).ok());
    ASSERT_TRUE(traceWhitted(scene, view, {}, pinhole, 0, 1, {}).ok());
    EXPECT_EQ(through.radiance(), pinhole.radiance());
}

} // namespace patina
