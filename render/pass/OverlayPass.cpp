#include "render/pass/OverlayPass.h"

#include "core/light/Light.h"
#include "render/pass/SurfacePass.h"

#include <algorithm>
#include <cmath>
#include <epoxy/gl.h>
#include <glm/geometric.hpp>

namespace patina::render {

namespace {

constexpr glm::vec3 kSelection{1.0f, 0.62f, 0.18f}; // amber: rare in materials
// Of a point's frame, as axes are coloured everywhere, and of what is reflected there.
constexpr glm::vec3 kTangent{0.93f, 0.33f, 0.36f}, kBitangent{0.45f, 0.78f, 0.33f},
    kNormal{0.36f, 0.58f, 1.0f}, kMirror{0.85f}, kLightRay{1.0f, 0.94f, 0.72f};
// Marks keep their size on a small picture and grow with a large one.
float markScale(float height, float pixels) {
    return pixels * std::max(1.0f, height / pixels / 1000.0f);
}

const char* markShape(LightType type) {
    switch (type) {
    case LightType::Directional:
        return "SUN";
    case LightType::Point:
        return "BULB";
    case LightType::Spot:
        return "SPOT";
    case LightType::Sphere:
        return "BALL";
    case LightType::Rectangle:
        return "PANEL";
    }
    return "BULB";
}

} // namespace

Result<void> OverlayPass::draw(const Canvas& canvas, const Targets& targets, const GpuScene& scene,
                               const FrameBlock& frame, const Camera& camera,
                               const OverlaySettings& settings) {
    if (auto done = drawMask(canvas, scene, settings); !done)
        return done;
    return drawLines(canvas, targets, scene, frame, camera, settings);
}

Result<void> OverlayPass::drawLines(const Canvas& canvas, const Targets& targets,
                                    const GpuScene& scene, const FrameBlock& frame,
                                    const Camera& camera, const OverlaySettings& settings) {
    if (auto done = drawGrid(canvas, targets, settings.look, camera); !done)
        return done;
    if (auto done = drawOutline(canvas, settings); !done)
        return done;
    Result<void> done = drawLights(canvas, scene, frame, settings);
    if (done && settings.meshHandles)
        done = drawMeshHandles(canvas, frame, *settings.meshHandles, settings.scale);
    if (done && settings.lobe)
        done = drawLobe(canvas, targets, *settings.lobe, frame, settings.scale);
    glDisable(GL_BLEND);
    return done;
}

Result<void> OverlayPass::drawGrid(const Canvas& canvas, const Targets& targets, const View& view,
                                   const Camera& camera) {
    const auto shader = m_shaders.program({{"screen.vert", "grid.frag"}, {}});
    if (!shader)
        return shader.error();
    (*shader)->use();
    ScreenPasses::setExposure(**shader, view);
    (*shader)->set("u_spacing", gridSpacing(camera.distance));
    (*shader)->set("u_fadeRadius", 3.0f * camera.distance);
    (*shader)->set("u_center", glm::vec3(camera.target.x, 0.0f, camera.target.z));
    targets.depth().bind(0);
    targets.linear().bind(1);
    canvas.bind();
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    m_screen.drawTriangle();
    return {};
}

Result<void> OverlayPass::drawMask(const Canvas& canvas, const GpuScene& scene,
                                   const OverlaySettings& settings) {
    m_hasMask = false;
    const auto& items = scene.items();
    const auto item = std::find_if(items.begin(), items.end(), [&](const DrawItem& i) {
        return i.id == settings.selectedMesh;
    });
    if (item == items.end())
        return {};
    if (m_mask.width() != canvas.width || m_mask.height() != canvas.height) {
        m_maskTarget = {};
        m_mask = gl::Texture(
            m_context, "selection",
            {.format = gl::PixelFormat::R8, .width = canvas.width, .height = canvas.height});
        m_mask.setSampling(gl::Filter::Linear, gl::Wrap::Clamp);
        auto made = gl::Framebuffer::create(m_context, "selection", {&m_mask}, nullptr);
        if (!made)
            return made.error();
        m_maskTarget = std::move(*made);
    }
    const auto mask = m_shaders.program({{"surface.vert", "mask.frag"}, {}});
    if (!mask)
        return mask.error();
    m_maskTarget.bind();
    m_maskTarget.clearColor(0, 0, 0, 0);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    (*mask)->use();
    drawItem(*item, false);
    m_hasMask = true;
    return {};
}

Result<void> OverlayPass::drawOutline(const Canvas& canvas, const OverlaySettings& settings) {
    if (!m_hasMask)
        return {};
    const auto outline = m_shaders.program({{"screen.vert", "outline.frag"}, {}});
    if (!outline)
        return outline.error();
    canvas.bind();
    glEnable(GL_BLEND);
    (*outline)->use();
    (*outline)->set("u_color", kSelection);
    (*outline)->set("u_radius",
                    2.5f * markScale(static_cast<float>(canvas.height), settings.scale));
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

Result<void> OverlayPass::drawLine(const GizmoLine& line, float scale) {
    const glm::vec2 along = line.to - line.from;
    const float length = glm::length(along);
    // Half of a pixel has no direction, and a line across the world no end.
    if (!(length > 0.5f) || length > 1e5f)
        return {};
    const glm::vec2 side = 2.5f * scale * glm::vec2(-along.y, along.x) / length;
    return drawMark(line.dashed ? "DASHED" : "LINE", 0.5f * (line.from + line.to), 0.5f * along,
                    side, line.color, scale);
}

// The lobe, the frame it stands in, and what it reflects: where the light comes from, or the viewer
// looks from, and the mirror direction of that.
Result<void> OverlayPass::drawLobe(const Canvas& canvas, const Targets& targets,
                                   const SurfaceLobe& lobe, const FrameBlock& frame, float pixels) {
    const float scale = markScale(frame.viewport.y, pixels);
    const GizmoView view{frame.worldToClip, glm::vec2(frame.viewport), scale};
    const float perMetre = pixelsPerMetre(view, lobe.position);
    if (!(perMetre > 0.0f)) // behind the camera
        return {};
    const float reach = kSurfaceLobeReach * scale / perMetre;
    if (auto done = m_lobe.draw(canvas, targets, lobe, glm::vec3(frame.cameraPosition), reach);
        !done)
        return done;
    canvas.bind();
    const auto ray = [&](const glm::vec3& direction, float length, const glm::vec3& color,
                         bool dashed) -> Result<void> {
        const auto from = project(view, lobe.position);
        const auto to = project(view, lobe.position + length * reach * direction);
        if (!from || !to)
            return {};
        return drawLine({*from, *to, color, dashed}, scale);
    };
    const glm::vec3 mirror = glm::reflect(-lobe.toFixed, lobe.normal);
    const struct {
        glm::vec3 direction;
        float length;
        glm::vec3 color;
        bool dashed;
    } rays[] = {{lobe.tangent, 0.45f, kTangent, false},
                {lobe.bitangent, 0.45f, kBitangent, false},
                {lobe.normal, 0.6f, kNormal, false},
                {mirror, 1.15f, kMirror, true},
                {lobe.toFixed, 1.25f, lobe.end == LobeEnd::Light ? kLightRay : kMirror, false}};
    for (const auto& r : rays) {
        // The viewer's own ray is a point to him.
        if (lobe.end == LobeEnd::Viewer && r.direction == lobe.toFixed)
            continue;
        if (auto done = ray(r.direction, r.length, r.color, r.dashed); !done)
            return done;
    }
    return {};
}

Result<void> OverlayPass::drawHandle(const GizmoPoint& handle, float scale) {
    const float knob = (kGizmoKnob + 3.0f) * scale; // room for the rim
    return drawMark(handle.square ? "BOX" : "KNOB", handle.at, {knob, 0}, {0, knob}, handle.color,
                    scale);
}

Result<void> OverlayPass::drawMeshHandles(const Canvas& canvas, const FrameBlock& frame,
                                          const MeshHandles& handles, float pixels) {
    canvas.bind();
    const float scale = markScale(frame.viewport.y, pixels);
    const GizmoView view{frame.worldToClip, glm::vec2(frame.viewport), scale};
    const MeshGizmo gizmo = meshGizmo(handles, view);
    for (const GizmoLine& line : gizmo.lines)
        if (auto done = drawLine(line, scale); !done)
            return done;
    for (const GizmoPoint& handle : gizmo.handles)
        if (auto done = drawHandle(handle, scale); !done)
            return done;
    return {};
}

Result<void> OverlayPass::drawLights(const Canvas& canvas, const GpuScene& scene,
                                     const FrameBlock& frame, const OverlaySettings& settings) {
    canvas.bind();
    const float scale = markScale(frame.viewport.y, settings.scale);
    const GizmoView view{frame.worldToClip, glm::vec2(frame.viewport), scale};
    const Document& document = scene.document();
    for (const Light& light : document.lights) {
        const bool selected = light.id != 0 && light.id == settings.selectedLight;
        const LightGizmo gizmo = lightGizmo(document, light, scene.bounds(), view, selected);
        if (!gizmo.visible)
            continue;
        for (const GizmoLine& line : gizmo.lines)
            if (auto done = drawLine(line, scale); !done)
                return done;
        const float half = kGizmoMark * scale;
        const glm::vec3 color = gizmo.selected ? kSelection : gizmo.color;
        if (auto done =
                drawMark(markShape(light.type), gizmo.mark, {half, 0}, {0, half}, color, scale);
            !done)
            return done;
        for (const GizmoPoint& handle : gizmo.handles)
            if (auto done = drawHandle(handle, scale); !done)
                return done;
    }
    return {};
}

} // namespace patina::render
