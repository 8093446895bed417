// Numbers of light and transfer that `patina info` and `render --inspect` state, against core's
// functions.
#include "CommandRunner.h"
#include "core/bake/file/BakeIO.h"
#include "core/bake/study/TransferStatistics.h"
#include "core/bake/study/TransferStudy.h"
#include "core/edit/Edit.h"
#include "core/io/ImageIO.h"
#include "core/light/DominantLight.h"
#include "core/light/EnvironmentLookup.h"
#include "core/light/LatLongGrid.h"
#include "core/scene/DocumentIO.h"
#include "core/scene/Scene.h"
#include "core/worker/WorkerClient.h"
#include "tests/core/light/LatLongPicture.h"

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

using namespace patina;
using namespace patina::test;
using testing::HasSubstr;
using testing::Not;

namespace {

using Json = nlohmann::json;

glm::vec3 vectorOf(const Json& json) {
    return {json.at(0).get<float>(), json.at(1).get<float>(), json.at(2).get<float>()};
}

void expectNear(const Json& json, const glm::vec3& expected) {
    EXPECT_LT(glm::distance(vectorOf(json), expected), 1e-5f * (1.0f + glm::length(expected)))
        << json.dump();
}

class StatedNumbers : public testing::Test {
  protected:
    void SetUp() override {
        // A warm cap in a dim sky: bands ring, and the dominant light is known.
        environment = latLong(128, 64, [](const glm::vec3& d) {
            return d.x > 0.9f ? glm::vec3(8.0f, 6.0f, 4.0f) : glm::vec3(0.1f, 0.2f, 0.3f);
        });
        const Result<void> saved = saveImage(worker, *environment, folder / "cap.exr");
        ASSERT_TRUE(saved.ok()) << saved.error().text();
    }
    EnvironmentLookup lookup(float rotationDeg, const glm::vec3& scale) const {
        EnvironmentLookup light;
        light.analysis = analyseEnvironment(environment, {});
        static const auto maps = // the same in all tests
            std::make_shared<const IblMaps>(computeIbl(*environment, IblSettings(), {}).value());
        light.maps = maps;
        light.orientation = rotationDeg;
        light.setScale(scale);
        return light;
    }
    static void expectLight(const Json& json, const EnvironmentLookup& light) {
        EXPECT_EQ(json.at("width"), 128);
        EXPECT_EQ(json.at("invalidSamples"), 0);
        EXPECT_NEAR(json.at("rms").get<double>(), light.rms(), 1e-6 * light.rms());
        EXPECT_NEAR(json.at("irradianceError").get<double>(), irradianceError(*light.maps), 1e-6);
        ASSERT_EQ(json.at("bands").size(), std::size_t(kMaxShOrder));
        double energies = 0.0;
        for (int n = 1; n <= kMaxShOrder; ++n) {
            const Json& band = json.at("bands").at(std::size_t(n - 1));
            const BandSumError sum = light.bandSumError(n);
            EXPECT_EQ(band.at("bands"), n);
            EXPECT_EQ(band.at("coefficients"), n * n);
            EXPECT_NEAR(band.at("rmse").get<double>(), sum.rmse, 1e-6 * sum.rmse);
            EXPECT_NEAR(band.at("rmseShare").get<double>(), sum.share, 1e-6);
            EXPECT_NEAR(band.at("lowest").get<double>(), sum.lowest, 1e-5);
            EXPECT_EQ(band.at("belowZero"), sum.belowZero);
            expectNear(band.at("lowestDirection"), sum.lowestDirection);
            energies += band.at("energyShare").get<double>();
            // The sums are compared at the centres of few pixels.
            EXPECT_NEAR(energies + sum.share * sum.share, 1.0, 5e-3) << n;
        }
        ASSERT_EQ(json.at("prefiltered").size(), std::size_t(kRoughnessSteps));
        for (int step = 0; step < kRoughnessSteps; ++step) {
            const LevelPair levels = levelsOf(*light.maps, roughnessStep(step));
            const Json& level = json.at("prefiltered").at(std::size_t(step));
            EXPECT_EQ(level.at("level"), levels.first);
            EXPECT_NEAR(level.at("shareOfNext").get<float>(), levels.share, 1e-6f);
            EXPECT_EQ(level.at("faceSize"), light.maps->prefiltered[levels.first].size);
        }
    }

    TemporaryFolder folder;
    WorkerClient worker;
    ImagePtr environment;
};

} // namespace

