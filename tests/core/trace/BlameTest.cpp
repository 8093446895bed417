#include "core/trace/blame/Blame.h"

#include "core/document/View.h"
#include "core/document/ViewChoices.h"
#include "core/job/Parallel.h"
#include "core/math/Sampling.h"
#include "core/trace/blame/PrefilterLobe.h"
#include "tests/core/trace/TraceBall.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <numeric>

namespace patina {
namespace {

constexpr int kBlameSize = 24;
constexpr std::uint32_t kBlamePaths = 16;

// `near`: so near that no edge is seen.
TraceView ballView(bool near = false) {
    TraceView view;
    view.camera.distance = near ? 2.0f : 4.0f;
    view.camera.fovDeg = 35.0f;
    view.width = view.height = kBlameSize;
    return view;
}

TraceScene blamedScene(const TraceInputs& inputs) {
    Result<TraceScene> scene = TraceScene::build(inputs, {});
    EXPECT_TRUE(scene.ok());
    return *std::move(scene);
}

// A sky that is brighter above.
ImagePtr evenSky() {
    Image image(64, 32, 3, PixelType::F32, ColorEncoding::Linear);
    for (std::size_t i = 0; i < image.f32().size(); ++i)
        image.f32()[i] = 1.0f - 0.02f * static_cast<float>(i / (3 * 64));
    return std::make_shared<const Image>(std::move(image));
}

// Bright on one side alone.
ImagePtr halfSky() {
    Image image(64, 32, 3, PixelType::F32, ColorEncoding::Linear);
    for (std::size_t i = 0; i < image.f32().size(); ++i)
        image.f32()[i] = i / 3 % 64 < 32 ? 1.0f : 0.02f;
    return std::make_shared<const Image>(std::move(image));
}

// With a small sun.
ImagePtr sunnySky() {
    Image image(64, 32, 3, PixelType::F32, ColorEncoding::Linear);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x)
            for (int c = 0; c < 3; ++c)
                image.f32()[static_cast<std::size_t>(3 * (64 * y + x) + c)] =
                    (x == 30 && y == 9) ? 200.0f : 1.0f - 0.02f * static_cast<float>(y + 3 * c);
    return std::make_shared<const Image>(std::move(image));
}

TraceInputs glossyBall(ImagePtr sky, float metallic = 0.0f) {
    Material material;
    material.id = 5;
    material.baseColor = {0.8f, 0.5f, 0.3f};
    material.metallic = metallic;
    material.perceptualRoughness = 0.5f;
    TraceInputs inputs = test::ballUnderSky(material);
    inputs.environments[0].image = std::move(sky);
    return inputs;
}

BlameFilm blameOf(const TraceScene& scene, std::uint32_t samples = kBlamePaths,
                  std::uint32_t seed = 0, bool near = false) {
    Result<BlameFilm> film = traceBlame(scene, ballView(near), {}, seed, samples, {});
    EXPECT_TRUE(film.ok());
    return *std::move(film);
}

Film tracedFilmOf(const TraceScene& scene, std::uint32_t samples = kBlamePaths, bool near = false) {
    Film film(kBlameSize, kBlameSize);
    EXPECT_TRUE(tracePaths(scene, ballView(near), {}, film, 0, samples, {}).ok());
    return film;
}

Image pictureOf(const BlameFilm& film, int channels,
                const std::function<glm::vec3(const BlameFilm::Pixel&)>& color) {
    Image image(film.width(), film.height(), channels, PixelType::F32, ColorEncoding::Linear);
    float* out = image.f32().data();
    for (const BlameFilm::Pixel& pixel : film.pixels()) {
        const glm::vec3 value = color(pixel);
        for (int c = 0; c < channels; ++c)
            *out++ = c == 3 ? pixel.coverage : value[c];
    }
    return image;
}

// A picture that is drawn without any error but that of what its terms are made of.
DrawnTerms drawnAs(const BlameFilm& film, BlameTerm diffuse, BlameTerm specular) {
    const auto term = [&](BlameTerm which) {
        return pictureOf(film, 4, [which](const auto& pixel) { return pixel.of(which); });
    };
    const auto whole = [&](const BlameFilm::Pixel& pixel) {
        return pixel.of(BlameTerm::Rest) + pixel.of(BlameTerm::Lights) + pixel.of(diffuse) +
               pixel.of(specular) + pixel.of(BlameTerm::Through);
    };
    return {pictureOf(film, 3, whole), pictureOf(film, 3, whole), term(diffuse), term(specular),
            term(BlameTerm::Lights),   term(BlameTerm::Through)};
}

Blame blameFor(const DrawnTerms& drawn, const BlameFilm& film, const Film& traced,
               std::span<const Id> materials = {}) {
    View view;
    view.toneMap = ToneMap::Clamp;
    Result<Blame> made = blame(drawn, film, traced, view, materials, {});
    EXPECT_TRUE(made.ok()) << (made ? "" : made.error().message);
    return *std::move(made);
}

} // namespace

