// What a traced picture holds besides its colour, against what is known of simple scenes.
#include "core/trace/path/TraceOutputs.h"

#include "core/job/Parallel.h"
#include "core/trace/file/OutputImages.h"
#include "core/trace/path/PathTracer.h"
#include "tests/core/trace/CornellScene.h"
#include "tests/core/trace/TraceBall.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace patina {
namespace {

struct TracedOutputs {
    TraceView view;
    Film film;
    TraceOutputs outputs;
    [[nodiscard]] Image image(OutputKind kind) const {
        return outputImage(kind, film, outputs, view.camera, false);
    }
};

TracedOutputs outputsOf(const TraceInputs& inputs, const TraceView& view, std::uint32_t samples,
                        const PathSettings& settings = {}) {
    const Result<TraceScene> scene = TraceScene::build(inputs, {});
    EXPECT_TRUE(scene.ok());
    TracedOutputs traced{view, Film(view.width, view.height),
                         TraceOutputs(view.width, view.height)};
    TraceTiles tiles;
    tiles.outputs = &traced.outputs;
    std::uint32_t done = 0;
    for (std::uint32_t pass = 1; done < samples; pass = std::min({2 * pass, 16u, samples - done})) {
        EXPECT_TRUE(
            tracePaths(*scene, view, settings, traced.film, done, pass, {}, nullptr, tiles).ok());
        done += pass;
    }
    return traced;
}

TraceView viewOfBall(int size) {
    TraceView view;
    view.width = view.height = size;
    view.camera.distance = 3.4f;
    return view;
}

// A room whose lamp is a glowing surface, and a ball under lights of every kind and the sky.
TraceView cornellView() {
    TraceView view;
    view.width = 40;
    view.height = 24;
    view.camera = {{0.278f, 0.273f, 0.28f}, 180.0f, 0.0f, 1.08f, 39.3f, {}};
    return view;
}

TraceInputs litBall() {
    Material material;
    material.emissive = {0.1f, 0.0f, 0.2f};
    material.metallic = 0.4f;
    material.perceptualRoughness = 0.3f;
    TraceInputs inputs = test::ballUnderSky(material, 0.5f);
    for (const LightType type : {LightType::Point, LightType::Spot, LightType::Directional,
                                 LightType::Sphere, LightType::Rectangle}) {
        Light light;
        light.type = type;
        inputs.lights.push_back(light);
    }
    return inputs;
}

} // namespace

TEST(TraceOutputs, TheBeautyIsTheSumOfItsParts) {
    for (const LightSearch search :
         {LightSearch::Both, LightSearch::Lights, LightSearch::Surfaces}) {
        PathSettings settings;
        settings.search = search;
        for (const TracedOutputs& traced :
             {outputsOf(test::cornellBox(test::kCornellWalls[0], true), cornellView(), 21,
                        settings),
              outputsOf(litBall(), viewOfBall(24), 21, settings)}) {
            const Image beauty = traced.image(OutputKind::Beauty);
            double sum = 0.0;
            std::vector<Image> parts;
            for (const OutputKind kind :
                 {OutputKind::Background, OutputKind::Emission, OutputKind::DirectDiffuse,
                  OutputKind::DirectSpecular, OutputKind::IndirectDiffuse,
                  OutputKind::IndirectSpecular})
                parts.push_back(traced.image(kind));
            for (int y = 0; y < beauty.height(); ++y)
                for (int x = 0; x < beauty.width(); ++x)
                    for (int c = 0; c < 3; ++c) {
                        float all = 0.0f;
                        for (const Image& part : parts)
                            all += part.sample(x, y, c);
                        const float whole = beauty.sample(x, y, c);
                        ASSERT_NEAR(all, whole, 1e-6f + 3e-6f * whole) << x << "," << y;
                        sum += static_cast<double>(whole);
                    }
            EXPECT_GT(sum, 0.0);
        }
    }
}

TEST(TraceOutputs, LeaveTheFilmAsItIs) {
    const TracedOutputs traced = outputsOf(litBall(), viewOfBall(24), 9);
    const Result<TraceScene> scene = TraceScene::build(litBall(), {});
    ASSERT_TRUE(scene.ok());
    Film film(24, 24);
    ASSERT_TRUE(tracePaths(*scene, traced.view, {}, film, 0, 9, {}).ok());
    EXPECT_TRUE(film == traced.film);
    for (const int threads : {1, 2, 7}) {
        const ThreadLimit limit(threads);
        EXPECT_TRUE(outputsOf(litBall(), viewOfBall(24), 9).outputs == traced.outputs) << threads;
    }
}

