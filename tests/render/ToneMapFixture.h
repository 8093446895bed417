// A fixture that puts pixels of any value into the frame's linear image and tone maps them.
#pragma once

#include "core/document/ToneResponse.h"
#include "core/math/Shading.h"
#include "render/gl/Buffer.h"
#include "render/pass/AdaptationPass.h"
#include "render/pass/ScreenPasses.h"
#include "tests/render/GlTest.h"

#include <memory>
#include <vector>

namespace patina::render {

class ToneMapFixture : public gl::GlTest {
  protected:
    void SetUp() override;
    void TearDown() override;

    // Premultiplied linear pixels, `width` in a row; stored as half floats.
    void setPicture(int width, const std::vector<glm::vec4>& pixels);
    // What the tone mapping is told of the picture's luminance, instead of measuring it.
    void setLuminance(const Luminance& luminance);
    // Measures the picture and lets the eye look at it for some seconds.
    Luminance lookAt(float seconds);
    // The displayed bytes, RGBA.
    std::vector<std::uint8_t> toneMapped(const View& view, bool dither = false);

    Targets& targets() { return m_gpu->targets; }
    AdaptationPass& adaptation() { return m_gpu->adaptation; }
    ScreenPasses& screen() { return m_gpu->screen; }

  private:
    struct Gpu {
        explicit Gpu(gl::Context& context)
            : shaders(context, {})
            , screen(context, shaders)
            , adaptation(context, shaders) {}
        ShaderLibrary shaders;
        Targets targets;
        ScreenPasses screen;
        AdaptationPass adaptation;
    };
    std::unique_ptr<Gpu> m_gpu;
    gl::Buffer m_luminance;
};

} // namespace patina::render
