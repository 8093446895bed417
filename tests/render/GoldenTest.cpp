// Whole pictures. Their scenes are made here, so that nothing but the renderer can change them.
#include "tests/render/Golden.h"
#include "core/document/ViewChoices.h"
#include "core/light/Light.h"
#include "core/light/Lights.h"
#include "core/material/Material.h"
#include "tests/render/RenderTest.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

namespace patina::render {
namespace {

constexpr int kSize = 256;

class Golden : public RenderTest {
  protected:
    // Draws with image-based light of the document's environment and compares what is displayed.
    void expectPicture(const Document& document, const std::string& name,
                       const FrameSettings& settings = {}) {
        setIblOf(document);
        draw(document, kSize, settings);
        expectGolden(renderer().readDisplayed(), name);
    }
};

// A day: blue above, brown below, a sun and a window-like soft box.
ImagePtr daylight() {
    return makeEnvironment(128, [](const glm::vec3& d) {
        const glm::vec3 sky = glm::mix(glm::vec3(0.75f, 0.85f, 1.0f), glm::vec3(0.2f, 0.4f, 0.9f),
                                       std::max(d.y, 0.0f));
        glm::vec3 radiance = d.y > 0.0f ? sky : glm::vec3(0.18f, 0.14f, 0.1f);
        if (glm::dot(d, glm::normalize(glm::vec3(0.6f, 0.7f, 0.5f))) > 0.985f)
            radiance = glm::vec3(40.0f, 36.0f, 28.0f);
        if (d.x < -0.7f && std::abs(d.y - 0.2f) < 0.3f && std::abs(d.z) < 0.35f)
            radiance = glm::vec3(3.0f);
        return radiance;
    });
}

Document daylightScene(const MeshPtr& mesh) {
    Document document = makeScene(mesh);
    document.environment().image = daylight();
    document.view.background = BackgroundMode::Blurred;
    return document;
}

// A second, third … object beside the first, with a material of its own.
Material& addObject(Document& document, const MeshPtr& mesh, const glm::mat4& transform) {
    MeshInstance instance;
    instance.id = document.takeId();
    instance.mesh = mesh;
    instance.placement = transform;
    Material material;
    material.id = instance.material = document.takeId();
    document.meshes.push_back(instance);
    document.materials.push_back(material);
    return document.materials.back();
}

glm::mat4 at(float x, float y, float z = 0.0f, float scale = 1.0f) {
    return glm::scale(glm::translate(glm::mat4(1.0f), glm::vec3(x, y, z)), glm::vec3(scale));
}

TEST_F(Golden, MetalAndRoughness) {
    Document document = daylightScene(makeSphere());
    document.meshes.clear();
    document.materials.clear();
    const MeshPtr sphere = makeSphere();
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) {
            Material& m = addObject(document, sphere,
                                    at(1.1f * static_cast<float>(column - 1),
                                       1.1f * static_cast<float>(1 - row), 0.0f, 0.5f));
            m.baseColor = {0.95f, 0.64f, 0.54f};
            m.metallic = 0.5f * static_cast<float>(row);
            m.perceptualRoughness = 0.05f + 0.4f * static_cast<float>(column);
        }
    document.view.camera.distance = 6.8f;
    expectPicture(document, "metal-and-roughness");
}

TEST_F(Golden, MapsAndLights) {
    Document document = daylightScene(makeSphere());
    document.environment().exposureEv = -2.0f;
    Material& m = document.materials[0];
    m.baseColor = glm::vec3(1.0f);
    m.baseColorMap.image =
        makeImage(128, 64, 3, PixelType::U8, ColorEncoding::Srgb, [](int x, int y, int c) {
            return ((x / 8 + y / 8) % 2 == 0) == (c == 0) ? 0.85f : 0.25f;
        });
    m.baseColorMap.uvScale = {2.0f, 2.0f};
    m.baseColorMap.uvRotationDeg = 30.0f;
    m.metallic = 1.0f;
    m.perceptualRoughness = 1.0f;
    const ImagePtr orm =
        makeImage(64, 64, 3, PixelType::U8, ColorEncoding::Data, [](int x, int y, int c) {
            return c == 0   ? 0.4f + 0.6f * static_cast<float>(y % 16) / 15.0f
                   : c == 1 ? 0.2f + 0.6f * static_cast<float>(x) / 63.0f
                            : (y / 16 % 2 == 0 ? 1.0f : 0.0f);
        });
    for (auto [slot, channel] : {std::pair{&m.occlusionMap, MapChannel::R},
                                 {&m.perceptualRoughnessMap, MapChannel::G},
                                 {&m.metallicMap, MapChannel::B}}) {
        slot->image = orm;
        slot->channel = channel;
    }
    m.normalMap.image =
        makeImage(128, 128, 3, PixelType::U16, ColorEncoding::Data, [](int x, int y, int c) {
            const float a = glm::radians(360.0f * static_cast<float>(x) / 16.0f);
            const float b = glm::radians(360.0f * static_cast<float>(y) / 16.0f);
            return c == 0   ? 0.5f + 0.2f * std::cos(a)
                   : c == 1 ? 0.5f - 0.2f * std::cos(b)
                            : 0.5f + 0.5f * std::sqrt(1.0f - 0.16f * (std::cos(a) * std::cos(a) +
                                                                      std::cos(b) * std::cos(b)));
        });
    Light sun;
    sun.azimuthDeg = 50.0f;
    Light lamp;
    lamp.type = LightType::Point;
    lamp.position = {-1.6f, 0.2f, 1.4f};
    lamp.color = {0.3f, 0.6f, 1.0f};
    lamp.intensity = 6.0f;
    document.lights = {sun, lamp};
    expectPicture(document, "maps-and-lights");
}

TEST_F(Golden, TurnedSkyInAMirror) {
    Document document = daylightScene(makeSphere());
    document.view.background = BackgroundMode::Environment;
    document.environment().rotationDeg = 120.0f;
    document.materials[0].metallic = 1.0f;
    document.materials[0].baseColor = glm::vec3(1.0f);
    document.materials[0].perceptualRoughness = 0.0f;
    document.view.camera.fovDeg = 60.0f;
    document.view.camera.distance = 3.0f;
    expectPicture(document, "turned-sky-in-a-mirror");
}

TEST_F(Golden, BlendMaskAndBothSides) {
    Document document = daylightScene(makeSphere());
    document.materials[0].baseColor = {0.9f, 0.3f, 0.1f};
    const glm::mat4 upright =
        glm::rotate(glm::mat4(1.0f), glm::half_pi<float>(), glm::vec3(1, 0, 0));
    Material& glass = addObject(document, makePlane(), at(-0.5f, 0.3f, 1.2f, 0.8f) * upright);
    glass.alphaMode = AlphaMode::Blend;
    glass.opacity = 0.4f;
    glass.baseColor = {0.1f, 0.7f, 0.3f};
    Material& fence =
        addObject(document, makePlane(),
                  at(0.7f, -0.4f, 1.3f, 0.6f) * glm::rotate(upright, 2.5f, glm::vec3(0, 0, 1)) *
                      glm::rotate(glm::mat4(1.0f), 3.0f, glm::vec3(1, 0, 0)));
    fence.alphaMode = AlphaMode::Mask;
    fence.doubleSided = true;
    fence.baseColor = glm::vec3(0.8f);
    fence.baseColorMap.image =
        makeImage(64, 64, 4, PixelType::U8, ColorEncoding::Srgb, [](int x, int y, int c) {
            return c < 3 ? 0.9f : (x % 16 < 6 || y % 16 < 6 ? 1.0f : 0.0f);
        });
    expectPicture(document, "blend-mask-and-both-sides");
}

TEST_F(Golden, Overlays) {
    Document document = daylightScene(makeSphere());
    document.meshes[0].placement = at(0.0f, 1.0f);
    document.materials[0].baseColor = {0.2f, 0.3f, 0.6f};
    Light sun;
    sun.azimuthDeg = 70.0f;
    Light lamp;
    lamp.type = LightType::Point;
    lamp.position = {-1.7f, 1.8f, 0.5f};
    lamp.color = {1.0f, 0.7f, 0.3f};
    document.lights = {sun, lamp};
    document.view.camera.pitchDeg = 20.0f;
    document.view.camera.yawDeg = 25.0f;
    document.view.camera.distance = 9.0f;
    document.view.camera.target = {0.0f, 0.8f, 0.0f};
    FrameSettings settings;
    settings.showOverlays = true;
    settings.selectedMesh = 1;
    expectPicture(document, "overlays", settings);
}

// Two bodies on a ground, under little other light.
Document stage() {
    Document document = daylightScene(makeSphere());
    document.environment().exposureEv = -4.0f;
    document.meshes[0].placement = at(-0.7f, 0.5f, 0.0f, 0.5f);
    document.materials[0].metallic = 1.0f;
    document.materials[0].baseColor = {0.95f, 0.9f, 0.85f};
    document.materials[0].perceptualRoughness = 0.3f;
    addObject(document, makeSphere(), at(0.7f, 0.5f, -0.2f, 0.5f)).perceptualRoughness = 0.8f;
    Material& ground = addObject(document, makePlane(), at(0.0f, 0.0f, 0.0f, 3.0f));
    ground.baseColor = glm::vec3(0.5f);
    ground.perceptualRoughness = 0.35f;
    document.view.camera.pitchDeg = 22.0f;
    document.view.camera.yawDeg = 10.0f;
    document.view.camera.distance = 8.0f;
    document.view.camera.target = {0.0f, 0.5f, 0.0f};
    return document;
}

Light lightAt(Document& document, LightType type, const glm::vec3& position, float intensity) {
    Light light;
    light.id = document.takeId();
    light.type = type;
    light.position = position;
    light.intensity = intensity;
    setDirectionToLight(light, position - glm::vec3(0.0f, 0.4f, 0.0f));
    return light;
}

TEST_F(Golden, AreaLights) {
    Document document = stage();
    Light panel = lightAt(document, LightType::Rectangle, {-1.8f, 1.4f, 0.6f}, 8.0f);
    panel.color = {1.0f, 0.7f, 0.4f};
    panel.height = 0.6f;
    panel.rollDeg = 20.0f;
    Light ball = lightAt(document, LightType::Sphere, {0.1f, 1.2f, 1.0f}, 12.0f);
    ball.color = {0.5f, 0.7f, 1.0f};
    document.lights = {panel, ball};
    expectPicture(document, "area-lights");
}

TEST_F(Golden, SoftShadows) {
    Document document = stage();
    Light sun = lightAt(document, LightType::Directional, {2.0f, 2.2f, 1.5f}, 2.0f);
    sun.shadowSoftness = 4.0f;
    Light spot = lightAt(document, LightType::Spot, {-2.2f, 2.6f, 1.8f}, 30.0f);
    spot.usesTemperature = true;
    spot.temperatureK = 3000.0f;
    spot.shadowSoftness = 0.5f;
    document.lights = {sun, spot};
    expectPicture(document, "soft-shadows");
}

TEST_F(Golden, HandlesOfLights) {
    Document document = stage();
    Light spot = lightAt(document, LightType::Spot, {-1.2f, 2.4f, 1.0f}, 12.0f);
    Light ball = lightAt(document, LightType::Sphere, {1.8f, 1.4f, 0.4f}, 6.0f);
    Light panel = lightAt(document, LightType::Rectangle, {0.6f, 1.9f, -0.8f}, 6.0f);
    Light off = lightAt(document, LightType::Point, {-2.2f, 0.8f, 0.0f}, 6.0f);
    off.enabled = false;
    document.lights = {spot, ball, panel, off};
    document.view.camera.distance = 11.0f;
    FrameSettings settings;
    settings.showOverlays = true;
    settings.selectedLight = spot.id;
    expectPicture(document, "handles-of-lights", settings);
}

TEST_F(Golden, MissingMaps) {
    Document document = daylightScene(makeSphere());
    document.meshes[0].placement = at(-1.1f, 0.0f);
    document.materials[0].baseColorMap.source = "/missing/color.png";
    Material& m = addObject(document, makeSphere(), at(1.1f, 0.0f));
    m.baseColor = {0.5f, 0.5f, 0.4f};
    m.normalMap.source = "/missing/normal.png";
    document.view.camera.distance = 9.0f;
    expectPicture(document, "missing-maps");
}

} // namespace
} // namespace patina::render
