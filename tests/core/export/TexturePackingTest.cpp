#include "ExportScene.h"
#include "core/bake/domain/BakeArtifact.h"
#include "core/base/Id.h"
#include "core/document/Document.h"
#include "core/image/Image.h"
#include "core/job/JobContext.h"
#include "core/material/Material.h"

#include <gmock/gmock.h>

using namespace patina;
using namespace patina::test;
using testing::ElementsAre;
using testing::HasSubstr;

namespace {

class TexturePacking : public testing::Test {
  protected:
    TexturePlan plan(const std::string& stem = {}) const {
        std::vector<const Material*> materials;
        for (const Material& material : m_document.materials)
            materials.push_back(&material);
        return planTextures(m_document, materials, m_settings, stem);
    }
    std::vector<int> pixels(const PackedTexture& texture) const {
        const Image image = packTexture(texture, JobContext());
        EXPECT_EQ(image.width(), texture.width);
        EXPECT_EQ(image.height(), texture.height);
        EXPECT_EQ(image.channels(), texture.channels);
        EXPECT_EQ(image.type(), texture.type);
        if (image.type() == PixelType::U16)
            return {image.u16().begin(), image.u16().end()};
        return {image.u8().begin(), image.u8().end()};
    }
    void attachAo(Id material, ImagePtr image) {
        BakeArtifact bake;
        bake.texels.push_back({material, std::move(image)});
        m_document.bakes.push_back(std::make_shared<const BakeArtifact>(std::move(bake)));
    }

    Document m_document;
    ExportSettings m_settings = glbSettings();
};

ImagePtr floats(int width, int height, const std::vector<float>& values) {
    Image image(width, height, 1, PixelType::F32, ColorEncoding::Data);
    for (std::size_t i = 0; i < image.f32().size(); ++i)
        image.f32()[i] = values[i % values.size()];
    return std::make_shared<const Image>(std::move(image));
}

} // namespace

TEST_F(TexturePacking, MaterialsWithoutMapsNeedNoTextures) {
    addMaterial(m_document, "Plain");
    const TexturePlan p = plan();
    EXPECT_TRUE(p.textures.empty());
    ASSERT_EQ(p.materials.size(), 1u);
    EXPECT_EQ(p.materials[0][MaterialInput::BaseColor].texture, -1);
    EXPECT_EQ(p.materials[0][MaterialInput::Metallic].texture, -1);
}

TEST_F(TexturePacking, ChannelsOfThreeMapsShareOneImage) {
    Material& m = addMaterial(m_document, "Body");
    m.occlusionMap = map(codes(1, 1, 1, {10}));
    m.perceptualRoughnessMap = map(codes(1, 1, 3, {1, 20, 3}), MapChannel::G);
    m.metallicMap = map(codes(1, 1, 4, {1, 2, 3, 30}), MapChannel::A);
    const TexturePlan p = plan();
    ASSERT_EQ(p.textures.size(), 1u);
    EXPECT_EQ(p.textures[0].name, "Body_orm");
    EXPECT_EQ(p.textures[0].contents, "Body: occlusion (R), roughness (G), metallic (B)");
    EXPECT_EQ(p.textures[0].formatText(), "PNG 8-bit RGB 1 × 1");
    EXPECT_THAT(pixels(p.textures[0]), ElementsAre(10, 20, 30));
    EXPECT_EQ(p.materials[0][MaterialInput::Occlusion].texture, 0);
    EXPECT_EQ(p.materials[0][MaterialInput::Metallic].texture, 0);
}

TEST_F(TexturePacking, AbsentMapsAreOne) {
    addMaterial(m_document, "A").metallicMap = map(codes(1, 1, 1, {9}));
    addMaterial(m_document, "B").occlusionMap = map(codes(1, 1, 3, {5, 6, 7}), MapChannel::B);
    const TexturePlan p = plan();
    ASSERT_EQ(p.textures.size(), 2u);
    EXPECT_EQ(p.textures[0].name, "A_metallicRoughness");
    EXPECT_THAT(pixels(p.textures[0]), ElementsAre(255, 255, 9));
    EXPECT_EQ(p.materials[0][MaterialInput::Occlusion].texture, -1);
    EXPECT_EQ(p.textures[1].name, "B_occlusion");
    EXPECT_EQ(p.textures[1].formatText(), "PNG 8-bit grey 1 × 1");
    EXPECT_THAT(pixels(p.textures[1]), ElementsAre(7));
    EXPECT_EQ(p.materials[1][MaterialInput::Metallic].texture, -1);
}

