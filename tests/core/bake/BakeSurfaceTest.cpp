#include "core/trace/BakeSurface.h"
#include "core/material/Material.h"

#include "core/bake/Bake.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/document/Document.h"
#include "core/image/Srgb.h"

#include <gtest/gtest.h>

using namespace patina;

namespace {

// Two columns and two rows: red, green / blue, grey (sRGB code 128); alpha 0, 85, 170, 255.
ImagePtr fourColors() {
    auto image = std::make_shared<Image>(2, 2, 4, PixelType::U8, ColorEncoding::Srgb);
    const std::uint8_t texels[] = {255, 0, 0,   0,   0,   255, 0,   85, //
                                   0,   0, 255, 170, 128, 128, 128, 255};
    std::copy(std::begin(texels), std::end(texels), image->u8().begin());
    return image;
}

BakeSurface mapped() {
    BakeSurface surface;
    surface.baseColor = {1, 1, 1};
    surface.baseColorMap.image = fourColors();
    return surface;
}

glm::vec3 albedo(const BakeSurface& surface, const glm::vec2& uv) {
    return DiffuseAlbedo(surface).of(AlbedoTexels(surface).at(uv));
}

void expectNear(const glm::vec3& a, const glm::vec3& b, float tolerance = 1e-6f) {
    EXPECT_NEAR(a.r, b.r, tolerance);
    EXPECT_NEAR(a.g, b.g, tolerance);
    EXPECT_NEAR(a.b, b.b, tolerance);
}

} // namespace

TEST(BakeSurface, AlbedoIsFactorTimesTexelWithoutTheMetalsShare) {
    BakeSurface surface = mapped();
    expectNear(albedo(surface, {0.25f, 0.25f}), {1, 0, 0}); // row 0 is the top
    expectNear(albedo(surface, {0.75f, 0.25f}), {0, 1, 0});
    expectNear(albedo(surface, {0.25f, 0.75f}), {0, 0, 1});
    const float grey = srgbToLinear(128.0f / 255.0f);
    expectNear(albedo(surface, {0.75f, 0.75f}), glm::vec3(grey));
    expectNear(albedo(surface, {-1.75f, 5.25f}), {1, 0, 0}); // repeats
    surface.baseColor = {0.5f, 0.25f, 0.125f};
    surface.metallic = 0.25f;
    expectNear(albedo(surface, {0.75f, 0.75f}), 0.75f * grey * surface.baseColor);
    EXPECT_EQ(DiffuseAlbedo(surface).uniform(), 0.75f * surface.baseColor);
    EXPECT_FALSE(hasAlbedoMap(BakeSurface{}));
    EXPECT_TRUE(hasAlbedoMap(surface));
}

TEST(BakeSurface, MetallicMapAndChannelsAreReadAsTheShaderReadsThem) {
    BakeSurface surface;
    surface.baseColor = {1, 1, 1};
    surface.metallic = 0.5f;
    auto image = std::make_shared<Image>(1, 1, 3, PixelType::U8, ColorEncoding::Data);
    image->u8()[0] = 10;
    image->u8()[1] = 20;
    image->u8()[2] = 153; // 0.6
    surface.metallicMap.image = image;
    surface.metallicMap.channel = MapChannel::B;
    expectNear(albedo(surface, {0.5f, 0.5f}), glm::vec3(1.0f - 0.5f * 0.6f), 0.002f);
    // One channel of a colour map is a grey.
    surface = mapped();
    surface.baseColorMap.channel = MapChannel::G;
    expectNear(albedo(surface, {0.75f, 0.25f}), {1, 1, 1});
    expectNear(albedo(surface, {0.25f, 0.25f}), {0, 0, 0});
}

TEST(BakeSurface, MapsMoveAsOnTheSurface) {
    BakeSurface surface = mapped();
    surface.baseColorMap.uvOffset = {0.5f, 0.0f};
    expectNear(albedo(surface, {0.25f, 0.25f}), {0, 1, 0});
    surface.baseColorMap.uvOffset = {0, 0};
    surface.baseColorMap.uvScale = {1, 2};
    expectNear(albedo(surface, {0.25f, 0.4f}), {0, 0, 1});
    // A quarter turn takes (u, v) to (v, -u).
    surface.baseColorMap.uvScale = {1, 1};
    surface.baseColorMap.uvRotationDeg = 90.0f;
    expectNear(albedo(surface, {0.75f, 0.25f}), {1, 0, 0});
    expectNear(albedo(surface, {0.75f, 0.75f}), {0, 1, 0});
}

