#include "render/pass/Targets.h"

#include "core/base/Check.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <utility>
#include <vector>

namespace patina::render {

Result<void> Targets::resize(gl::Context& context, int width, int height, int samples,
                             bool floats) {
    const int limit = context.info().maxTextureSize;
    if (width < 1 || height < 1 || width > limit || height > limit)
        return Error{
            ErrorKind::Usage,
            fmt::format("A picture of {} × {} pixels cannot be drawn; this machine draws 1 × 1 to "
                        "{} × {}.",
                        width, height, limit, limit),
            {},
            {}};
    samples = std::clamp(samples, 1, std::min(4, context.info().maxSamples));
    if (width == m_width && height == m_height && samples == m_samples && floats == m_floats)
        return {};
    *this = {};
    const gl::PixelFormat color = floats ? gl::PixelFormat::Rgba32f : gl::PixelFormat::Rgba16f;

    const auto texture = [&](const char* label, gl::PixelFormat format, int n) {
        return gl::Texture(context, label,
                           {.kind = n > 1 ? gl::TextureKind::Multisample : gl::TextureKind::Flat,
                            .format = format,
                            .width = width,
                            .height = height,
                            .samples = n});
    };
    m_linear = texture("linear", color, 1);
    m_depth = texture("depth", gl::PixelFormat::Depth32f, 1);
    m_displayed = texture("displayed", gl::PixelFormat::Rgba8, 1);
    m_displayed.setSampling(gl::Filter::Linear, gl::Wrap::Clamp); // where it is stretched
    auto resolved = gl::Framebuffer::create(context, "scene", {&m_linear}, &m_depth);
    auto display = gl::Framebuffer::create(context, "display", {&m_displayed}, nullptr);
    if (!resolved || !display)
        return resolved ? display.error() : resolved.error();
    m_resolved = std::move(*resolved);
    m_display = std::move(*display);
    if (samples > 1) {
        m_linearSamples = texture("linear samples", color, samples);
        m_depthSamples = texture("depth samples", gl::PixelFormat::Depth32f, samples);
        auto multisampled = gl::Framebuffer::create(context, "multisampled scene",
                                                    {&m_linearSamples}, &m_depthSamples);
        if (!multisampled)
            return multisampled.error();
        m_multisampled = std::move(*multisampled);
    }
    m_width = width;
    m_height = height;
    m_samples = samples;
    m_floats = floats;
    return {};
}

void Targets::setLinear(const Image& picture) {
    CHECK(picture.width() == m_width && picture.height() == m_height);
    CHECK(picture.type() == PixelType::F32 && picture.channels() == 4);
    // OpenGL's rows run from the bottom up; half floats end at 65504.
    const float brightest = m_floats ? std::numeric_limits<float>::max() : 65504.0f;
    const std::size_t row = 4 * static_cast<std::size_t>(m_width);
    const auto samples = picture.f32();
    std::vector<float> rows(samples.size());
    for (std::size_t y = 0; y < static_cast<std::size_t>(m_height); ++y)
        std::ranges::transform(samples.subspan(y * row, row),
                               rows.end() - static_cast<std::ptrdiff_t>((y + 1) * row),
                               [=](float sample) { return std::min(sample, brightest); });
    m_linear.upload(0, 4, gl::SampleType::F32, rows.data());
}

Result<const gl::Framebuffer*> Targets::dataTarget(gl::Context& context) {
    if (m_dataTarget.empty()) {
        m_data =
            gl::Texture(context, "view data",
                        {.format = gl::PixelFormat::Rgba32f, .width = m_width, .height = m_height});
        auto made = gl::Framebuffer::create(context, "view data", {&m_data}, &m_depth);
        if (!made)
            return made.error();
        m_dataTarget = std::move(*made);
    }
    return &m_dataTarget;
}

Result<const gl::Framebuffer*> Targets::meanTarget(gl::Context& context, std::size_t side) {
    gl::Framebuffer& target = m_meanTargets[side];
    if (target.empty()) {
        m_means[side] =
            gl::Texture(context, "mean of frames",
                        {.format = gl::PixelFormat::Rgba32f, .width = m_width, .height = m_height});
        auto made = gl::Framebuffer::create(context, "mean of frames", {&m_means[side]}, nullptr);
        if (!made)
            return made.error();
        target = std::move(*made);
    }
    return &target;
}

void Targets::takeMeans(Targets& other) {
    std::swap(m_means, other.m_means);
    std::swap(m_meanTargets, other.m_meanTargets);
}

void Targets::resolve() const {
    if (m_samples > 1)
        m_multisampled.resolveTo(m_resolved, true);
}

} // namespace patina::render
