// Passes that cover the whole picture with one triangle: sky, tone map, copy to the window.
#pragma once

#include "render/gl/VertexArray.h"
#include "render/pass/DisplayProgram.h"
#include "render/pass/Targets.h"
#include "render/scene/GpuScene.h"
#include "render/shader/ShaderLibrary.h"

#include <optional>

namespace patina::render {

// Display value, of 255, of what has no surface in views of terms.
inline constexpr int kEmptyDisplay = 28;

struct ToneMapSettings {
    bool dither = false;      // noise of half a display step hides bands
    float scale = 1.0f;       // on radiance, beside the exposure
    bool fillEmpty = false;   // kEmptyDisplay instead of transparency
    bool markClipped = false; // what the display cannot show instead of the picture
    glm::vec3 side{0.0f};     // shaders/include/side.glsl
};

// What finished pictures are shown in, or drawn over: a framebuffer of targets or of a window, or a
// part of it.
struct Canvas {
    unsigned framebuffer = 0;
    int width = 0, height = 0; // pixels
    int x = 0, y = 0;          // of its lower left corner in the framebuffer

    [[nodiscard]] static Canvas of(const Targets& targets) {
        return {targets.display().id(), targets.width(), targets.height()};
    }
    [[nodiscard]] static Canvas window(const Targets& targets, unsigned framebuffer) {
        return {framebuffer, targets.width(), targets.height()};
    }
    void bind() const; // for drawing, with the viewport set to the whole of it
};

class ScreenPasses {
  public:
    ScreenPasses(gl::Context& context, ShaderLibrary& shaders);

    // Where nothing has been drawn yet (depth 1), into the bound scene target. Nothing for
    // BackgroundMode::Color and Off: that is the clear colour. `blur` of BackgroundMode::Blurred:
    // perceptual roughness of the prefiltered level. `floats`: SurfaceSettings::floats.
    Result<void> drawSky(const EnvironmentLight& environment, BackgroundMode mode, float blur,
                         bool floats);

    // Premultiplied radiance to display values, of the same size: exposure, tone curve, transfer
    // function. The luminance that the view may ask for is bound (AdaptationPass). Until
    // setDisplay() has been given a view of OpenColorIO, the default curve stands in for it.
    Result<void> toneMap(const gl::Texture& radiance, const gl::Framebuffer& target,
                         const View& view, const ToneMapSettings& settings = {});
    void setDisplay(std::optional<DisplayProgram> display) { m_display = std::move(display); }

    // The mean of linear() over `count` frames, this one included, for either side of a split: into
    // linear(). Count 1 begins anew. Error Internal from the driver.
    Result<void> accumulate(gl::Context& context, Targets& targets, std::size_t side, int count);
    // That mean once more, without a new frame.
    Result<void> showMean(const Targets& targets, std::size_t side);

    // displayed() into a framebuffer of the window system, multisampled or not, stretched to its
    // size. `side`: shaders/include/side.glsl, in pixels of the canvas. Less opaque: over what is
    // there.
    Result<void> present(const Targets& targets, const Canvas& canvas,
                         const glm::vec3& side = glm::vec3(0.0f), float opacity = 1.0f);

    // Compiles the programs, so that a broken one is found when the renderer is made.
    Result<void> compile();

    void drawTriangle() const; // with the program in use

    // The uniforms of shaders/include/exposure.glsl.
    static void setExposure(const gl::Program& program, const View& view);

  private:
    Result<void> copy(const gl::Texture& from);
    Result<const gl::Program*> program(const char* fragment, std::vector<std::string> defines = {});

    ShaderLibrary& m_shaders;
    gl::VertexArray m_noAttributes;
    std::optional<DisplayProgram> m_display;
};

} // namespace patina::render
