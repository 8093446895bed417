#include "render/pass/ScreenPasses.h"

#include "core/document/ViewChoices.h"

#include <cmath>
#include <epoxy/gl.h>

namespace patina::render {

namespace {
constexpr unsigned kEnvironmentUnit = 0, kPictureUnit = 0, kBlurredUnit = 7;
// Just under a whole step from end to end, so that a value on a step stays there.
constexpr float kDitherAmplitude = 0.998f;

std::vector<std::string> toneMapDefines(ToneMap curve) {
    if (curve == ToneMap::OpenColorIo)
        curve = View().toneMap;
    return {"TONE_MAP " + std::to_string(static_cast<int>(curve))};
}
} // namespace

ScreenPasses::ScreenPasses(gl::Context& context, ShaderLibrary& shaders)
    : m_shaders(shaders)
    , m_noAttributes(context, "no attributes") {}

Result<const gl::Program*> ScreenPasses::program(const char* fragment,
                                                 std::vector<std::string> defines) {
    return m_shaders.program({{"screen.vert", fragment}, std::move(defines)});
}

void ScreenPasses::drawTriangle() const {
    glDisable(GL_CULL_FACE);
    m_noAttributes.bind();
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

Result<void> ScreenPasses::compile() {
    for (const char* fragment : {"sky.frag", "copy.frag", "texel.frag"})
        if (auto made = program(fragment); !made)
            return made.error();
    if (auto made = program("copy.frag", {"STRETCHED"}); !made) // not when a drag begins
        return made.error();
    if (auto made = program("tonemap.frag", toneMapDefines(View().toneMap)); !made)
        return made.error();
    return {};
}

Result<void> ScreenPasses::drawSky(const EnvironmentLight& environment, BackgroundMode mode,
                                   float blur, bool floats) {
    if (mode == BackgroundMode::Color || mode == BackgroundMode::Off)
        return {};
    const bool blurred = mode == BackgroundMode::Blurred;
    std::vector<std::string> defines;
    if (blurred)
        defines.emplace_back("BLURRED");
    if (floats)
        defines.emplace_back("FLOATS");
    const auto shader = program("sky.frag", std::move(defines));
    if (!shader)
        return shader.error();
    (*shader)->use();
    if (blurred)
        (*shader)->set("u_blur", blur);
    environment.background().bind(kEnvironmentUnit);
    environment.prefiltered().bind(kBlurredUnit);
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL); // the triangle lies on the far plane
    glDepthMask(GL_FALSE);
    drawTriangle();
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
    return {};
}

void ScreenPasses::setExposure(const gl::Program& program, const View& view) {
    // The photographic operator brings its key, which is an automatic exposure of its own.
    const bool automatic = view.exposureMode == ExposureMode::Automatic &&
                           view.toneMap != ToneMap::ReinhardPhotographic;
    program.set("u_exposureEv", view.exposureEv);
    program.set("u_automatic", automatic ? 1 : 0);
}

Result<void> ScreenPasses::toneMap(const gl::Texture& radiance, const gl::Framebuffer& target,
                                   const View& view, const ToneMapSettings& settings) {
    const gl::Program* shader = nullptr;
    if (view.toneMap == ToneMap::OpenColorIo && m_display) {
        shader = &m_display->program();
        m_display->bindTables();
    } else {
        const auto made = program("tonemap.frag", toneMapDefines(view.toneMap));
        if (!made)
            return made.error();
        shader = *made;
    }
    shader->use();
    setExposure(*shader, view);
    shader->set("u_exposureEv", view.exposureEv + std::log2(settings.scale));
    shader->set("u_autoKey", view.reinhardAutoKey ? 1 : 0);
    shader->set("u_reinhardKey", view.reinhardKey);
    shader->set("u_reinhardWhite", view.reinhardWhite);
    shader->set("u_reinhardPerChannel", view.reinhardPerChannel ? 1 : 0);
    shader->set("u_exponentialK", view.exponentialK);
    shader->set("u_transfer", static_cast<int>(view.displayTransfer));
    shader->set("u_gamma", view.displayGamma);
    shader->set("u_ditherAmplitude", settings.dither ? kDitherAmplitude : 0.0f);
    shader->set("u_empty", settings.fillEmpty ? static_cast<float>(kEmptyDisplay) / 255.0f : -1.0f);
    shader->set("u_markClipped", settings.markClipped ? 1 : 0);
    shader->set("u_side", settings.side);
    radiance.bind(kPictureUnit);
    target.bind();
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    drawTriangle();
    return {};
}

// Into what is bound, blending as it is.
Result<void> ScreenPasses::copy(const gl::Texture& from) {
    const auto shader = program("texel.frag");
    if (!shader)
        return shader.error();
    (*shader)->use();
    from.bind(kPictureUnit);
    glDisable(GL_DEPTH_TEST);
    drawTriangle();
    return {};
}

Result<void> ScreenPasses::accumulate(gl::Context& context, Targets& targets, std::size_t side,
                                      int count) {
    const auto mean = targets.meanTarget(context, side);
    if (!mean)
        return mean.error();
    (*mean)->bind();
    glEnable(GL_BLEND); // always, so that a driver compiles one program
    glBlendColor(0.0f, 0.0f, 0.0f, 1.0f / static_cast<float>(count));
    glBlendFunc(GL_CONSTANT_ALPHA, count == 1 ? GL_ZERO : GL_ONE_MINUS_CONSTANT_ALPHA);
    Result<void> done = copy(targets.linear());
    glDisable(GL_BLEND);
    return done && count > 1 ? showMean(targets, side) : done;
}

Result<void> ScreenPasses::showMean(const Targets& targets, std::size_t side) {
    targets.resolved().bind();
    glDisable(GL_BLEND);
    return copy(targets.mean(side));
}

void Canvas::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(x, y, width, height);
}

Result<void> ScreenPasses::present(const Targets& targets, const Canvas& canvas,
                                   const glm::vec3& side, float opacity) {
    // A context without a surface has no window to show anything in.
    if (glCheckNamedFramebufferStatus(canvas.framebuffer, GL_DRAW_FRAMEBUFFER) ==
        GL_FRAMEBUFFER_UNDEFINED)
        return {};
    const bool stretched = canvas.width != targets.width() || canvas.height != targets.height();
    const auto shader = program("copy.frag", stretched ? std::vector<std::string>{"STRETCHED"}
                                                       : std::vector<std::string>{});
    if (!shader)
        return shader.error();
    canvas.bind();
    (*shader)->use();
    (*shader)->set("u_origin", glm::vec2(canvas.x, canvas.y));
    (*shader)->set("u_side", side);
    (*shader)->set("u_opacity", opacity);
    targets.displayed().bind(kPictureUnit);
    glDisable(GL_DEPTH_TEST);
    if (opacity < 1.0f) {
        glEnable(GL_BLEND);
        glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    } else {
        glDisable(GL_BLEND);
    }
    drawTriangle();
    return {};
}

} // namespace patina::render
