// Where a picture is drawn once more to be looked at: its numbers as floats, and as displayed. One
// for all pictures, so that looking changes none of them.
#pragma once

#include "render/gl/Framebuffer.h"

namespace patina::render {

class ReadTargets {
  public:
    // Made anew when something differs. `samples`: of the picture, as Targets has it. Error
    // Internal from the driver.
    Result<void> resize(gl::Context& context, int width, int height, int samples);

    // RGBA32F with depth: one sample for each pixel, or as many as the picture has; resolve() makes
    // data() readable of those.
    [[nodiscard]] const gl::Framebuffer& single() const { return m_single; }
    [[nodiscard]] const gl::Framebuffer& sampled() const {
        return m_samples > 1 ? m_sampled : m_single;
    }
    void resolve() const;
    [[nodiscard]] const gl::Texture& data() const { return m_data; }
    [[nodiscard]] const gl::Framebuffer& display() const { return m_display; } // RGBA8

  private:
    int m_width = 0, m_height = 0, m_samples = 0;
    gl::Texture m_data, m_depth, m_dataSamples, m_depthSamples, m_displayed;
    gl::Framebuffer m_single, m_sampled, m_display;
};

} // namespace patina::render
