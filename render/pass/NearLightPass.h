// What lights near by add under transfer, for each vertex or texel: made anew when a light, the
// transfer or a place has changed, and kept while the environment rotates.
#pragma once

#include "render/pass/TransferWork.h"
#include "render/scene/Blocks.h"
#include "render/shader/ShaderLibrary.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace patina::render {

class NearLightPass {
  public:
    NearLightPass(gl::Context& context, ShaderLibrary& shaders);

    // Those of the frame, sorted by type up to `ends` (FrameBlock::lightEnds), whose buffers are
    // bound; `ids` of all of them, or of none. `shareLights`: ids of those that items may have
    // shares of, in the order of these.
    void setLights(const glm::ivec4& ends, std::span<const LightBlock> all, std::span<const Id> ids,
                   std::span<const Id> shareLights);
    [[nodiscard]] bool any() const { return !m_lights.lights.empty(); }
    [[nodiscard]] std::uint64_t revision() const { return m_revision; } // grows with each change

    // Since the beginning.
    [[nodiscard]] std::uint64_t dispatches() const { return m_dispatches; }

    // The light of all of them into `target`, a vec4 for each element. Where the work has shares of
    // a light, what arrives directly is its closed form times these.
    Result<void> light(const TransferWork& work, const gl::Buffer& target);

  private:
    struct Lights {
        glm::ivec4 ends{0};
        std::vector<LightBlock> lights;
        std::vector<Id> ids; // of the lights; 0: unknown
        friend bool operator==(const Lights&, const Lights&) = default;
    };
    Result<void> dispatch(const TransferWork& work, const char* kind, const gl::Buffer& block,
                          int begin, int end, bool adds, std::optional<std::size_t> sharesBuffer);
    void setRows(const glm::ivec4& ends, std::span<const Id> ids, std::span<const Id> shareLights);
    [[nodiscard]] const std::vector<gl::Buffer>& blocks(int order);

    gl::Context& m_context;
    ShaderLibrary& m_shaders;
    TransferParts m_parts;
    Lights m_lights;
    std::uint64_t m_revision = 0, m_dispatches = 0;
    std::vector<std::int32_t> m_rows; // of NearShareBuffers, of the frame's lights; -1: none
    gl::Buffer m_rowsBuffer;
    // For bakes of that order: one without a rectangle, then one for each.
    std::vector<gl::Buffer> m_blocks;
    int m_blocksOrder = 0;
};

} // namespace patina::render
