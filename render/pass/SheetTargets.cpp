#include "render/pass/SheetTargets.h"

#include "render/SceneRendererImpl.h"

#include <fmt/format.h>

namespace patina::render {

Result<void> SheetTargets::resize(gl::Context& context, int width, int height) {
    const int limit = context.info().maxTextureSize;
    if (width < 1 || height < 1 || width > limit || height > limit)
        return Error{ErrorKind::Usage,
                     fmt::format("Views of {} × {} pixels cannot be drawn; this machine draws "
                                 "1 × 1 to {} × {}.",
                                 width, height, limit, limit),
                     {},
                     {}};
    if (width == m_width && height == m_height)
        return {};
    *this = {};
    const auto texture = [&](const char* label, gl::PixelFormat format) {
        return gl::Texture(context, label, {.format = format, .width = width, .height = height});
    };
    for (gl::Texture& values : m_values)
        values = texture("sheet values", gl::PixelFormat::Rgba32f);
    m_depth = texture("sheet depth", gl::PixelFormat::Depth32f);
    m_displayed = texture("sheet", gl::PixelFormat::Rgba8);
    const auto& v = m_values;
    auto numbers =
        gl::Framebuffer::create(context, "sheet values",
                                {&v[0], &v[1], &v[2], &v[3], &v[4], &v[5], &v[6], &v[7]}, &m_depth);
    auto display = gl::Framebuffer::create(context, "sheet", {&m_displayed}, nullptr);
    if (!numbers || !display)
        return numbers ? display.error() : numbers.error();
    m_numbers = std::move(*numbers);
    m_display = std::move(*display);
    m_width = width;
    m_height = height;
    return {};
}

Image SheetTargets::readDisplayed() const {
    Image image(m_width, m_height, 4, PixelType::U8, ColorEncoding::Srgb);
    const auto bytes = m_displayed.readBytes(4);
    std::copy(bytes.begin(), bytes.end(), image.u8().begin());
    flipRows(image);
    return image;
}

} // namespace patina::render
