// The surface against what can be worked out by hand.
#include "core/document/ViewChoices.h"
#include "core/light/Cubemap.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/math/Shading.h"
#include "render/scene/EnvironmentLight.h"
#include "tests/render/RenderTest.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

namespace patina::render {
namespace {

using Surface = RenderTest;

Material& materialOf(Document& document) {
    return document.materials.front();
}

// Bilinear lookup in the table the renderer uses.
glm::vec2 dfgAt(float NoV, float perceptualRoughness) {
    static const Image table =
        computeDfgTable(128, Distribution::GGX, Visibility::SmithCorrelated, DfgTexels::ToTheEnds);
    const float x = NoV * 127.0f, y = perceptualRoughness * 127.0f;
    const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
    const int x1 = std::min(x0 + 1, table.width() - 1), y1 = std::min(y0 + 1, table.height() - 1);
    const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
    const auto texel = [&](int i, int j) { return glm::vec2(pixel(table, i, j)); };
    return glm::mix(glm::mix(texel(x0, y0), texel(x1, y0), fx),
                    glm::mix(texel(x0, y1), texel(x1, y1), fx), fy);
}

// What the surface of `material` reflects of a directional light, seen from +Y on the plane.
glm::vec3 reflectedOfLight(const Material& m, const glm::vec3& n, const glm::vec3& l, float E) {
    const glm::vec3 v(0, 1, 0);
    const float NoV = std::max(glm::dot(n, v), shading::kMinNoV);
    const auto s =
        shading::makeSurface(shading::defaultBrdfModel(),
                             {m.baseColor, m.metallic, m.perceptualRoughness, m.diffuseRoughness},
                             n, v, dfgAt(NoV, m.perceptualRoughness));
    const auto shaded = shading::shadeDirect(s, l, glm::vec3(E));
    return shaded.diffuse + shaded.specular;
}

Light directional(float azimuthDeg, float elevationDeg, float intensity) {
    Light light;
    light.id = 7;
    light.azimuthDeg = azimuthDeg;
    light.elevationDeg = elevationDeg;
    light.intensity = intensity;
    return light;
}

Document planeSeenFromAbove() {
    Document document = makeScene(makePlane());
    document.view.camera = cameraAbove();
    return document;
}

// Radiance 1 + 0.9 y in every level: the picture tells in which direction it was looked up.
IblMaps slopingIbl() {
    IblMaps maps = uniformIbl(glm::vec3(1.0f));
    maps.prefiltered.clear();
    for (const int size : {64, 64}) {
        CubeLevel level{size, {}};
        for (int i = 0; i < 6 * size * size; ++i) {
            const auto centre = [&](int k) {
                return (static_cast<float>(k % size) + 0.5f) / static_cast<float>(size);
            };
            const glm::vec3 d =
                glm::normalize(cubeDirection(i / (size * size), centre(i), centre(i / size)));
            level.texels.emplace_back(1.0f + 0.9f * d.y);
        }
        maps.prefiltered.push_back(level);
    }
    return maps;
}

TEST_F(Surface, WhiteDielectricInAWhiteFurnaceDisappears) {
    setBackground(makeEnvironment(8, [](auto) { return glm::vec3(1.0f); }),
                  uniformIbl(glm::vec3(1.0f)));
    for (const float perceptualRoughness : {0.0f, 0.3f, 1.0f}) {
        Document document = makeScene(makeSphere());
        materialOf(document).baseColor = glm::vec3(1.0f);
        materialOf(document).perceptualRoughness = perceptualRoughness;
        document.view.background = BackgroundMode::Environment;
        const Image image = draw(document);
        float low = 10.0f, high = 0.0f;
        for (const float value : image.f32()) {
            low = std::min(low, value);
            high = std::max(high, value);
        }
        EXPECT_NEAR(low, 1.0f, 1e-2f) << perceptualRoughness;
        EXPECT_NEAR(high, 1.0f, 1e-2f) << perceptualRoughness;
    }
}

TEST_F(Surface, MetalInAWhiteFurnaceShowsItsDfgAlbedo) {
    sceneRenderer().setIbl(uniformIbl(glm::vec3(1.0f)));
    for (const float perceptualRoughness : {0.1f, 0.5f, 0.9f}) {
        Document document = makeScene(makeSphere());
        Material& m = materialOf(document);
        m.metallic = 1.0f;
        m.baseColor = {1.0f, 0.6f, 0.2f};
        m.perceptualRoughness = perceptualRoughness;
        const glm::vec3 seen(centerPixel(draw(document, 65)));
        const glm::vec3 expected = shading::specularAlbedo(shading::defaultBrdfModel(), m.baseColor,
                                                           1.0f, dfgAt(1.0f, perceptualRoughness));
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(seen[c], expected[c], 3e-3f) << perceptualRoughness << " channel " << c;
    }
}

TEST_F(Surface, MetalReflectsWhatItsLobeLooksAt) {
    sceneRenderer().setIbl(slopingIbl());
    Document document = planeSeenFromAbove();
    document.view.camera.pitchDeg = 20.0f;
    document.view.camera.fovDeg = 1.0f;
    Material& m = materialOf(document);
    m.metallic = 1.0f;
    m.baseColor = glm::vec3(1.0f);
    const float NoV = std::sin(glm::radians(20.0f));
    for (const float perceptualRoughness : {0.1f, 0.5f, 0.9f}) {
        m.perceptualRoughness = perceptualRoughness;
        const auto expected = [&](double tilt) { // 1 + 0.9 y of normalize(mix(n, R, tilt))
            const double y = 1.0 - tilt + tilt * NoV;
            return 1.0 + 0.9 * y / std::hypot(y, tilt * std::sqrt(1.0 - NoV * NoV));
        };
        document.model.lobeDirection = LobeDirection::Mean;
        EXPECT_NEAR(centerPixel(draw(document)).x,
                    expected(integrateDfg(NoV, perceptualRoughness).z), 5e-3)
            << perceptualRoughness;
        document.model.lobeDirection = LobeDirection::Mirror;
        EXPECT_NEAR(centerPixel(draw(document)).x, expected(1.0), 5e-3) << perceptualRoughness;
    }
}

TEST_F(Surface, ClearGlassInAWhiteFurnaceDisappears) {
    setBackground(makeEnvironment(8, [](auto) { return glm::vec3(1.0f); }),
                  uniformIbl(glm::vec3(1.0f)));
    for (const bool thinWalled : {true, false})
        for (const float perceptualRoughness : {0.0f, 0.6f}) {
            Document document = makeScene(makeSphere());
            Material& m = materialOf(document);
            m.baseColor = glm::vec3(1.0f);
            m.perceptualRoughness = perceptualRoughness;
            m.transmission = 0.7f;
            m.thinWalled = thinWalled;
            m.ior = 1.8f;
            document.view.background = BackgroundMode::Environment;
            const Image image = draw(document);
            for (const float value : image.f32())
                ASSERT_NEAR(value, 1.0f, 1e-2f) << perceptualRoughness;
        }
}

// Straight on through a wall; through a body bent at both faces of a ball, 2 (i - t) in all.
TEST_F(Surface, GlassShowsTheEnvironmentBehindIt) {
    sceneRenderer().setIbl(slopingIbl());
    Document document = planeSeenFromAbove();
    document.view.camera.pitchDeg = 20.0f;
    document.view.camera.fovDeg = 1.0f;
    Material& m = materialOf(document);
    m.baseColor = {1.0f, 0.5f, 0.25f};
    m.perceptualRoughness = 0.0f;
    m.transmission = 1.0f;
    const float NoV = std::sin(glm::radians(20.0f));
    const float layer = shading::specularAlbedo(shading::defaultBrdfModel(), glm::vec3(0.04f), 0.0f,
                                                dfgAt(NoV, 0.0f))
                            .x;
    const float entering = std::acos(NoV), inside = std::asin(std::sin(entering) / 1.5f);
    for (const bool thinWalled : {true, false}) {
        m.thinWalled = thinWalled;
        const float below = glm::radians(20.0f) + (thinWalled ? 0.0f : 2.0f * (entering - inside));
        const glm::vec3 seen(centerPixel(draw(document)));
        for (int c = 0; c < 3; ++c) {
            const float tint = thinWalled ? m.baseColor[c] : m.baseColor[c] * m.baseColor[c];
            EXPECT_NEAR(seen[c],
                        layer * (1.0f + 0.9f * NoV) +
                            (1.0f - layer) * tint * (1.0f - 0.9f * std::sin(below)),
                        6e-3f)
                << thinWalled << " channel " << c;
        }
    }
}

TEST_F(Surface, LambertPlaneReflectsAlbedoOverPiTimesECosine) {
    const float albedo = 0.5f, E = 4.0f, elevation = 30.0f;
    Document document = planeSeenFromAbove();
    Material& m = materialOf(document);
    m.baseColor = glm::vec3(albedo);
    m.perceptualRoughness = 1.0f;
    document.lights = {directional(75.0f, elevation, E)};
    const glm::vec3 seen(centerPixel(draw(document)));

    // Diffuse: what the specular layer leaves of the albedo; cos of the angle to +Y is sin 30° = ½.
    const glm::vec3 l = document.lights[0].directionToLight();
    EXPECT_NEAR(l.y, 0.5f, 1e-6f);
    const float layer = shading::specularAlbedo(shading::defaultBrdfModel(), glm::vec3(0.04f), 0.0f,
                                                dfgAt(1.0f, 1.0f))
                            .x;
    const float diffuse = albedo * (1.0f - layer) / glm::pi<float>() * E * 0.5f;
    EXPECT_NEAR(seen.x, reflectedOfLight(m, {0, 1, 0}, l, E).x, 2e-3f * seen.x);
    EXPECT_GT(seen.x, diffuse);
    EXPECT_LT(seen.x, 1.05f * diffuse); // the specular lobe of roughness 1 adds little here
}

TEST_F(Surface, PointLightFallsOffWithTheSquareOfTheDistance) {
    Document document = planeSeenFromAbove();
    Light light;
    light.id = 7;
    light.type = LightType::Point;
    light.intensity = 5.0f;
    light.position = {0, 1, 0};
    document.lights = {light};
    const float near = centerPixel(draw(document)).x;
    document.lights[0].position.y = 2.0f;
    const float far = centerPixel(draw(document)).x;
    EXPECT_NEAR(near / far, 4.0f, 0.01f);
    EXPECT_NEAR(near, reflectedOfLight(materialOf(document), {0, 1, 0}, {0, 1, 0}, 5.0f).x,
                2e-3f * near);
    document.lights[0].enabled = false;
    EXPECT_EQ(centerPixel(draw(document)).x, 0.0f);
}

TEST_F(Surface, NormalMapFollowsTheConventionItIsToldToHave) {
    // A map that leans towards image up (green 0.8); a light from -Z, image up on the plane.
    const float lean = 0.8f;
    Document document = planeSeenFromAbove();
    Material& m = materialOf(document);
    m.perceptualRoughness = 1.0f;
    m.normalMap.image =
        makeImage(2, 2, 3, PixelType::F32, ColorEncoding::Data, [&](int, int, int c) {
            return c == 0 ? 0.5f : c == 1 ? lean : 0.5f + 0.5f * std::sqrt(1.0f - 0.36f);
        });
    document.lights = {directional(180.0f, 45.0f, 1.0f)};
    const glm::vec3 l = document.lights[0].directionToLight();
    EXPECT_NEAR(l.z, -std::sqrt(0.5f), 1e-5f);

    const glm::vec3 up = glm::normalize(glm::vec3(0.0f, 0.8f, -0.6f));
    const glm::vec3 down = glm::normalize(glm::vec3(0.0f, 0.8f, 0.6f));
    const float openGl = centerPixel(draw(document)).x;
    m.normalConvention = NormalConvention::DirectX;
    const float directX = centerPixel(draw(document)).x;
    EXPECT_NEAR(openGl, reflectedOfLight(m, up, l, 1.0f).x, 3e-3f * openGl);
    EXPECT_NEAR(directX, reflectedOfLight(m, down, l, 1.0f).x, 3e-3f * openGl);
    EXPECT_GT(openGl, 2.0f * directX);

    // Turned by 90°, image up of the map lies along the tangent: (uv' = R uv) gives -X or +X.
    m.normalConvention = NormalConvention::OpenGl;
    m.normalMap.uvRotationDeg = 90.0f;
    document.lights = {directional(90.0f, 45.0f, 1.0f)}; // from +X
    EXPECT_NEAR(document.lights[0].directionToLight().x, std::sqrt(0.5f), 1e-5f);
    const float turned = centerPixel(draw(document)).x;
    EXPECT_NEAR(turned, openGl, 3e-3f * openGl);

    // A mirrored instance shows the same relief: its tangent space is mirrored with it.
    m.normalMap.uvRotationDeg = 0.0f;
    document.lights = {directional(180.0f, 45.0f, 1.0f)};
    document.meshes[0].placement = glm::scale(glm::mat4(1.0f), glm::vec3(-1, 1, 1));
    EXPECT_NEAR(centerPixel(draw(document)).x, openGl, 3e-3f * openGl);

    m.normalStrength = 0.0f;
    EXPECT_NEAR(centerPixel(draw(document)).x, reflectedOfLight(m, {0, 1, 0}, l, 1.0f).x,
                3e-3f * openGl);
}

TEST_F(Surface, MapsMultiplyTheirNumbersThroughTheirChannel) {
    sceneRenderer().setIbl(uniformIbl(glm::vec3(1.0f)));
    Document document = planeSeenFromAbove();
    Material& m = materialOf(document);
    m.baseColor = {0.9f, 0.8f, 0.7f};
    m.metallic = 0.8f;
    m.perceptualRoughness = 0.9f;
    // Occlusion, roughness, metallic in one image, as in glTF.
    const ImagePtr orm =
        makeImage(2, 2, 3, PixelType::U8, ColorEncoding::Data, [](int, int, int c) {
            return c == 0 ? 1.0f : c == 1 ? 0.4f : 0.6f;
        });
    m.metallicMap.image = m.perceptualRoughnessMap.image = orm;
    m.metallicMap.channel = MapChannel::B;
    m.perceptualRoughnessMap.channel = MapChannel::G;
    m.baseColorMap.image =
        makeImage(2, 2, 3, PixelType::U8, ColorEncoding::Srgb,
                  [](int, int, int c) { return c == 1 ? 188.0f / 255.0f : 1.0f; });
    const auto expected = [&](float metallic, float perceptualRoughness, const glm::vec3& color) {
        const auto s = shading::makeSurface(shading::defaultBrdfModel(),
                                            {color, metallic, perceptualRoughness, 0.0f}, {0, 1, 0},
                                            {0, 1, 0}, dfgAt(1.0f, perceptualRoughness));
        const auto light =
            shading::shadeEnvironment(s, glm::vec3(glm::pi<float>()), glm::vec3(1.0f));
        return light.diffuse + light.specular;
    };
    const glm::vec3 color =
        m.baseColor * glm::vec3(1.0f, shading::srgbDecode(188.0f / 255.0f), 1.0f);
    const auto check = [&](const glm::vec3& want, const char* what) {
        const glm::vec3 seen(centerPixel(draw(document)));
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(seen[c], want[c], 3e-3f) << what << ", channel " << c;
    };
    check(expected(0.8f * 0.6f, 0.9f * 0.4f, color), "packed");

    // The same through separate images, one of them 16-bit, one grey.
    m.metallicMap.image =
        makeImage(2, 2, 1, PixelType::U16, ColorEncoding::Data, [](int, int, int) { return 0.6f; });
    m.metallicMap.channel = MapChannel::Rgb;
    check(expected(0.8f * 0.6f, 0.9f * 0.4f, color), "separate");

    m.emissive = {0.5f, 0.25f, 0.0f};
    m.emissiveStrength = 3.0f;
    check(expected(0.8f * 0.6f, 0.9f * 0.4f, color) + 3.0f * m.emissive, "emissive");
}

TEST_F(Surface, TextureTransformMovesTheImageAsGltfSays) {
    // KHR_texture_transform's example: offset (0, 1), rotation 90°, scale ½ shows the lower left
    // quadrant. Each quadrant has its own colour.
    Document document = planeSeenFromAbove();
    Material& m = materialOf(document);
    m.emissive = glm::vec3(1.0f);
    m.baseColor = glm::vec3(0.0f);
    m.emissiveMap.image =
        makeImage(64, 64, 3, PixelType::U8, ColorEncoding::Data, [](int x, int y, int c) {
            const int quadrant = (x < 32 ? 0 : 1) + (y < 32 ? 0 : 2); // 2: lower left
            return quadrant == 3 ? 1.0f : quadrant == c ? 1.0f : 0.0f;
        });
    const auto at = [&](float u, float v) { // of the plane
        const Image image = draw(document, 64);
        // The plane spans 2 m, the view 2 · 5 · tan(10°) = 1.763 m.
        const float half = 5.0f * std::tan(glm::radians(10.0f));
        const auto coordinate = [&](float t) {
            return static_cast<int>(32.0f + 32.0f * (2.0f * t - 1.0f) / half);
        };
        return glm::vec3(pixel(image, coordinate(u), coordinate(v)));
    };
    EXPECT_EQ(at(0.25f, 0.25f), glm::vec3(1, 0, 0)); // upright: upper left is red
    EXPECT_EQ(at(0.75f, 0.25f), glm::vec3(0, 1, 0));
    EXPECT_EQ(at(0.25f, 0.75f), glm::vec3(0, 0, 1));
    EXPECT_EQ(at(0.75f, 0.75f), glm::vec3(1, 1, 1));

    m.emissiveMap.uvScale = glm::vec2(0.5f);
    EXPECT_EQ(at(0.75f, 0.75f), glm::vec3(1, 0, 0));
    m.emissiveMap.uvOffset = {0.0f, 1.0f};
    m.emissiveMap.uvRotationDeg = 90.0f;
    for (const float u : {0.2f, 0.8f})
        for (const float v : {0.2f, 0.8f})
            EXPECT_EQ(at(u, v), glm::vec3(0, 0, 1)) << u << ' ' << v;
}

TEST_F(Surface, MissingMapIsVisible) {
    sceneRenderer().setIbl(uniformIbl(glm::vec3(1.0f)));
    Document document = planeSeenFromAbove();
    materialOf(document).baseColorMap.source = "/nowhere/color.png";
    materialOf(document).baseColorMap.problem = "not found";
    const Image image = draw(document, 64);
    int magenta = 0, black = 0;
    for (int y = 16; y < 48; ++y)
        for (int x = 16; x < 48; ++x) {
            const glm::vec4 p = pixel(image, x, y);
            magenta += p.x > 0.8f && p.y < 0.2f && p.z > 0.8f ? 1 : 0;
            black += p.x < 0.2f && p.y < 0.2f && p.z < 0.2f ? 1 : 0;
        }
    EXPECT_GT(magenta, 300);
    EXPECT_GT(black, 300);
}

// Numbers that are missing are the material's factors; the base colour that is there stays as it
// is.
TEST_F(Surface, MissingDataMapsFallBackToTheirFactors) {
    sceneRenderer().setIbl(uniformIbl(glm::vec3(1.0f)));
    Document document = planeSeenFromAbove();
    const Image whole = draw(document, 32);
    Material& m = materialOf(document);
    for (MapSlot* map : {&m.metallicMap, &m.perceptualRoughnessMap, &m.normalMap, &m.occlusionMap,
                         &m.emissiveMap}) {
        map->source = "/nowhere/data.png";
        map->problem = "not found";
        const Image without = draw(document, 32);
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 32; ++x)
                ASSERT_EQ(pixel(without, x, y), pixel(whole, x, y)) << x << ' ' << y;
        *map = {};
    }
}

TEST_F(Surface, AlphaModesCutAndBlend) {
    Document document = planeSeenFromAbove();
    Material& m = materialOf(document);
    m.emissive = glm::vec3(2.0f);
    m.baseColor = glm::vec3(0.0f);
    m.opacity = 0.25f;
    document.view.backgroundColor = {0.0f, 1.0f, 0.0f};
    m.alphaMode = AlphaMode::Opaque;
    EXPECT_NEAR(centerPixel(draw(document)).x, 2.0f, 1e-3f);
    m.alphaMode = AlphaMode::Mask;
    m.alphaCutoff = 0.5f;
    EXPECT_EQ(glm::vec3(centerPixel(draw(document))), glm::vec3(0, 1, 0));
    m.alphaCutoff = 0.2f;
    EXPECT_NEAR(centerPixel(draw(document)).x, 2.0f, 1e-3f);
    m.alphaMode = AlphaMode::Blend;
    const glm::vec4 blended = centerPixel(draw(document));
    EXPECT_NEAR(blended.x, 0.25f * 2.0f, 1e-3f);
    EXPECT_NEAR(blended.y, 0.25f * 2.0f + 0.75f, 2e-3f);

    // Over nothing: the alpha itself, colour premultiplied; straight in the displayed picture.
    document.view.camera.distance = 10.0f; // leaves room beside the plane
    FrameSettings settings;
    settings.transparentBackground = true;
    document.view.toneMap = ToneMap::Clamp;
    const glm::vec4 over = centerPixel(draw(document, 64, settings));
    EXPECT_NEAR(over.w, 0.25f, 1e-3f);
    EXPECT_NEAR(over.y, 0.5f, 1e-3f);
    const Image displayed = renderer().readDisplayed();
    EXPECT_NEAR(centerPixel(displayed).w, 0.25f, 0.5f / 255.0f);
    EXPECT_EQ(centerPixel(displayed).x, 1.0f);
    EXPECT_EQ(pixel(displayed, 0, 0), glm::vec4(0.0f)); // beside the plane
}

TEST_F(Surface, BackFacesShowOnlyWhenDoubleSided) {
    Document document = planeSeenFromAbove();
    document.meshes[0].placement =
        glm::rotate(glm::mat4(1.0f), glm::pi<float>(), glm::vec3(1, 0, 0)); // faces -Y now
    document.lights = {directional(0.0f, 90.0f, 2.0f)};
    EXPECT_EQ(centerPixel(draw(document)).x, 0.0f);
    Material& m = materialOf(document);
    m.doubleSided = true;
    const float seen = centerPixel(draw(document)).x;
    EXPECT_NEAR(seen, reflectedOfLight(m, {0, 1, 0}, {0, 1, 0}, 2.0f).x, 3e-3f * seen);

    // A mirror image of a front face stays a front face.
    m.doubleSided = false;
    document.meshes[0].placement = glm::scale(glm::mat4(1.0f), glm::vec3(1, 1, -1));
    EXPECT_NEAR(centerPixel(draw(document)).x, seen, 1e-4f);
}

TEST_F(Surface, ExposureAndEnvironmentExposureDouble) {
    sceneRenderer().setIbl(uniformIbl(glm::vec3(0.1f)));
    Document document = planeSeenFromAbove();
    document.view.toneMap = ToneMap::Clamp;
    const float before = centerPixel(draw(document)).x;
    const auto displayedLinear = [&] {
        return shading::srgbDecode(centerPixel(renderer().readDisplayed()).x);
    };
    const float displayedBefore = displayedLinear();
    document.view.exposureEv = 1.0f;
    EXPECT_EQ(centerPixel(draw(document)).x, before) << "exposure belongs to the display";
    EXPECT_NEAR(displayedLinear() / displayedBefore, 2.0f, 0.05f);
    document.environment().exposureEv = 1.0f;
    EXPECT_NEAR(centerPixel(draw(document)).x, 2.0f * before, 1e-3f * before);
    // Reinhard of a grey: L / (1 + L).
    document.view.toneMap = ToneMap::Reinhard;
    const float L = 2.0f * centerPixel(draw(document)).x;
    EXPECT_NEAR(displayedLinear(), L / (1.0f + L), 0.005f);
}

} // namespace
} // namespace patina::render
