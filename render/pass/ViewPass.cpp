#include "render/pass/ViewPass.h"

#include "render/pass/ScreenPasses.h"

#include <cstring>
#include <epoxy/gl.h>

namespace patina::render {
namespace {

constexpr unsigned kValuesUnit = 0, kColorsUnit = 1, kRangeBinding = 0;
constexpr int kColorSteps = 256;

gl::Texture makeColors(gl::Context& context) {
    std::vector<float> rows;
    for (const ColorMap map : {ColorMap::Grey, ColorMap::Sequential, ColorMap::Diverging})
        for (int i = 0; i < kColorSteps; ++i) {
            const glm::vec3 color = mapColor(map, static_cast<float>(i) / (kColorSteps - 1));
            rows.insert(rows.end(), {color.r, color.g, color.b, 1.0f});
        }
    gl::Texture texture(context, "colour maps",
                        {.format = gl::PixelFormat::Rgba32f, .width = kColorSteps, .height = 3});
    texture.upload(0, 4, gl::SampleType::F32, rows.data());
    texture.setSampling(gl::Filter::Nearest, gl::Wrap::Clamp);
    return texture;
}

} // namespace

bool showsRadiance(const ViewChoice& choice) {
    return choice.mode == ViewMode::Contribution || viewInfo(choice.kind).exposed;
}

ViewPass::ViewPass(gl::Context& context, ShaderLibrary& shaders, const ScreenPasses& screen)
    : m_context(context)
    , m_shaders(shaders)
    , m_screen(screen)
    , m_block(context, "views", sizeof(ViewsBlock))
    , m_range(context, "view range", sizeof(ViewRange))
    , m_colors(makeColors(context)) {}

void ViewPass::setBlock(const ViewsBlock& block) {
    m_block.writeValue(block);
    m_block.bindUniform(kViewsBinding);
}

Result<std::optional<ViewRange>> ViewPass::measure(const gl::Texture& values, bool positive) {
    const auto shader = m_shaders.program({{"range.comp"}, {}});
    if (!shader)
        return shader.error();
    (*shader)->use();
    (*shader)->set("u_positive", positive ? 1 : 0);
    values.bind(kValuesUnit);
    m_range.bindStorage(kRangeBinding);
    glDispatchCompute(1, 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    ViewRange range;
    std::memcpy(&range, m_range.read().data(), sizeof(range));
    if (range.min > range.max)
        return std::optional<ViewRange>();
    return std::optional(range);
}

Result<const gl::Program*> ViewPass::useProgram(int value, const glm::vec3& side) {
    const auto shader = m_shaders.program({{"screen.vert", "view.frag"}, {}});
    if (shader) {
        (*shader)->use();
        (*shader)->set("u_value", value);
        (*shader)->set("u_empty", glm::vec3(static_cast<float>(kEmptyDisplay) / 255.0f));
        (*shader)->set("u_side", side);
    }
    return shader;
}

void ViewPass::draw(const gl::Texture& values, const gl::Framebuffer& target) {
    values.bind(kValuesUnit);
    m_colors.bind(kColorsUnit);
    target.bind();
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    m_screen.drawTriangle();
}

Result<void> ViewPass::showEmpty(const gl::Texture& cosines, const glm::vec3& side,
                                 const gl::Framebuffer& target) {
    if (const auto shader = useProgram(-1, side); !shader)
        return shader.error();
    draw(cosines, target);
    return {};
}

Result<void> ViewPass::show(const gl::Texture& values, const ViewInfo& info, const ViewRange& range,
                            const View& view, const glm::vec3& side, float marks,
                            const gl::Framebuffer& target) {
    const auto shader = useProgram(static_cast<int>(info.value), side);
    if (!shader)
        return shader.error();
    ScreenPasses::setExposure(**shader, view);
    (*shader)->set("u_kind", info.kind);
    (*shader)->set("u_range", glm::vec2(range.min, range.max));
    (*shader)->set("u_logarithmic", info.logarithmic ? 1 : 0);
    (*shader)->set("u_colorMap", static_cast<int>(info.colorMap));
    (*shader)->set("u_marks", marks);
    (*shader)->set("u_transfer", static_cast<int>(view.displayTransfer));
    (*shader)->set("u_gamma", view.displayGamma);
    draw(values, target);
    return {};
}

} // namespace patina::render
