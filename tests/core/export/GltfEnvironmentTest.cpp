// EXT_lights_image_based: what a reader of the file reconstructs is the environment's radiance,
// filtered; read here as the extension's text says, not as the writer does it.
#include "core/export/GltfEnvironment.h"
#include "ExportScene.h"
#include "core/io/ImageIO.h"
#include "core/io/MeshImport.h"
#include "core/light/Orientation.h"
#include "core/worker/WorkerClient.h"
#include "tests/support/KnownRadiance.h"
#include "tests/support/TemporaryFolder.h"
#include "tests/support/TextureFiles.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gmock/gmock.h>
#include <numbers>

using namespace patina;
using namespace patina::test;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

namespace fs = std::filesystem;

namespace {

constexpr double kPi = std::numbers::pi;

ImagePtr latLong(const std::function<glm::dvec3(const glm::dvec3&)>& radiance) {
    return std::make_shared<const Image>(latLongImage(radiance));
}

class GltfEnvironmentFile : public testing::Test {
  protected:
    GltfEnvironmentFile() {
        addSquare(m_document, 0);
        m_document.environment().source = "/skies/linear.exr";
    }

    ExportSettings settings(const std::string& name) const {
        ExportSettings result;
        result.output = m_folder / name;
        result.format =
            result.output.extension() == ".glb" ? ExportFormat::Glb : ExportFormat::Gltf;
        result.includeEnvironment = true;
        return result;
    }

    // Exports and takes the file apart. `light` is the only one.
    void exportAndRead(const std::string& name) {
        const ExportPlan plan = planExport(m_document, settings(name));
        const auto written = runExport(m_worker, plan, JobContext());
        ASSERT_TRUE(written.ok()) << written.error().text();
        if (fs::path(name).extension() == ".glb") {
            const Bytes file = readFile(m_folder / name, 1 << 28).value();
            const std::size_t length = u32(file, 12);
            m_json = Json::parse(reinterpret_cast<const char*>(file.data()) + 20,
                                 reinterpret_cast<const char*>(file.data()) + 20 + length);
            m_buffer.assign(file.begin() + 28 + static_cast<std::ptrdiff_t>(length), file.end());
        } else {
            m_json = Json::parse(readTextFile(m_folder / name, 1 << 28).value());
            m_buffer = readFile(m_folder / m_json["buffers"][0]["uri"].get<std::string>(), 1 << 28)
                           .value();
        }
        const Json& lights = m_json.at("extensions").at("EXT_lights_image_based").at("lights");
        ASSERT_EQ(lights.size(), 1u);
        EXPECT_EQ(m_json["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"], 0);
        EXPECT_THAT(m_json["extensionsUsed"], testing::Contains("EXT_lights_image_based"));
        m_light = lights[0];
    }

    Image face(int level, int face) {
        const auto index = m_light.at("specularImages")
                               .at(static_cast<std::size_t>(level))
                               .at(static_cast<std::size_t>(face))
                               .get<std::size_t>();
        const Json& image = m_json.at("images").at(index);
        EXPECT_EQ(image.at("mimeType"), "image/png");
        const Json& view = m_json.at("bufferViews").at(image.at("bufferView").get<std::size_t>());
        const auto offset = view.value("byteOffset", std::size_t{0});
        const Result<LoadedImage> loaded = loadImageFromMemory(
            m_worker, std::span(m_buffer).subspan(offset, view.at("byteLength").get<std::size_t>()),
            "face");
        EXPECT_TRUE(loaded.ok());
        return loaded.ok() ? loaded->image() : Image();
    }

    // The largest error of intensity · rgb^2.2 / a against constant + slope · d, where the image,
    // flipped back about its vertical axis, is a face of OpenGL's.
    double worstError(int level, double constant, double slope) {
        const int size = kGltfEnvironmentSize >> level;
        double worst = 0.0;
        for (int f = 0; f < 6; ++f) {
            const Image image = face(level, f);
            EXPECT_EQ(image.width(), size);
            EXPECT_EQ(image.channels(), 4);
            EXPECT_EQ(image.type(), PixelType::U8);
            for (int y = 0; y < size; ++y)
                for (int x = 0; x < size; ++x) {
                    const glm::dvec3 d = faceDirection(f, size - 1 - x, y, size);
                    for (int c = 0; c < 3; ++c) {
                        const double decoded = m_light["intensity"].get<double>() *
                                               std::pow(image.sample(x, y, c), 2.2) /
                                               image.sample(x, y, 3);
                        worst = std::max(worst, std::abs(decoded - constant - slope * d[c]));
                    }
                }
        }
        return worst;
    }

