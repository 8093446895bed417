#include "tests/render/ToneMapFixture.h"
#include "core/document/ViewChoices.h"

#include <epoxy/gl.h>

namespace patina::render {

void ToneMapFixture::SetUp() {
    GlTest::SetUp();
    m_gpu = std::make_unique<Gpu>(context());
}

void ToneMapFixture::TearDown() {
    m_luminance = {};
    m_gpu.reset();
    GlTest::TearDown();
}

void ToneMapFixture::setPicture(int width, const std::vector<glm::vec4>& pixels) {
    const int height = static_cast<int>(pixels.size()) / width;
    ASSERT_EQ(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), pixels.size());
    ASSERT_TRUE(targets().resize(context(), width, height, 1).ok());
    glTextureSubImage2D(targets().linear().id(), 0, 0, 0, width, height, GL_RGBA, GL_FLOAT,
                        pixels.data());
    targets().resolved().clearDepth(1.0f); // background alone
}

void ToneMapFixture::setLuminance(const Luminance& luminance) {
    constexpr unsigned kBinding = 5; // of the block in shaders/include/exposure.glsl
    gl::Buffer block(context(), "luminance", sizeof luminance);
    block.writeValue(luminance);
    block.bindUniform(kBinding);
    m_luminance = std::move(block);
}

Luminance ToneMapFixture::lookAt(float seconds) {
    EXPECT_TRUE(adaptation().measure(targets()).ok());
    EXPECT_TRUE(adaptation().adapt(seconds, ExposureMeter::Surfaces).ok());
    const auto result = adaptation().read();
    EXPECT_TRUE(result.has_value());
    return result.value_or(Luminance{});
}

std::vector<std::uint8_t> ToneMapFixture::toneMapped(const View& view, bool dither) {
    const auto done =
        screen().toneMap(targets().linear(), targets().display(), view, {.dither = dither});
    EXPECT_TRUE(done.ok()) << (done.ok() ? std::string() : done.error().text());
    return targets().displayed().readBytes(4);
}

} // namespace patina::render
