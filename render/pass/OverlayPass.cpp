#include "render/pass/OverlayPass.h"

#include "render/pass/SurfacePass.h"

#include <algorithm>
#include <cmath>
#include <epoxy/gl.h>
#include <glm/geometric.hpp>
#include <optional>

namespace patina::render {

namespace {

constexpr glm::vec3 kSelection{1.0f, 0.62f, 0.18f}; // amber: rare in materials
constexpr float kMarkSize = 14.0f;                  // half the side of a light's mark, in units

// Pixels from the bottom left; nothing behind the camera.
std::optional<glm::vec2> project(const FrameBlock& frame, const glm::vec3& point) {
    const glm::vec4 clip = frame.worldToClip * glm::vec4(point, 1.0f);
    if (clip.w <= 1e-6f)
        return std::nullopt;
    return (glm::vec2(clip) / clip.w * 0.5f + 0.5f) * glm::vec2(frame.viewport);
}

// Marks keep their size on a small picture and grow with a large or dense one.
float markScale(const FrameBlock& frame) {
    return std::max(1.0f, frame.viewport.y / 1000.0f);
}

// Hue of a light at full brightness.
glm::vec3 markColor(const Light& light) {
    const float most = std::max({light.color.r, light.color.g, light.color.b, 1e-6f});
    return glm::mix(glm::vec3(1.0f), light.color / most, 0.8f);
}

} // namespace

Result<void> OverlayPass::draw(const Targets& targets, const GpuScene& scene,
                               const FrameBlock& frame, const Camera& camera, Id selected) {
    if (auto done = drawGrid(targets, scene.document().view, camera); !done)
        return done;
    if (auto done = drawOutline(targets, scene, selected); !done)
        return done;
    Result<void> done = drawLights(targets, scene, frame);
    glDisable(GL_BLEND);
    return done;
}

Result<void> OverlayPass::drawGrid(const Targets& targets, const View& view, const Camera& camera) {
    const auto shader = m_shaders.program({{"screen.vert", "grid.frag"}, {}});
    if (!shader)
        return shader.error();
    // The power of ten that gives a handful of cells across the picture.
    const float spacing = std::pow(10.0f, std::round(std::log10(camera.distance / 6.0f)));
    (*shader)->use();
    ScreenPasses::setExposure(**shader, view);
    (*shader)->set("u_spacing", spacing);
    (*shader)->set("u_fadeRadius", 3.0f * camera.distance);
    (*shader)->set("u_center", glm::vec3(camera.target.x, 0.0f, camera.target.z));
    targets.depth().bind(0);
    targets.linear().bind(1);
    targets.display().bind();
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    m_screen.drawTriangle();
    return {};
}

Result<void> OverlayPass::drawOutline(const Targets& targets, const GpuScene& scene, Id selected) {
    const auto& items = scene.items();
    const auto item = std::find_if(items.begin(), items.end(),
                                   [&](const DrawItem& i) { return i.id == selected; });
    if (item == items.end())
        return {};
    if (m_mask.width() != targets.width() || m_mask.height() != targets.height()) {
        m_maskTarget = {};
        m_mask = gl::Texture(
            m_context, "selection",
            {.format = gl::PixelFormat::R8, .width = targets.width(), .height = targets.height()});
        m_mask.setSampling(gl::Filter::Linear, gl::Wrap::Clamp);
        auto made = gl::Framebuffer::create(m_context, "selection", {&m_mask}, nullptr);
        if (!made)
            return made.error();
        m_maskTarget = std::move(*made);
    }
    const auto mask = m_shaders.program({{"surface.vert", "mask.frag"}, {}});
    const auto outline = m_shaders.program({{"screen.vert", "outline.frag"}, {}});
    if (!mask || !outline)
        return mask ? outline.error() : mask.error();

    m_maskTarget.bind();
    m_maskTarget.clearColor(0, 0, 0, 0);
    glDisable(GL_BLEND);
    (*mask)->use();
    drawItem(*item, false);

    targets.display().bind();
    glEnable(GL_BLEND);
    (*outline)->use();
    (*outline)->set("u_color", kSelection);
    (*outline)->set("u_radius",
                    2.5f * std::max(1.0f, static_cast<float>(targets.height()) / 1000.0f));
    m_mask.bind(0);
    m_screen.drawTriangle();
    return {};
}

Result<void> OverlayPass::drawMark(const char* shape, const glm::vec2& center,
                                   const glm::vec2& axisX, const glm::vec2& axisY,
                                   const glm::vec3& color, float scale) {
    const auto shader = m_shaders.program({{"gizmo.vert", "gizmo.frag"}, {shape}});
    if (!shader)
        return shader.error();
    (*shader)->use();
    (*shader)->set("u_center", center);
    (*shader)->set("u_axisX", axisX);
    (*shader)->set("u_axisY", axisY);
    (*shader)->set("u_color", color);
    (*shader)->set("u_scale", scale);
    m_noAttributes.bind();
    glDisable(GL_CULL_FACE);
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    return {};
}

Result<void> OverlayPass::drawLights(const Targets& targets, const GpuScene& scene,
                                     const FrameBlock& frame) {
    targets.display().bind();
    const float scale = markScale(frame), half = kMarkSize * scale;
    const glm::vec3 center = scene.bounds().center();
    const float radius = std::max(scene.bounds().radius(), 1e-3f);
    for (const Light& light : scene.document().lights) {
        if (!light.enabled)
            continue;
        // A directional light has no place: its mark stands on the side it comes from.
        const bool sun = light.type == LightType::Directional;
        const glm::vec3 d = sun ? light.directionToLight() : glm::vec3(0.0f);
        const auto mark = project(frame, sun ? center + 1.6f * radius * d : light.position);
        if (!mark)
            continue;
        const glm::vec3 color = markColor(light);
        if (const auto end = project(frame, center + 1.05f * radius * d); sun && end) {
            const glm::vec2 along = *end - *mark;
            const float length = glm::length(along);
            if (length > 2.0f * half) {
                const glm::vec2 start = *mark + along * (half / length);
                const glm::vec2 halfLine = 0.5f * (*end - start);
                const glm::vec2 side = 2.0f * scale * glm::vec2(-along.y, along.x) / length;
                if (auto done = drawMark("LINE", start + halfLine, halfLine, side, color, scale);
                    !done)
                    return done;
            }
        }
        if (auto done = drawMark(sun ? "SUN" : "BULB", *mark, {half, 0}, {0, half}, color, scale);
            !done)
            return done;
    }
    return {};
}

} // namespace patina::render
