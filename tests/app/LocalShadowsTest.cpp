// Pictures of local lights under transfer, as `patina render` writes them: with complete shadows.
#include "CommandRunner.h"
#include "core/document/ViewChoices.h"
#include "core/io/ImageIO.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/scene/DocumentIO.h"
#include "core/scene/Scene.h"
#include "core/worker/WorkerClient.h"

#include <algorithm>
#include <cstdio>
#include <glm/ext/matrix_transform.hpp>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

using namespace patina;
using namespace patina::test;
using testing::HasSubstr;
using testing::Not;

namespace {

constexpr int kSize = 64;

// A floor of 2 m with a wall on it, half a metre high, seen from above; a light left of the wall.
class LocalShadows : public testing::Test {
  protected:
    void SetUp() override {
        Document& d = m_document;
        d = startDocument();
        d.meshes.clear();
        d.materials.clear();
        Material& white = d.materials.emplace_back();
        white.id = d.takeId();
        white.name = "White";
        white.baseColor = glm::vec3(1.0f);
        for (const char* name : {"Floor", "Wall"}) {
            MeshInstance& mesh = d.meshes.emplace_back();
            mesh.id = d.takeId();
            mesh.name = name;
            mesh.source = "builtin:plane";
            mesh.material = white.id;
        }
        d.meshes[1].placement = glm::translate(glm::mat4(1.0f), {-0.22f, 0.25f, 0.0f}) *
                                glm::rotate(glm::mat4(1.0f), 1.5707963f, {0, 0, 1}) *
                                glm::scale(glm::mat4(1.0f), {0.25f, 1.0f, 0.6f});
        d.environment().enabled = false;
        d.view.background = BackgroundMode::Color;
        d.view.reflectionMix = 0.0f; // diffuse light alone
        d.view.camera = {{0, 0, 0}, 0.0f, 89.0f, 5.0f, 25.0f, {}};
        Light& light = d.lights.emplace_back();
        light.id = d.takeId();
        light.name = "Bulb";
        light.type = LightType::Sphere;
        light.position = {-0.85f, 0.9f, 0.0f};
        light.radius = 0.05f;
        light.intensity = 100.0f;
        ASSERT_TRUE(saveProject(m_worker, d, m_folder / "scene.patina").ok());
        const Outcome bake = runPatina({"bake", "prt", m_folder / "scene.patina", "-o",
                                        m_folder / "bake.exr", "--order", "8", "--samples", "32"});
        ASSERT_EQ(bake.status, 0) << bake.err;
    }

    Outcome render(const std::string& name, std::vector<std::string> more) {
        std::vector<std::string> arguments{"render",    m_folder / "scene.patina",
                                           "-o",        m_folder / name,
                                           "--size",    "64x64",
                                           "--samples", "1",
                                           "--bake",    m_folder / "bake.exr",
                                           "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        Outcome outcome = runPatina(arguments);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return outcome;
    }
    Image load(const std::string& name) {
        Result<LoadedImage> image = loadImage(m_worker, m_folder / name);
        EXPECT_TRUE(image.ok()) << image.error().text();
        return image->image();
    }
    float at(const Image& image, float x, float z) const {
        Bounds bounds;
        bounds.add({-1, 0, -1});
        bounds.add({1, 0.5f, 1});
        const Camera& camera = m_document.view.camera;
        const glm::vec4 clip = camera.projectionMatrix(1.0f, bounds) * camera.viewMatrix() *
                               glm::vec4(x, 0.0f, z, 1.0f);
        return image.sample(int((0.5f + 0.5f * clip.x / clip.w) * kSize),
                            int((0.5f - 0.5f * clip.y / clip.w) * kSize), 1);
    }
    // The most that is left of the open light where the wall hides all of it.
    float leak(const Image& image, const Image& open) const {
        float most = 0.0f;
        for (float x = -0.1f; x <= 0.35f; x += 0.05f)
            for (float z = -0.3f; z <= 0.31f; z += 0.1f)
                most = std::max(most, at(image, x, z) / at(open, x, z));
        return most;
    }

    Document m_document;
    TemporaryFolder m_folder;
    WorkerClient m_worker;
};

// Lights and shadows beyond what pictures show are warnings, for people and for programs.
TEST_F(LocalShadows, LimitsOfLightsAreWarnings) {
    m_document.lights[0].type = LightType::Point;
    m_document.lights.resize(5000, m_document.lights[0]);
    for (std::size_t i = 1; i < m_document.lights.size(); ++i) {
        Light& light = m_document.lights[i];
        light.id = m_document.takeId();
        light.range = 0.1f;
        if (i < 10)
            light.type = LightType::Spot;
    }
    ASSERT_TRUE(saveProject(m_worker, m_document, m_folder / "scene.patina").ok());
    const Outcome told = runPatina({"render", m_folder / "scene.patina", "-o",
                                    m_folder / "limits.png", "--size", "16x16", "--json"});
    EXPECT_EQ(told.status, 0) << told.err;
    EXPECT_THAT(told.err, HasSubstr("Only the first 4096 of 5000 lights are drawn"));
    EXPECT_THAT(told.err, HasSubstr("Only the first 4 of 9 lights with shadows cast them"));
    const auto warnings = nlohmann::json::parse(told.out).at("warnings").dump();
    EXPECT_THAT(warnings, HasSubstr("Only the first 4096 of 5000 lights are drawn"));
    EXPECT_THAT(warnings, HasSubstr("Only the first 4 of 9 lights with shadows cast them"));
}

} // namespace

TEST_F(LocalShadows, AreTracedBeforeThePictureIsDrawn) {
    const Outcome plain = render("open.exr", {"--lighting", "ibl"});
    EXPECT_FALSE(plain.json().contains("localShadows")); // no bake is read
    const Image open = load("open.exr");
    ASSERT_GT(at(open, 0.1f, 0.0f), 0.01f);

    const Outcome traced = render("traced.exr", {"--lighting", "prt"});
    EXPECT_THAT(traced.err, Not(HasSubstr("soft")));
    EXPECT_EQ(traced.json()["localShadows"]["lights"], 1);
    const Image shadowed = load("traced.exr");

    // Without memory for rays the picture is that of the bands, and says so.
    const Outcome refused = render("bands.exr", {"--lighting", "prt", "--max-memory", "1KiB"});
    EXPECT_THAT(refused.err, HasSubstr("shadows of local lights stay soft"));
    EXPECT_THAT(refused.json()["warnings"].dump(), HasSubstr("1 local light"));
    const Image bands = load("bands.exr");
    std::printf("[ figures  ] left in the umbra: %.4f by rays, %.3f in bands\n",
                double(leak(shadowed, open)), double(leak(bands, open)));
    EXPECT_LT(leak(shadowed, open), 0.01f);
    EXPECT_GT(leak(bands, open), 0.10f);
    for (float z = -0.7f; z <= 0.71f; z += 0.2f) // left of the wall all is as it was
        EXPECT_NEAR(at(shadowed, -0.5f, z), at(open, -0.5f, z), 0.01f * at(open, -0.5f, z));

    // A view of the way of lighting, in whatever light the document is.
    const Outcome view = render("view.exr", {"--view", "shadowed"});
    EXPECT_EQ(view.json()["localShadows"]["lights"], 1);
    EXPECT_LT(leak(load("view.exr"), open), 0.01f);
    // Whatever the number of threads.
    render("one.exr", {"--lighting", "prt", "--threads", "1"});
    EXPECT_EQ(readBytes(m_folder / "one.exr"), readBytes(m_folder / "traced.exr"));
}
