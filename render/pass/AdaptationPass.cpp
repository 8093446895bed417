#include "render/pass/AdaptationPass.h"

#include "core/document/ViewChoices.h"

#include <cmath>
#include <epoxy/gl.h>
#include <utility>

namespace patina::render {

namespace {

constexpr int kTile = 64;                                // pixels a side: luminance.comp
constexpr std::size_t kSumBytes = 2 * 4 * sizeof(float); // of the model, of all pixels
constexpr unsigned kTilesBinding = 0, kStateBinding = 1; // storage blocks of the shaders
constexpr unsigned kMeteredUnit = 0, kMeteredDepthUnit = 1;

gl::Handle<gl::deleteBuffer> makeReadback(std::size_t bytes) {
    GLuint id = 0;
    glCreateBuffers(1, &id);
    glNamedBufferStorage(id, static_cast<GLsizeiptr>(bytes), nullptr,
                         GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT);
    glObjectLabel(GL_BUFFER, id, -1, "luminance readback");
    return gl::Handle<gl::deleteBuffer>(id);
}

} // namespace

AdaptationPass::AdaptationPass(gl::Context& context, ShaderLibrary& shaders)
    : m_context(context)
    , m_shaders(shaders)
    , m_state(context, "luminance", sizeof(Luminance))
    , m_readback(makeReadback(kSlots * sizeof(Luminance))) {
    m_results = static_cast<const Luminance*>(
        glMapNamedBufferRange(m_readback.id(), 0, kSlots * sizeof(Luminance),
                              GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT));
}

AdaptationPass::~AdaptationPass() {
    for (const Slot& slot : m_slots)
        glDeleteSync(static_cast<GLsync>(slot.fence)); // null is ignored
}

Result<void> AdaptationPass::compile(ShaderLibrary& shaders) {
    for (const char* file : {"luminance.comp", "adapt.comp"})
        if (auto made = shaders.program({{file}, {}}); !made)
            return made.error();
    return {};
}

Result<void> AdaptationPass::measure(const Targets& targets, int firstRow, int rows) {
    const auto shader = m_shaders.program({{"luminance.comp"}, {}});
    if (!shader)
        return shader.error();
    const int columns = (targets.width() + kTile - 1) / kTile;
    const int allRows = (targets.height() + kTile - 1) / kTile;
    const int first = firstRow / kTile, end = (firstRow + rows + kTile - 1) / kTile;
    const int count = columns * allRows;
    const std::size_t bytes = kSumBytes * static_cast<std::size_t>(count);
    if (m_nextTiles.empty() || m_nextTiles.size() < bytes)
        m_nextTiles = gl::Buffer(m_context, "luminance of tiles", bytes);
    (*shader)->use();
    (*shader)->set("u_firstRow", first);
    targets.linear().bind(kMeteredUnit);
    targets.depth().bind(kMeteredDepthUnit);
    m_nextTiles.bindStorage(kTilesBinding);
    glDispatchCompute(static_cast<GLuint>(columns), static_cast<GLuint>(end - first), 1);
    if (end < allRows)
        return {};
    std::swap(m_tiles, m_nextTiles);
    m_tileCount = count;
    ++m_revision;
    return {};
}

Result<void> AdaptationPass::adapt(float seconds, ExposureMeter meter) {
    const auto shader = m_shaders.program({{"adapt.comp"}, {}});
    if (!shader)
        return shader.error();
    if (seconds > 0.0f)
        ++m_revision;
    (*shader)->use();
    (*shader)->set("u_tileCount", m_tileCount);
    (*shader)->set("u_wholeFrame", meter == ExposureMeter::Frame ? 1 : 0);
    (*shader)->set("u_seconds", std::isfinite(seconds) ? seconds : -1.0f);
    m_tiles.bindStorage(kTilesBinding);
    m_state.bindStorage(kStateBinding);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    glDispatchCompute(1, 1, 1);
    glMemoryBarrier(GL_UNIFORM_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT |
                    GL_SHADER_STORAGE_BARRIER_BIT);

    // On its way to the CPU. When it never asks, the oldest result gives way.
    if (m_underWay == kSlots) {
        m_oldest = (m_oldest + 1) % kSlots;
        --m_underWay;
    }
    const std::size_t slot = (m_oldest + m_underWay) % kSlots;
    ++m_underWay;
    glCopyNamedBufferSubData(m_state.id(), m_readback.id(), 0,
                             static_cast<GLintptr>(slot * sizeof(Luminance)), sizeof(Luminance));
    glMemoryBarrier(GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT);
    glDeleteSync(static_cast<GLsync>(m_slots[slot].fence));
    m_slots[slot].fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    return {};
}

std::optional<Luminance> AdaptationPass::poll() {
    while (m_underWay > 0) {
        const auto fence = static_cast<GLsync>(m_slots[m_oldest].fence);
        const GLenum state = glClientWaitSync(fence, GL_SYNC_FLUSH_COMMANDS_BIT, 0);
        if (state != GL_ALREADY_SIGNALED && state != GL_CONDITION_SATISFIED)
            break;
        m_newest = m_results[m_oldest];
        m_oldest = (m_oldest + 1) % kSlots;
        --m_underWay;
    }
    return m_newest;
}

std::optional<Luminance> AdaptationPass::read() {
    glFinish();
    return poll();
}

} // namespace patina::render
