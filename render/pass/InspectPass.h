// What the surface shader computes at one pixel, written to memory by the shader itself.
#pragma once

#include "render/gl/Buffer.h"
#include "render/pass/PickPass.h"
#include "render/pass/SurfacePass.h"
#include "render/view/Inspection.h"

namespace patina::render {

class InspectPass {
  public:
    explicit InspectPass(gl::Context& context);

    // Draws `items`, of which PickPass has found one at (x, y) from the bottom left, once more over
    // that pixel. The frame's blocks and those of views and shadows are bound. Fills values,
    // contributions and lights (in the frame's order) of `result`.
    Result<void> draw(const GpuScene& scene, const std::vector<const DrawItem*>& items,
                      const PickPass& picked, SurfacePass& surface, const SurfaceSettings& settings,
                      int x, int y, Inspection& result);

  private:
    gl::Context& m_context;
    gl::Buffer m_records;
};

} // namespace patina::render
