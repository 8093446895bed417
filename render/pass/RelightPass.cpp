#include "render/pass/RelightPass.h"

#include "core/base/Check.h"
#include "core/document/Lighting.h"
#include "core/document/ViewChoices.h"
#include "core/light/Light.h"
#include "render/scene/LightBlocks.h"

#include <algorithm>
#include <cstdint>
#include <epoxy/gl.h>

namespace patina::render {

namespace {

constexpr std::uint64_t kNoBounces = ~std::uint64_t{0}; // in place of a revision of bounced light

struct TransferLightBlock {
    std::array<glm::vec4, 48> coefficients{};
};

TransferLightBlock pack(const std::vector<glm::vec3>& light) {
    TransferLightBlock block;
    for (std::size_t i = 0; i < light.size(); ++i)
        for (int c = 0; c < 3; ++c)
            block.coefficients[static_cast<std::size_t>(c) * 16 + i / 4]
                              [static_cast<glm::length_t>(i % 4)] = light[i][c];
    return block;
}

} // namespace

RelightPass::RelightPass(gl::Context& context, ShaderLibrary& shaders)
    : m_context(context)
    , m_shaders(shaders)
    , m_near(context, shaders)
    , m_parts(context) {}

RelightPass::FarLight& RelightPass::farLight(const GpuScene& scene, LightId id, int order) {
    FarLight& light = m_far[{id, order}];
    if (light.current)
        return light;
    light.current = true;
    std::vector<glm::vec3> coefficients = scene.transferLight(id, order);
    if (light.revision != 0 && coefficients == light.coefficients)
        return light;
    if (light.block.empty())
        light.block = gl::Buffer(m_context, "light of transfer", sizeof(TransferLightBlock));
    light.block.writeValue(pack(coefficients));
    light.coefficients = std::move(coefficients);
    light.revision = ++m_farRevision;
    return light;
}

void RelightPass::removeLight(LightId light) {
    std::erase_if(m_far, [&](const auto& entry) { return entry.first.first == light; });
}

Result<void> RelightPass::update(GpuScene& scene, const RelightSettings& settings,
                                 const FrameBlock& frame) {
    if (!readsBake(settings.lighting) && settings.lighting != LightingMode::Unshadowed)
        return {};
    for (auto& [key, light] : m_far)
        light.current = false;
    const std::vector<Id> ids = lightOrder(scene.document());
    if (frame.lightEnds.w > kUniformLights) {
        const PackedLights& many = scene.manyLights().lights();
        m_near.setLights(many.ends, many.lights, ids, scene.nearShareLights());
    } else {
        m_near.setLights(frame.lightEnds, frame.lights, ids, scene.nearShareLights());
    }
    bool any = false;
    for (const DrawItem& item : scene.items()) {
        const Result<bool> done = relight(scene, item, settings);
        if (!done)
            return done.error();
        any |= *done;
    }
    if (any)
        glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
    return {};
}

Result<bool> RelightPass::relight(GpuScene& scene, const DrawItem& item,
                                  const RelightSettings& settings) {
    const LightingMode mode = settings.lighting;
    const bool openSky = mode == LightingMode::Unshadowed;
    const Transfer* transfer = item.transfer;
    if (!openSky && transfer == nullptr)
        return false;
    const bool perTexel = !openSky && transfer->side > 0;
    const bool bounces = mode == LightingMode::Prt && settings.bounces;
    const int order = openSky ? kMaxShOrder : transfer->order();
    const FarLight& light = farLight(scene, settings.light, order);
    LitElements& elements = openSky ? *item.litVertices : *item.lit;
    const LitByLight& lit = elements.byLight[settings.light];
    ExitRadiance& exit = elements.stage(settings.light, mode);

    TransferWork work{.elements = openSky ? item.mesh->vertices : transfer->direct,
                      .elementVectors = openSky ? kVertexVectors : transfer->vectors(),
                      .count = openSky ? item.mesh->vertexCount : transfer->count,
                      .order = order,
                      .openSky = openSky,
                      .normalToWorld = item.normalToWorld};
    if (bounces && !transfer->bounced.empty())
        work.bounced = &transfer->bounced;
    ExitRadiance::Sources sources;
    sources.transfer = openSky ? 0 : transfer->revision;
    // The lights near by bounce like the others.
    sources.bounced = bounces ? 0 : kNoBounces;
    if (openSky)
        sources.transform = item.transform;
    if (m_near.any()) {
        m_nearUsed |= !openSky;
        ExitRadiance::Sources nearSources = sources;
        nearSources.nearLights = m_near.revision();
        if (perTexel)
            nearSources.places = scene.placeRevision();
        else
            nearSources.transform = item.transform;
        work.places =
            perTexel ? &scene.texelPlaces(item.materialId, transfer->side) : &item.mesh->vertices;
        work.placeVectors = perTexel ? kTexelPlaceVectors : kVertexVectors;
        if (!openSky && !item.lit->nearShares.empty()) {
            work.nearShares = &item.lit->nearShares;
            nearSources.shares = item.lit->nearSharesRevision;
            if (perTexel) // in the world already
                work.normalToWorld = glm::mat3(1.0f);
        }
        if (!perTexel)
            work.placeToWorld = item.transform;
        if (auto done = relightNear(exit, work, nearSources); !done)
            return done.error();
        sources.nearLights = exit.nearRevision;
    } else if (!exit.nearValues.empty()) {
        exit.nearValues = gl::Buffer();
        exit.nearSources = {};
    }
    sources.light = light.revision;
    sources.bounced = bounces ? lit.bouncedRevision : kNoBounces;
    const std::size_t bytes = elementBytes(work.count, 1);
    if (exit.values.size() == bytes && exit.sources == sources)
        return false;
    exit.sources = sources;
    if (exit.values.size() != bytes)
        exit.values = gl::Buffer(m_context, "exit radiance", bytes);

    // What a solver found for this very light stands in for the coefficients.
    const bool adds = bounces && lit.bouncedLight.size() == bytes;
    if (adds)
        glCopyNamedBufferSubData(lit.bouncedLight.id(), exit.values.id(), 0, 0,
                                 static_cast<GLsizeiptr>(bytes));
    if (auto done = dispatch(work, exit, light, adds); !done)
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

Result<void> RelightPass::relightNear(ExitRadiance& exit, const TransferWork& work,
                                      const ExitRadiance::Sources& sources) {
    const std::size_t bytes = elementBytes(work.count, 1);
    if (exit.nearValues.size() == bytes && exit.nearSources == sources)
        return {};
    if (exit.nearValues.size() != bytes)
        exit.nearValues = gl::Buffer(m_context, "light near by", bytes);
    exit.nearSources = sources;
    exit.nearRevision = ++m_farRevision;
    m_nearElementsDone += work.count;
    auto done = m_near.light(work, exit.nearValues);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    return done;
}

Result<void> RelightPass::dispatch(const TransferWork& work, const ExitRadiance& exit,
                                   const FarLight& light, bool adds) {
    ProgramKey key{{"relight.comp"}, {}};
    if (work.bounced)
        key.defines.emplace_back("COLORED");
    if (work.openSky)
        key.defines.emplace_back("OPEN_SKY");
    if (work.places)
        key.defines.emplace_back("NEAR_LIGHTS");
    const auto shader = m_shaders.program(key);
    if (!shader)
        return shader.error();
    const gl::Program& program = **shader;
    program.use();
    light.block.bindUniform(kTransferLightBinding);
    exit.values.bindStorage(kExitBinding);
    if (work.places)
        exit.nearValues.bindStorage(kNearBinding);
    program.set("u_vectors", work.vectors());
    program.set("u_adds", adds ? 1 : 0);
    if (work.openSky)
        program.set("u_normalToWorld", glm::mat4(work.normalToWorld));
    m_parts.run(work, [&](int first, int count) {
        program.set("u_first", first);
        program.set("u_count", count);
        m_elementsDone += static_cast<std::uint64_t>(count);
    });
    return {};
}

} // namespace patina::render
