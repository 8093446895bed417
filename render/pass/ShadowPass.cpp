#include "render/pass/ShadowPass.h"

#include "core/light/Light.h"
#include "core/material/Material.h"
#include "render/pass/SurfacePass.h"
#include "render/scene/LightBlocks.h"

#include <algorithm>
#include <epoxy/gl.h>
#include <glm/matrix.hpp>

namespace patina::render {
namespace {

constexpr unsigned kShadowDepthUnit = 10, kNearestUnit = 11,
                   kRangeUnit = 12;            // of the surface shader
constexpr unsigned kImageUnit = 0;             // of the pyramid's
constexpr int kRangeSize = kShadowMapSize / 2; // level 0 of the pyramid, per map
constexpr int kRangeLevels = 10;               // 512 … 1
constexpr int kGroup = 8;                      // threads along a side of a group
static_assert(kRangeSize >> (kRangeLevels - 1) == 1);

gl::Handle<deleteSampler> makeComparison() {
    GLuint id = 0;
    glCreateSamplers(1, &id);
    glSamplerParameteri(id, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glSamplerParameteri(id, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    glSamplerParameteri(id, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glSamplerParameteri(id, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glSamplerParameteri(id, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glSamplerParameteri(id, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glObjectLabel(GL_SAMPLER, id, -1, "shadow comparison");
    return gl::Handle<deleteSampler>(id);
}

} // namespace

void deleteSampler(unsigned id) {
    glDeleteSamplers(1, &id);
}

ShadowPass::ShadowPass(gl::Context& context, ShaderLibrary& shaders)
    : m_context(context)
    , m_shaders(shaders)
    , m_frameBlock(context, "shadow frame", sizeof(FrameBlock))
    , m_shadowBlock(context, "shadows", sizeof(ShadowBlocks))
    , m_compare(makeComparison()) {}

Result<void> ShadowPass::compile() {
    for (const ProgramKey& key : {ProgramKey{{"surface.vert", "shadow.frag"}, {}},
                                  ProgramKey{{"shadowrange.comp"}, {"FROM_DEPTH"}}})
        if (auto made = m_shaders.program(key); !made)
            return made.error();
    return {};
}

Result<void> ShadowPass::resize(int columns, int rows) {
    if (m_depth.width() == columns * kShadowMapSize && m_depth.height() == rows * kShadowMapSize)
        return {};
    m_target = {};
    m_depth = gl::Texture(m_context, "shadow maps",
                          {.format = gl::PixelFormat::Depth32f,
                           .width = columns * kShadowMapSize,
                           .height = rows * kShadowMapSize});
    m_depth.setSampling(gl::Filter::Nearest, gl::Wrap::Clamp);
    for (auto [texture, label] :
         {std::pair{&m_nearest, "shadow pyramid"}, {&m_range, "shadow pyramid, dilated"}}) {
        *texture = gl::Texture(m_context, label,
                               {.format = gl::PixelFormat::Rg32f,
                                .width = columns * kRangeSize,
                                .height = rows * kRangeSize,
                                .levels = kRangeLevels});
        texture->setSampling(gl::Filter::Nearest, gl::Wrap::Clamp);
        glTextureParameteri(texture->id(), GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
    }
    for (Slot& slot : m_slots)
        slot.drawn = false;
    auto target = gl::Framebuffer::create(m_context, "shadow maps", {}, &m_depth);
    if (!target)
        return target.error();
    m_target = std::move(*target);
    return {};
}

Result<void> ShadowPass::update(const GpuScene& scene) {
    const std::vector<const Light*> lights = castingLights(scene.document());
    m_lightCount = std::min(lights.size(), std::size_t{kMaxShadows});
    if (m_lightCount == 0)
        return {};
    const int columns = m_lightCount > 1 ? 2 : 1, rows = m_lightCount > 2 ? 2 : 1;
    if (auto done = resize(columns, rows); !done)
        return done;

    ShadowBlocks blocks;
    for (std::size_t i = 0; i < m_lightCount; ++i) {
        m_lights[i] = lights[i]->id;
        const ShadowView view = shadowView(*lights[i], scene.bounds(), kShadowMapSize);
        const int column = static_cast<int>(i) % columns, row = static_cast<int>(i) / columns;
        ShadowBlock& block = blocks[i];
        block.worldToMap = view.worldToMap;
        block.planeToMap = glm::transpose(glm::inverse(view.worldToMap));
        const bool spot = lights[i]->type == LightType::Spot;
        block.light = spot ? glm::vec4(lights[i]->position, 1.0f)
                           : glm::vec4(lights[i]->directionToLight(), 0.0f);
        block.tile = {static_cast<float>(column) / static_cast<float>(columns),
                      static_cast<float>(row) / static_cast<float>(rows),
                      1.0f / static_cast<float>(columns), 1.0f / static_cast<float>(rows)};
        block.penumbra = view.penumbra;
        block.texelDepth = view.texelDepth;
        block.maxSlope = view.maxSlope;
        block.texel = view.empty ? 0.0f : 1.0f / static_cast<float>(kShadowMapSize);

        Slot& slot = m_slots[i];
        if (!view.empty && (!slot.drawn || slot.shapeRevision != scene.shapeRevision() ||
                            slot.view.worldToClip != view.worldToClip)) {
            if (auto done = drawMap(scene, view, column * kShadowMapSize, row * kShadowMapSize);
                !done)
                return done;
            if (auto done = drawPyramid(column * kRangeSize, row * kRangeSize); !done)
                return done;
            slot = {view, scene.shapeRevision(), true};
            ++m_mapsDrawn;
        }
    }
    m_shadowBlock.writeValue(blocks);
    return {};
}

Result<void> ShadowPass::drawMap(const GpuScene& scene, const ShadowView& view, int x, int y) {
    FrameBlock frame;
    frame.worldToClip = view.worldToClip;
    m_frameBlock.writeValue(frame);
    m_frameBlock.bindUniform(kFrameBinding);
    m_target.bind();
    glViewport(x, y, kShadowMapSize, kShadowMapSize);
    glScissor(x, y, kShadowMapSize, kShadowMapSize);
    glEnable(GL_SCISSOR_TEST);
    glDepthMask(GL_TRUE);
    m_target.clearDepth(1.0f);
    glDisable(GL_SCISSOR_TEST);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    for (const DrawItem& item : scene.items()) {
        // Glass and other blended surfaces let light through.
        if (item.material->alphaMode == AlphaMode::Blend ||
            !insideFrustum(item.bounds, view.worldToClip))
            continue;
        const SurfaceFeatures features = coverageFeatures(item.material->features);
        const auto shader =
            m_shaders.program({{"surface.vert", "shadow.frag"}, surfaceDefines(features)});
        if (!shader)
            return shader.error();
        (*shader)->use();
        bindMap(*item.material, MaterialInput::BaseColor);
        drawItem(item, false); // meshes need not be closed
    }
    return {};
}

Result<void> ShadowPass::drawPyramid(int x, int y) {
    const auto reduce = [&](const char* define, const gl::Texture& from, int fromLevel,
                            const gl::Texture& to, int level) -> Result<void> {
        const auto shader = m_shaders.program({{"shadowrange.comp"}, {define}});
        if (!shader)
            return shader.error();
        (*shader)->use();
        from.bind(0);
        glBindImageTexture(kImageUnit, to.id(), level, GL_FALSE, 0, GL_WRITE_ONLY, GL_RG32F);
        const int size = kRangeSize >> level;
        (*shader)->set("u_fromLevel", fromLevel);
        (*shader)->set("u_firstX", x >> level);
        (*shader)->set("u_firstY", y >> level);
        (*shader)->set("u_size", size);
        const auto groups = static_cast<GLuint>((size + kGroup - 1) / kGroup);
        glDispatchCompute(groups, groups, 1);
        glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
        return {};
    };
    for (int level = 0; level < kRangeLevels; ++level) {
        auto done = level == 0 ? reduce("FROM_DEPTH", m_depth, 0, m_nearest, 0)
                               : reduce("FROM_PYRAMID", m_nearest, level - 1, m_nearest, level);
        if (done)
            done = reduce("DILATE", m_nearest, level, m_range, level);
        if (!done)
            return done;
    }
    return {};
}

void ShadowPass::bind() const {
    if (m_lightCount == 0)
        return;
    m_depth.bind(kShadowDepthUnit);
    glBindSampler(kShadowDepthUnit, m_compare.id());
    m_nearest.bind(kNearestUnit);
    m_range.bind(kRangeUnit);
    m_shadowBlock.bindUniform(kShadowBinding);
}

void ShadowPass::unbind() const {
    glBindSampler(kShadowDepthUnit, 0);
}

} // namespace patina::render