TEST_F(TexturePacking, SmallerMapsGrowToTheLargest) {
    Material& m = addMaterial(m_document, "M");
    m.perceptualRoughnessMap = map(codes(4, 2, 1, {10, 20, 30, 40}));
    m.metallicMap = map(codes(1, 1, 1, {77}));
    const TexturePlan p = plan();
    EXPECT_EQ(p.textures[0].width, 4);
    EXPECT_EQ(p.textures[0].height, 2);
    EXPECT_THAT(pixels(p.textures[0]),
                ElementsAre(255, 10, 77, 255, 20, 77, 255, 30, 77, 255, 40, 77, 255, 10, 77, 255,
                            20, 77, 255, 30, 77, 255, 40, 77));
}

TEST_F(TexturePacking, TheSizeLimitShrinksByArea) {
    m_settings.maxTextureSize = 2;
    addMaterial(m_document, "M").perceptualRoughnessMap =
        map(codes(4, 2, 1, {10, 30, 50, 70, 10, 30, 50, 70}));
    const TexturePlan p = plan();
    EXPECT_EQ(p.textures[0].width, 2);
    EXPECT_EQ(p.textures[0].height, 1);
    EXPECT_THAT(pixels(p.textures[0]), ElementsAre(255, 20, 255, 255, 60, 255));
}

TEST_F(TexturePacking, DirectXNormalsAreTurnedUp) {
    Material& m = addMaterial(m_document, "M");
    m.normalMap = map(codes(1, 1, 3, {100, 200, 250}));
    EXPECT_THAT(pixels(plan().textures[0]), ElementsAre(100, 200, 250));
    m.normalConvention = NormalConvention::DirectX;
    EXPECT_THAT(pixels(plan().textures[0]), ElementsAre(100, 55, 250));
}

TEST_F(TexturePacking, FineNormalsStayFine) {
    Image image(1, 1, 3, PixelType::U16, ColorEncoding::Data);
    image.u16()[0] = 30000;
    image.u16()[1] = 40001;
    image.u16()[2] = 65535;
    Material& m = addMaterial(m_document, "M");
    m.normalMap = map(std::make_shared<const Image>(image));
    const TexturePlan p = plan();
    EXPECT_EQ(p.textures[0].formatText(), "PNG 16-bit RGB 1 × 1");
    EXPECT_THAT(pixels(p.textures[0]), ElementsAre(30000, 40001, 65535));
}

// Maps of 16 bits are written as they were read; what is packed with them, too.
TEST_F(TexturePacking, MapsOf16BitsStayMapsOf16Bits) {
    const auto fine = [](int channels, ColorEncoding encoding, const std::vector<int>& values) {
        Image image(1, 1, channels, PixelType::U16, encoding);
        for (std::size_t i = 0; i < values.size(); ++i)
            image.u16()[i] = static_cast<std::uint16_t>(values[i]);
        return map(std::make_shared<const Image>(image));
    };
    Material& m = addMaterial(m_document, "M");
    m.baseColorMap = fine(3, ColorEncoding::Srgb, {1, 30001, 65534});
    m.perceptualRoughnessMap = fine(1, ColorEncoding::Data, {12345});
    m.metallicMap = map(codes(1, 1, 1, {1}));
    m.transmissionMap = fine(1, ColorEncoding::Data, {54321});
    TexturePlan p = plan();
    ASSERT_EQ(p.textures.size(), 3u);
    EXPECT_EQ(p.textures[0].formatText(), "PNG 16-bit RGB 1 × 1");
    EXPECT_THAT(pixels(p.textures[0]), ElementsAre(1, 30001, 65534));
    EXPECT_EQ(p.textures[1].formatText(), "PNG 16-bit RGB 1 × 1");
    EXPECT_THAT(pixels(p.textures[1]), ElementsAre(65535, 12345, 257));
    EXPECT_THAT(pixels(p.textures[2]), ElementsAre(54321));
    m_settings.textures = ExportTextureFormat::Jpeg;
    p = plan();
    EXPECT_EQ(p.textures[0].formatText(), "JPEG 8-bit RGB 1 × 1"); // as was asked for
    EXPECT_THAT(pixels(p.textures[0]), ElementsAre(0, 117, 255));
    EXPECT_EQ(p.textures[1].formatText(), "PNG 16-bit RGB 1 × 1");
}