    const TemporaryFolder m_folder;
    Document m_document;
    WorkerClient m_worker;
    Json m_json, m_light;
    Bytes m_buffer;
};

} // namespace

TEST_F(GltfEnvironmentFile, ReconstructsTheFilteredRadiance) {
    m_document.environment().image = latLong(linearRadiance);
    for (const char* name : {"scene.glb", "scene.gltf"}) {
        exportAndRead(name);
        EXPECT_EQ(m_light["intensity"], 1.0);
        EXPECT_EQ(m_light["name"], "linear");
        EXPECT_EQ(m_light["specularImageSize"], 256);
        EXPECT_EQ(m_light["extras"]["perceptualRoughness"],
                  nlohmann::json({0.0, 0.25, 0.5, 0.75, 1.0}));
        ASSERT_EQ(m_light["specularImages"].size(), 5u);
        // Levels spread evenly over perceptual roughness.
        for (int level = 0; level < 5; ++level) // half a code at 3: 0.9 % of the brightest
            EXPECT_LT(worstError(level, 2.0, kLambda1[static_cast<std::size_t>(level)]), 0.032)
                << level;
    }
}

TEST_F(GltfEnvironmentFile, IrradianceIsInOrthonormalHarmonics) {
    m_document.environment().image = latLong(linearRadiance);
    exportAndRead("scene.glb");
    const Json& e = m_light["irradianceCoefficients"];
    ASSERT_EQ(e.size(), 9u);
    // A_1 ∫ x_k Y_i: 2pi/3 · sqrt(4pi/3), negative for y and x (Condon-Shortley).
    const double linear = 2 * kPi / 3 * std::sqrt(4 * kPi / 3);
    for (std::size_t i = 0; i < 9; ++i)
        for (std::size_t c = 0; c < 3; ++c) {
            double expected = i == 0 ? kPi * 2 * std::sqrt(4 * kPi) : 0.0;
            if ((i == 3 && c == 0) || (i == 1 && c == 1))
                expected = -linear;
            if (i == 2 && c == 2)
                expected = linear;
            EXPECT_NEAR(e[i][c].get<double>(), expected, 2e-3) << i << ' ' << c;
        }
}

TEST_F(GltfEnvironmentFile, AWhiteSkyIsTheAnchor) {
    m_document.environment().image = latLong([](const glm::dvec3&) { return glm::dvec3(1.0); });
    exportAndRead("scene.glb");
    EXPECT_EQ(m_light["intensity"], 1.0); // always written
    EXPECT_THAT(m_light["rotation"], ElementsAre(0.0, 0.0, 0.0, 1.0));
    const Json& e = m_light["irradianceCoefficients"];
    for (std::size_t i = 0; i < 9; ++i)
        EXPECT_NEAR(e[i][0].get<double>(), i == 0 ? 11.1367 : 0.0, 1e-4);
    for (int level = 0; level < 5; ++level)
        EXPECT_LT(worstError(level, 1.0, 0.0), 1e-6);
}

TEST_F(GltfEnvironmentFile, TurnAndBrightnessAreTheLightsOwn) {
    m_document.environment().image = latLong(linearRadiance);
    m_document.environment().rotationDeg = 90.0f;
    m_document.environment().exposureEv = 3.0f;
    exportAndRead("scene.glb");
    EXPECT_EQ(m_light["intensity"], 8.0);
    // About +Y, counter-clockwise from above: (0, sin 45°, 0, cos 45°)
    const Json& q = m_light["rotation"];
    EXPECT_NEAR(q[1].get<double>(), std::sqrt(0.5), 1e-9);
    EXPECT_NEAR(q[3].get<double>(), std::sqrt(0.5), 1e-9);
    EXPECT_LT(worstError(0, 16.0, 8.0), 8 * 0.032); // the images are not turned

    m_document.environment().tiltDeg = 35.0f;
    m_document.environment().rollDeg = -20.0f;
    exportAndRead("tilted.glb");
    const Json& t = m_light["rotation"]; // x, y, z, w
    const glm::dquat tilted(t[3].get<double>(), t[0].get<double>(), t[1].get<double>(),
                            t[2].get<double>());
    const glm::dmat3 expected = orientationOf(m_document.environment()).matrix();
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_LT(glm::distance(glm::mat3_cast(tilted)[axis], expected[axis]), 1e-6) << axis;
}

