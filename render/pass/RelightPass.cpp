#include "render/pass/RelightPass.h"

#include "core/base/Check.h"
#include "core/math/SphericalHarmonics.h"

#include <algorithm>
#include <epoxy/gl.h>
#include <glm/gtc/constants.hpp>
#include <glm/matrix.hpp>

namespace patina::render {

namespace {

constexpr unsigned kElementsUnit = 0;
constexpr std::size_t kGroup = 64;                // local_size_x of relight.comp
constexpr std::size_t kMaxElements = 1024 * 1024; // of a dispatch: no driver has too few groups
constexpr std::size_t kVertexVectors = 3;         // of GpuMesh::vertices

struct LightBlock3 {
    std::array<glm::vec4, 48> coefficients{};
};

LightBlock3 pack(const TransferLightSh& light) {
    LightBlock3 block;
    for (std::size_t i = 0; i < light.size(); ++i)
        for (int c = 0; c < 3; ++c)
            block.coefficients[static_cast<std::size_t>(c) * 16 + i / 4]
                              [static_cast<glm::length_t>(i % 4)] = light[i][c];
    return block;
}

// Under an open sky a surface's transfer is the clamped cosine: A_l / pi Y_lm(n).
TransferLightSh overOpenSky(TransferLightSh light) {
    for (int l = 0; l < kMaxShOrder; ++l)
        for (int i = l * l; i < (l + 1) * (l + 1); ++i)
            light[static_cast<std::size_t>(i)] *=
                static_cast<float>(cosineConvolution(l) / glm::pi<double>());
    return light;
}

} // namespace

RelightPass::RelightPass(gl::Context& context, ShaderLibrary& shaders)
    : m_context(context)
    , m_shaders(shaders)
    , m_block(context, "light of transfer", sizeof(LightBlock3))
    , m_openSkyBlock(context, "light of an open sky", sizeof(LightBlock3))
    , m_view(context, "elements") {}

Result<void> RelightPass::update(const GpuScene& scene, LightingMode mode,
                                 const TransferLightSh& light) {
    if (mode < LightingMode::Unshadowed)
        return {};
    if (m_lightRevision == 0 || light != m_light) {
        m_light = light;
        ++m_lightRevision;
        m_block.writeValue(pack(light));
        m_openSkyBlock.writeValue(pack(overOpenSky(light)));
    }
    bool any = false;
    for (const DrawItem& item : scene.items()) {
        const Result<bool> done = relight(item, mode);
        if (!done)
            return done.error();
        any |= *done;
    }
    if (any)
        glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
    return {};
}

Result<bool> RelightPass::relight(const DrawItem& item, LightingMode mode) {
    const bool openSky = mode == LightingMode::Unshadowed;
    const Transfer* transfer = item.transfer;
    if (!openSky && transfer == nullptr)
        return false;
    ExitRadiance& exit = (openSky ? item.litVertices : item.lit)->stage(mode);
    const bool bounces = mode == LightingMode::Prt;
    ExitRadiance made;
    made.lightRevision = m_lightRevision;
    if (openSky)
        made.normalToWorld = item.normalToWorld;
    else
        made.transferRevision = transfer->revision;
    if (bounces)
        made.bouncedRevision = item.lit->bouncedRevision;
    const std::size_t count = openSky ? item.mesh->vertexCount : transfer->count;
    const std::size_t bytes = count * sizeof(glm::vec4);
    if (exit.values.size() == bytes && exit.sameSources(made))
        return false;
    exit.takeSources(made);
    if (exit.values.size() != bytes)
        exit.values = gl::Buffer(m_context, "exit radiance", bytes);

    if (openSky) {
        if (auto done = dispatch(Source::OpenSky, item.mesh->vertices, count, kVertexVectors, false,
                                 exit.values, item.normalToWorld);
            !done)
            return done.error();
        return true;
    }
    // What a solver found for this very light stands in for the coefficients.
    const bool solved = bounces && item.lit->bouncedLight.size() == bytes;
    if (solved)
        glCopyNamedBufferSubData(item.lit->bouncedLight.id(), exit.values.id(), 0, 0,
                                 static_cast<GLsizeiptr>(bytes));
    const int vectors = transfer->vectors();
    if (auto done = dispatch(Source::Direct, transfer->direct, count, vectors, solved, exit.values,
                             glm::mat3(1.0f));
        !done)
        return done.error();
    if (bounces && !solved && !transfer->bounced.empty()) {
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
        if (auto done = dispatch(Source::Bounced, transfer->bounced, count, 3 * vectors, true,
                                 exit.values, glm::mat3(1.0f));
            !done)
            return done.error();
    }
    if (transfer->side > 0) { // filtered lookups want a texture
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

Result<void> RelightPass::dispatch(Source source, const gl::Buffer& elements, std::size_t count,
                                   int vectors, bool adds, const gl::Buffer& exit,
                                   const glm::mat3& normalToWorld) {
    ProgramKey key{{"relight.comp"}, {}};
    if (source == Source::Bounced)
        key.defines = {"COLORED"};
    if (source == Source::OpenSky)
        key.defines = {"OPEN_SKY"};
    const auto shader = m_shaders.program(key);
    if (!shader)
        return shader.error();
    const gl::Program& program = **shader;
    program.use();
    (source == Source::OpenSky ? m_openSkyBlock : m_block).bindUniform(kTransferLightBinding);
    exit.bindStorage(kExitBinding);
    program.set("u_adds", adds ? 1 : 0);
    if (source == Source::OpenSky)
        program.set("u_normalToWorld", glm::mat4(normalToWorld));
    else
        program.set("u_vectors", source == Source::Bounced ? vectors / 3 : vectors);
    // Whole groups of 64 elements keep the alignment of views.
    const std::size_t elementBytes = static_cast<std::size_t>(vectors) * sizeof(glm::vec4);
    const std::size_t most = std::clamp(gl::BufferView::maxBytes() / elementBytes / kGroup * kGroup,
                                        kGroup, kMaxElements);
    for (std::size_t first = 0; first < count; first += most) {
        const std::size_t part = std::min(most, count - first);
        m_view.show(elements, first * elementBytes, part * elementBytes);
        m_view.bind(kElementsUnit);
        program.set("u_first", static_cast<int>(first));
        program.set("u_count", static_cast<int>(part));
        glDispatchCompute(static_cast<GLuint>((part + kGroup - 1) / kGroup), 1, 1);
        m_elementsDone += part;
    }
    return {};
}

} // namespace patina::render
