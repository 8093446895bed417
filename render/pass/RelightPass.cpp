#include "render/pass/RelightPass.h"

#include "core/base/Check.h"
#include "core/light/TransferLight.h"

#include <algorithm>
#include <epoxy/gl.h>

namespace patina::render {

namespace {

constexpr unsigned kElementsUnit = 0, kBouncedUnit = 1, kPlacesUnit = 2;
constexpr std::size_t kGroup = 64;                // local_size_x of relight.comp
constexpr std::size_t kMaxElements = 1024 * 1024; // of a dispatch: no driver has too few groups
constexpr int kVertexVectors = 3;                 // of GpuMesh::vertices

struct TransferLightBlock {
    std::array<glm::vec4, 48> coefficients{};
    std::array<float, 8> window{};
};
static_assert(sizeof(TransferLightBlock) == 50 * sizeof(glm::vec4));

TransferLightBlock pack(const std::vector<glm::vec3>& light, int order) {
    TransferLightBlock block;
    for (std::size_t i = 0; i < light.size(); ++i)
        for (int c = 0; c < 3; ++c)
            block.coefficients[static_cast<std::size_t>(c) * 16 + i / 4]
                              [static_cast<glm::length_t>(i % 4)] = light[i][c];
    block.window = nearLightWindow(order);
    return block;
}

// How many bytes of `vectors` vec4 for each of so many elements lie before an element.
std::size_t bytesOf(std::size_t elements, int vectors) {
    return elements * static_cast<std::size_t>(vectors) * sizeof(glm::vec4);
}

} // namespace

// What is to be computed for an item.
struct RelightPass::Work {
    const gl::Buffer& exit;
    const gl::Buffer& elements;
    int elementVectors = 0;
    const gl::Buffer* bounced = nullptr; // three times as many vectors; null: none
    std::size_t count = 0;
    const FarLight& light;
    int order = 0;
    bool openSky = false;
    glm::mat3 normalToWorld{1.0f};
    bool adds = false;
    const gl::Buffer* places = nullptr; // null: no lights near by
    int placeVectors = 1;
    glm::mat4 placeToWorld{1.0f};
};

RelightPass::RelightPass(gl::Context& context, ShaderLibrary& shaders)
    : m_context(context)
    , m_shaders(shaders)
    , m_elements(context, "elements")
    , m_bounced(context, "bounced elements")
    , m_places(context, "places of elements") {}

RelightPass::FarLight& RelightPass::farLight(const GpuScene& scene, int order) {
    FarLight& light = m_far[static_cast<std::size_t>(order)];
    if (light.current)
        return light;
    light.current = true;
    std::vector<glm::vec3> coefficients = scene.transferLight(order);
    if (light.revision != 0 && coefficients == light.coefficients)
        return light;
    if (light.block.empty())
        light.block = gl::Buffer(m_context, "light of transfer", sizeof(TransferLightBlock));
    light.block.writeValue(pack(coefficients, order));
    light.coefficients = std::move(coefficients);
    light.revision = ++m_farRevision;
    return light;
}

Result<void> RelightPass::update(GpuScene& scene, LightingMode mode, const FrameBlock& frame) {
    if (mode < LightingMode::Unshadowed)
        return {};
    for (FarLight& light : m_far)
        light.current = false;
    NearLights lights{
        frame.lightEnds,
        {frame.lights.begin() + frame.lightEnds.x, frame.lights.begin() + frame.lightEnds.w}};
    for (LightBlock& light : lights.lights)
        light.place.w = 0.0f; // the slot of its shadow map says nothing here
    if (!(lights == m_near)) {
        m_near = std::move(lights);
        ++m_nearRevision;
    }
    bool any = false;
    for (const DrawItem& item : scene.items()) {
        const Result<bool> done = relight(scene, item, mode);
        if (!done)
            return done.error();
        any |= *done;
    }
    if (any)
        glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
    return {};
}

Result<bool> RelightPass::relight(GpuScene& scene, const DrawItem& item, LightingMode mode) {
    const bool openSky = mode == LightingMode::Unshadowed;
    const Transfer* transfer = item.transfer;
    if (!openSky && transfer == nullptr)
        return false;
    const bool perTexel = !openSky && transfer->side > 0;
    const bool bounces = mode == LightingMode::Prt;
    const int order = openSky ? kMaxShOrder : transfer->order();
    const FarLight& light = farLight(scene, order);
    ExitRadiance& exit = (openSky ? item.litVertices : item.lit)->stage(mode);

    ExitRadiance::Sources sources;
    sources.light = light.revision;
    sources.transfer = openSky ? 0 : transfer->revision;
    sources.bounced = bounces ? item.lit->bouncedRevision : 0;
    if (!m_near.lights.empty())
        sources.nearLights = m_nearRevision;
    if (!m_near.lights.empty() && perTexel)
        sources.places = scene.placeRevision();
    if (openSky || (!m_near.lights.empty() && !perTexel))
        sources.transform = item.transform;
    const std::size_t count = openSky ? item.mesh->vertexCount : transfer->count;
    const std::size_t bytes = bytesOf(count, 1);
    if (exit.values.size() == bytes && exit.sources == sources)
        return false;
    exit.sources = sources;
    if (exit.values.size() != bytes)
        exit.values = gl::Buffer(m_context, "exit radiance", bytes);

    Work work{.exit = exit.values,
              .elements = openSky ? item.mesh->vertices : transfer->direct,
              .elementVectors = openSky ? kVertexVectors : transfer->vectors(),
              .count = count,
              .light = light,
              .order = order,
              .openSky = openSky,
              .normalToWorld = item.normalToWorld};
    if (bounces && !transfer->bounced.empty())
        work.bounced = &transfer->bounced;
    // What a solver found for this very light stands in for the coefficients.
    work.adds = bounces && item.lit->bouncedLight.size() == bytes;
    if (work.adds)
        glCopyNamedBufferSubData(item.lit->bouncedLight.id(), exit.values.id(), 0, 0,
                                 static_cast<GLsizeiptr>(bytes));
    if (!m_near.lights.empty()) {
        work.places = perTexel ? &scene.texelPositions(item.materialId, transfer->side)
                               : &item.mesh->vertices;
        work.placeVectors = perTexel ? 1 : kVertexVectors;
        if (!perTexel)
            work.placeToWorld = item.transform;
    }
    if (auto done = dispatch(work); !done)
        return done.error();

    if (perTexel) { // filtered lookups want a texture
        if (exit.texels.width() != transfer->side) {
            exit.texels = gl::Texture(m_context, "exit radiance",
                                      {.format = gl::PixelFormat::Rgba16f,
                                       .width = transfer->side,
                                       .height = transfer->side});
            exit.texels.setSampling(gl::Filter::Linear, gl::Wrap::Repeat);
        }
        glMemoryBarrier(GL_PIXEL_BUFFER_BARRIER_BIT);
        exit.texels.copyFrom(exit.values);
    }
    return true;
}

Result<void> RelightPass::dispatch(const Work& work) {
    ProgramKey key{{"relight.comp"}, {}};
    if (work.bounced)
        key.defines.emplace_back("COLORED");
    if (work.openSky)
        key.defines.emplace_back("OPEN_SKY");
    if (m_near.ends.y > m_near.ends.x)
        key.defines.emplace_back("NEAR_POINTS");
    if (m_near.ends.z > m_near.ends.y)
        key.defines.emplace_back("NEAR_SPHERES");
    if (m_near.ends.w > m_near.ends.z)
        key.defines.emplace_back("NEAR_RECTANGLES");
    const auto shader = m_shaders.program(key);
    if (!shader)
        return shader.error();
    const gl::Program& program = **shader;
    program.use();
    work.light.block.bindUniform(kTransferLightBinding);
    work.exit.bindStorage(kExitBinding);
    const int vectors = (shCount(work.order) + 3) / 4;
    program.set("u_vectors", vectors);
    program.set("u_adds", work.adds ? 1 : 0);
    if (work.openSky)
        program.set("u_normalToWorld", glm::mat4(work.normalToWorld));
    if (work.places) {
        program.set("u_order", work.order);
        program.set("u_placeVectors", work.placeVectors);
        program.set("u_placeToWorld", work.placeToWorld);
    }
    // Whole groups of 64 elements keep the alignment of views.
    const int widest = std::max(work.elementVectors, work.bounced ? 3 * vectors : 0);
    const std::size_t most =
        std::clamp(gl::BufferView::maxBytes() / bytesOf(1, std::max(widest, work.placeVectors)) /
                       kGroup * kGroup,
                   kGroup, kMaxElements);
    for (std::size_t first = 0; first < work.count; first += most) {
        const std::size_t part = std::min(most, work.count - first);
        const auto show = [&](const gl::BufferView& view, const gl::Buffer& buffer, int each,
                              unsigned unit) {
            view.show(buffer, bytesOf(first, each), bytesOf(part, each));
            view.bind(unit);
        };
        show(m_elements, work.elements, work.elementVectors, kElementsUnit);
        if (work.bounced)
            show(m_bounced, *work.bounced, 3 * vectors, kBouncedUnit);
        if (work.places)
            show(m_places, *work.places, work.placeVectors, kPlacesUnit);
        program.set("u_first", static_cast<int>(first));
        program.set("u_count", static_cast<int>(part));
        glDispatchCompute(static_cast<GLuint>((part + kGroup - 1) / kGroup), 1, 1);
        m_elementsDone += part;
    }
    return {};
}

} // namespace patina::render
