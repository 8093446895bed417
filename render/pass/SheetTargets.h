// Where thumbnails of views are drawn: eight pictures of numbers at once, and one to show them in.
#pragma once

#include "core/image/Image.h"
#include "render/gl/Framebuffer.h"

#include <array>

namespace patina::render {

class SheetTargets {
  public:
    static constexpr std::size_t kViews = 8;

    // Made anew when the size changed. Errors: Usage for an impossible size, Internal from the
    // driver.
    Result<void> resize(gl::Context& context, int width, int height);

    [[nodiscard]] const gl::Framebuffer& numbers() const { return m_numbers; } // all eight
    [[nodiscard]] const gl::Texture& values(std::size_t i) const { return m_values[i]; }
    [[nodiscard]] const gl::Framebuffer& display() const { return m_display; }
    // 8-bit RGBA, top row first.
    [[nodiscard]] Image readDisplayed() const;

  private:
    int m_width = 0, m_height = 0;
    std::array<gl::Texture, kViews> m_values;
    gl::Texture m_depth, m_displayed;
    gl::Framebuffer m_numbers, m_display;
};

} // namespace patina::render
