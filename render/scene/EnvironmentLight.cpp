#include "render/scene/EnvironmentLight.h"

#include "core/base/Check.h"
#include "core/base/Log.h"
#include "core/math/SphericalHarmonics.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

namespace patina::render {

namespace {

constexpr float kLargestHalf = 65504.0f;
constexpr float kGreySky = 0.5f; // radiance that lights the scene before an environment is ready

// Half floats hold up to 65504: more would become infinite and spread. Returns how many changed.
std::size_t clampToHalf(std::span<glm::vec3> texels) {
    std::size_t clamped = 0;
    for (glm::vec3& texel : texels) {
        const glm::vec3 limited = glm::min(texel, glm::vec3(kLargestHalf));
        clamped += limited != texel ? 1u : 0u;
        texel = limited;
    }
    return clamped;
}

gl::Texture makeDfg(gl::Context& context, const ShadingModel& model) {
    const Image table = computeDfgTable(128, model.distribution, iblVisibility(model.visibility));
    gl::Texture texture(
        context, "DFG table",
        {.format = gl::PixelFormat::Rgba16f, .width = table.width(), .height = table.height()});
    texture.upload(0, table.channels(), gl::SampleType::F32, table.f32().data());
    texture.setSampling(gl::Filter::Linear, gl::Wrap::Clamp);
    return texture;
}

gl::Texture makeCube(gl::Context& context, const std::vector<CubeLevel>& levels,
                     std::size_t& clamped) {
    CHECK(!levels.empty());
    gl::Texture cube(context, "prefiltered environment",
                     {.kind = gl::TextureKind::Cube,
                      .format = gl::PixelFormat::Rgba16f,
                      .width = levels[0].size,
                      .height = levels[0].size,
                      .levels = static_cast<int>(levels.size())});
    for (std::size_t level = 0; level < levels.size(); ++level) {
        const int side = std::max(1, levels[0].size >> level);
        CHECK_EQ(levels[level].size, side);
        std::vector<glm::vec3> texels = levels[level].texels;
        const auto face = static_cast<std::size_t>(levels[level].size) *
                          static_cast<std::size_t>(levels[level].size);
        CHECK(texels.size() == 6 * face);
        clamped += clampToHalf(texels);
        for (int i = 0; i < 6; ++i)
            cube.uploadFace(i, static_cast<int>(level), 3, gl::SampleType::F32,
                            texels.data() + static_cast<std::size_t>(i) * face);
    }
    cube.setSampling(gl::Filter::Trilinear, gl::Wrap::Clamp);
    return cube;
}

} // namespace

IblMaps uniformIbl(const glm::vec3& radiance) {
    // L = L_00 Y_00 with Y_00 = 1 / sqrt(4 pi); E = pi L.
    const float l00 = std::sqrt(4.0f * glm::pi<float>());
    IblMaps maps;
    maps.prefiltered.push_back({1, std::vector<glm::vec3>(6, radiance)});
    maps.irradianceSh.fill(glm::vec3(0));
    maps.radianceSh.fill(glm::vec3(0));
    maps.radianceSh[0] = radiance * l00;
    maps.irradianceSh[0] = maps.radianceSh[0] * glm::pi<float>();
    return maps;
}

EnvironmentLight::EnvironmentLight(gl::Context& context)
    : m_context(context)
    , m_dfg(makeDfg(context, m_model)) {
    setIbl(uniformIbl(glm::vec3(kGreySky)));
    setBackground(nullptr);
}

void EnvironmentLight::setIbl(const IblMaps& maps) {
    m_clampedTexels = 0;
    m_prefiltered = makeCube(m_context, maps.prefiltered, m_clampedTexels);
    if (m_clampedTexels > 0)
        logInfo("{} texels of the environment exceed 65504 and were limited", m_clampedTexels);
    m_irradianceSh = maps.irradianceSh;
    m_radianceSh = maps.radianceSh;
}

void EnvironmentLight::setModel(const ShadingModel& model) {
    const bool same = model.distribution == m_model.distribution &&
                      iblVisibility(model.visibility) == iblVisibility(m_model.visibility);
    m_model = model;
    if (!same)
        m_dfg = makeDfg(m_context, model);
}

void EnvironmentLight::setBackground(const ImagePtr& image) {
    if (image == m_backgroundImage && !m_background.empty())
        return;
    m_backgroundImage = image;
    if (!image) {
        const glm::vec3 grey(kGreySky);
        m_background = gl::Texture(m_context, "background",
                                   {.format = gl::PixelFormat::Rgba16f, .width = 1, .height = 1});
        m_background.upload(0, 3, gl::SampleType::F32, &grey);
        return;
    }
    const int limit = m_context.info().maxTextureSize;
    Image picture = convertImage(*image, PixelType::F32, ColorEncoding::Linear);
    if (picture.width() > limit || picture.height() > limit)
        picture = shrinkImage(picture, limit);
    for (float& value : picture.f32())
        value = std::min(value, kLargestHalf);
    m_background = gl::Texture(m_context, "background",
                               {.format = gl::PixelFormat::Rgba16f,
                                .width = picture.width(),
                                .height = picture.height(),
                                .levels = 0});
    m_background.upload(0, std::min(picture.channels(), 4), gl::SampleType::F32,
                        picture.f32().data());
    m_background.generateMipmaps();
    m_background.setSampling(gl::Filter::Trilinear, gl::Wrap::RepeatU);
}

void EnvironmentLight::fill(const Environment& environment, FrameBlock& frame) const {
    const float angle = glm::radians(environment.rotationDeg);
    frame.radianceScale = std::exp2(environment.exposureEv);
    frame.prefilteredLevels = m_prefiltered.levels();
    // The surroundings turn by `angle`, so a world direction is looked up turned back.
    frame.worldToEnvironment = glm::rotate(glm::mat4(1.0f), -angle, glm::vec3(0, 1, 0));

    std::array<glm::vec3, 9> irradiance{};
    std::array<glm::vec3, kMaxTransferCount> radiance{};
    ShRotation::aboutY(angle, 3).apply(std::span<const glm::vec3>(m_irradianceSh),
                                       std::span<glm::vec3>(irradiance));
    ShRotation::aboutY(angle, 5).apply(std::span<const glm::vec3>(m_radianceSh),
                                       std::span<glm::vec3>(radiance));
    for (std::size_t i = 0; i < irradiance.size(); ++i)
        frame.irradianceSh[i] = glm::vec4(frame.radianceScale * irradiance[i], 0.0f);
    for (std::size_t i = 0; i < radiance.size(); ++i)
        frame.radianceSh[i] = glm::vec4(frame.radianceScale * radiance[i], 0.0f);
}

} // namespace patina::render
