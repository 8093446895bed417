// Maps of numbers that lie at one place share a texture, and nobody sees it.
#include "core/base/Limits.h"
#include "core/document/ViewChoices.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "render/WarmUp.h"
#include "render/gl/Uploads.h"
#include "render/scene/GpuScene.h"
#include "tests/render/RenderTest.h"

#include <algorithm>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <random>
#include <set>

namespace patina::render {
namespace {

constexpr auto kMetallic = MaterialInput::Metallic, kOcclusion = MaterialInput::Occlusion,
               kRoughness = MaterialInput::PerceptualRoughness;

ImagePtr noise(int width, int height, int channels, unsigned seed, PixelType type = PixelType::U8,
               ColorEncoding encoding = ColorEncoding::Data) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> value(0.0f, 1.0f);
    return makeImage(width, height, channels, type, encoding,
                     [&](int, int, int) { return value(random); });
}

// Three maps of numbers, each an image of its own.
Material threeMaps(int side = 16, int channels = 1, PixelType type = PixelType::U8) {
    Material m;
    m.id = 2;
    m.metallic = m.perceptualRoughness = 1.0f;
    m.metallicMap.image = noise(side, side, channels, 1, type);
    m.perceptualRoughnessMap.image = noise(side, side, channels, 2, type);
    m.occlusionMap.image = noise(side, side, channels, 3, type);
    return m;
}

MaterialInput ownerOf(const Material& m, MaterialInput input) {
    return mapFetches(m)[input]->owner;
}

// How many fetches the three maps take.
std::size_t fetchCount(const Material& m) {
    const auto fetches = mapFetches(m);
    std::set<MaterialInput> owners;
    for (const MaterialInput input : {kMetallic, kRoughness, kOcclusion})
        if (fetches[input])
            owners.insert(fetches[input]->owner);
    return owners.size();
}

TEST(MapPacking, SharedImagesAreFetchedOnceAsTheyAre) {
    const ImagePtr orm = noise(1, 1, 3, 1);
    Material m;
    m.metallicMap.image = m.perceptualRoughnessMap.image = m.occlusionMap.image = orm;
    m.metallicMap.channel = MapChannel::B;
    m.perceptualRoughnessMap.channel = MapChannel::G;
    EXPECT_EQ(fetchCount(m), 1u);
    EXPECT_EQ(ownerOf(m, kOcclusion), kMetallic);
    EXPECT_EQ(mapFetches(m)[kMetallic]->texture.image, orm);
    EXPECT_EQ(mapFetches(m)[kMetallic]->channel, 2);
    EXPECT_EQ(mapFetches(m)[kOcclusion]->channel, 0);
    m.perceptualRoughnessMap.uvScale.x = 2.0f;
    EXPECT_EQ(ownerOf(m, kRoughness), kRoughness) << "another place in the same image";
    m.occlusionMap = m.perceptualRoughnessMap;
    EXPECT_EQ(ownerOf(m, kOcclusion), kRoughness);
}

TEST(MapPacking, ImagesOfOneSizeShareATexture) {
    Material m = threeMaps();
    EXPECT_EQ(fetchCount(m), 1u);
    const auto fetches = mapFetches(m);
    const TexelSource& texture = fetches[kMetallic]->texture;
    EXPECT_EQ(texture.image, nullptr);
    EXPECT_EQ(texture.packed, (std::vector<ImageChannel>{{m.metallicMap.image, 0},
                                                         {m.perceptualRoughnessMap.image, 0},
                                                         {m.occlusionMap.image, 0}}));
    EXPECT_EQ(fetches[kRoughness]->channel, 1);
    EXPECT_EQ(fetches[kOcclusion]->channel, 2);

    // Roughness and metallic of one image, occlusion of another: the usual files.
    m.metallicMap.image = m.perceptualRoughnessMap.image = noise(16, 16, 3, 4);
    m.metallicMap.channel = MapChannel::B;
    m.perceptualRoughnessMap.channel = MapChannel::G;
    EXPECT_EQ(mapFetches(m)[kMetallic]->texture.packed,
              (std::vector<ImageChannel>{
                  {m.metallicMap.image, 2}, {m.metallicMap.image, 1}, {m.occlusionMap.image, 0}}));
    m.metallicMap.channel = MapChannel::G;
    EXPECT_EQ(mapFetches(m)[kMetallic]->texture.packed.size(), 2u) << "one channel for two inputs";
    EXPECT_EQ(mapFetches(m)[kOcclusion]->channel, 1);
}

TEST(MapPacking, WhatDiffersStaysApart) {
    const auto apart = [](const char* what, auto edit) {
        Material m = threeMaps();
        edit(m);
        EXPECT_EQ(ownerOf(m, kRoughness), kRoughness) << what;
        EXPECT_EQ(ownerOf(m, kOcclusion), kMetallic) << what << ": the others share as before";
    };
    apart("scale", [](Material& m) { m.perceptualRoughnessMap.uvScale.y = 2.0f; });
    apart("offset", [](Material& m) { m.perceptualRoughnessMap.uvOffset.x = 0.5f; });
    apart("rotation", [](Material& m) { m.perceptualRoughnessMap.uvRotationDeg = 90.0f; });
    apart("size", [](Material& m) { m.perceptualRoughnessMap.image = noise(16, 8, 1, 4); });
    apart("precision", [](Material& m) {
        m.perceptualRoughnessMap.image = noise(16, 16, 1, 4, PixelType::U16);
    });
    apart("encoding", [](Material& m) {
        m.perceptualRoughnessMap.image = noise(16, 16, 1, 4, PixelType::U8, ColorEncoding::Srgb);
    });
    apart("an alpha that is stored nowhere",
          [](Material& m) { m.perceptualRoughnessMap.channel = MapChannel::A; });

    Material floats = threeMaps(16, 1, PixelType::F32);
    EXPECT_EQ(fetchCount(floats), 1u);
    floats.occlusionMap.image = noise(16, 16, 3, 4, PixelType::F32);
    EXPECT_EQ(ownerOf(floats, kOcclusion), kOcclusion) << "its texture has half floats";
    EXPECT_EQ(fetchCount(threeMaps(16, 3, PixelType::F32)), 3u) << "so have all";
}

TEST(MapPacking, MapsThatAreNotThereAreNotFetched) {
    Material m = threeMaps();
    m.perceptualRoughnessMap.image = nullptr;
    m.perceptualRoughnessMap.source = "/damaged.png";
    EXPECT_FALSE(mapFetches(m)[kRoughness]);
    EXPECT_FALSE(materialFeatures(m).maps[kRoughness].used) << "the number stands for it";
    EXPECT_EQ(fetchCount(m), 1u);
    m.metallicMap = {};
    EXPECT_EQ(mapFetches(m)[kOcclusion]->texture.image, m.occlusionMap.image);
    EXPECT_EQ(fetchCount(Material()), 0u);
}

// A reduced scene compiles the programs of the whole one: what is apart there is not packed here.
TEST(MapPacking, ReducedMapsArePackedAsTheMapsAre) {
    Document document = makeScene(makeSphere(8));
    const std::pair<int, int> sizes[] = {{64, 64},  {128, 64}, {64, 128}, {100, 60},
                                         {60, 100}, {4, 4},    {4, 64},   {2, 100}};
    const auto use = [&](std::size_t i) { return noise(sizes[i].first, sizes[i].second, 1, 1); };
    for (std::size_t i = 0; i < std::size(sizes); ++i)
        for (std::size_t k = 0; k < std::size(sizes); ++k) {
            Material& m = document.materials[0];
            m.baseColorMap.image = use((i + 1) % std::size(sizes));
            m.metallicMap.image = use(i);
            m.perceptualRoughnessMap.image = use(k);
            m.occlusionMap.image = use((i + k) % std::size(sizes));
            const Document scene = warmUpScene(document);
            ASSERT_EQ(materialFeatures(scene.materials[0]), materialFeatures(m)) << i << ' ' << k;
            const FrameKind picture{SurfaceOutput::Picture, LightingMode::Ibl};
            ASSERT_EQ(surfacePrograms(scene, picture), surfacePrograms(document, picture));
            forEachMap(scene.materials[0], [](const MapSlot& map) {
                if (map.image) {
                    EXPECT_LE(map.image->width() * map.image->height(), 64 * 8);
                }
            });
        }
}

// --- On the GPU ----------------------------------------------------------------------------------

class MapPackingGpuTest : public gl::GlTest {};

TEST_F(MapPackingGpuTest, TexturesComeAndGoWithWhatShowsThem) {
    GpuScene scene(context());
    Document document = makeScene(makeSphere(8));
    Material& m = document.materials[0] = threeMaps();
    const auto count = [&] {
        scene.update(document);
        return scene.textureCount();
    };
    const auto texture = [&](MaterialInput input) {
        return scene.items()[0].material->maps[input].get();
    };
    EXPECT_EQ(count(), 1u);
    EXPECT_EQ(texture(kRoughness), nullptr);
    const gl::Texture* packed = texture(kMetallic);

    m.baseColor.x = 0.3f;
    m.metallic = 0.3f;
    for (MapSlot* map : {&m.metallicMap, &m.perceptualRoughnessMap, &m.occlusionMap})
        map->uvScale = {2.0f, 2.0f};
    EXPECT_EQ(count(), 1u) << "all moved alike";
    EXPECT_EQ(texture(kMetallic), packed) << "and nothing was packed anew";

    m.perceptualRoughnessMap.uvScale = {3.0f, 3.0f};
    EXPECT_EQ(count(), 2u) << "moved alone";
    EXPECT_NE(texture(kRoughness), nullptr);
    m.perceptualRoughnessMap.uvScale = {2.0f, 2.0f};
    EXPECT_EQ(count(), 1u);
    EXPECT_EQ(texture(kRoughness), nullptr);

    // Another material shows one of the images by itself.
    Material other;
    other.id = document.takeId();
    other.baseColorMap.image = m.metallicMap.image;
    document.materials.push_back(other);
    EXPECT_EQ(count(), 2u);
    Material& first = document.materials[0];
    document.materials[1].metallicMap = first.metallicMap;
    document.materials[1].perceptualRoughnessMap = first.perceptualRoughnessMap;
    document.materials[1].occlusionMap = first.occlusionMap;
    EXPECT_EQ(count(), 2u) << "the packed one is shared";
    document.materials.pop_back();
    EXPECT_EQ(count(), 1u);

    // One is removed, another arrives, is not readable, arrives later, is edited.
    Material& last = document.materials[0];
    const ImagePtr metallic = last.metallicMap.image;
    last.metallicMap = {};
    EXPECT_EQ(count(), 1u);
    ASSERT_NE(texture(kRoughness), nullptr);
    EXPECT_EQ(texture(kRoughness)->settings().format, gl::PixelFormat::Rg8);
    last.metallicMap.source = "/late.png";
    last.metallicMap.uvScale = {2.0f, 2.0f};
    EXPECT_EQ(count(), 1u);
    last.metallicMap.image = metallic;
    EXPECT_EQ(count(), 1u);
    ASSERT_NE(texture(kMetallic), nullptr);
    EXPECT_EQ(texture(kMetallic)->settings().format, gl::PixelFormat::Rgba8);
    last.occlusionMap.image = noise(16, 16, 1, 9);
    const std::uint64_t before = gl::uploadedBytes();
    EXPECT_EQ(count(), 1u);
    EXPECT_EQ(gl::uploadedBytes() - before, 16u * 16 * 4 + sizeof(MaterialBlock));
    last.occlusionMap.image = noise(32, 32, 1, 9);
    EXPECT_EQ(count(), 2u) << "of another size";

    last = Material();
    last.id = 2;
    EXPECT_EQ(count(), 0u);
}

TEST_F(MapPackingGpuTest, AMapHandedOnIsNotUploadedAgain) {
    GpuScene scene(context());
    Document document = makeScene(makeSphere(8));
    const ImagePtr image = noise(64, 64, 3, 1), another = noise(32, 32, 3, 2);
    document.materials[0].baseColorMap.image = image;
    document.materials[0].emissiveMap.image = another;
    document.materials.emplace_back().id = document.takeId();
    scene.update(document);
    const std::uint64_t before = gl::uploadedBytes();
    document.materials[0].baseColorMap.image = another;
    document.materials[0].emissiveMap = {};
    document.materials[1].baseColorMap.image = image;
    scene.update(document);
    EXPECT_EQ(gl::uploadedBytes() - before, 2 * sizeof(MaterialBlock));
    EXPECT_EQ(scene.textureCount(), 2u);
}

// --- Pictures ------------------------------------------------------------------------------------

using PackedPictures = RenderTest;

// Offsets that no coordinate notices tell three places apart.
Material takenApart(Material m) {
    m.perceptualRoughnessMap.uvOffset.x += 2e-30f;
    m.occlusionMap.uvOffset.x += 3e-30f;
    EXPECT_EQ(fetchCount(m), 3u);
    return m;
}

Document litScene(const Material& material) {
    Document document = makeScene(makeSphere(48));
    document.materials[0] = material;
    document.view.camera.distance = 4.0f;
    Light light;
    light.id = document.takeId();
    light.castsShadow = false;
    light.azimuthDeg = 40.0f;
    document.lights = {light};
    return document;
}

TEST_F(PackedPictures, AreThoseOfMapsApart) {
    sceneRenderer().setIbl(uniformIbl(glm::vec3(1.0f, 0.8f, 0.6f)));
    for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32})
        for (const int channels : {1, 2, 3, 4, 5})
            for (const int side : {64, 200, 1024}) { // enlarged, no power of two, reduced
                SCOPED_TRACE(fmt::format("type {} channels {} side {}", static_cast<int>(type),
                                         channels, side));
                Material m = threeMaps(side, channels, type);
                if (channels == 2)
                    m.metallicMap.channel = MapChannel::A;
                if (channels >= 3) {
                    m.metallicMap.channel = MapChannel::B;
                    m.perceptualRoughnessMap.channel = MapChannel::G;
                }
                if (channels >= 4)
                    m.occlusionMap.channel = MapChannel::A;
                m.baseColorMap.image = noise(32, 32, 3, 7, PixelType::U8, ColorEncoding::Srgb);
                const std::size_t fetches = type == PixelType::F32 && channels > 2 ? 3 : 1;
                ASSERT_EQ(fetchCount(m), fetches);
                const Image packed = draw(litScene(m), 96);
                EXPECT_TRUE(packed == draw(litScene(takenApart(m)), 96));
                m.metallicMap.image = m.perceptualRoughnessMap.image;
                ASSERT_EQ(fetchCount(m), fetches == 1 ? 1 : 2);
                EXPECT_TRUE(draw(litScene(m), 96) == draw(litScene(takenApart(m)), 96))
                    << "two images";
                EXPECT_FALSE(draw(litScene(m), 96) == packed);
            }
}