TEST_F(TexturePacking, AveragedNormalsStayUnit) {
    m_settings.maxTextureSize = 1;
    // (±0.6, 0, 0.8): their mean is (0, 0, 0.8).
    addMaterial(m_document, "M").normalMap = map(codes(2, 1, 3, {204, 128, 230, 51, 128, 230}));
    const std::vector<int> mean = pixels(plan().textures[0]);
    EXPECT_NEAR(mean[0], 128, 1);
    EXPECT_EQ(mean[2], 255);
}

TEST_F(TexturePacking, OpacityTravelsInTheAlphaOfTheBaseColour) {
    Material& m = addMaterial(m_document, "Leaf");
    m.baseColorMap = map(codes(1, 1, 4, {1, 2, 3, 128}, ColorEncoding::Srgb));
    m_settings.textures = ExportTextureFormat::Jpeg;
    TexturePlan p = plan();
    EXPECT_EQ(p.textures[0].contents, "Leaf: base colour");
    EXPECT_EQ(p.textures[0].formatText(), "JPEG 8-bit RGB 1 × 1");
    EXPECT_THAT(pixels(p.textures[0]), ElementsAre(1, 2, 3));
    m.alphaMode = AlphaMode::Mask;
    p = plan();
    EXPECT_EQ(p.textures[0].contents, "Leaf: base colour (RGB), opacity (A)");
    EXPECT_EQ(p.textures[0].formatText(), "PNG 8-bit RGBA 1 × 1"); // JPEG has no alpha
    EXPECT_THAT(pixels(p.textures[0]), ElementsAre(1, 2, 3, 128));
}

TEST_F(TexturePacking, JpegIsForColoursOnly) {
    m_settings.textures = ExportTextureFormat::Jpeg;
    Material& m = addMaterial(m_document, "M");
    m.normalMap = map(codes(1, 1, 3, {128, 128, 255}));
    m.metallicMap = map(codes(1, 1, 1, {0}));
    m.emissiveMap = map(codes(1, 1, 3, {1, 2, 3}, ColorEncoding::Srgb));
    for (const PackedTexture& texture : plan().textures)
        EXPECT_EQ(texture.format == ImageFileFormat::Jpeg, texture.kind == PackKind::Color);
}

TEST_F(TexturePacking, FloatColoursAreEncodedAndTheLossIsTold) {
    Image image(1, 1, 3, PixelType::F32, ColorEncoding::Linear);
    image.f32()[0] = 0.5f; // sRGB 188 (IEC 61966-2-1)
    image.f32()[1] = 4.0f;
    addMaterial(m_document, "M").emissiveMap = map(std::make_shared<const Image>(image));
    const TexturePlan p = plan();
    EXPECT_THAT(pixels(p.textures[0]), ElementsAre(188, 255, 0));
    EXPECT_THAT(p.warnings, ElementsAre(HasSubstr("clipped")));
}

TEST_F(TexturePacking, EqualImagesAreWrittenOnceEvenWhenLoadedTwice) {
    addMaterial(m_document, "A").baseColorMap = map(codes(2, 1, 3, {1, 2, 3}, ColorEncoding::Srgb));
    addMaterial(m_document, "B").baseColorMap = map(codes(2, 1, 3, {1, 2, 3}, ColorEncoding::Srgb));
    addMaterial(m_document, "C").baseColorMap = map(codes(2, 1, 3, {1, 2, 4}, ColorEncoding::Srgb));
    addMaterial(m_document, "D").emissiveMap = m_document.materials[0].baseColorMap;
    m_document.materials[1].baseColorMap.uvScale = {2, 2}; // the reference differs, not the image
    const TexturePlan p = plan();
    ASSERT_EQ(p.textures.size(), 2u);
    EXPECT_EQ(p.textures[0].contents, "A, B: base colour; D: emissive");
    EXPECT_EQ(p.materials[1][MaterialInput::BaseColor].texture, 0);
    EXPECT_EQ(p.materials[1][MaterialInput::BaseColor].scale, glm::vec2(2));
    EXPECT_EQ(p.materials[2][MaterialInput::BaseColor].texture, 1);
    EXPECT_EQ(p.materials[3][MaterialInput::Emissive].texture, 0);
}