TEST_F(StatedNumbers, InfoTellsTheLightOfAnEnvironment) {
    const Outcome told = runPatina({"info", folder / "cap.exr", "--light", "--json"});
    ASSERT_EQ(told.status, 0) << told.err;
    const EnvironmentLookup light = lookup(0.0f, glm::vec3(1.0f));
    const Json json = told.json();
    EXPECT_EQ(json.at("kind"), "environment");
    expectLight(json.at("light"), light);
    const DominantLight dominant = dominantLight(light.maps->irradianceSh);
    const Json& stated = json.at("light").at("dominantLight");
    expectNear(stated.at("direction"), dominant.toLight);
    EXPECT_GT(dominant.toLight.x, 0.99f);
    EXPECT_NEAR(stated.at("azimuthDeg").get<double>(), 90.0, 1.0);
    expectNear(stated.at("irradiance"), dominant.irradiance);
    EXPECT_NEAR(stated.at("directionality").get<float>(), directionality(light.maps->irradianceSh),
                1e-6f);
    EXPECT_FALSE(json.at("light").contains("at"));

    const Outcome text = runPatina({"info", folder / "cap.exr", "--light"});
    EXPECT_THAT(text.out, HasSubstr("dominant light"));
    EXPECT_THAT(text.out, HasSubstr("8 bands"));
    EXPECT_THAT(runPatina({"info", folder / "cap.exr"}).out, Not(HasSubstr("dominant light")));
}

// As the project has its environment, in a direction of the scene.
TEST_F(StatedNumbers, InfoLooksLightUpInADirectionOfAProject) {
    Document document = startDocument();
    document.environment().kind = EnvironmentKind::Image;
    document.environment().source = folder / "cap.exr";
    document.environment().image = document.environment().fileImage = environment;
    document.environment().rotationDeg = 90.0f;
    document.environment().exposureEv = 1.0f;
    ASSERT_TRUE(saveProject(worker, document, folder / "scene.patina").ok());
    const Outcome told =
        runPatina({"info", folder / "scene.patina", "--light", "--direction", "-180,10", "--json"});
    ASSERT_EQ(told.status, 0) << told.err;
    const Json light = told.json().at("light");
    const EnvironmentLookup expected = lookup(90.0f, glm::vec3(2.0f));
    EXPECT_EQ(told.json().at("kind"), "project");
    expectLight(light, expected);
    EXPECT_EQ(light.at("rotationDeg"), 90.0f);
    expectNear(light.at("scale"), glm::vec3(2.0f));
    // What stood at +X stands at -Z.
    EXPECT_LT(light.at("dominantLight").at("direction").at(2).get<float>(), -0.99f);
    const glm::vec3 d(directionFromAngles(-180.0, 10.0));
    const Json& at = light.at("at");
    EXPECT_NEAR(at.at("elevationDeg").get<double>(), 10.0, 1e-4);
    expectNear(at.at("direction"), d);
    expectNear(at.at("radiance"), *expected.radiance(d));
    EXPECT_GT(at.at("radiance").at(0).get<float>(), 15.0f) << "of the cap, a stop brighter";
    expectNear(at.at("irradiance"), *expected.irradiance(d));
    expectNear(at.at("irradianceSh9"), *expected.irradianceSh9(d));
    for (int n = 1; n <= kMaxShOrder; ++n)
        expectNear(at.at("bands").at(std::size_t(n - 1)), *expected.bandSum(n, d));
    for (int step = 0; step < kRoughnessSteps; ++step)
        expectNear(at.at("prefiltered").at(std::size_t(step)),
                   *expected.prefiltered(roughnessStep(step), d));
}

TEST_F(StatedNumbers, LightIsRefusedOfWhatHasNone) {
    EXPECT_EQ(runPatina({"info", "builtin:sphere", "--light"}).status, 2);
    EXPECT_EQ(runPatina({"info", "builtin:list", "--light"}).status, 2);
    EXPECT_EQ(runPatina({"info", folder / "cap.exr", "--direction", "0,0"}).status, 2);
    for (const char* direction : {"0", "0,91", "400,0", "a,b", "1,2,3"})
        EXPECT_EQ(
            runPatina({"info", folder / "cap.exr", "--light", "--direction", direction}).status, 2)
            << direction;
    Image picture(4, 4, 3, PixelType::U8, ColorEncoding::Srgb);
    ASSERT_TRUE(saveImage(worker, picture, folder / "map.png").ok());
    const Outcome refused = runPatina({"info", folder / "map.png", "--light", "--json"});
    EXPECT_EQ(refused.status, 2);
    EXPECT_THAT(refused.json().at("error").at("message").get<std::string>(),
                HasSubstr("environments and projects"));
}