TEST_F(PackedPictures, OfSharedImagesAndOfSeveralSizesAreThoseOfMapsApart) {
    sceneRenderer().setIbl(uniformIbl(glm::vec3(1.0f, 0.8f, 0.6f)));
    Material m = threeMaps(256, 3);
    m.metallicMap.channel = MapChannel::B;
    m.perceptualRoughnessMap.channel = MapChannel::G;
    m.metallicMap.image = m.perceptualRoughnessMap.image = m.occlusionMap.image;
    const Image shared = draw(litScene(m), 96);
    EXPECT_TRUE(shared == draw(litScene(takenApart(m)), 96));
    // The same numbers packed from images of one channel.
    const auto single = [](MapSlot& map) {
        const Image& image = *map.image;
        const int channel = map.channel == MapChannel::B ? 2 : map.channel == MapChannel::G ? 1 : 0;
        map.image = makeImage(image.width(), image.height(), 1, PixelType::U8, ColorEncoding::Data,
                              [&](int x, int y, int) { return image.sample(x, y, channel); });
        map.channel = MapChannel::Rgb;
    };
    for (MapSlot* map : {&m.metallicMap, &m.perceptualRoughnessMap, &m.occlusionMap})
        single(*map);
    ASSERT_EQ(fetchCount(m), 1u);
    EXPECT_TRUE(draw(litScene(m), 96) == shared);

    m.occlusionMap.image = noise(128, 128, 1, 3);
    ASSERT_EQ(fetchCount(m), 2u);
    EXPECT_TRUE(draw(litScene(m), 96) == draw(litScene(takenApart(m)), 96));
    m.perceptualRoughnessMap.image = noise(64, 256, 1, 2);
    ASSERT_EQ(fetchCount(m), 3u);
    EXPECT_TRUE(draw(litScene(m), 96) == draw(litScene(takenApart(m)), 96));
}

