// Overlays over a picture that has fewer pixels than what it is shown on.

#include "core/light/Light.h"
#include "render/gl/Framebuffer.h"
#include "tests/render/RenderTest.h"

#include <algorithm>
#include <cstdlib>

namespace patina::render {
namespace {

constexpr int kShown = 256;

class Overlays : public RenderTest {
  protected:
    void SetUp() override {
        RenderTest::SetUp();
        m_document = makeScene(makeSphere());
        Light lamp;
        lamp.id = 7;
        lamp.type = LightType::Spot;
        lamp.position = {-1.4f, 1.5f, 0.8f};
        m_document.lights = {lamp};
        m_document.view.camera.pitchDeg = 20.0f;
        m_document.view.camera.distance = 6.0f;
        m_texture =
            gl::Texture(context(), "shown",
                        {.format = gl::PixelFormat::Rgba8, .width = kShown, .height = kShown});
        auto made = gl::Framebuffer::create(context(), "shown", {&m_texture}, nullptr);
        ASSERT_TRUE(made.ok());
        m_framebuffer = std::move(*made);
        sceneRenderer().setDocument(m_document);
    }

    // What is shown of a picture of `size` pixels.
    std::vector<std::uint8_t> shown(int size, bool overlays) {
        FrameSettings frame;
        frame.width = frame.height = size;
        frame.samples = 1;
        frame.shownWidth = frame.shownHeight = kShown;
        frame.camera = m_document.view.camera;
        frame.showOverlays = overlays;
        frame.selectedMesh = m_document.meshes[0].id;
        frame.selectedLight = 7;
        EXPECT_TRUE(renderer().render(frame, m_framebuffer.id()).ok());
        const auto bytes = m_texture.readBytes(4);
        return {bytes.begin(), bytes.end()};
    }
    // Pixels that the overlays change.
    std::vector<bool> marked(int size) {
        const auto without = shown(size, false), with = shown(size, true);
        std::vector<bool> result(without.size() / 4);
        for (std::size_t i = 0; i < result.size(); ++i)
            for (std::size_t c = 0; c < 3; ++c)
                if (std::abs(int(with[4 * i + c]) - int(without[4 * i + c])) > 24)
                    result[i] = true;
        return result;
    }

    Document m_document;
    gl::Texture m_texture;
    gl::Framebuffer m_framebuffer;
};

TEST_F(Overlays, AreAsFineOverACoarsePictureAsOverAFineOne) {
    const std::vector<bool> fine = marked(kShown), coarse = marked(kShown / 4);
    const auto count = std::count(fine.begin(), fine.end(), true);
    ASSERT_GT(count, 400); // grid, outline, the light and its handles
    std::ptrdiff_t differing = 0;
    for (std::size_t i = 0; i < fine.size(); ++i)
        differing += fine[i] != coarse[i];
    // Where the edge of a body hides the grid, the coarse picture's depth decides.
    EXPECT_LT(differing, count / 8) << count << " pixels are marked";
}

TEST_F(Overlays, ACoarsePictureFillsWhatItIsShownOn) {
    const auto fine = shown(kShown, false), coarse = shown(kShown / 2, false);
    double difference = 0.0;
    for (std::size_t i = 0; i < fine.size(); ++i)
        difference += std::abs(int(fine[i]) - int(coarse[i]));
    EXPECT_LT(difference / static_cast<double>(fine.size()), 3.0);
}

} // namespace
} // namespace patina::render
