// How noisy pictures by paths are: what weights and sequences are there for.
#include "core/trace/path/PathTracer.h"

#include "core/math/Sampling.h"
#include "tests/core/trace/CornellScene.h"
#include "tests/core/trace/TraceBall.h"
#include "tests/core/trace/VeachPlates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <vector>

namespace patina {

using test::kPlateLights;
using test::kPlates;

namespace {

TraceScene noiseScene(const TraceInputs& inputs) {
    Result<TraceScene> scene = TraceScene::build(inputs, {});
    EXPECT_TRUE(scene.ok()) << (scene.ok() ? std::string() : scene.error().text());
    return *std::move(scene);
}

// Luminance of each pixel.
std::vector<double> picture(const TraceScene& scene, const TraceView& view,
                            const PathSettings& settings, std::uint32_t samples) {
    Film film(view.width, view.height);
    EXPECT_TRUE(tracePaths(scene, view, settings, film, 0, samples, {}).ok());
    std::vector<double> result;
    for (const Film::Pixel& pixel : film.pixels())
        result.push_back(pixel.luminance());
    return result;
}

// Root mean square error of the pixels of such pictures: of means of many seeds that no search
// biases (BiasTest.cpp) it is how far the seeds are apart.
double spread(const std::vector<std::vector<double>>& pictures) {
    const auto count = static_cast<double>(pictures.size());
    double variances = 0.0;
    for (std::size_t p = 0; p < pictures.front().size(); ++p) {
        double sum = 0.0, squares = 0.0;
        for (const std::vector<double>& picture : pictures) {
            sum += picture[p];
            squares += picture[p] * picture[p];
        }
        variances += (squares - sum * sum / count) / (count - 1.0);
    }
    return std::sqrt(variances / static_cast<double>(pictures.front().size()));
}

} // namespace

// Light of one bounce, by each search alone and by both, against a picture of 64 times as many
// paths: both are better than either over the picture, and nowhere much worse than the better one.
TEST(PathNoise, BothSearchesAreBetterThanEither) {
    const TraceScene scene = noiseScene(test::veachPlates());
    const TraceView view = test::ofVeachPlates();
    const std::vector<std::optional<int>> cells = test::plateCells();
    constexpr std::uint32_t kSamples = 16, kPictures = 12;
    PathSettings settings;
    settings.maxBounces = 0;
    settings.seed = 77;
    const std::vector<double> converged = picture(scene, view, settings, 64 * kSamples);

    constexpr std::size_t kCells = kPlates * kPlateLights, kWhole = kCells;
    std::array<std::array<double, kCells + 1>, 3> rmse{};
    for (const LightSearch search :
         {LightSearch::Both, LightSearch::Lights, LightSearch::Surfaces}) {
        std::array<double, kCells + 1> squares{}, counts{};
        for (std::uint32_t i = 0; i < kPictures; ++i) {
            settings.search = search;
            settings.seed = seedFor(static_cast<std::uint32_t>(search), i);
            const std::vector<double> noisy = picture(scene, view, settings, kSamples);
            for (std::size_t p = 0; p < noisy.size(); ++p) {
                const double square = std::pow(noisy[p] - converged[p], 2.0);
                const auto add = [&](std::size_t part) {
                    squares[part] += square;
                    counts[part] += 1.0;
                };
                add(kWhole);
                if (cells[p])
                    add(static_cast<std::size_t>(*cells[p]));
            }
        }
        for (std::size_t part = 0; part <= kCells; ++part)
            rmse[static_cast<std::size_t>(search)][part] = std::sqrt(squares[part] / counts[part]);
    }
    const auto& [both, lights, surfaces] = rmse;
    EXPECT_LE(both[kWhole], 0.7 * std::min(lights[kWhole], surfaces[kWhole]));
    for (std::size_t cell = 0; cell < kCells; ++cell)
        EXPECT_LE(both[cell], 1.2 * std::min(lights[cell], surfaces[cell]))
            << "plate " << cell / kPlateLights << ", light " << cell % kPlateLights;
}

// 64 points of one scrambled sequence against 64 that each are the first of another one, which is
// to say independent of each other.
TEST(PathNoise, SequencesAreBetterThanIndependentNumbers) {
    Material gloss;
    gloss.metallic = 0.5f;
    gloss.perceptualRoughness = 0.4f;
    TraceView box, ball;
    box.width = ball.width = 32;
    box.height = ball.height = 24;
    box.camera = {{0.278f, 0.273f, 0.28f}, 180.0f, 0.0f, 1.08f, 39.3f};
    ball.camera.distance = 2.2f; // it fills the picture
    const struct {
        const char* name;
        TraceInputs inputs;
        TraceView view;
    } scenes[] = {{"box", test::cornellBox(test::kCornellWalls[0], true), box},
                  {"ball", test::ballUnderSky(gloss, 0.5f), ball}};
    constexpr std::uint32_t kPictures = 8, kSamples = 64;
    for (const auto& [name, inputs, view] : scenes) {
        const TraceScene scene = noiseScene(inputs);
        std::vector<std::vector<double>> sequences, independent;
        for (std::uint32_t i = 0; i < kPictures; ++i) {
            PathSettings settings;
            settings.seed = seedFor(1, i);
            sequences.push_back(picture(scene, view, settings, kSamples));
            std::vector<double>& mean = independent.emplace_back(sequences[0].size());
            for (std::uint32_t s = 0; s < kSamples; ++s) {
                settings.seed = seedFor(2, i * kSamples + s);
                const std::vector<double> one = picture(scene, view, settings, 1);
                for (std::size_t p = 0; p < mean.size(); ++p)
                    mean[p] += one[p] / kSamples;
            }
        }
        EXPECT_LE(spread(sequences), 0.7 * spread(independent)) << name;
    }
}

} // namespace patina
