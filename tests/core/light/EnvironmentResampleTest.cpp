// What a change of layout may not change: constants, flux, what a picture shows.
#include "core/light/EnvironmentResample.h"
#include "core/document/Document.h"
#include "core/job/Parallel.h"
#include "core/library/Library.h"
#include "core/light/Ibl.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace patina {
namespace {

using L = EnvironmentLayout;
using C = EnvironmentConvention;

using std::numbers::pi;
constexpr L kLayouts[] = {L::LatLong,         L::AngularMap,    L::MirrorBall,
                          L::HorizontalCross, L::VerticalCross, L::HorizontalStrip,
                          L::VerticalStrip,   L::SixFaces};

EnvironmentMapping mapping(L layout, int size, C convention = C::Common) {
    return *EnvironmentMapping::create(layout, EnvironmentMapping::imageSize(layout, size),
                                       convention);
}

// Each pixel the value at its centre, black where there is none.
template <class Radiance>
Image painted(const EnvironmentMapping& map, const Radiance& radiance) {
    Image image(map.size().width, map.size().height, 3, PixelType::F32, ColorEncoding::Linear);
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            if (map.solidAngle(x, y) > 0.0) {
                const auto ray = map.ray({x + 0.5f, y + 0.5f});
                const glm::vec3 value = radiance(ray ? ray->direction : glm::vec3(0, 0, 1));
                for (int c = 0; c < 3; ++c)
                    image.f32()[static_cast<std::size_t>((y * image.width() + x) * 3 + c)] =
                        value[c];
            }
    return image;
}

float value(const Image& image, int x, int y, int c = 0) {
    return image.f32()[static_cast<std::size_t>((y * image.width() + x) * 3 + c)];
}

TEST(EnvironmentResample, ConstantsStayConstantBetweenAllLayouts) {
    for (const L from : kLayouts) {
        const EnvironmentMapping source = mapping(from, 24);
        const Image image = painted(source, [](const glm::vec3&) { return glm::vec3(3, 1, 0.5f); });
        for (const L to : kLayouts) {
            SCOPED_TRACE(static_cast<int>(from) * 100 + static_cast<int>(to));
            const EnvironmentMapping target = mapping(to, 20);
            const Image result = resampleEnvironment(image, source, target);
            for (int y = 0; y < result.height(); ++y)
                for (int x = 0; x < result.width(); ++x) {
                    const bool covered = target.solidAngle(x, y) > 0.0;
                    ASSERT_NEAR(value(result, x, y, 0), covered ? 3.0f : 0.0f, 2e-5f)
                        << x << " " << y;
                    ASSERT_NEAR(value(result, x, y, 2), covered ? 0.5f : 0.0f, 2e-5f);
                }
        }
    }
}

// The integrals of 1, max(0, z) and (1 + z)² over the sphere: 4pi, pi, 16pi/3.
TEST(EnvironmentResample, FluxOfSmoothLightIsKept) {
    for (const L from : kLayouts) {
        const EnvironmentMapping source = mapping(from, 64);
        const Image image = painted(source, [](const glm::vec3& d) {
            return glm::vec3(1.0f, std::max(0.0f, d.z), (1.0f + d.z) * (1.0f + d.z));
        });
        for (const L to : kLayouts) {
            SCOPED_TRACE(static_cast<int>(from) * 100 + static_cast<int>(to));
            const EnvironmentMapping target = mapping(to, 48);
            const glm::dvec3 flux =
                environmentFlux(resampleEnvironment(image, source, target), target);
            EXPECT_NEAR(flux.x / (4.0 * pi), 1.0, 1e-5);
            EXPECT_NEAR(flux.y / pi, 1.0, 2e-3);
            EXPECT_NEAR(flux.z / (16.0 * pi / 3.0), 1.0, 2e-3);
        }
    }
}

// A texel of radiance 1 alone in the dark carries its solid angle.
TEST(EnvironmentResample, FluxOfASingleTexelIsKept) {
    const EnvironmentMapping source = mapping(L::LatLong, 128);
    for (const glm::ivec2 texel : {glm::ivec2(0, 0), glm::ivec2(100, 1), glm::ivec2(64, 32),
                                   glm::ivec2(127, 45), glm::ivec2(33, 63)}) {
        Image image(128, 64, 3, PixelType::F32, ColorEncoding::Linear);
        image.f32()[static_cast<std::size_t>((texel.y * 128 + texel.x) * 3)] = 1.0f;
        const double omega = source.solidAngle(texel.x, texel.y);
        for (const L to : kLayouts)
            for (const int size : {16, 80}) {
                SCOPED_TRACE(static_cast<int>(to));
                const EnvironmentMapping target = mapping(to, size);
                const Image result = resampleEnvironment(image, source, target);
                EXPECT_NEAR(environmentFlux(result, target).x / omega, 1.0, 1e-3)
                    << texel.x << " " << texel.y << " to " << size;
                EXPECT_EQ(environmentFlux(result, target).y, 0.0);
            }
    }
}

TEST(EnvironmentResample, ReducingALatLongKeepsItsFluxExactly) {
    const EnvironmentMapping source = mapping(L::LatLong, 60);
    const Image image = painted(source, [](const glm::vec3& d) {
        return glm::vec3(std::abs(std::sin(40.0f * d.x + 3.0f * d.y)), d.y > 0.97f ? 1e4f : 0.0f,
                         1);
    });
    const glm::dvec3 before = environmentFlux(image, source);
    for (const int width : {46, 30, 14, 2}) {
        const Image small = shrinkLatLong(image, width);
        ASSERT_EQ(small.width(), width);
        ASSERT_EQ(small.height(), width / 2);
        const glm::dvec3 after = environmentFlux(small, mapping(L::LatLong, width));
        EXPECT_NEAR(after.x / before.x, 1.0, 1e-6) << width;
        EXPECT_NEAR(after.y / before.y, 1.0, 1e-6) << width;
        EXPECT_NEAR(after.z / (4.0 * pi), 1.0, 1e-6) << width;
    }
    EXPECT_EQ(shrinkLatLong(image, 60), image);
}

// Each octant has a colour of its own: a lost sign or a swapped face would exchange two.
TEST(EnvironmentResample, NothingIsMirrored) {
    const auto octants = [](const glm::vec3& d) {
        return glm::vec3(d.x > 0 ? 1 : 0.2f, d.y > 0 ? 1 : 0.2f, d.z > 0 ? 1 : 0.2f);
    };
    const auto check = [&](const EnvironmentMapping& map, const Image& image) {
        for (int i = 0; i < 8; ++i) {
            const glm::vec3 d = glm::normalize(
                glm::vec3(i & 1 ? 1.0f : -1.0f, i & 2 ? 0.8f : -0.8f, i & 4 ? 0.6f : -0.6f));
            EXPECT_LT(glm::length(map.lookup(image, d) - octants(d)), 1e-3f) << i;
        }
    };
    const EnvironmentMapping latLong = mapping(L::LatLong, 128);
    const Image image = painted(latLong, octants);
    for (const L to : kLayouts)
        for (const C convention : {C::Common, C::OpenExr}) {
            SCOPED_TRACE(static_cast<int>(to));
            const EnvironmentMapping target = mapping(to, 64, convention);
            const Image there = resampleEnvironment(image, latLong, target);
            check(target, there);
            check(latLong, resampleEnvironment(there, target, latLong));
        }
}

TEST(EnvironmentResample, RotationAndScaleAreThoseOfTheScene) {
    const EnvironmentMapping map = mapping(L::LatLong, 64);
    Image image(64, 32, 3, PixelType::F32, ColorEncoding::Linear);
    // A lamp straight ahead, -Z; counter-clockwise from above it turns to -X.
    image.f32()[static_cast<std::size_t>((16 * 64 + 32) * 3)] = 100.0f;
    const Image turned = resampleEnvironment(image, map, map, {90.0f, 2.0f});
    EXPECT_GT(map.lookup(turned, {-1.0f, 0.0f, 0.0f}).x, 10.0f);
    EXPECT_LT(map.lookup(turned, {1.0f, 0.0f, 0.0f}).x, 1e-3f);
    EXPECT_NEAR(environmentFlux(turned, map).x / environmentFlux(image, map).x, 2.0, 1e-3);
}

TEST(EnvironmentResample, ThreadsChangeNothing) {
    const EnvironmentMapping source = mapping(L::LatLong, 96);
    const Image image = painted(source, [](const glm::vec3& d) {
        return glm::vec3(d.z < -0.99f ? 500.0f : 0.1f, std::abs(d.x), d.y + 1);
    });
    const EnvironmentMapping target = mapping(L::AngularMap, 64);
    const Image all = resampleEnvironment(image, source, target);
    const ThreadLimit one(1);
    EXPECT_EQ(resampleEnvironment(image, source, target), all);
}

// A sphere under a probe that went through another layout and back is lit as before: RMSE of what
// its diffuse and glossy surface reflects (perceptual roughness 0.5 … 1) below 0.5 % of the mean.
TEST(EnvironmentResample, ProbesLightASphereAlikeAfterARoundTrip) {
    IblSettings settings;
    settings.cubeSize = 64;
    settings.levels = 5;
    settings.spacing = LevelSpacing::Even;
    for (const char* name : {"sunset", "studio"}) {
        const auto sky = library::environment(name);
        ASSERT_TRUE(sky.ok());
        const EnvironmentMapping latLong = mapping(L::LatLong, 256);
        const Image original = shrinkLatLong(**sky, 256);
        const auto before = computeIbl(original, settings, {});
        ASSERT_TRUE(before.ok());
        for (const L layout : {L::AngularMap, L::HorizontalCross, L::VerticalStrip}) {
            const EnvironmentMapping there = mapping(layout, layout == L::AngularMap ? 256 : 128);
            const Image back =
                resampleEnvironment(resampleEnvironment(original, latLong, there), there, latLong);
            const auto after = computeIbl(back, settings, {});
            ASSERT_TRUE(after.ok());
            ASSERT_EQ(after->prefiltered.size(), before->prefiltered.size());
            for (std::size_t level = 2; level < after->prefiltered.size(); ++level) {
                double squares = 0.0, sum = 0.0;
                const auto& a = after->prefiltered[level].texels;
                const auto& b = before->prefiltered[level].texels;
                for (std::size_t i = 0; i < a.size(); ++i) {
                    const glm::vec3 difference = a[i] - b[i];
                    squares += dot(difference, difference) / 3.0;
                    sum += (b[i].x + b[i].y + b[i].z) / 3.0;
                }
                const auto count = static_cast<double>(a.size());
                EXPECT_LT(std::sqrt(squares / count) / (sum / count), 0.005)
                    << name << ", layout " << static_cast<int>(layout) << ", level " << level;
            }
            for (std::size_t i = 0; i < 9; ++i)
                EXPECT_LT(length(after->irradianceSh[i] - before->irradianceSh[i]),
                          0.005f * length(before->irradianceSh[0]))
                    << name << ", layout " << static_cast<int>(layout) << ", coefficient " << i;
        }
    }
}

} // namespace
} // namespace patina
