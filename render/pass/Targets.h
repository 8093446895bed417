// The images a frame is made of, all of one size: scene-linear colour with depth (multisampled and
// resolved) and the displayed picture.
#pragma once

#include "core/image/Image.h"
#include "render/gl/Framebuffer.h"

#include <array>
#include <cstddef>

namespace patina::render {

class Targets {
  public:
    // Makes them anew when the size, the number of samples or the format changed. `samples` is
    // limited to what the context has; `floats`: colour of 32 bits instead of half floats. Errors:
    // Usage for an impossible size, Internal from the driver.
    Result<void> resize(gl::Context& context, int width, int height, int samples,
                        bool floats = false);

    [[nodiscard]] int width() const { return m_width; }
    [[nodiscard]] int height() const { return m_height; }
    [[nodiscard]] int samples() const { return m_samples; }
    [[nodiscard]] bool floats() const { return m_floats; }

    // Where the scene is drawn; resolve() makes linear() and depth() readable.
    [[nodiscard]] const gl::Framebuffer& scene() const {
        return m_samples > 1 ? m_multisampled : m_resolved;
    }
    void resolve() const;
    // Instead of resolve(): linear() is this picture, F32 RGBA of the same size, row 0 on top.
    void setLinear(const Image& picture);

    [[nodiscard]] const gl::Texture& linear() const { return m_linear; } // premultiplied
    [[nodiscard]] const gl::Texture& depth() const { return m_depth; }
    [[nodiscard]] const gl::Framebuffer& display() const { return m_display; }
    [[nodiscard]] const gl::Texture& displayed() const { return m_displayed; } // RGBA8, sRGB values

    // Where means over several frames are kept, RGBA32F, for either side of a split. Made when
    // first asked for. Error Internal from the driver.
    Result<const gl::Framebuffer*> meanTarget(gl::Context& context, std::size_t side);
    [[nodiscard]] const gl::Texture& mean(std::size_t side) const { return m_means[side]; }
    [[nodiscard]] const gl::Framebuffer& resolved() const { return m_resolved; } // linear()
    // Takes over what `other`, of the same size, keeps of that.
    void takeMeans(Targets& other);

    // Numbers of a view instead of radiance: RGBA32F with the depth of the resolved scene. Made
    // when first asked for. Error Internal from the driver.
    Result<const gl::Framebuffer*> dataTarget(gl::Context& context);
    [[nodiscard]] const gl::Texture& data() const { return m_data; } // once there is a target

  private:
    int m_width = 0, m_height = 0, m_samples = 0;
    bool m_floats = false;
    gl::Texture m_linearSamples, m_depthSamples, m_linear, m_depth, m_displayed, m_data;
    gl::Framebuffer m_multisampled, m_resolved, m_display, m_dataTarget;
    std::array<gl::Texture, 2> m_means;
    std::array<gl::Framebuffer, 2> m_meanTargets;
};

} // namespace patina::render