TEST(PrefilterLobe, WeighsAndChoosesOneInAll) {
    const glm::vec3 axis = glm::normalize(glm::vec3(0.3f, -0.5f, 0.7f));
    for (const float alpha : {0.002f, 0.05f, 0.3f, 0.8f, 0.99999f, 1.0f}) {
        const PrefilterLobe lobe(axis, alpha);
        double weighed = 0.0, chosen = 0.0;
        constexpr std::uint32_t kPoints = 4096;
        for (std::uint32_t i = 0; i < kPoints; ++i) {
            const glm::vec3 l = lobe.sample(sobolOwen2D(i, 1));
            if (lobe.pdf(l) > 0.0f)
                weighed += static_cast<double>(lobe.weight(l) / lobe.pdf(l)) / kPoints;
        }
        EXPECT_NEAR(weighed, 1.0, 2e-3) << alpha;
        // By angle to the axis: 2 pi sin is the rest. A narrow lobe wants narrow steps.
        constexpr int kSteps = 200000;
        for (int i = 0; i < kSteps; ++i) {
            const double t = (i + 0.5) / kSteps, angle = std::numbers::pi * t * t;
            glm::vec3 side, other;
            orthonormalBasis(axis, side, other);
            const glm::vec3 l = static_cast<float>(std::sin(angle)) * side +
                                static_cast<float>(std::cos(angle)) * axis;
            chosen += static_cast<double>(lobe.pdf(glm::normalize(l))) * 2.0 * std::numbers::pi *
                      std::sin(angle) * 2.0 * std::numbers::pi * t / kSteps;
        }
        EXPECT_NEAR(chosen, 1.0, 5e-3) << alpha;
    }
}

// The same random numbers as the path tracer's: not only on average.
TEST(BlameFilm, AConvexBodyIsItsTracedPicture) {
    for (const ImagePtr& sky : {test::uniformSky(0.7f), sunnySky()}) {
        TraceInputs inputs = glossyBall(sky);
        Light lamp;
        lamp.type = LightType::Sphere;
        lamp.radius = 0.4f;
        lamp.position = {2.0f, 2.0f, 2.0f};
        lamp.intensity = 6.0f;
        inputs.lights = {lamp};
        inputs.materials[0].emissive = {0.1f, 0.2f, 0.1f};
        // Its faces are flat, and reflect each other's glow where normals are smooth: nowhere here.
        const TraceScene scene = blamedScene(inputs);
        const BlameFilm blame = blameOf(scene);
        const Film film = tracedFilmOf(scene);
        for (std::size_t i = 0; i < film.pixels().size(); ++i) {
            const BlameFilm::Pixel& pixel = blame.pixels()[i];
            const glm::vec3 traced(film.pixels()[i].sum / static_cast<double>(kBlamePaths));
            const glm::vec3 sum = pixel.of(BlameTerm::Rest) + pixel.of(BlameTerm::Lights) +
                                  pixel.of(BlameTerm::Occluded);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(sum[c], traced[c], 1e-4f * (1.0f + traced[c])) << i;
        }
    }
}

TEST(BlameFilm, UniformLightLeavesNothingToFilter) {
    for (const float metallic : {0.0f, 1.0f}) {
        const BlameFilm film =
            blameOf(blamedScene(glossyBall(test::uniformSky(2.0f), metallic)), 1024);
        glm::dvec3 filtered(0.0), lobe(0.0), specular(0.0), diffuse(0.0), occluded(0.0);
        for (const BlameFilm::Pixel& pixel : film.pixels()) {
            filtered += pixel.of(BlameTerm::Filtered);
            lobe += pixel.of(BlameTerm::Lobe);
            specular += pixel.of(BlameTerm::Specular);
            diffuse += pixel.of(BlameTerm::Diffuse);
            occluded += pixel.of(BlameTerm::Occluded);
        }
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(lobe[c] / filtered[c], 1.0, 0.01) << metallic;
            EXPECT_NEAR(specular[c] / filtered[c], 1.0, 0.01) << metallic;
            // What points below a face of a smooth ball is hidden by the ball.
            EXPECT_NEAR(occluded[c] / (specular[c] + diffuse[c]), 1.0, 0.002) << metallic;
        }
    }
}

