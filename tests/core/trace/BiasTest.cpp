// Pictures by paths against a brute force that was written apart from them, and of each search for
// light against the others: no pixel, no part of a picture and no picture differs by more than
// chance. Means over thousands of pixels show a bias that is far below the noise of each.
#include "core/trace/path/PathTracer.h"

#include "core/math/Sampling.h"
#include "tests/core/trace/BiasScenes.h"
#include "tests/core/trace/PictureStatistics.h"

#include <cmath>
#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <vector>

namespace patina {

using namespace test;

namespace {

constexpr std::uint32_t kSeeds = 16;

TraceScene built(const TraceInputs& inputs) {
    Result<TraceScene> scene = TraceScene::build(inputs, {});
    EXPECT_TRUE(scene.ok()) << (scene.ok() ? std::string() : scene.error().text());
    return *std::move(scene);
}

SeedPictures byPaths(const BiasScene& scene, LightSearch search) {
    const TraceScene traced = built(scene.inputs);
    const std::uint32_t samples = scene.samples[static_cast<std::size_t>(search)];
    SeedPictures pictures;
    for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
        PathSettings settings;
        settings.search = search;
        settings.seed = seedFor(static_cast<std::uint32_t>(search), seed);
        Film film(scene.view.width, scene.view.height);
        EXPECT_TRUE(tracePaths(traced, scene.view, settings, film, 0, samples, {}).ok());
        std::vector<glm::dvec3>& picture = pictures.emplace_back();
        for (const Film::Pixel& pixel : film.pixels())
            picture.push_back(pixel.sum / static_cast<double>(pixel.samples));
    }
    return pictures;
}

SeedPictures byReference(const BiasScene& scene) {
    const Result<reference::PictureReference> judge =
        reference::PictureReference::create(scene.inputs, scene.bright);
    EXPECT_TRUE(judge.ok());
    SeedPictures pictures;
    for (std::uint32_t seed = 0; seed < kSeeds; ++seed)
        pictures.push_back(judge->look(scene.view.camera, scene.view.width, scene.view.height,
                                       scene.referencePaths, 1000 + seed));
    return pictures;
}

void expectTheSameByAllWays(const BiasScene& scene) {
    const SeedPictures both = byPaths(scene, LightSearch::Both), judge = byReference(scene);
    expectSameMean(both, judge, scene.view.width, "brute force");
    // And one percent is no chance any more.
    SeedPictures brighter = both;
    for (std::vector<glm::dvec3>& picture : brighter)
        for (glm::dvec3& pixel : picture)
            pixel *= 1.01;
    EXPECT_GT(summary(differences(brighter, judge, 1), scene.view.width).mean, 6.0);
    expectSameMean(both, byPaths(scene, LightSearch::Lights), scene.view.width, "lights");
    expectSameMean(both, byPaths(scene, LightSearch::Surfaces), scene.view.width, "surfaces");
}

} // namespace

// Tables of Student's t and of the normal distribution.
TEST(PictureStatistics, TurnsStudentsTIntoANormalValue) {
    EXPECT_NEAR(normalOfStudent(2.364624, 7.0), 1.959964, 1e-4);
    EXPECT_NEAR(normalOfStudent(-2.976843, 14.0), -2.575829, 1e-4);
    EXPECT_NEAR(normalOfStudent(4.140454, 14.0), 3.290527, 1e-3); // two in a thousand
    EXPECT_EQ(normalOfStudent(0.0, 9.5), 0.0);
}

// Seeds of e^normal and of 1 + normal, both of mean 1 or a twentieth above.
TEST(PictureStatistics, FindsWhatIsNoChanceAndNothingElse) {
    constexpr std::size_t kPixels = 4096;
    const auto pictures = [](std::uint32_t of, double mean, bool skewed) {
        SeedPictures result(kSeeds, std::vector<glm::dvec3>(kPixels));
        for (std::uint32_t s = 0; s < kSeeds; ++s)
            for (std::uint32_t p = 0; p < kPixels; ++p) {
                double normal = -6.0; // of twelve even numbers
                for (std::uint32_t i = 0; i < 12; ++i)
                    normal +=
                        static_cast<double>(sobolOwen2D(0, seedFor(seedFor(of, s), 12 * p + i)).x);
                result[s][p] = glm::dvec3(mean * (skewed ? std::exp(normal - 0.5) : 1.0 + normal));
            }
        return result;
    };
    const auto found = [&](double mean) {
        return summary(differences(pictures(1, mean, true), pictures(2, 1.0, false), 0), 64);
    };
    EXPECT_GE(found(1.0).passing, 0.9975);
    EXPECT_LT(std::abs(found(1.0).mean), 3.0);
    EXPECT_GT(found(1.05).mean, 5.0);
}

TEST(Bias, OpenRoom) {
    expectTheSameByAllWays(openRoom());
}

TEST(Bias, GlossyBall) {
    expectTheSameByAllWays(glossyBall());
}

TEST(Bias, LightsOverMetal) {
    expectTheSameByAllWays(lightsOverMetal());
}

TEST(Bias, GlowAndAlpha) {
    expectTheSameByAllWays(glowAndAlpha());
}

} // namespace patina
