// The lights of a frame that has more of them than its block of uniforms holds, in storage buffers,
// with the cells that say which of them reach where. shaders/include/frame.glsl has the other side.
#pragma once

#include "render/gl/Buffer.h"
#include "render/scene/LightBlocks.h"
#include "render/scene/LightCells.h"

#include <optional>

namespace patina::render {

class ManyLights {
  public:
    explicit ManyLights(gl::Context& context)
        : m_context(context) {}

    // Uploads what differs. `box`: of the scene.
    void set(PackedLights lights, const Bounds& box);
    void bind() const; // nothing before the first set()
    [[nodiscard]] const PackedLights& lights() const { return m_lights; }
    // How often cells have been made anew.
    [[nodiscard]] std::uint64_t rebuilds() const { return m_rebuilds; }

  private:
    gl::Context& m_context;
    PackedLights m_lights;
    std::optional<Bounds> m_box; // that the cells are of
    gl::Buffer m_buffer, m_cells;
    std::uint64_t m_rebuilds = 0;
};

} // namespace patina::render
