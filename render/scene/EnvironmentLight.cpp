#include "render/scene/EnvironmentLight.h"

#include "core/base/Check.h"
#include "core/base/Log.h"
#include "core/light/DominantLight.h"
#include "core/math/ShRotation.h"
#include "core/mix/TransferLight.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <span>
#include <utility>

namespace patina::render {

namespace {

constexpr float kGreySky = 0.5f; // radiance that lights the scene before an environment is ready
constexpr std::uint16_t kGreyHalf = 0x3800, kOneHalf = 0x3c00; // 0.5 and 1

gl::Texture makePrefiltered(gl::Context& context, const HalfPicture& atlas) {
    gl::Texture texture(
        context, "prefiltered environment",
        {.format = gl::PixelFormat::Rgba16f, .width = atlas.width, .height = atlas.height});
    texture.setSampling(gl::Filter::Linear, gl::Wrap::Clamp);
    return texture;
}

// Pictures larger than textures may be are shown by the first of their mipmaps that is not.
std::span<const HalfPicture> fittingLevels(const gl::Context& context, const HalfMipmaps& picture) {
    const int limit = context.info().maxTextureSize;
    const auto first = std::ranges::find_if(picture, [&](const HalfPicture& level) {
        return std::max(level.width, level.height) <= limit;
    });
    return {first, picture.end()};
}

gl::Texture makeBackground(gl::Context& context, std::span<const HalfPicture> levels) {
    gl::Texture texture(context, "background",
                        {.format = gl::PixelFormat::Rgba16f,
                         .width = levels[0].width,
                         .height = levels[0].height,
                         .levels = static_cast<int>(levels.size())});
    texture.setSampling(gl::Filter::Trilinear, gl::Wrap::RepeatU);
    return texture;
}

} // namespace

void packIrradiance(const std::array<glm::vec3, 9>& coefficients, FrameBlock& frame) {
    constexpr float kLargest = 32767.0f;
    float largest = 0.0f;
    for (const glm::vec3& c : coefficients)
        for (int channel = 0; channel < 3; ++channel)
            largest = std::max(largest, std::abs(c[channel] * frame.radianceScale[channel]));
    frame.irradianceScale = largest / kLargest;
    frame.irradianceSh.fill(glm::uvec4(0));
    if (largest == 0.0f)
        return;
    for (int k = 0; k < 27; ++k) {
        const float value = coefficients[static_cast<std::size_t>(k / 3)][k % 3] *
                            frame.radianceScale[k % 3] / largest;
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
    const auto grey = std::make_shared<const HalfMipmaps>(
        HalfMipmaps{{1, 1, {kGreyHalf, kGreyHalf, kGreyHalf, kOneHalf}}});
    set(makeEnvironmentTexels(nullptr, uniformIbl(glm::vec3(kGreySky)), grey));
}

void EnvironmentLight::set(const EnvironmentTexels& texels) {
    // Not owned: it is gone from m_arriving when this returns.
    begin(EnvironmentTexelsPtr(EnvironmentTexelsPtr(), &texels));
    proceed(std::numeric_limits<std::size_t>::max());
}

void EnvironmentLight::setIbl(const IblMaps& maps) {
    set(makeEnvironmentTexels(m_textures.image, maps, nullptr));
}

void EnvironmentLight::begin(EnvironmentTexelsPtr texels) {
    Arriving next{texels, {makePrefiltered(m_context, texels->prefiltered)}, std::nullopt};
    const bool shown = texels->image == m_textures.image && m_textures.background;
    if (m_arriving && m_arriving->background && m_arriving->texels->image == texels->image)
        next.background = std::move(m_arriving->background);
    else if (!shown)
        next.background =
            Filling{makeBackground(m_context, fittingLevels(m_context, *texels->background))};
    m_arriving = std::move(next);
}

void EnvironmentLight::share(const EnvironmentTextures& textures) {
    m_arriving.reset();
    adopt(textures);
}

void EnvironmentLight::adopt(EnvironmentTextures textures) {
    m_textures = std::move(textures);
    if (m_textures.image)
        setProjection(m_textures.image, m_textures.radianceSh);
    if (m_wanted.image == m_textures.image)
        m_shown = m_wanted;
}

bool EnvironmentLight::proceed(std::size_t bytes) {
    CHECK(bytes > 0);
    // Returns whether all of the texture is filled.
    const auto fill = [&bytes](Filling& filling, std::span<const HalfPicture> levels) {
        while (filling.level < filling.texture.levels()) {
            if (bytes == 0)
                return false;
            const HalfPicture& level = levels[static_cast<std::size_t>(filling.level)];
            const std::size_t rowTexels = 4 * static_cast<std::size_t>(level.width);
            const std::size_t rowBytes = rowTexels * sizeof(std::uint16_t);
            const int rows =
                static_cast<int>(std::clamp(bytes / rowBytes, std::size_t{1},
                                            static_cast<std::size_t>(level.height - filling.row)));
            filling.texture.uploadRows(filling.level, filling.row, rows, 4, gl::SampleType::F16,
                                       level.texels.data() +
                                           static_cast<std::size_t>(filling.row) * rowTexels);
            bytes -= std::min(bytes, static_cast<std::size_t>(rows) * rowBytes);
            filling.row += rows;
            if (filling.row == level.height) {
                ++filling.level;
                filling.row = 0;
            }
        }
        return true;
    };
    if (!m_arriving)
        return true;
    const EnvironmentTexels& texels = *m_arriving->texels;
    if (!fill(m_arriving->prefiltered, std::span(&texels.prefiltered, 1)) ||
        (m_arriving->background &&
         !fill(*m_arriving->background, fittingLevels(m_context, *texels.background))))
        return false;

    // All there: from now on it is what is seen.
    const auto shared = [](Filling& filling) {
        return std::make_shared<const gl::Texture>(std::move(filling.texture));
    };
    EnvironmentTextures all;
    all.prefiltered = shared(m_arriving->prefiltered);
    all.background =
        m_arriving->background ? shared(*m_arriving->background) : m_textures.background;
    all.source = m_arriving->texels;
    all.image = texels.image;
    all.irradianceSh = texels.irradianceSh;
    all.radianceSh = texels.radianceSh;
    all.side = texels.side;
    all.levels = texels.levels;
    all.irradianceSide = texels.irradianceSide;
    all.irradianceTop = texels.irradianceTop;
    all.clamped = texels.clamped;
    m_arriving.reset();
    adopt(std::move(all));
    if (m_textures.clamped > 0)
        logInfo("{} texels of the environment exceed 65504 and were limited", m_textures.clamped);
    return true;
}

std::size_t EnvironmentTextures::bytes() const {
    return prefiltered->memoryBytes() + background->memoryBytes();
}

std::size_t EnvironmentLight::memoryBytes() const {
    std::size_t bytes = m_textures.bytes();
    if (m_arriving) {
        bytes += m_arriving->prefiltered.texture.memoryBytes();
        if (m_arriving->background)
            bytes += m_arriving->background->texture.memoryBytes();
    }
    return bytes;
}

void EnvironmentLight::show(const EnvironmentPart& part) {
    m_wanted = part;
    // Pictures of one role follow each other (drafts of a sky): the turn goes on meanwhile.
    if (part.role == m_shown.role || part.image == m_textures.image)
        m_shown = part;
}

void EnvironmentLight::fill(FrameBlock& frame) const {
    const Orientation& stands = m_shown.orientation;
    frame.radianceScale = scale();
    frame.prefilteredLevels = m_textures.levels;
    frame.prefilteredSide = static_cast<float>(m_textures.side);
    frame.irradianceSide = static_cast<float>(m_textures.irradianceSide);
    frame.irradianceTop = static_cast<float>(m_textures.irradianceTop);
    // A world direction is looked up where it lies in the picture.
    frame.worldToEnvironment = glm::mat4(glm::transpose(glm::mat3(stands.matrix())));

    std::array<glm::vec3, 9> irradiance{};
    stands.harmonics(3).apply(std::span<const glm::vec3>(m_textures.irradianceSh),
                              std::span<glm::vec3>(irradiance));
    packIrradiance(irradiance, frame);
    const DominantLight light = dominantLight(irradiance);
    frame.dominantLight = glm::vec4(light.toLight, 0.0f);
    frame.dominantIrradiance = glm::vec4(frame.radianceScale * light.irradiance, 0.0f);
}

glm::vec3 EnvironmentLight::scale() const {
    return m_wanted.scale == glm::vec3(0.0f) ? m_wanted.scale : m_shown.scale;
}

void EnvironmentLight::setProjection(const ImagePtr& image, const ProjectionSh& coefficients) {
    std::erase_if(m_projections, [](const auto& entry) { return entry.first.expired(); });
    m_projections.insert_or_assign(image, coefficients);
}

bool EnvironmentLight::knowsProjection(const ImagePtr& image) const {
    return m_projections.contains(image);
}

std::vector<glm::vec3> EnvironmentLight::transferLight(std::span<const EnvironmentPart> parts,
                                                       int order) const {
    const auto known = [this](const EnvironmentPart& part) -> std::span<const glm::vec3> {
        const auto found = m_projections.find(part.image);
        if (found == m_projections.end())
            return {};
        return found->second;
    };
    if (!parts.empty())
        if (auto light = environmentLight(parts, order, known))
            return std::move(*light);
    EnvironmentPart shown = m_shown;
    shown.scale = scale();
    return *environmentLight(std::span(&shown, 1), order,
                             [this](const EnvironmentPart&) -> std::span<const glm::vec3> {
                                 return m_textures.radianceSh;
                             });
}

} // namespace patina::render
