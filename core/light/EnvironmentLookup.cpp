#include "core/light/EnvironmentLookup.h"

#include "core/base/Check.h"
#include "core/light/CubeSampling.h"
#include "core/light/Cubemap.h"
#include "core/light/Environment.h"
#include "core/light/EnvironmentMapping.h"
#include "core/math/Shading.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

namespace patina {
namespace {

constexpr double kBelowZero = 1e-3; // of the RMS: smaller dips are rounding

} // namespace

void EnvironmentLookup::setScale(const glm::vec3& all) {
    scale = std::max({all.x, all.y, all.z});
    tint = scale > 0.0f ? all / scale : glm::vec3(1.0f);
}

std::optional<glm::vec3> EnvironmentLookup::radiance(const glm::vec3& world) const {
    if (!analysis)
        return std::nullopt;
    const Image& picture = *analysis->environment;
    const EnvironmentMapping mapping =
        EnvironmentMapping::create(EnvironmentLayout::LatLong, {picture.width(), picture.height()})
            .value();
    return tint * scale * mapping.lookup(picture, orientation.toPicture(world));
}

std::optional<glm::vec3> EnvironmentLookup::bandSum(int bands, const glm::vec3& world) const {
    if (!analysis)
        return std::nullopt;
    return tint * scale * shSum(analysis->bands.coefficients, bands, orientation.toPicture(world));
}

std::optional<glm::vec3> EnvironmentLookup::prefiltered(float perceptualRoughness,
                                                        const glm::vec3& world) const {
    if (!maps)
        return std::nullopt;
    const LevelPair levels = levelsOf(*maps, perceptualRoughness);
    return tint * scale *
           sampleCubes(maps->prefiltered[levels.first], maps->prefiltered[levels.second],
                       levels.share, orientation.toPicture(world));
}

std::optional<glm::vec3> EnvironmentLookup::irradiance(const glm::vec3& normal) const {
    if (!maps)
        return std::nullopt;
    return tint * scale * sampleIrradiance(*maps, orientation.toPicture(normal));
}

std::optional<glm::vec3> EnvironmentLookup::irradianceSh9(const glm::vec3& normal) const {
    if (!maps)
        return std::nullopt;
    return tint * scale *
           shading::irradianceFromSh9(maps->irradianceSh.data(), orientation.toPicture(normal));
}

double EnvironmentLookup::rms() const {
    CHECK(analysis != nullptr);
    return analysis->bands.rms * static_cast<double>(scale);
}

BandSumError EnvironmentLookup::bandSumError(int bands) const {
    CHECK(analysis != nullptr);
    CHECK(bands >= 1 && bands <= kMaxShOrder);
    const ShBandSum& sum = analysis->bands.sums[static_cast<std::size_t>(bands - 1)];
    const double rms = analysis->bands.rms;
    const auto all = static_cast<double>(scale);
    const auto lowest = static_cast<double>(sum.lowest);
    return {all * sum.rmse, rms > 0.0 ? sum.rmse / rms : 0.0, all * lowest,
            orientation.toWorld(sum.lowestDirection), lowest < -kBelowZero * rms};
}

double irradianceError(const IblMaps& maps) {
    const CubeLevel& exact = maps.prefiltered.back();
    const std::vector<float> solidAngles = cubeSolidAngles(exact.size);
    double difference = 0.0, all = 0.0;
    for (int face = 0; face < 6; ++face)
        for (int y = 0; y < exact.size; ++y)
            for (int x = 0; x < exact.size; ++x) {
                const auto n = static_cast<float>(exact.size);
                const glm::vec3 d = glm::normalize(cubeDirection(
                    face, (static_cast<float>(x) + 0.5f) / n, (static_cast<float>(y) + 0.5f) / n));
                const glm::dvec3 e(std::numbers::pi_v<float> * cubeTexel(exact, face, x, y));
                const glm::dvec3 nine(shading::irradianceFromSh9(maps.irradianceSh.data(), d));
                const double weight =
                    static_cast<double>(solidAngles[static_cast<std::size_t>(y * exact.size + x)]);
                difference += weight * glm::dot(nine - e, nine - e);
                all += weight * glm::dot(e, e);
            }
    return all > 0.0 ? std::sqrt(difference / all) : 0.0;
}

} // namespace patina
