// Keeps the radiance that surfaces send out under transfer in step with the light, by a compute
// shader that runs when something it depends on has changed: a light that stands still costs
// frames nothing.
#pragma once

#include "render/gl/BufferView.h"
#include "render/scene/GpuScene.h"
#include "render/shader/ShaderLibrary.h"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

namespace patina::render {

class RelightPass {
  public:
    RelightPass(gl::Context& context, ShaderLibrary& shaders);

    // Exit radiance of all items for `mode` in `light`; does nothing for modes that need none.
    Result<void> update(const GpuScene& scene, LightingMode mode, const TransferLightSh& light);

    // Elements that have been computed since the beginning, to see that nothing is done in vain.
    [[nodiscard]] std::uint64_t elementsDone() const { return m_elementsDone; }

  private:
    enum class Source { Direct, Bounced, OpenSky };
    // Whether there was something to do.
    Result<bool> relight(const DrawItem& item, LightingMode mode);
    Result<void> dispatch(Source source, const gl::Buffer& elements, std::size_t count, int vectors,
                          bool adds, const gl::Buffer& exit, const glm::mat3& normalToWorld);

    gl::Context& m_context;
    ShaderLibrary& m_shaders;
    gl::Buffer m_block, m_openSkyBlock;
    gl::BufferView m_view;
    TransferLightSh m_light{};
    std::uint64_t m_lightRevision = 0;
    std::uint64_t m_elementsDone = 0;
};

} // namespace patina::render