TEST_F(TexturePacking, MaterialsOfOneNameGetDifferentFiles) {
    addMaterial(m_document, "Körper").baseColorMap = map(codes(1, 1, 3, {1}));
    addMaterial(m_document, "Körper").baseColorMap = map(codes(1, 1, 3, {2}));
    const TexturePlan p = plan("scene");
    EXPECT_EQ(p.textures[0].name, "scene_K__rper_baseColor");
    EXPECT_EQ(p.textures[1].name, "scene_K__rper_baseColor_2");
}

TEST_F(TexturePacking, DifferentTransformsKeepOcclusionApart) {
    Material& m = addMaterial(m_document, "M");
    m.occlusionMap = map(codes(1, 1, 1, {10}));
    m.perceptualRoughnessMap = map(codes(1, 1, 1, {20}));
    m.perceptualRoughnessMap.uvScale = {3, 3};
    m.metallicMap = map(codes(1, 1, 1, {30}));
    m.metallicMap.uvRotationDeg = 45;
    const TexturePlan p = plan();
    ASSERT_EQ(p.textures.size(), 2u);
    EXPECT_EQ(p.textures[0].name, "M_occlusion");
    EXPECT_EQ(p.textures[1].name, "M_metallicRoughness");
    EXPECT_EQ(p.materials[0][MaterialInput::Occlusion].scale, glm::vec2(1));
    EXPECT_EQ(p.materials[0][MaterialInput::Metallic].scale, glm::vec2(3));
    EXPECT_THAT(p.warnings, ElementsAre(HasSubstr("metallic map will follow")));
}

TEST_F(TexturePacking, TheBakeIsTheOcclusion) {
    Material& m = addMaterial(m_document, "M");
    attachAo(m.id, floats(2, 1, {0.2f, 0.6f}));
    TexturePlan p = plan();
    ASSERT_EQ(p.textures.size(), 1u);
    EXPECT_EQ(p.textures[0].contents, "M: baked occlusion");
    EXPECT_THAT(pixels(p.textures[0]), ElementsAre(51, 153));
    m_settings.includeBakedAo = false;
    EXPECT_TRUE(plan().textures.empty());
}

// As in the viewport: darkening twice would export another picture than the one shown. The map's
// tiling does not apply to the bake, which has the mesh's own texture space.
TEST_F(TexturePacking, TheBakeReplacesTheOcclusionMap) {
    Material& m = addMaterial(m_document, "M");
    m.occlusionMap = map(codes(2, 1, 1, {255, 102}));
    m.occlusionMap.uvScale = {3, 3};
    m.perceptualRoughnessMap = map(codes(1, 1, 1, {7}));
    attachAo(m.id, floats(2, 1, {0.5f, 0.2f}));
    const TexturePlan p = plan();
    ASSERT_EQ(p.textures.size(), 1u);
    EXPECT_EQ(p.textures[0].contents, "M: baked occlusion (R), roughness (G)");
    EXPECT_THAT(pixels(p.textures[0]), ElementsAre(128, 7, 255, 51, 7, 255));
    EXPECT_EQ(p.materials[0][MaterialInput::Occlusion].scale, glm::vec2(1));
}

TEST_F(TexturePacking, MissingImagesAreLeftOutAndTold) {
    Material& m = addMaterial(m_document, "M");
    m.normalMap.source = "/gone/normal.png";
    m.metallicMap.source = m.perceptualRoughnessMap.source = "/gone/mr.png";
    const TexturePlan p = plan();
    EXPECT_TRUE(p.textures.empty());
    EXPECT_THAT(
        p.warnings,
        ElementsAre("M: “/gone/mr.png” could not be read and will be left out (roughness, "
                    "metallic)",
                    "M: “/gone/normal.png” could not be read and will be left out (normal)"));
}

TEST_F(TexturePacking, ACancelledJobPacksNothing) {
    addMaterial(m_document, "M").baseColorMap = map(codes(4, 4, 3, {1}));
    JobControl control;
    control.cancel();
    EXPECT_TRUE(packTexture(plan().textures[0], control.context()).empty());
}