TEST(BlameFilm, SameNumbersForAnyThreads) {
    const TraceScene scene = blamedScene(glossyBall(sunnySky()));
    const BlameFilm film = blameOf(scene, 9);
    for (const int threads : {1, 2, 7}) {
        const ThreadLimit limit(threads);
        EXPECT_TRUE(blameOf(scene, 9).pixels() == film.pixels()) << threads;
    }
}

TEST(BlameFilm, EndsWhenItIsCancelled) {
    JobControl control;
    control.cancel();
    const Result<BlameFilm> film = traceBlame(blamedScene(glossyBall(sunnySky())), ballView(), {},
                                              0, 1u << 20, control.context());
    ASSERT_FALSE(film.ok());
    EXPECT_EQ(film.error().kind, ErrorKind::Cancelled);
}

TEST(Blame, StepsAreTheWholeDifference) {
    const TraceScene scene = blamedScene(glossyBall(evenSky()));
    const BlameFilm another = blameOf(scene, 256, 7);
    for (const std::uint32_t samples : {2u, 9u, 16u}) {
        const BlameFilm film = blameOf(scene, samples);
        const Film traced = tracedFilmOf(scene, samples);
        DrawnTerms drawn = drawnAs(another, BlameTerm::Diffuse, BlameTerm::Filtered);
        for (float& value : drawn.diffuse.f32())
            value *= 0.9f; // coverage, too
        for (float& value : drawn.picture.f32())
            value *= 1.1f;
        const std::vector<Id> materials(traced.pixels().size(), 5);
        const Blame blame = blameFor(drawn, film, traced, materials);
        for (std::size_t i = 0; i < traced.pixels().size(); ++i)
            for (std::size_t c = 0; c < 3; ++c) {
                double sum = 0.0;
                for (const Image& step : blame.steps)
                    sum += static_cast<double>(step.f32()[3 * i + c]);
                const double truth = traced.pixels()[i].sum[static_cast<int>(c)] / samples;
                EXPECT_NEAR(sum, truth - static_cast<double>(drawn.picture.f32()[3 * i + c]),
                            1e-5 * (1.0 + truth));
            }
        double shares = 0.0;
        for (const BlameShare& share : blame.whole.causes)
            shares += share.share;
        EXPECT_NEAR(shares, 1.0, 1e-9);
        ASSERT_EQ(blame.materials.size(), 1u);
        EXPECT_EQ(blame.materials[0].material, 5u);
        EXPECT_NEAR(blame.materials[0].relative, blame.whole.relative, 1e-12);
        const auto here = blame.at(kBlameSize / 2 * (kBlameSize + 1));
        ASSERT_TRUE(here.has_value());
        EXPECT_NEAR(std::accumulate(here->begin(), here->end(), 0.0), 1.0, 1e-9);
    }
}

TEST(Blame, OfTheTruthThereIsNone) {
    const TraceScene scene = blamedScene(glossyBall(evenSky()));
    const BlameFilm film = blameOf(scene);
    const Blame blame =
        blameFor(drawnAs(film, BlameTerm::Diffuse, BlameTerm::Specular), film, tracedFilmOf(scene));
    EXPECT_LT(blame.whole.relative, 1e-3);
    EXPECT_LT(blame.whole.of(BlameCause::Bounces).relative, 1e-3);
}

// A specular term made one step of the series worse is blamed on that step alone.
TEST(Blame, FindsTheStepThatIsWrong) {
    // All that it reflects goes with the angle: a black metal.
    TraceInputs inputs = glossyBall(halfSky(), 1.0f);
    inputs.materials[0].baseColor = glm::vec3(0.0f);
    inputs.materials[0].perceptualRoughness = 0.9f;
    const TraceScene scene = blamedScene(inputs);
    const BlameFilm film = blameOf(scene, 64, 0, true), another = blameOf(scene, 1024, 7, true);
    const Film traced = tracedFilmOf(scene, 64, true);
    const Blame split =
        blameFor(drawnAs(another, BlameTerm::Diffuse, BlameTerm::Lobe), film, traced);
    ASSERT_TRUE(split.whole.isKnown);
    EXPECT_EQ(split.whole.largest(), BlameCause::SplitSum);
    EXPECT_NEAR(split.whole.of(BlameCause::SplitSum).share, 1.0, 0.05);
    DrawnTerms dark = drawnAs(another, BlameTerm::Diffuse, BlameTerm::Specular);
    for (float& value : dark.picture.f32())
        value *= 0.5f; // by occlusion: the picture without it is right
    const Blame occluded = blameFor(dark, film, traced);
    EXPECT_EQ(occluded.whole.largest(), BlameCause::Occlusion);
    EXPECT_NEAR(occluded.whole.of(BlameCause::Occlusion).share, 1.0, 0.02);
    EXPECT_NEAR(occluded.whole.of(BlameCause::Occlusion).bias, -0.5, 0.01);
    EXPECT_LT(occluded.whole.of(BlameCause::Occlusion).noise, 0.05);
}

