#include "render/scene/EnvironmentLight.h"

#include "core/base/Check.h"
#include "core/base/Log.h"
#include "core/light/CubeAtlas.h"
#include "core/math/SphericalHarmonics.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <utility>

namespace patina::render {

namespace {

constexpr float kLargestHalf = 65504.0f;
constexpr float kGreySky = 0.5f; // radiance that lights the scene before an environment is ready

// Half floats hold up to 65504: more would become infinite and spread.
glm::vec3 clampToHalf(const glm::vec3& texel) {
    return glm::min(texel, glm::vec3(kLargestHalf));
}

std::size_t countClamped(const std::vector<CubeLevel>& levels) {
    std::size_t count = 0;
    for (const CubeLevel& level : levels)
        for (const glm::vec3& texel : level.texels)
            count += clampToHalf(texel) != texel ? 1u : 0u;
    return count;
}

gl::Texture makeDfg(gl::Context& context, Distribution distribution, Visibility visibility) {
    const Image table = computeDfgTable(128, distribution, visibility);
    gl::Texture texture(
        context, "DFG table",
        {.format = gl::PixelFormat::Rgba16f, .width = table.width(), .height = table.height()});
    texture.upload(0, table.channels(), gl::SampleType::F32, table.f32().data());
    texture.setSampling(gl::Filter::Linear, gl::Wrap::Clamp);
    return texture;
}

gl::Texture makePrefiltered(gl::Context& context, const CubeAtlas& atlas) {
    gl::Texture texture(
        context, "prefiltered environment",
        {.format = gl::PixelFormat::Rgba16f, .width = atlas.width, .height = atlas.height});
    texture.upload(0, 3, gl::SampleType::F32, atlas.texels.data());
    texture.setSampling(gl::Filter::Linear, gl::Wrap::Clamp);
    return texture;
}

} // namespace

void packIrradiance(const std::array<glm::vec3, 9>& coefficients, FrameBlock& frame) {
    constexpr float kLargest = 32767.0f;
    float largest = 0.0f;
    for (const glm::vec3& c : coefficients)
        largest = std::max({largest, std::abs(c.x), std::abs(c.y), std::abs(c.z)});
    frame.irradianceScale = frame.radianceScale * largest / kLargest;
    frame.irradianceSh.fill(glm::uvec4(0));
    if (largest == 0.0f)
        return;
    for (int k = 0; k < 27; ++k) {
        const float value = coefficients[static_cast<std::size_t>(k / 3)][k % 3] / largest;
        const auto bits = static_cast<std::uint32_t>(std::lround(value * kLargest)) & 0xffffu;
        frame.irradianceSh[static_cast<std::size_t>(k / 8)][k / 2 % 4] |=
            k % 2 == 0 ? bits << 16 : bits;
    }
}

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
    : m_context(context) {
    setModel(ShadingModel{});
    setIbl(uniformIbl(glm::vec3(kGreySky)));
    setBackground(nullptr);
}

void EnvironmentLight::setIbl(const IblMaps& maps) {
    CubeAtlas atlas = makeCubeAtlas(maps.prefiltered);
    for (glm::vec3& texel : atlas.texels)
        texel = clampToHalf(texel);
    m_clampedTexels = countClamped(maps.prefiltered);
    m_prefilteredSide = atlas.side;
    m_prefilteredLevels = atlas.levels;
    m_prefiltered = makePrefiltered(m_context, atlas);
    if (m_clampedTexels > 0)
        logInfo("{} texels of the environment exceed 65504 and were limited", m_clampedTexels);
    m_irradianceSh = maps.irradianceSh;
    m_radianceSh = maps.radianceSh;
}

void EnvironmentLight::setModel(const ShadingModel& model) {
    const std::pair terms(model.distribution, iblVisibility(model.visibility));
    auto known = m_dfgTables.find(terms);
    if (known == m_dfgTables.end())
        known = m_dfgTables.emplace(terms, makeDfg(m_context, terms.first, terms.second)).first;
    m_dfg = &known->second;
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
    // Usually nothing has to be changed, and a copy of a large picture would hold a frame up.
    Image changed;
    const Image* picture = image.get();
    const auto change = [&](Image other) {
        changed = std::move(other);
        picture = &changed;
    };
    if (image->type() != PixelType::F32 || image->encoding() != ColorEncoding::Linear)
        change(convertImage(*image, PixelType::F32, ColorEncoding::Linear));
    const int limit = m_context.info().maxTextureSize;
    if (picture->width() > limit || picture->height() > limit)
        change(shrinkImage(*picture, limit));
    const std::span<const float> values = picture->f32();
    if (std::any_of(values.begin(), values.end(), [](float v) { return v > kLargestHalf; })) {
        change(Image(*picture));
        for (float& value : changed.f32())
            value = std::min(value, kLargestHalf);
    }
    m_background = gl::Texture(m_context, "background",
                               {.format = gl::PixelFormat::Rgba16f,
                                .width = picture->width(),
                                .height = picture->height(),
                                .levels = 0});
    m_background.upload(0, std::min(picture->channels(), 4), gl::SampleType::F32,
                        picture->f32().data());
    m_background.generateMipmaps();
    m_background.setSampling(gl::Filter::Trilinear, gl::Wrap::RepeatU);
}

std::size_t EnvironmentLight::memoryBytes() const {
    std::size_t bytes = m_prefiltered.memoryBytes() + m_background.memoryBytes();
    for (const auto& [terms, table] : m_dfgTables)
        bytes += table.memoryBytes();
    return bytes;
}

void EnvironmentLight::fill(const Environment& environment, FrameBlock& frame) const {
    const float angle = glm::radians(environment.rotationDeg);
    frame.radianceScale = std::exp2(environment.exposureEv);
    frame.prefilteredLevels = m_prefilteredLevels;
    frame.prefilteredSide = static_cast<float>(m_prefilteredSide);
    // The surroundings turn by `angle`, so a world direction is looked up turned back.
    frame.worldToEnvironment = glm::rotate(glm::mat4(1.0f), -angle, glm::vec3(0, 1, 0));

    std::array<glm::vec3, 9> irradiance{};
    std::array<glm::vec3, kMaxTransferCount> radiance{};
    ShRotation::aboutY(angle, 3).apply(std::span<const glm::vec3>(m_irradianceSh),
                                       std::span<glm::vec3>(irradiance));
    ShRotation::aboutY(angle, 5).apply(std::span<const glm::vec3>(m_radianceSh),
                                       std::span<glm::vec3>(radiance));
    packIrradiance(irradiance, frame);
    for (std::size_t i = 0; i < radiance.size(); ++i)
        frame.radianceSh[i] = glm::vec4(frame.radianceScale * radiance[i], 0.0f);
}

} // namespace patina::render
