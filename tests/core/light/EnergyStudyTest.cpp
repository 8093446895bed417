// What the study of a material's energy shows, and which faults it finds.
#include "core/light/EnergyStudy.h"
#include "core/light/Light.h"
#include "core/material/Material.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace patina {
namespace {

SurfaceRange uniform(const SurfacePoint& point) {
    return {point, point, point};
}

EnergyStudy study(const ShadingModel& model, const SurfaceRange& surface, float NoV = 0.6f) {
    std::optional<EnergyStudy> result = studyEnergy(model, surface, NoV, JobContext());
    EXPECT_TRUE(result);
    return std::move(result).value();
}

const EnergyFault* faultOf(const EnergyStudy& study, EnergyFault::Kind kind) {
    for (const EnergyFault& fault : study.faults)
        if (fault.kind == kind)
            return &fault;
    return nullptr;
}

TEST(EnergyStudy, CutsMapAndAverageAreTakenFromOneFunction) {
    ShadingModel model;
    model.multiScatter = false;
    const SurfacePoint gold{{1.0f, 0.77f, 0.34f}, 1.0f, 0.75f, 0.0f};
    const EnergyStudy s = study(model, uniform(gold));
    ASSERT_EQ(s.byRoughness.size(), EnergyStudy::kRoughnesses);
    ASSERT_EQ(s.byAngle.size(), EnergyStudy::kAngles);
    ASSERT_EQ(s.map.size(), std::size_t{EnergyStudy::kMapSize} * EnergyStudy::kMapSize);

    // Roughness 0.75 is the 30th of 40 steps; 60° the 30th of 45.
    EXPECT_EQ(s.byRoughness[30].single.total(), returnedFromEnvironment(model, gold, 0.6f).total());
    EXPECT_EQ(s.byRoughness[30].lights.total(), returnedFromLights(model, gold, 0.6f).total());
    EXPECT_NEAR(s.byAngle[30].single.total().y,
                returnedFromEnvironment(model, gold, 0.5f).total().y, 1e-5);
    EXPECT_NEAR(s.byAngle[30].compensated.total().y,
                returnedFromEnvironment(withCompensation(model, true), gold, 0.5f).total().y, 1e-5);
    // Rows are angles: 0.5 + 26 of 40 is 59.6°.
    SurfacePoint there = gold;
    there.perceptualRoughness = 10.5f / 40.0f;
    EXPECT_NEAR(
        s.map[26 * EnergyStudy::kMapSize + 10].z,
        returnedFromEnvironment(model, there, cosineOfAngle(90.0f * 26.5f / 40.0f)).total().z,
        1e-5);
    EXPECT_LT(s.average.single.total().x, 0.7);
    EXPECT_NEAR(s.average.compensated.total().x, 1.0, 1e-4);
    EXPECT_NEAR(s.average.lights.total().x, s.average.single.total().x, 1e-3);
    EXPECT_TRUE(s.faults.empty());
}

TEST(EnergyStudy, TheDefaultModelNeverMakesLight) {
    for (const float metallic : {0.0f, 1.0f})
        for (const float r : {0.0f, 0.3f, 1.0f}) {
            const EnergyStudy s = study({}, uniform({glm::vec3(1.0f), metallic, r, r}));
            EXPECT_TRUE(s.faults.empty()) << metallic << " " << r;
        }
}

// Blinn-Phong with the Smith terms it borrows returns up to 1.6 times the light at grazing views
// (shaders/shared/brdf.glsl); compensation takes it back.
TEST(EnergyStudy, BlinnPhongWithSmithMakesLight) {
    ShadingModel model;
    model.distribution = Distribution::BlinnPhong;
    model.multiScatter = false;
    // The red channel reflects most.
    const SurfaceRange copper = uniform({{0.95f, 0.64f, 0.54f}, 1.0f, 0.9f, 0.0f});
    const EnergyStudy made = study(model, copper);
    const EnergyFault* fault = faultOf(made, EnergyFault::Kind::MakesLight);
    ASSERT_NE(fault, nullptr);
    EXPECT_EQ(fault->channel, 0);
    EXPECT_GT(fault->value, 1.2);
    EXPECT_LT(fault->NoV, 0.1f);
    EXPECT_EQ(fault->perceptualRoughness, 0.9f);
    EXPECT_NEAR(fault->value, returnedFromLights(model, copper.high, fault->NoV).total().x, 1e-9);
    EXPECT_TRUE(study(withCompensation(model, true), copper).faults.empty());
    const EnergyStudy white = study(model, uniform({glm::vec3(1.0f), 1.0f, 0.9f, 0.0f}));
    ASSERT_EQ(white.faults.size(), 1u);
    EXPECT_FALSE(white.faults.front().channel); // all alike
    // Smooth facets hide none: nothing is made below roughness 0.5.
    EXPECT_TRUE(study(model, uniform({glm::vec3(1.0f), 1.0f, 0.3f, 0.0f})).faults.empty());
}

// The worst roughness of a map is found, not only its mean.
TEST(EnergyStudy, LooksAtTheWholeRangeOfMaps) {
    ShadingModel model;
    model.distribution = Distribution::BlinnPhong;
    model.multiScatter = false;
    SurfaceRange range = uniform({glm::vec3(1.0f), 1.0f, 0.3f, 0.0f});
    range.high.perceptualRoughness = 1.0f;
    const EnergyStudy rough = study(model, range);
    const EnergyFault* fault = faultOf(rough, EnergyFault::Kind::MakesLight);
    ASSERT_NE(fault, nullptr);
    EXPECT_EQ(fault->perceptualRoughness, 1.0f);
    // Metal in parts.
    range = uniform({glm::vec3(1.0f), 0.0f, 1.0f, 0.0f});
    EXPECT_EQ(faultOf(study(model, range), EnergyFault::Kind::MakesLight), nullptr);
    range.high.metallic = 1.0f;
    EXPECT_NE(faultOf(study(model, range), EnergyFault::Kind::MakesLight), nullptr);
}

// Karis' k = (r + 1)² / 8 is for lights only: what they return differs from the environment.
TEST(EnergyStudy, TheTwoKOfSchlickDisagree) {
    ShadingModel model;
    model.visibility = Visibility::SchlickDirect;
    const SurfaceRange steel = uniform({glm::vec3(0.6f), 1.0f, 0.2f, 0.0f});
    const EnergyStudy both = study(model, steel);
    const EnergyFault* fault = faultOf(both, EnergyFault::Kind::LightsDiffer);
    ASSERT_NE(fault, nullptr);
    EXPECT_LT(fault->value, -0.2); // lights lose more
    model.visibility = Visibility::SchlickIbl;
    EXPECT_TRUE(study(model, steel).faults.empty());
}

// Its albedo under an environment is taken at one angle, which costs up to a percent at grazing
// views.
TEST(EnergyStudy, ExactWaterOnWhiteMakesLessThanAPercent) {
    ShadingModel model;
    model.fresnel = Fresnel::Dielectric;
    const EnergyStudy white = study(model, uniform({glm::vec3(1.0f), 0.0f, 0.3f, 0.0f}));
    const EnergyFault* fault = faultOf(white, EnergyFault::Kind::MakesLight);
    ASSERT_NE(fault, nullptr);
    EXPECT_LT(fault->value, 1.01);
    EXPECT_TRUE(study(model, uniform({glm::vec3(0.8f), 0.0f, 0.3f, 0.0f})).faults.empty());
}

TEST(EnergyStudy, CancelledWorkIsNothing) {
    JobControl control;
    control.cancel();
    EXPECT_FALSE(studyEnergy({}, {}, 1.0f, control.context()));
}

// ---- What maps hold ----

ImagePtr makeMap(std::initializer_list<std::array<std::uint8_t, 3>> texels,
                 ColorEncoding encoding) {
    Image image(static_cast<int>(texels.size()), 1, 3, PixelType::U8, encoding);
    auto out = image.u8().begin();
    for (const auto& texel : texels)
        out = std::copy(texel.begin(), texel.end(), out);
    return std::make_shared<const Image>(std::move(image));
}

TEST(EnergyStudy, MapsMultiplyTheMaterialsNumbers) {
    Material material;
    material.baseColor = {0.5f, 1.0f, 1.0f};
    material.baseColorMap.image =
        makeMap({{{0, 255, 188}}, {{255, 255, 188}}}, ColorEncoding::Srgb);
    material.metallic = 1.0f;
    material.metallicMap.image = makeMap({{{9, 0, 51}}, {{9, 255, 255}}}, ColorEncoding::Data);
    material.metallicMap.channel = MapChannel::B;
    material.perceptualRoughness = 0.5f;
    material.perceptualRoughnessMap = material.metallicMap;
    material.perceptualRoughnessMap.channel = MapChannel::G;
    material.diffuseRoughness = 0.7f;
    int asked = 0;
    const SurfaceRange range = surfaceRange(material, [&](const ImagePtr& image) {
        ++asked;
        return texelRange(*image, JobContext());
    });
    EXPECT_EQ(asked, 3);
    EXPECT_EQ(range.low.baseColor.x, 0.0f);
    EXPECT_NEAR(range.mean.baseColor.x, 0.25f, 1e-6f);
    EXPECT_NEAR(range.high.baseColor.x, 0.5f, 1e-6f);
    EXPECT_NEAR(range.mean.baseColor.z, 0.5029f, 1e-4f); // sRGB 188
    EXPECT_NEAR(range.low.metallic, 0.2f, 1e-6f);
    EXPECT_NEAR(range.mean.metallic, 0.6f, 1e-6f);
    EXPECT_EQ(range.low.perceptualRoughness, 0.0f);
    EXPECT_NEAR(range.high.perceptualRoughness, 0.5f, 1e-6f);
    EXPECT_EQ(range.mean.diffuseRoughness, 0.7f);

    Material plain;
    plain.perceptualRoughness = 0.3f;
    const SurfaceRange same = surfaceRange(plain, [](const ImagePtr&) { return TexelRange(); });
    EXPECT_EQ(same.low, same.high);
    EXPECT_EQ(same.mean.perceptualRoughness, 0.3f);
}

TEST(EnergyStudy, ColoursAboveOneAreNamed) {
    Image bright(2, 1, 3, PixelType::F32, ColorEncoding::Linear);
    bright.f32()[1] = 1.75f;
    Material material;
    material.baseColor = glm::vec3(1.0f);
    material.baseColorMap.image = std::make_shared<const Image>(bright);
    const SurfaceRange range = surfaceRange(
        material, [](const ImagePtr& image) { return texelRange(*image, JobContext()); });
    const EnergyStudy s = study({}, range);
    const EnergyFault* fault = faultOf(s, EnergyFault::Kind::ColorAboveOne);
    ASSERT_NE(fault, nullptr);
    EXPECT_EQ(fault->channel, 1);
    EXPECT_EQ(fault->value, 1.75);
    EXPECT_EQ(s.faults.size(), 1u); // the renderer cuts it: no light is made
}

} // namespace
} // namespace patina