// The bake alone is enough for its statistics; a pixel of the picture says where a point is.
TEST_F(StatedNumbers, TransferIsToldOfABakeAndOfAPixel) {
    for (const char* target : {"vertex", "texel"}) {
        SCOPED_TRACE(target);
        const std::string file = folder / (std::string(target) + ".exr");
        std::vector<std::string> arguments{"bake",    "prt", "builtin:torus-knot", "-o", file,
                                           "--order", "4",   "--samples",          "16", "--target",
                                           target};
        if (std::string(target) == "texel")
            arguments.insert(arguments.end(), {"--size", "64"});
        ASSERT_EQ(runPatina(arguments).status, 0);
        Result<OpenedScene> scene = openScene(worker, "builtin:torus-knot", {});
        ASSERT_TRUE(scene.ok());
        Document& document = scene->document;
        Result<BakeArtifact> loaded = loadBake(worker, file, document);
        ASSERT_TRUE(loaded.ok()) << loaded.error().text();
        const auto bake = std::make_shared<const BakeArtifact>(*std::move(loaded));
        const std::vector<float>& values =
            isPerTexel(bake->kind) ? bake->texels[0].values : bake->vertices[0].values;
        const TransferStatistics expected = transferStatistics(values, {}, 4);

        const Outcome told = runPatina({"info", file, "--json"});
        ASSERT_EQ(told.status, 0) << told.err;
        const Json stated = told.json().at("bake").at("parts").at(0).at("statistics");
        EXPECT_EQ(stated.at("elements"), expected.elements);
        EXPECT_EQ(stated.at("dark"), expected.dark);
        const Json& visibility = stated.at("skyVisibility");
        EXPECT_NEAR(visibility.at("lowest").get<float>(), expected.lowestVisibility, 1e-6f);
        EXPECT_NEAR(visibility.at("mean").get<double>(), expected.meanVisibility, 1e-6);
        EXPECT_NEAR(visibility.at("highest").get<float>(), expected.highestVisibility, 1e-6f);
        EXPECT_GT(expected.meanVisibility, 0.3);
        EXPECT_LT(expected.lowestVisibility, expected.highestVisibility);
        ASSERT_EQ(stated.at("bandShares").size(), 4u);
        for (std::size_t l = 0; l < 4; ++l)
            EXPECT_NEAR(stated.at("bandShares").at(l).get<double>(), expected.bandShares[l], 1e-9);
        EXPECT_THAT(runPatina({"info", file}).out, HasSubstr("sky visibility"));

        const Outcome pixel =
            runPatina({"render", "builtin:torus-knot", "--bake", file, "--size", "64x64",
                       "--samples", "1", "--inspect", "20,32", "--json"});
        ASSERT_EQ(pixel.status, 0) << pixel.err;
        const Json transfer = pixel.json().at("transfer");
        attachBake(document, bake);
        TransferRequest request = transferRequest(document);
        request.mesh = document.meshes[0].id;
        request.position = vectorOf(transfer.at("position"));
        TransferMemory memory;
        const Result<TransferStudy> study = studyTransfer(document, request, memory, {});
        ASSERT_TRUE(study.ok()) << study.error().text();
        EXPECT_EQ(transfer.at("order"), 4);
        EXPECT_EQ(transfer.at("bounces"), false);
        EXPECT_NEAR(transfer.at("skyVisibility").get<float>(), study->visibility, 1e-5f);
        expectNear(transfer.at("radiance"), study->all());
        EXPECT_EQ(transfer.at("localLights").at("count"), 0);
        EXPECT_NEAR(transfer.at("lowest").get<float>(), study->function.lowest, 1e-5f);
        EXPECT_NEAR(transfer.at("highest").get<float>(), study->function.highest, 1e-5f);
        EXPECT_NEAR(transfer.at("negativeShare").get<double>(), study->function.negativeShare,
                    1e-3);
        ASSERT_EQ(transfer.at("bands").size(), 4u);
        for (int l = 0; l < 4; ++l) {
            const Json& band = transfer.at("bands").at(std::size_t(l));
            expectNear(band.at("radiance"), study->byBand[std::size_t(l)]);
            ASSERT_EQ(band.at("coefficients").size(), std::size_t(2 * l + 1));
            EXPECT_NEAR(band.at("coefficients").at(0).get<float>(),
                        study->transfer.meanCoefficient(std::size_t(l * l)), 1e-5f);
        }
    }
    const Outcome without = runPatina({"render", "builtin:torus-knot", "--size", "64x64",
                                       "--samples", "1", "--inspect", "20,32", "--json"});
    EXPECT_FALSE(without.json().contains("transfer"));
}