// Photometric images have thousands of units; 8 bits hold them around the mean.
TEST_F(GltfEnvironmentFile, UnusualScalesGoIntoTheIntensity) {
    m_document.environment().image =
        latLong([](const glm::dvec3& d) { return 8000.0 + 4000.0 * d; });
    exportAndRead("scene.glb");
    EXPECT_EQ(m_light["intensity"], 8192.0);
    EXPECT_LT(worstError(0, 8000.0, 4000.0), 0.011 * 12000.0);
    EXPECT_NEAR(m_light["irradianceCoefficients"][0][0].get<double>() * 8192.0,
                kPi * 8000 * std::sqrt(4 * kPi), 20.0);
}

TEST_F(GltfEnvironmentFile, ThePlanNamesItAndWarnsOfTheSun) {
    m_document.environment().image = latLong([](const glm::dvec3&) { return glm::dvec3(1.0); });
    ExportPlan plan = planExport(m_document, settings("scene.gltf"));
    ASSERT_EQ(plan.files.size(), 3u);
    EXPECT_EQ(plan.files[2].path, (m_folder / "scene.bin").string() + "#environment");
    EXPECT_TRUE(plan.files[2].embedded);
    EXPECT_THAT(plan.files[2].format, HasSubstr("256 × 256"));
    EXPECT_THAT(plan.warnings, IsEmpty());
    EXPECT_EQ(planExport(m_document, settings("scene.glb")).files[1].path,
              (m_folder / "scene.glb").string() + "#environment");

    m_document.environment().image =
        latLong([](const glm::dvec3& d) { return glm::dvec3(d.y > 0.999 ? 3000.0 : 1.0); });
    EXPECT_THAT(planExport(m_document, settings("scene.glb")).warnings,
                ElementsAre(HasSubstr("brighter")));

    m_document.environment().problem = "gone";
    EXPECT_EQ(planExport(m_document, settings("scene.glb")).files.size(), 1u);
    m_document.environment().kind = EnvironmentKind::Sky; // needs no file
    EXPECT_EQ(planExport(m_document, settings("scene.glb")).files.size(), 2u);
    m_document.environment().image = nullptr;
    plan = planExport(m_document, settings("scene.glb"));
    EXPECT_EQ(plan.files.size(), 1u);
    EXPECT_THAT(plan.warnings, ElementsAre(HasSubstr("missing")));
    m_document.environment().image = latLong([](const glm::dvec3&) { return glm::dvec3(1.0); });
    ExportSettings without = settings("scene.glb");
    without.includeEnvironment = false;
    EXPECT_EQ(planExport(m_document, without).files.size(), 1u);
}

TEST_F(GltfEnvironmentFile, OurImportTakesTheModelWithoutAWord) {
    m_document.environment().image = latLong([](const glm::dvec3&) { return glm::dvec3(1.0); });
    exportAndRead("scene.glb");
    const Result<ImportedModel> model = importModel(m_worker, m_folder / "scene.glb");
    ASSERT_TRUE(model.ok()) << model.error().text();
    EXPECT_THAT(model->warnings, IsEmpty());
}

TEST_F(GltfEnvironmentFile, ACancelWritesNothing) {
    m_document.environment().image = latLong([](const glm::dvec3&) { return glm::dvec3(1.0); });
    JobControl job;
    job.cancel();
    const auto result =
        runExport(m_worker, planExport(m_document, settings("scene.glb")), job.context());
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().kind, ErrorKind::Cancelled);
    EXPECT_THAT(m_folder.files(), IsEmpty());
}