// One half of the picture is dark by occlusion, the other has a specular term that is off: a pixel
// is blamed for what is wrong about itself, and an error below its noise for nothing.
TEST(Blame, APixelHasItsOwnCauses) {
    TraceInputs inputs = glossyBall(halfSky(), 1.0f);
    inputs.materials[0].baseColor = glm::vec3(0.0f);
    inputs.materials[0].perceptualRoughness = 0.9f;
    const TraceScene scene = blamedScene(inputs);
    const BlameFilm film = blameOf(scene, 64, 0, true), another = blameOf(scene, 1024, 7, true);
    const Film traced = tracedFilmOf(scene, 64, true);
    DrawnTerms drawn = drawnAs(another, BlameTerm::Diffuse, BlameTerm::Lobe);
    const DrawnTerms right = drawnAs(another, BlameTerm::Diffuse, BlameTerm::Specular);
    const int width = traced.width();
    std::vector<Id> materials(traced.pixels().size(), 5);
    for (std::size_t i = 0; i < materials.size(); ++i) {
        if (static_cast<int>(i) % width >= width / 2)
            continue;
        materials[i] = 6;
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t channels = static_cast<std::size_t>(drawn.picture.channels());
            drawn.picture.f32()[channels * i + c] = 0.5f * right.picture.f32()[channels * i + c];
            drawn.unoccluded.f32()[channels * i + c] = right.unoccluded.f32()[channels * i + c];
            drawn.specular.f32()[4 * i + c] = right.specular.f32()[4 * i + c];
        }
    }
    const Result<Blame> made = blame(drawn, film, traced, View(), materials, {}, true);
    ASSERT_TRUE(made.ok());
    ASSERT_EQ(made->pixels.size(), materials.size());
    const int row = width / 2;
    const BlameScore occluded = made->around(width / 4, row, 2, materials);
    EXPECT_EQ(occluded.material, 6u);
    EXPECT_EQ(occluded.pixels, 25u);
    EXPECT_TRUE(occluded.isKnown);
    EXPECT_NEAR(occluded.of(BlameCause::Occlusion).share, 1.0,
                5.0 * occluded.of(BlameCause::Occlusion).noise + 0.01);
    // At the border only those of its own material count.
    const BlameScore beside = made->around(width / 2, row, 2, materials);
    EXPECT_EQ(beside.material, 5u);
    EXPECT_EQ(beside.pixels, 15u);
    EXPECT_NEAR(beside.of(BlameCause::Occlusion).share, 0.0, 0.05);
    // All pixels of a material around one are that material's score.
    const BlameScore whole = made->around(0, 0, width, materials);
    const auto same = std::ranges::find(made->materials, Id(6), &BlameScore::material);
    ASSERT_NE(same, made->materials.end());
    EXPECT_EQ(whole.pixels, same->pixels);
    EXPECT_NEAR(whole.of(BlameCause::Occlusion).share, same->of(BlameCause::Occlusion).share, 1e-4);
    EXPECT_NEAR(whole.of(BlameCause::Occlusion).noise, same->of(BlameCause::Occlusion).noise, 1e-4);

    // The truth itself: what is left is noise.
    const Result<Blame> nothing = blame(drawnAs(film, BlameTerm::Diffuse, BlameTerm::Specular),
                                        film, traced, View(), materials, {}, true);
    ASSERT_TRUE(nothing.ok());
    EXPECT_FALSE(nothing->around(width / 2, row, 2, materials).isKnown);
}

TEST(Blame, RefusesPicturesThatDoNotFit) {
    const TraceScene scene = blamedScene(glossyBall(sunnySky()));
    const BlameFilm film = blameOf(scene, 4);
    DrawnTerms drawn = drawnAs(film, BlameTerm::Diffuse, BlameTerm::Filtered);
    const View view;
    const Result<Blame> other = blame(drawn, film, tracedFilmOf(scene, 5), view, {}, {});
    ASSERT_FALSE(other.ok());
    EXPECT_EQ(other.error().kind, ErrorKind::Usage);
    drawn.specular.f32()[7] = std::nanf("");
    const Result<Blame> broken = blame(drawn, film, tracedFilmOf(scene, 4), view, {}, {});
    ASSERT_FALSE(broken.ok());
    EXPECT_EQ(broken.error().kind, ErrorKind::InputBroken);
}

} // namespace patina
