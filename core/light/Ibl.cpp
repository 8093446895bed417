#include "core/light/Ibl.h"

#include "core/base/Check.h"
#include "core/light/Cubemap.h"
#include "core/light/Prefilter.h"
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

Result<IblMaps> computeIbl(const Image& environment, const IblSettings& settings,
                           const JobContext& job) {
    CHECK(environment.type() == PixelType::F32);
    CHECK_LE(3, environment.channels());
    CHECK(settings.cubeSize > 0 && std::has_single_bit(static_cast<unsigned>(settings.cubeSize)));
    CHECK(settings.levels >= 2 && settings.levels <= 16);
    CHECK(settings.smallestLevel > 0 &&
          std::has_single_bit(static_cast<unsigned>(settings.smallestLevel)));
    const Error cancelled{ErrorKind::Cancelled, "The image-based light was cancelled.", {}, {}};

    IblMaps maps;

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
        return std::max(settings.cubeSize >> level,
                        std::min(settings.cubeSize, settings.smallestLevel));
    };
    double done = 0.0, total = 0.0; // texels of a face
    for (int i = 1; i < settings.levels; ++i)
        total += sideOf(i) * sideOf(i);
    for (int i = 1; i < settings.levels; ++i) {
        const float perceptualRoughness =
            static_cast<float>(i) / static_cast<float>(settings.levels - 1);
        // The largest level costs three quarters of the time; far from its narrow lobe finer cells
        // gain least. Cells are 2^-k wide: by default 1/16 there, 1/32 elsewhere.
        const float widest = (i == 1 ? 0.7f : 0.35f) * settings.cellSize;
        maps.prefiltered.push_back(prefilterGGX(pyramid, sideOf(i),
                                                perceptualRoughness * perceptualRoughness,
                                                {settings.cellSize, widest}, job));
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
