#include "render/pass/ReadTargets.h"

#include <utility>

namespace patina::render {

Result<void> ReadTargets::resize(gl::Context& context, int width, int height, int samples) {
    if (width == m_width && height == m_height && samples == m_samples)
        return {};
    *this = {};
    const auto texture = [&](const char* label, gl::PixelFormat format, int n) {
        return gl::Texture(context, label,
                           {.kind = n > 1 ? gl::TextureKind::Multisample : gl::TextureKind::Flat,
                            .format = format,
                            .width = width,
                            .height = height,
                            .samples = n});
    };
    m_data = texture("numbers to read", gl::PixelFormat::Rgba32f, 1);
    m_depth = texture("depth to read", gl::PixelFormat::Depth32f, 1);
    m_displayed = texture("display to read", gl::PixelFormat::Rgba8, 1);
    auto single = gl::Framebuffer::create(context, "numbers to read", {&m_data}, &m_depth);
    auto display = gl::Framebuffer::create(context, "display to read", {&m_displayed}, nullptr);
    if (!single || !display)
        return single ? display.error() : single.error();
    m_single = std::move(*single);
    m_display = std::move(*display);
    if (samples > 1) {
        m_dataSamples = texture("samples to read", gl::PixelFormat::Rgba32f, samples);
        m_depthSamples = texture("depth samples to read", gl::PixelFormat::Depth32f, samples);
        auto sampled =
            gl::Framebuffer::create(context, "samples to read", {&m_dataSamples}, &m_depthSamples);
        if (!sampled)
            return sampled.error();
        m_sampled = std::move(*sampled);
    }
    m_width = width;
    m_height = height;
    m_samples = samples;
    return {};
}

void ReadTargets::resolve() const {
    if (m_samples > 1)
        m_sampled.resolveTo(m_single, true);
}

} // namespace patina::render