// Of a convex body in uniform light nothing is indirect, and it shows its albedo.
TEST(TraceOutputs, ABallInUniformLightShowsItsAlbedo) {
    for (const float metallic : {0.0f, 1.0f}) {
        Material material;
        material.baseColor = {0.7f, 0.4f, 0.1f};
        material.metallic = metallic;
        const TracedOutputs traced = outputsOf(test::ballUnderSky(material), viewOfBall(32), 256);
        const Image beauty = traced.image(OutputKind::Beauty);
        const Image albedo = traced.image(OutputKind::Albedo);
        const Image background = traced.image(OutputKind::Background);
        const Image coverage = traced.image(OutputKind::Coverage);
        const Image diffuse = traced.image(OutputKind::DirectDiffuse);
        glm::dvec3 light(0.0), expected(0.0);
        int pixels = 0;
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 32; ++x) {
                if (coverage.sample(x, y, 0) == 0.0f) {
                    EXPECT_EQ(background.sample(x, y, 0), 1.0f);
                    EXPECT_EQ(albedo.sample(x, y, 0), 0.0f);
                }
                if (coverage.sample(x, y, 0) < 1.0f)
                    continue;
                ++pixels;
                for (int c = 0; c < 3; ++c) {
                    light[c] += static_cast<double>(beauty.sample(x, y, c));
                    expected[c] += static_cast<double>(albedo.sample(x, y, c));
                }
                EXPECT_EQ(background.sample(x, y, 0), 0.0f);
                EXPECT_EQ(diffuse.sample(x, y, 0) == 0.0f, metallic == 1.0f);
            }
        ASSERT_GT(pixels, 100);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(light[c] / expected[c], 1.0, 0.01) << metallic << " " << c;
        for (const OutputKind kind :
             {OutputKind::IndirectDiffuse, OutputKind::IndirectSpecular, OutputKind::Emission}) {
            const Image none = traced.image(kind);
            EXPECT_EQ(std::ranges::count(none.f32(), 0.0f),
                      static_cast<std::ptrdiff_t>(none.f32().size()));
        }
    }
}

TEST(TraceOutputs, SayWhereTheSurfaceIs) {
    const TracedOutputs traced = outputsOf(test::ballUnderSky({}), viewOfBall(33), 64);
    const Image position = traced.image(OutputKind::Position);
    const Image normal = traced.image(OutputKind::Normal);
    const Image depth = traced.image(OutputKind::Depth);
    const Camera& camera = traced.view.camera;
    const auto at = [](const Image& image, int x, int y) {
        return glm::vec3(image.sample(x, y, 0), image.sample(x, y, 1), image.sample(x, y, 2));
    };
    // In the middle the ball of radius 1 faces the camera.
    const glm::vec3 toCamera = -camera.forward();
    EXPECT_LT(glm::distance(at(position, 16, 16), toCamera), 3e-3f);
    EXPECT_LT(glm::distance(at(normal, 16, 16), toCamera), 3e-3f);
    EXPECT_NEAR(depth.sample(16, 16, 0), 2.4f, 3e-3f);
    for (const auto& [x, y] : {std::pair{10, 20}, {22, 12}, {16, 8}}) {
        const glm::vec3 place = at(position, x, y);
        EXPECT_NEAR(glm::length(place), 1.0f, 5e-3f);
        EXPECT_NEAR(glm::length(at(normal, x, y)), 1.0f, 1e-5f);
        EXPECT_LT(glm::distance(at(normal, x, y), place), 2e-2f);
        EXPECT_NEAR(depth.sample(x, y, 0), glm::dot(place - camera.position(), camera.forward()),
                    1e-5f);
    }
    EXPECT_EQ(depth.sample(0, 0, 0), 0.0f);
    EXPECT_EQ(traced.image(OutputKind::Samples).sample(3, 5, 0), 64.0f);
}

TEST(TraceOutputs, LightOfTheFirstBounceIsDirect) {
    PathSettings none;
    none.maxBounces = 0;
    const TraceInputs room = test::cornellBox(test::kCornellWalls[0], true);
    const TracedOutputs direct = outputsOf(room, cornellView(), 16, none);
    const TracedOutputs all = outputsOf(room, cornellView(), 16);
    double indirect = 0.0;
    for (std::size_t i = 0; i < direct.outputs.pixels().size(); ++i) {
        const TraceOutputs::Pixel& once = direct.outputs.pixels()[i];
        const TraceOutputs::Pixel& often = all.outputs.pixels()[i];
        EXPECT_EQ(once.indirectDiffuse, glm::vec3(0.0f));
        EXPECT_EQ(once.indirectSpecular, glm::vec3(0.0f));
        EXPECT_EQ(once.directDiffuse, often.directDiffuse);
        EXPECT_EQ(once.directSpecular, often.directSpecular);
        indirect += static_cast<double>(often.indirectDiffuse.y);
    }
    EXPECT_GT(indirect, 0.0);
}

TEST(TraceOutputs, StandardErrorIsThatOfThePixel) {
    Film film(2, 1);
    for (int i = 0; i < 100; ++i)
        film.at(0, 0).add(glm::vec3(i % 2 == 0 ? 1.0f : 3.0f), 1.0f);
    film.at(1, 0).add(glm::vec3(2.0f), 1.0f);
    const Image error = outputImage(OutputKind::StandardError, film, {}, {}, false);
    EXPECT_NEAR(error.sample(0, 0, 0), std::sqrt(1.0 / 99.0), 1e-5);
    EXPECT_NEAR(error.sample(1, 0, 0), 2.0f, 1e-5f) << "one sample may be all error";
}

TEST(TraceOutputs, HaveNames) {
    const auto ids = [](std::string_view text) { return namesOf(parseOutputs(text).value()); };
    EXPECT_EQ(ids("depth,normal"), "beauty,normal,depth");
    EXPECT_EQ(ids("beauty"), "beauty");
    EXPECT_EQ(parseOutputs("all")->size(), outputInfos().size());
    EXPECT_EQ(ids("all,depth"), ids("all"));
    for (const char* wrong : {"", "depths", "depth,,normal", ","}) {
        const auto parsed = parseOutputs(wrong);
        ASSERT_FALSE(parsed.ok()) << wrong;
        EXPECT_EQ(parsed.error().kind, ErrorKind::Usage);
        EXPECT_NE(parsed.error().message.find("indirectSpecular"), std::string::npos);
    }
    EXPECT_FALSE(needTraceOutputs(parseOutputs("samples,standardError").value()));
    EXPECT_TRUE(needTraceOutputs(parseOutputs("depth").value()));
}

} // namespace patina