// What is edited shows what a new renderer shows, whatever was packed before.
TEST_F(PackedPictures, FollowEdits) {
    sceneRenderer().setIbl(uniformIbl(glm::vec3(1.0f)));
    Document document = litScene(threeMaps(64, 3));
    Material& m = document.materials[0];
    const auto check = [&](const char* what) {
        const Image here = draw(document, 64);
        Document apart = document;
        apart.materials[0] = m;
        apart.materials[0].perceptualRoughnessMap.uvOffset.x += 2e-30f;
        apart.materials[0].occlusionMap.uvOffset.x += 3e-30f;
        auto scene = SceneRenderer::create(context());
        ASSERT_TRUE(scene.ok());
        (*scene)->setIbl(uniformIbl(glm::vec3(1.0f)));
        (*scene)->setDocument(apart);
        ViewRenderer view(**scene);
        FrameSettings frame;
        frame.width = frame.height = 64;
        frame.camera = document.view.camera;
        ASSERT_TRUE(view.render(frame, 0).ok());
        EXPECT_TRUE(view.readLinear() == here) << what;
    };
    check("three maps");
    m.metallicMap.channel = MapChannel::B;
    check("a channel");
    m.perceptualRoughnessMap.image = noise(64, 64, 3, 11);
    check("an image replaced");
    m.perceptualRoughnessMap.uvScale.x = 2.0f;
    check("moved alone");
    m.perceptualRoughnessMap.uvScale.x = 1.0f;
    check("moved back");
    const MapSlot before = m.occlusionMap;
    m.occlusionMap = {};
    check("removed");
    m.occlusionMap.source = "/damaged.png";
    m.occlusionMap.problem = "damaged";
    check("damaged");
    m.occlusionMap = before;
    check("there again");
    m.metallicMap.image = nullptr;
    m.metallicMap.source = "/late.png";
    check("not there yet");
    m.metallicMap.image = noise(64, 64, 1, 12);
    m.metallicMap.channel = MapChannel::R;
    check("arrived");
}

// Images beyond what the driver takes are reduced, packed or not. (Some drivers take all that an
// Image may be.)
TEST_F(PackedPictures, OfHugeImagesAreThoseOfMapsApart) {
    const int side = std::min(2 * context().info().maxTextureSize, limits::kMaxImageSide);
    Material m = threeMaps();
    m.metallicMap.image = noise(side, 1, 1, 1);
    m.perceptualRoughnessMap.image = noise(side, 1, 1, 2);
    m.occlusionMap.image = noise(side, 1, 1, 3);
    ASSERT_EQ(fetchCount(m), 1u);
    sceneRenderer().setIbl(uniformIbl(glm::vec3(1.0f)));
    EXPECT_TRUE(draw(litScene(m), 64) == draw(litScene(takenApart(m)), 64));
}

} // namespace
} // namespace patina::render
