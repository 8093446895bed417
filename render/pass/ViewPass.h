// Turns the numbers of a view into display values, and keeps what its shaders need: the block of
// settings, the colour maps, the range of the values.
#pragma once

#include "core/document/Document.h"
#include "render/gl/Buffer.h"
#include "render/gl/VertexArray.h"
#include "render/pass/Targets.h"
#include "render/scene/Blocks.h"
#include "render/shader/ShaderLibrary.h"
#include "render/view/ViewSettings.h"

namespace patina::render {

class ScreenPasses;

class ViewPass {
  public:
    ViewPass(gl::Context& context, ShaderLibrary& shaders, const ScreenPasses& screen);

    // The block that the recording variants of surface.frag read.
    void setBlock(const ViewsBlock& block);

    // The smallest and the largest number of `values` where a surface is; nothing when none is.
    // `positive`: numbers above 0 only. Waits for the GPU.
    Result<std::optional<ViewRange>> measure(const gl::Texture& values, bool positive);

    // Where a view does not apply: the shape of what is there, in stripes. `cosines`: N·V.
    Result<void> showEmpty(const gl::Texture& cosines, const glm::vec3& side,
                           const gl::Framebuffer& target);

    // The whole of `values` into `target`, of the same size. `side`: shaders/include/side.glsl;
    // `marks`: ViewSettings::flags.
    Result<void> show(const gl::Texture& values, const ViewInfo& info, const ViewRange& range,
                      const View& view, const glm::vec3& side, float marks,
                      const gl::Framebuffer& target);

  private:
    Result<const gl::Program*> useProgram(int value, const glm::vec3& side);
    void draw(const gl::Texture& values, const gl::Framebuffer& target);

    gl::Context& m_context;
    ShaderLibrary& m_shaders;
    const ScreenPasses& m_screen;
    gl::Buffer m_block, m_range;
    gl::Texture m_colors;
};

// Whether the view is seen through exposure and tone curve, as the picture is.
[[nodiscard]] bool showsRadiance(const ViewChoice& choice);

} // namespace patina::render
