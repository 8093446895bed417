#include "tests/render/RenderTest.h"

#include "core/document/ViewChoices.h"
#include "core/material/Material.h"
#include "core/math/Shading.h"
#include "render/scene/EnvironmentLight.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

namespace patina::render {

MeshPtr makeSphere(int rings) {
    auto mesh = std::make_shared<Mesh>();
    mesh->name = "sphere";
    const int segments = 2 * rings;
    for (int ring = 0; ring <= rings; ++ring)
        for (int segment = 0; segment <= segments; ++segment) {
            const glm::vec2 uv(static_cast<float>(segment) / static_cast<float>(segments),
                               static_cast<float>(ring) / static_cast<float>(rings));
            const float phi = glm::two_pi<float>() * uv.x, theta = glm::pi<float>() * uv.y;
            const glm::vec3 n(std::sin(theta) * std::sin(phi), std::cos(theta),
                              std::sin(theta) * std::cos(phi));
            mesh->positions.push_back(n);
            mesh->normals.push_back(n);
            mesh->tangents.emplace_back(std::cos(phi), 0.0f, -std::sin(phi), 1.0f);
            mesh->uvs.push_back(uv);
        }
    const auto at = [&](int ring, int segment) {
        return static_cast<std::uint32_t>(ring * (segments + 1) + segment);
    };
    for (int ring = 0; ring < rings; ++ring)
        for (int segment = 0; segment < segments; ++segment) {
            const auto a = at(ring, segment), b = at(ring + 1, segment),
                       c = at(ring + 1, segment + 1), d = at(ring, segment + 1);
            if (ring > 0)
                mesh->indices.insert(mesh->indices.end(), {a, b, d});
            if (ring + 1 < rings)
                mesh->indices.insert(mesh->indices.end(), {b, c, d});
        }
    return mesh;
}

MeshPtr makePlane() {
    auto mesh = std::make_shared<Mesh>();
    mesh->name = "plane";
    for (const float z : {-1.0f, 1.0f})
        for (const float x : {-1.0f, 1.0f}) {
            mesh->positions.emplace_back(x, 0.0f, z);
            mesh->normals.emplace_back(0.0f, 1.0f, 0.0f);
            // cross(n, t) = (0, 0, -1): up in the image is towards -Z.
            mesh->tangents.emplace_back(1.0f, 0.0f, 0.0f, 1.0f);
            mesh->uvs.emplace_back(0.5f * x + 0.5f, 0.5f * z + 0.5f);
        }
    mesh->indices = {0, 2, 1, 1, 2, 3};
    return mesh;
}

Document makeScene(const MeshPtr& mesh) {
    Document document;
    Material material;
    material.id = 2;
    document.materials.push_back(material);
    MeshInstance instance;
    instance.id = 1;
    instance.mesh = mesh;
    instance.material = 2;
    document.meshes.push_back(instance);
    document.nextId = 3;
    document.environment().source.clear();
    document.view.background = BackgroundMode::Color;
    document.view.backgroundColor = glm::vec3(0.0f);
    document.view.camera.yawDeg = 0.0f;
    document.view.camera.pitchDeg = 0.0f;
    document.view.camera.distance = 5.0f;
    document.view.camera.fovDeg = 30.0f;
    return document;
}

Camera cameraAbove() {
    Camera camera;
    camera.yawDeg = 0.0f;
    camera.pitchDeg = 90.0f;
    camera.distance = 5.0f;
    camera.fovDeg = 20.0f;
    return camera;
}

ImagePtr makeImage(int width, int height, int channels, PixelType type, ColorEncoding encoding,
                   const std::function<float(int x, int y, int channel)>& value) {
    Image image(width, height, channels, type, encoding);
    std::size_t i = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < channels; ++c, ++i) {
                const float v = value(x, y, c);
                if (type == PixelType::U8)
                    image.u8()[i] = static_cast<std::uint8_t>(std::lround(v * 255.0f));
                else if (type == PixelType::U16)
                    image.u16()[i] = static_cast<std::uint16_t>(std::lround(v * 65535.0f));
                else
                    image.f32()[i] = v;
            }
    return std::make_shared<const Image>(std::move(image));
}

ImagePtr makeEnvironment(int height,
                         const std::function<glm::vec3(const glm::vec3& direction)>& radiance) {
    const int width = 2 * height;
    return makeImage(
        width, height, 3, PixelType::F32, ColorEncoding::Linear, [&](int x, int y, int c) {
            const glm::vec2 uv((static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                               (static_cast<float>(y) + 0.5f) / static_cast<float>(height));
            return radiance(shading::directionFromLatLong(uv))[c];
        });
}

glm::vec4 pixel(const Image& image, int x, int y) {
    glm::vec4 result(0.0f, 0.0f, 0.0f, 1.0f);
    for (int c = 0; c < image.channels(); ++c)
        result[c] = image.sample(x, y, c);
    return result;
}

glm::vec4 centerPixel(const Image& image) {
    return pixel(image, image.width() / 2, image.height() / 2);
}

void RenderTest::SetUp() {
    GlTest::SetUp();
    auto made = SceneRenderer::create(context());
    ASSERT_TRUE(made.ok()) << made.error().text();
    m_scene = std::move(*made);
    m_renderer = std::make_unique<ViewRenderer>(*m_scene);
    m_scene->setIbl(uniformIbl(glm::vec3(0.0f)));
}

void RenderTest::TearDown() {
    m_renderer.reset();
    m_scene.reset();
    GlTest::TearDown();
}

Image RenderTest::draw(const Document& document, int size, const FrameSettings& settings) {
    FrameSettings frame = settings;
    frame.width = frame.height = size;
    frame.camera = document.view.camera;
    m_scene->setDocument(document);
    const auto done = m_renderer->render(frame, 0);
    EXPECT_TRUE(done.ok()) << (done.ok() ? std::string() : done.error().text());
    return m_renderer->readLinear();
}

void RenderTest::setIblOf(const Document& document) {
    const auto maps =
        computeIbl(*document.environment().image, {.cubeSize = 32, .levels = 5}, JobContext());
    ASSERT_TRUE(maps.ok()) << maps.error().text();
    setBackground(document.environment().image, *maps);
}

void RenderTest::setBackground(const ImagePtr& image, const IblMaps& light) {
    m_scene->setEnvironment(std::make_shared<const EnvironmentTexels>(
        makeEnvironmentTexels(image, light, *makeBackground(*image, JobContext()))));
}

} // namespace patina::render