TEST(BakeSurface, LargeMapsAreAveragedInLinearLight) {
    BakeSurface surface;
    surface.baseColor = {1, 1, 1};
    auto image = std::make_shared<Image>(2 * AlbedoTexels::kMaxSide, 2, 3, PixelType::U8,
                                         ColorEncoding::Srgb);
    for (std::size_t i = 0; i < image->u8().size(); ++i)
        image->u8()[i] = i / 3 % 2 == 0 ? 255 : 0; // white and black columns
    surface.baseColorMap.image = image;
    expectNear(albedo(surface, {0.3f, 0.5f}), glm::vec3(0.5f), 0.004f);
}

TEST(BakeSurface, CoverageIsOpacityTimesInterpolatedAlpha) {
    BakeSurface surface = mapped();
    surface.opacity = 0.5f;
    surface.alphaMode = AlphaMode::Blend;
    const Coverage coverage(surface);
    EXPECT_NEAR(coverage.alphaAt({0.25f, 0.25f}), 0.0f, 1e-6f);
    EXPECT_NEAR(coverage.alphaAt({0.75f, 0.25f}), 0.5f * 85.0f / 255.0f, 1e-6f);
    EXPECT_NEAR(coverage.alphaAt({0.75f, 0.75f}), 0.5f, 1e-6f);
    EXPECT_NEAR(coverage.alphaAt({0.5f, 0.5f}), 0.25f, 1e-6f);                   // between all four
    EXPECT_NEAR(coverage.alphaAt({0.0f, 0.75f}), 0.5f * 212.5f / 255.0f, 1e-6f); // across the edge
    EXPECT_TRUE(coverage.solidAt({0.5f, 0.5f}, 0.24f));
    EXPECT_FALSE(coverage.solidAt({0.5f, 0.5f}, 0.26f));
    surface.alphaMode = AlphaMode::Mask;
    surface.alphaCutoff = 0.2f;
    EXPECT_TRUE(Coverage(surface).solidAt({0.5f, 0.5f}, 0.99f));
    EXPECT_FALSE(Coverage(surface).solidAt({0.25f, 0.25f}, 0.0f));
    surface.alphaMode = AlphaMode::Opaque;
    EXPECT_TRUE(Coverage(surface).solidAt({0.25f, 0.25f}, 0.99f));
}

TEST(BakeSurface, HashesTellGeometryFromAlbedo) {
    Document document;
    document.materials.push_back({});
    document.materials[0].id = 1;
    document.materials[0].baseColorMap.image = fourColors();
    MeshInstance instance;
    instance.id = 2;
    instance.material = 1;
    instance.mesh = std::make_shared<const Mesh>();
    document.meshes.push_back(instance);
    const auto geometry = [&] { return hashBakeInputs(bakeInputs(document)); };
    const auto color = [&] { return hashBakeAlbedo(bakeInputs(document)); };
    const Hash inputs = geometry(), albedos = color();
    Material& material = document.materials[0];
    const Material before = material;
    const auto expect = [&](bool sameGeometry, bool sameAlbedo) {
        EXPECT_EQ(geometry() == inputs, sameGeometry);
        EXPECT_EQ(color() == albedos, sameAlbedo);
        material = before;
    };
    material.baseColor.g = 0.25f;
    expect(true, false);
    material.metallic = 0.5f;
    expect(true, false);
    material.baseColorMap.uvScale.y = 2.0f;
    expect(true, false);
    material.baseColorMap.image = nullptr;
    expect(true, false);
    material.doubleSided = true;
    expect(true, false);
    material.perceptualRoughness = 0.1f;
    material.opacity = 0.5f; // of an opaque surface
    expect(true, true);
    material.alphaMode = AlphaMode::Mask;
    expect(false, true);
    material.alphaMode = AlphaMode::Blend;
    const Hash blend = geometry();
    material.opacity = 0.25f;
    EXPECT_NE(geometry(), blend);
}
