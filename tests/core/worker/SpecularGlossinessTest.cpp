#include "core/io/SpecularGlossiness.h"

#include "core/image/Srgb.h"
#include "core/io/ImageIO.h"
#include "tests/core/worker/ModelFiles.h"

#include <glm/gtc/type_precision.hpp>

namespace patina {
namespace {

using nlohmann::json;
using test::GltfBuilder;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

// Khronos' convert-between-workflows, by hand.
TEST(SpecularGlossiness, ColoursAreThoseOfTheConverter) {
    const auto near = [](const MetallicColor& converted, glm::vec3 baseColor, float metallic) {
        EXPECT_LT(glm::distance(converted.baseColor, baseColor), 2e-4f)
            << converted.baseColor.r << " " << converted.baseColor.g;
        EXPECT_NEAR(converted.metallic, metallic, 2e-4f);
    };
    const glm::vec3 gold(1.0f, 0.766f, 0.336f), red(0.5f, 0.1f, 0.05f);
    near(metallicOf(glm::vec3(0.0f), gold), gold, 1.0f);
    near(metallicOf(red, glm::vec3(0.04f)), red, 0.0f);
    near(metallicOf(red, glm::vec3(0.0f)), red / 0.96f, 0.0f);
    near(metallicOf(glm::vec3(1.0f), glm::vec3(1.0f)), glm::vec3(1.0f), 1.0f);
    near(metallicOf(glm::vec3(0.2f), glm::vec3(0.3f)), glm::vec3(0.4324f), 0.6627f);
    near(metallicOf(glm::vec3(0.0f), glm::vec3(0.0f)), glm::vec3(0.0f), 0.0f);
}

class SpecularGlossinessImport : public test::ImportTest {
  protected:
    static std::string png(const std::vector<glm::u8vec4>& texels, int width) {
        Image image(width, static_cast<int>(texels.size()) / width, 4, PixelType::U8,
                    ColorEncoding::Srgb);
        for (std::size_t i = 0; i < texels.size(); ++i)
            for (int c = 0; c < 4; ++c)
                image.u8()[4 * i + static_cast<std::size_t>(c)] = texels[i][c];
        const auto bytes = encodeImage(worker(), image, ImageFileFormat::Png);
        return bytes.ok() ? test::bytesOf(*bytes) : std::string();
    }
    ImportedModel withMaterial(const json& glossiness, const std::vector<std::string>& images = {},
                               int count = 1) {
        GltfBuilder builder;
        for (const std::string& image : images) {
            const bool isFile = image.ends_with(".png");
            builder.root["images"].push_back(
                isFile ? json{{"uri", image}}
                       : json{{"bufferView", builder.view(image)}, {"mimeType", "image/png"}});
            builder.root["textures"].push_back({{"source", builder.root["images"].size() - 1}});
        }
        for (int i = 0; i < count; ++i) {
            builder.root["materials"].push_back(
                {{"extensions", {{"KHR_materials_pbrSpecularGlossiness", glossiness}}}});
            builder.node({{"mesh", builder.triangle(i)}});
        }
        return import("a.glb", builder.glb());
    }
    Image embedded(const ImportedModel& model, const std::optional<ImportedTexture>& map,
                   ColorEncoding encoding) {
        if (!map || map->embedded < 0)
            return {1, 1, 4, PixelType::U8, encoding};
        ImageLoadOptions options;
        options.integerEncoding = encoding;
        auto image = loadImageFromMemory(
            worker(), model.embeddedImages.at(static_cast<std::size_t>(map->embedded)), "map",
            options);
        EXPECT_TRUE(image.ok());
        return image->image();
    }
};

TEST_F(SpecularGlossinessImport, GoldBecomesAMetal) {
    const ImportedModel model = withMaterial({{"diffuseFactor", {0, 0, 0, 0.5}},
                                              {"specularFactor", {1, 0.766, 0.336}},
                                              {"glossinessFactor", 0.8}},
                                             {}, 2);
    const ImportedMaterial& gold = model.materials[0];
    expectNear(glm::vec3(gold.baseColor), {1, 0.766f, 0.336f});
    EXPECT_FLOAT_EQ(gold.baseColor.a, 0.5f);
    EXPECT_NEAR(gold.numbers[MaterialInput::Metallic], 1.0f, 1e-4f);
    EXPECT_NEAR(gold.numbers[MaterialInput::PerceptualRoughness], 0.2f, 1e-6f);
    EXPECT_THAT(model.warnings, ElementsAre(HasSubstr("2 materials of the outdated")));
}

// What the extension says where it says nothing: white and a mirror.
TEST_F(SpecularGlossinessImport, AnEmptyOneHasDefaults) {
    const ImportedMaterial mirror = withMaterial(json::object()).materials[0];
    EXPECT_NEAR(mirror.numbers[MaterialInput::Metallic], 1.0f, 1e-4f);
    EXPECT_EQ(mirror.numbers[MaterialInput::PerceptualRoughness], 0.0f);
}

TEST_F(SpecularGlossinessImport, MapsAreConverted) {
    // A texel of gold, one of red plastic (specular .04, whose sRGB code is 56) half as glossy.
    const std::string diffuse = png({{0, 0, 0, 255}, {188, 0, 0, 64}}, 2);
    const std::string specular = png({{255, 226, 157, 255}, {56, 56, 56, 128}}, 2);
    const ImportedModel model = withMaterial(
        {{"diffuseTexture", {{"index", 0}}}, {"specularGlossinessTexture", {{"index", 1}}}},
        {diffuse, specular}, 2);
    ASSERT_EQ(model.embeddedImages.size(), 4u) << "both materials share the new ones";
    const ImportedMaterial& material = model.materials[1];
    EXPECT_EQ(material.baseColor, glm::vec4(1.0f));
    EXPECT_EQ(material.numbers[MaterialInput::Metallic], 1.0f);
    EXPECT_EQ(material.numbers[MaterialInput::PerceptualRoughness], 1.0f);
    ASSERT_TRUE(material.maps[MaterialInput::Metallic] &&
                material.maps[MaterialInput::PerceptualRoughness]);
    EXPECT_EQ(material.maps[MaterialInput::Metallic]->channel, 'b');
    EXPECT_EQ(material.maps[MaterialInput::PerceptualRoughness]->channel, 'g');
    const Image color =
        embedded(model, material.maps[MaterialInput::BaseColor], ColorEncoding::Srgb);
    const Image surface =
        embedded(model, material.maps[MaterialInput::Metallic], ColorEncoding::Data);
    ASSERT_EQ(color.width(), 2);
    ASSERT_EQ(surface.width(), 2);
    expectNear(glm::vec3(color.linear(0, 0)),
               {1.0f, srgbToLinear(226 / 255.0f), srgbToLinear(157 / 255.0f)}, 0.01f);
    EXPECT_NEAR(surface.sample(0, 0, 2), 1.0f, 0.005f);
    EXPECT_NEAR(surface.sample(0, 0, 1), 0.0f, 0.005f);
    expectNear(glm::vec3(color.linear(1, 0)), {srgbToLinear(188 / 255.0f), 0, 0}, 0.01f);
    EXPECT_NEAR(color.linear(1, 0).a, 64 / 255.0f, 0.005f);
    EXPECT_NEAR(surface.sample(1, 0, 2), 0.0f, 0.005f);
    EXPECT_NEAR(surface.sample(1, 0, 1), 127 / 255.0f, 0.005f);
}

TEST_F(SpecularGlossinessImport, MapsOfDifferentSizesAreConvertedAtTheLarger) {
    const ImportedModel model = withMaterial(
        {{"diffuseTexture", {{"index", 0}}}, {"specularGlossinessTexture", {{"index", 1}}}},
        {png({{255, 255, 255, 255}}, 1), png(std::vector<glm::u8vec4>(12, {56, 56, 56, 0}), 4)});
    const Image color =
        embedded(model, model.materials[0].maps[MaterialInput::BaseColor], ColorEncoding::Srgb);
    EXPECT_EQ(color.width(), 4);
    EXPECT_EQ(color.height(), 3);
}

TEST_F(SpecularGlossinessImport, ANonMetalKeepsItsDiffuseMap) {
    const ImportedModel model = withMaterial(
        {{"diffuseTexture", {{"index", 0}}}, {"specularFactor", {0, 0, 0}}}, {"wood.png"});
    const ImportedMaterial& wood = model.materials[0];
    ASSERT_TRUE(wood.maps[MaterialInput::BaseColor]);
    EXPECT_EQ(wood.maps[MaterialInput::BaseColor]->file, folder.path() / "wood.png");
    EXPECT_FALSE(wood.maps[MaterialInput::Metallic]);
    EXPECT_EQ(wood.numbers[MaterialInput::Metallic], 0.0f);
}

TEST_F(SpecularGlossinessImport, WhatCannotBeConvertedIsNamed) {
    const json both = {{"diffuseTexture", {{"index", 0}}},
                       {"specularGlossinessTexture", {{"index", 1}}}};
    const std::string white = png({{255, 255, 255, 255}}, 1);
    const ImportedModel gone = withMaterial(both, {white, "gone.png"}, 2);
    EXPECT_THAT(gone.missingTextures, ElementsAre("gone.png"));
    EXPECT_THAT(gone.warnings, Contains(HasSubstr("\"material 2\": without its specular-gl")));
    EXPECT_EQ(gone.materials[1].maps[MaterialInput::BaseColor]->embedded, 0);
    EXPECT_NEAR(gone.materials[1].numbers[MaterialInput::Metallic], 0.0f, 1e-4f);
    EXPECT_THAT(withMaterial(both, {white, "no picture"}).warnings,
                Contains(HasSubstr("\"material 1\": a map of the specular-glossiness model cannot "
                                   "be read")));
    json apart = both;
    apart["diffuseTexture"]["extensions"]["KHR_texture_transform"]["scale"] = {2, 2};
    const ImportedModel model =
        withMaterial(apart, {png({{188, 0, 0, 255}}, 1), png({{56, 56, 56, 255}}, 1)});
    EXPECT_THAT(model.warnings, Contains(HasSubstr("its mean was used")));
    EXPECT_EQ(model.materials[0].maps[MaterialInput::BaseColor]->uvScale, glm::vec2(2.0f));
    expectNear(glm::vec3(embedded(model, model.materials[0].maps[MaterialInput::BaseColor],
                                  ColorEncoding::Srgb)
                             .linear(0, 0)),
               {srgbToLinear(188 / 255.0f), 0, 0}, 0.01f);
}

} // namespace
} // namespace patina
