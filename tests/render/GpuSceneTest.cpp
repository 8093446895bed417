// What reaches the GPU, and how it reads there.
#include "render/scene/GpuScene.h"
#include "core/base/Limits.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "render/gl/Uploads.h"
#include "render/scene/DrawList.h"
#include "tests/render/RenderTest.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <tuple>
#include <vector>

namespace patina::render {
namespace {

TEST(DrawListTest, BoxesOutsideTheViewAreLeftOut) {
    Camera camera;
    camera.yawDeg = 0.0f;
    camera.pitchDeg = 0.0f;
    camera.distance = 10.0f;
    camera.fovDeg = 40.0f;
    Bounds scene{glm::vec3(-20.0f), glm::vec3(20.0f)};
    const glm::mat4 worldToClip = camera.projectionMatrix(1.5f, scene) * camera.viewMatrix();
    const auto inside = [&](const glm::vec3& center, float half) {
        return insideFrustum({center - half, center + half}, worldToClip);
    };
    EXPECT_TRUE(inside({0, 0, 0}, 1.0f));
    EXPECT_TRUE(inside({0, 0, 0}, 100.0f)) << "the camera is inside the box";
    EXPECT_FALSE(inside({0, 0, 14}, 1.0f)) << "behind the camera";
    // At distance 10 the picture is 2 · 10 · tan(20°) = 7.28 high and 10.92 wide.
    EXPECT_FALSE(inside({7.5f, 0, 0}, 1.0f));
    EXPECT_TRUE(inside({6.0f, 0, 0}, 1.0f)) << "reaches in";
    EXPECT_FALSE(inside({0, -5.5f, 0}, 1.0f));
    EXPECT_TRUE(inside({0, 4.5f, 0}, 1.0f));
    EXPECT_FALSE(inside({-7.5f, 0, 0}, 1.0f));
    EXPECT_FALSE(inside({0, 5.5f, 0}, 1.0f));
}

TEST(DrawListTest, OpaqueFromTheFrontBlendedFromTheBack) {
    GpuMaterial opaque, blended;
    blended.alphaMode = AlphaMode::Blend;
    std::vector<DrawItem> items;
    for (const float z : {-2.0f, 3.0f, 0.0f}) {
        for (const GpuMaterial* material : {&opaque, &blended}) {
            DrawItem item;
            item.id = static_cast<Id>(items.size() + 1);
            item.material = material;
            item.bounds = {glm::vec3(-0.1f, -0.1f, z), glm::vec3(0.1f, 0.1f, z)};
            items.push_back(item);
        }
    }
    const glm::mat4 projection = glm::perspective(1.0f, 1.0f, 0.1f, 100.0f);
    const glm::vec3 eye(0, 0, 10);
    const DrawList list =
        makeDrawList(items, projection * glm::translate(glm::mat4(1.0f), -eye), eye);
    const auto ids = [](const std::vector<const DrawItem*>& drawn) {
        std::vector<Id> result;
        for (const DrawItem* item : drawn)
            result.push_back(item->id);
        return result;
    };
    EXPECT_EQ(ids(list.opaque), (std::vector<Id>{3, 5, 1}));
    EXPECT_EQ(ids(list.blended), (std::vector<Id>{2, 6, 4}));
}

// Fewer triangles the fewer pixels there are: cells of a wall have few.
TEST(DrawListTest, SmallerPicturesAreDrawnWithFewerTriangles) {
    GpuMesh mesh;
    mesh.bounds = {glm::vec3(-1.0f), glm::vec3(1.0f)};
    mesh.indexCount = 300'000;
    for (const float cells : {64.0f, 45.0f, 32.0f, 23.0f, 16.0f})
        mesh.coarse.push_back({mesh.indexCount, 1, 2.0f / cells});
    DrawItem item;
    item.mesh = &mesh;
    item.bounds = mesh.bounds;
    // Its near side, 4 in front of the eye, is half as high as the picture: 2 of 4.
    const glm::mat4 clip = glm::perspective(2.0f * std::atan(0.5f), 1.0f, 0.1f, 100.0f) *
                           glm::translate(glm::mat4(1.0f), glm::vec3(0.0f, 0.0f, -5.0f));
    const auto cells = [&](int height) {
        const GpuMesh::Coarse* coarse = coarseFor(item, {clip, height});
        return coarse ? 2.0f / coarse->cell : 0.0f;
    };
    EXPECT_FLOAT_EQ(cells(2000), 64.0f) << "a 128th of the height is no more than a 45th";
    EXPECT_FLOAT_EQ(cells(359), 45.0f); // 3.99 pixels
    EXPECT_FLOAT_EQ(cells(361), 64.0f); // 4.01 of the next
    EXPECT_FLOAT_EQ(cells(240), 32.0f);
    EXPECT_FLOAT_EQ(cells(60), 23.0f) << "of the next a cell is more than a 45th of the height";
    mesh.coarse.resize(1);
    EXPECT_FLOAT_EQ(cells(60), 64.0f);
    mesh.coarse.clear();
    EXPECT_FLOAT_EQ(cells(60), 0.0f);
}

class GpuSceneTest : public gl::GlTest {};

TEST_F(GpuSceneTest, UploadsEachPayloadOnceAndDropsWhatIsUnused) {
    GpuScene scene(context());
    Document document = makeScene(makeSphere(8));
    document.meshes.push_back(document.meshes[0]);
    document.meshes.back().id = 9;
    Material& m = document.materials[0];
    m.baseColorMap.image = m.emissiveMap.image =
        makeImage(4, 4, 3, PixelType::U8, ColorEncoding::Srgb, [](int, int, int) { return 0.5f; });
    scene.update(document);
    EXPECT_EQ(scene.items().size(), 2u);
    EXPECT_EQ(scene.meshCount(), 1u);
    EXPECT_EQ(scene.textureCount(), 1u);
    const unsigned buffer = scene.items()[0].mesh->vertices.id();

    m.normalMap.image =
        makeImage(4, 4, 3, PixelType::U8, ColorEncoding::Data, [](int, int, int) { return 0.5f; });
    scene.update(document);
    EXPECT_EQ(scene.textureCount(), 2u);
    EXPECT_EQ(scene.items()[0].mesh->vertices.id(), buffer) << "the mesh was not touched";

    m = Material{};
    m.id = 2;
    scene.update(document);
    EXPECT_EQ(scene.textureCount(), 0u);

    // A material that is not there, a mesh that was not resolved: shown, and left out.
    document.meshes[0].material = 77;
    document.meshes[1].mesh = nullptr;
    scene.update(document);
    ASSERT_EQ(scene.items().size(), 1u);
    EXPECT_EQ(scene.items()[0].material->values.baseColor, glm::vec4(Material{}.baseColor, 1.0f));

    document.meshes.clear();
    scene.update(document);
    EXPECT_EQ(scene.meshCount(), 0u);
    EXPECT_TRUE(scene.bounds().empty());
}

// What a hand that drags something costs, whatever the machine: bytes and rebuilt lists.
TEST_F(GpuSceneTest, ADragUploadsNoMoreThanWhatItChanges) {
    GpuScene scene(context());
    Document document = makeScene(makeSphere(8));
    document.nextId = 10;
    for (int i = 0; i < 20; ++i) {
        document.meshes.push_back(document.meshes[0]);
        document.meshes.back().id = document.takeId();
        Material material = document.materials[0];
        material.id = document.takeId();
        document.materials.push_back(material);
    }
    document.materials[0].baseColorMap.image = makeImage(
        64, 64, 3, PixelType::U8, ColorEncoding::Srgb, [](int, int, int) { return 0.5f; });
    document.lights.emplace_back().id = document.takeId();
    scene.update(document);
    const auto cost = [&](const std::function<void()>& edit) {
        const std::uint64_t bytes = gl::uploadedBytes(), rebuilds = scene.rebuilds(),
                            shapes = scene.shapeRevision();
        edit();
        scene.update(document);
        return std::tuple(gl::uploadedBytes() - bytes, scene.rebuilds() - rebuilds,
                          scene.shapeRevision() - shapes);
    };
    const auto free = std::tuple(0u, 0u, 0u);
    EXPECT_EQ(cost([] {}), free);
    const auto number = std::tuple(sizeof(MaterialBlock), 0u, 0u);
    static_assert(sizeof(MaterialBlock) < 1024);
    EXPECT_EQ(cost([&] { document.materials[0].metallic = 0.7f; }), number);
    EXPECT_EQ(cost([&] { document.materials[5].alphaCutoff = 0.7f; }), number);
    EXPECT_EQ(cost([&] { document.materials[0].name = "Another"; }), free);
    // Numbers that are read for each frame.
    EXPECT_EQ(cost([&] { document.lights[0].intensity = 7.0f; }), free);
    EXPECT_EQ(cost([&] { document.mix.fade = 0.3f; }), free);
    EXPECT_EQ(cost([&] { document.view.exposureEv = 1.0f; }), free);
    EXPECT_EQ(cost([&] { document.model.f90 = 0.5f; }), std::tuple(sizeof(ModelBlock), 0u, 0u));
    EXPECT_EQ(cost([&] {
                  document.meshes[3].placement.setPosition({1, 0, 0});
              }),
              std::tuple(sizeof(InstanceBlock), 1u, 1u))
        << "the other twenty stay where they are";
    // Live preview of a bake: its values, again and again.
    const std::vector<float> values(document.meshes[0].mesh->vertexCount(), 0.5f);
    EXPECT_EQ(cost([&] { scene.previewVertices(BakeKind::AoVertex, 1, 1, values); }),
              std::tuple(values.size() * sizeof(float), 0u, 0u));
    EXPECT_NE(scene.items()[0].visibility, nullptr);
    EXPECT_EQ(scene.items()[1].visibility, nullptr);
    EXPECT_EQ(cost([&] { scene.clearPreview(); }), free);
    EXPECT_EQ(scene.items()[0].visibility, nullptr);
}

TEST_F(GpuSceneTest, HalfFloatsAreLimitedAndCounted) {
    EnvironmentLight light(context());
    EXPECT_EQ(light.clampedTexels(), 0u);
    light.setIbl(uniformIbl(glm::vec3(1.0f, 70'000.0f, 2.0f)));
    EXPECT_EQ(light.clampedTexels(), 6u);
    light.setIbl(uniformIbl(glm::vec3(65'504.0f)));
    EXPECT_EQ(light.clampedTexels(), 0u);
}

TEST_F(GpuSceneTest, PackedIrradianceKeepsFourDigits) {
    std::array<glm::vec3, 9> coefficients;
    for (int i = 0; i < 9; ++i)
        coefficients[static_cast<std::size_t>(i)] =
            glm::vec3(3.0f - i, 0.37f * i * i, i % 2 == 0 ? 25.0f : -25.0f);
    FrameBlock frame;
    frame.radianceScale = glm::vec3(4.0f, 2.0f, 1.0f);
    packIrradiance(coefficients, frame);
    for (int k = 0; k < 27; ++k) { // as irradiancePair() in frame.glsl
        const std::uint32_t word = frame.irradianceSh[static_cast<std::size_t>(k / 8)][k / 2 % 4];
        const auto half = static_cast<std::int16_t>(k % 2 == 0 ? word >> 16 : word & 0xffffu);
        EXPECT_NEAR(frame.irradianceScale * half,
                    frame.radianceScale[k % 3] *
                        coefficients[static_cast<std::size_t>(k / 3)][k % 3],
                    4.0f * 25.0f * 1.6e-5f)
            << k;
    }
    packIrradiance({}, frame); // night
    EXPECT_EQ(frame.irradianceScale, 0.0f);
    EXPECT_EQ(frame.irradianceSh[0], glm::uvec4(0));
}

TEST_F(GpuSceneTest, APreparedEnvironmentFitsIntoSeventyMebibytes) {
    // Everything that stays of a 2048 × 1024 picture: itself, its maps, and their textures.
    const auto image =
        std::make_shared<const Image>(Image(2048, 1024, 3, PixelType::F32, ColorEncoding::Linear));
    const IblSettings settings;
    IblMaps maps;
    for (int i = 0; i < settings.levels; ++i) {
        const int side = levelSide(settings.spacing, i, settings.cubeSize);
        maps.prefiltered.push_back({side, std::vector<glm::vec3>(6u * side * side)});
    }
    const int side = settings.irradianceSize;
    maps.irradiance = {side, std::vector<glm::vec3>(6u * side * side)};
    EnvironmentLight light(context());
    const std::size_t before = light.memoryBytes();
    light.set(makeEnvironmentTexels(image, maps, *makeBackground(*image, JobContext())));
    const std::size_t picture = image->f32().size_bytes(), onGpu = light.memoryBytes();
    const std::size_t total = picture + onGpu;
    EXPECT_EQ(picture, std::size_t{24} << 20);
    EXPECT_GT(onGpu, before);
    // Half floats, and a third more for the background's mipmaps
    EXPECT_GE(onGpu, 2048u * 1024 * 8 * 4 / 3 + maps.prefiltered[0].texels.size() * 8);
    EXPECT_LE(total, std::size_t{70} << 20);
    // 2.5 times the 1548 × 620 texels of seven levels that halve, and the rows of the irradiance
    EXPECT_LE(light.prefiltered().memoryBytes(), 1548u * (620 * 5 / 2 + 260) * 8);
    RecordProperty("mebibytes", std::to_string(static_cast<double>(total) / (1 << 20)));
}

// The red of a texture's texels.
std::vector<float> reds(const gl::Texture& texture) {
    return texture.readFloats(1);
}

EnvironmentTexelsPtr environment(float brightness, int height = 16, float light = 0.0f) {
    const ImagePtr image =
        makeEnvironment(height, [&](const glm::vec3&) { return glm::vec3(brightness); });
    return std::make_shared<const EnvironmentTexels>(
        makeEnvironmentTexels(image, uniformIbl(glm::vec3(light > 0.0f ? light : brightness)),
                              *makeBackground(*image, JobContext())));
}

// What is seen is all of one environment, however small the pieces are it arrives in.
TEST_F(GpuSceneTest, AnEnvironmentArrivesInPiecesAndShowsAsAWhole) {
    EnvironmentLight light(context());
    const auto seen = [&] {
        FrameBlock frame;
        light.fill(frame);
        return glm::vec3(reds(light.prefiltered())[0], reds(light.background())[0],
                         light.transferLight({}, 1)[0].x / std::sqrt(4.0f * glm::pi<float>()));
    };
    const EnvironmentTexelsPtr first = environment(2.0f), second = environment(4.0f);
    light.begin(first);
    EXPECT_NEAR(glm::length(seen() - glm::vec3(0.5f)), 0.0f, 1e-5f) << "the grey sky";
    int pieces = 1;
    for (; !light.proceed(1); ++pieces)
        ASSERT_NEAR(glm::length(seen() - glm::vec3(0.5f)), 0.0f, 1e-5f) << pieces;
    // A row at a time: 1 × 1 texels of light in rows of their own, 16 + 8 + 4 + 2 + 1 + 1 of the
    // background.
    EXPECT_EQ(pieces, first->prefiltered.height + 32);
    EXPECT_NEAR(glm::length(seen() - glm::vec3(2.0f)), 0.0f, 1e-5f);
    EXPECT_TRUE(light.proceed(1)) << "nothing left to do";
    for (const float red : reds(light.background()))
        ASSERT_EQ(red, 2.0f);

    // The newest wins; nothing of the one it overtook is ever seen.
    light.begin(environment(3.0f));
    EXPECT_FALSE(light.proceed(1000));
    light.begin(second);
    while (!light.proceed(1000))
        ASSERT_NEAR(glm::length(seen() - glm::vec3(2.0f)), 0.0f, 1e-5f);
    EXPECT_NEAR(glm::length(seen() - glm::vec3(4.0f)), 0.0f, 1e-5f);
    for (const float red : reds(light.background()))
        ASSERT_EQ(red, 4.0f);
    EXPECT_EQ(light.memoryBytes(), [&] {
        EnvironmentLight other(context());
        other.set(*second);
        return other.memoryBytes();
    }()) << "what was passed over is gone";
}

// Finer light of the same picture: the picture is neither uploaded twice nor started again.
TEST_F(GpuSceneTest, BetterLightKeepsThePictureThatIsThere) {
    EnvironmentLight light(context());
    const EnvironmentTexelsPtr quick = environment(2.0f, 64);
    auto finer = std::make_shared<EnvironmentTexels>(
        makeEnvironmentTexels(quick->image, uniformIbl(glm::vec3(5.0f)), quick->background));
    light.begin(quick);
    EXPECT_FALSE(light.proceed(60'000)); // most of the 128 × 64 picture
    light.begin(finer);
    EXPECT_TRUE(light.proceed(60'000)) << "the rest of it, and the light";
    EXPECT_EQ(reds(light.prefiltered())[0], 5.0f);
    for (const float red : reds(light.background()))
        ASSERT_EQ(red, 2.0f);

    // A picture that is shown is not needed again at all.
    const unsigned texture = light.background().id();
    finer = std::make_shared<EnvironmentTexels>(
        makeEnvironmentTexels(quick->image, uniformIbl(glm::vec3(7.0f)), nullptr));
    light.begin(finer);
    EXPECT_TRUE(light.proceed(100'000));
    EXPECT_EQ(reds(light.prefiltered())[0], 7.0f);
    EXPECT_EQ(light.background().id(), texture);

    light.setIbl(uniformIbl(glm::vec3(1.0f)));
    EXPECT_EQ(light.background().id(), texture);
    EXPECT_EQ(reds(light.prefiltered())[0], 1.0f);
}

TEST_F(GpuSceneTest, PicturesTooLargeForATextureShowTheirFirstMipmapThatIsNot) {
    // Some drivers take all that an Image may be.
    const int limit = context().info().maxTextureSize;
    const int side = std::min(2 * limit, limits::kMaxImageSide);
    const auto texel = [](int x, int, int) { return x % 2 == 0 ? 1.0f : 3.0f; };
    const ImagePtr image = makeImage(side, 1, 3, PixelType::F32, ColorEncoding::Linear, texel);
    EnvironmentLight light(context());
    light.set(makeEnvironmentTexels(image, uniformIbl(glm::vec3(1.0f)),
                                    *makeBackground(*image, JobContext())));
    EXPECT_EQ(light.background().width(), std::min(side, limit));
    const std::vector<float> shown = reds(light.background());
    for (std::size_t x = 0; x < shown.size(); ++x)
        ASSERT_EQ(shown[x], side > limit ? 2.0f : texel(static_cast<int>(x), 0, 0)) << x;
}

// Every kind of image reads in the shader as Image::linear() says.
using Formats = RenderTest;

TEST_F(Formats, EveryImageReadsAsItsLinearValue) {
    Document document = makeScene(makePlane());
    document.view.camera = cameraAbove();
    Material& m = document.materials[0];
    m.baseColor = glm::vec3(0.0f);
    m.perceptualRoughness = 1.0f;
    m.emissive = glm::vec3(1.0f);
    const float values[6] = {0.2f, 0.5f, 0.8f, 0.6f, 0.1f, 0.9f};
    for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32})
        for (const ColorEncoding encoding :
             {ColorEncoding::Linear, ColorEncoding::Srgb, ColorEncoding::Data})
            for (const int channels : {1, 2, 3, 4, 6}) {
                if (type == PixelType::F32 && encoding == ColorEncoding::Srgb)
                    continue; // floating-point images are never encoded
                SCOPED_TRACE(fmt::format("type {} encoding {} channels {}", static_cast<int>(type),
                                         static_cast<int>(encoding), channels));
                m.emissiveMap.image = makeImage(3, 5, channels, type, encoding,
                                                [&](int, int, int c) { return values[c]; });
                const glm::vec3 seen(centerPixel(draw(document, 8)));
                // Beyond four channels (bake files) the first three are shown as a colour.
                glm::vec4 expected;
                if (channels <= 4)
                    expected = m.emissiveMap.image->linear(1, 1);
                else
                    expected = makeImage(1, 1, 4, type, encoding, [&](int, int, int c) {
                                   return values[c];
                               })->linear(0, 0);
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(seen[c], expected[c], 2e-3f) << "channel " << c;
            }
}

TEST_F(Formats, EveryChannelCanBeChosen) {
    Document document = makeScene(makePlane());
    document.view.camera = cameraAbove();
    Material& m = document.materials[0];
    m.baseColor = glm::vec3(0.0f);
    m.emissive = glm::vec3(1.0f);
    m.emissiveMap.image =
        makeImage(2, 2, 4, PixelType::U8, ColorEncoding::Data,
                  [](int, int, int c) { return 0.2f * static_cast<float>(c + 1); });
    const MapChannel channels[] = {MapChannel::R, MapChannel::G, MapChannel::B, MapChannel::A};
    for (int c = 0; c < 4; ++c) {
        m.emissiveMap.channel = channels[c];
        const glm::vec3 seen(centerPixel(draw(document, 8)));
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(seen[k], 0.2f * static_cast<float>(c + 1), 2e-3f) << c;
    }
}

} // namespace
} // namespace patina::render
