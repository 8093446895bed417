#include "core/light/Ibl.h"

#include "core/base/Check.h"
#include "core/light/Cubemap.h"
#include "core/light/Prefilter.h"
#include "core/math/Shading.h"
#include "core/math/SphericalHarmonics.h"

#include <algorithm>
#include <bit>
#include <numbers>

namespace patina {

std::size_t memoryBytes(const IblMaps& maps) {
    std::size_t texels = maps.irradiance.texels.size();
    for (const CubeLevel& level : maps.prefiltered)
        texels += level.texels.size();
    return sizeof(IblMaps) + texels * sizeof(glm::vec3);
}

namespace {

constexpr int kMostLevels = 32;

// The narrower a lobe is, the less of its light comes from cells far away: they may be wider, where
// levels have the most texels.
PrefilterQuality levelQuality(const IblSettings& settings, float perceptualRoughness, int side) {
    const float cell = settings.cellSize;
    if (settings.spacing == LevelSpacing::Even) // one level of each size: the largest counts
        return {cell, (2 * side == settings.cubeSize ? 0.7f : 0.35f) * cell};
    const float relative = std::min(cell * std::max(1.0f, 0.27f / perceptualRoughness), 0.5f);
    return {relative, 0.7f * relative};
}

} // namespace

float levelRoughness(LevelSpacing spacing, int level, int levels, int cubeSize) {
    if (spacing == LevelSpacing::Even)
        return static_cast<float>(level) / static_cast<float>(levels - 1);
    return shading::prefilteredRoughness(level, levels, static_cast<float>(cubeSize));
}

int levelSide(LevelSpacing spacing, int level, int cubeSize) {
    if (spacing == LevelSpacing::Even)
        return std::max(cubeSize >> level, 1);
    return static_cast<int>(shading::cubeLevelSide(level, static_cast<float>(cubeSize)));
}

LevelPair levelsOf(const IblMaps& maps, float perceptualRoughness) {
    const int count = static_cast<int>(maps.prefiltered.size());
    CHECK_LE(1, count);
    const float level =
        maps.spacing == LevelSpacing::Even
            ? std::clamp(perceptualRoughness, 0.0f, 1.0f) * static_cast<float>(count - 1)
            : shading::prefilteredLevel(perceptualRoughness, count,
                                        static_cast<float>(maps.prefiltered.front().size));
    const auto first = static_cast<std::size_t>(level);
    return {first, std::min(first + 1, maps.prefiltered.size() - 1),
            level - static_cast<float>(first)};
}

Result<IblMaps> computeIbl(const Image& environment, const IblSettings& settings,
                           const JobContext& job) {
    CHECK(environment.type() == PixelType::F32);
    CHECK_LE(3, environment.channels());
    CHECK(settings.cubeSize > 0 && std::has_single_bit(static_cast<unsigned>(settings.cubeSize)));
    CHECK(settings.levels >= 2 && settings.levels <= kMostLevels);
    const Error cancelled{ErrorKind::Cancelled, "The image-based light was cancelled.", {}, {}};

    IblMaps maps;
    maps.spacing = settings.spacing;

    // Spherical harmonics straight from the lat-long image: no resampling error.
    job.setActivity("projecting the environment");
    const std::vector<glm::vec3> radiance = projectLatLong(environment, kMaxShOrder, job);
    std::ranges::copy(radiance, maps.radianceSh.begin());
    std::copy_n(radiance.begin(), 9, maps.irradianceSh.begin());
    convolveWithCosine(maps.irradianceSh);
    if (job.cancelled())
        return cancelled;
    job.setProgress(0.05);

    // Level 0 is the environment itself.
    job.setActivity("building the cubemap");
    maps.prefiltered.push_back(cubeFromLatLong(environment, settings.cubeSize, job));
    if (job.cancelled())
        return cancelled;
    const CubePyramid pyramid(maps.prefiltered.front());
    job.setProgress(0.2);

    job.setActivity("filtering reflections");
    const auto sideOf = [&](int level) {
        return levelSide(settings.spacing, level, settings.cubeSize);
    };
    double done = 0.0, total = 0.0; // texels of a face
    for (int i = 1; i < settings.levels; ++i)
        total += sideOf(i) * sideOf(i);
    for (int i = 1; i < settings.levels; ++i) {
        const float r = levelRoughness(settings.spacing, i, settings.levels, settings.cubeSize);
        maps.prefiltered.push_back(
            prefilterGGX(pyramid, sideOf(i), r * r, levelQuality(settings, r, sideOf(i)), job));
        if (job.cancelled())
            return cancelled;
        done += sideOf(i) * sideOf(i);
        job.setProgress(0.2 + 0.8 * done / total);
    }

    // At alpha = 1 the lobe is the clamped cosine.
    if (settings.irradianceSize > 0) {
        maps.irradiance = prefilterGGX(pyramid, settings.irradianceSize, 1.0f,
                                       {settings.cellSize, 0.7f * settings.cellSize}, job);
        for (glm::vec3& texel : maps.irradiance.texels)
            texel *= std::numbers::pi_v<float>;
        if (job.cancelled())
            return cancelled;
    }
    return maps;
}

} // namespace patina
