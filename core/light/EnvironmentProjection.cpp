#include "core/light/EnvironmentProjection.h"

#include "core/base/Check.h"
#include "core/math/ShSampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace patina {
namespace {

// Samples per side of the square.
int sideOf(int samples) {
    int side = static_cast<int>(std::sqrt(static_cast<double>(samples)));
    while (side * side < samples)
        ++side;
    return side;
}

} // namespace

int environmentSamples(ShMethod method, int samples) {
    return method == ShMethod::Stratified ? sideOf(samples) * sideOf(samples) : samples;
}

std::vector<glm::vec3> projectEnvironment(const Image& environment, int order, ShMethod method,
                                          int samples, const JobContext& job) {
    if (method == ShMethod::Exact)
        return projectLatLong(environment, order, job);
    CHECK(samples >= 1 && samples <= 1 << 28);
    const int width = environment.width(), height = environment.height();
    const auto channels = static_cast<std::size_t>(environment.channels());
    const std::span<const float> texels = environment.f32();
    // The conventions of patina::Environment: u = 0.5 + atan2(x, -z) / 2 pi, v = acos(y) / pi.
    const SphereFunction radiance = [&](const glm::vec3& d) {
        constexpr float kPi = std::numbers::pi_v<float>;
        const float u = 0.5f + std::atan2(d.x, -d.z) / (2.0f * kPi);
        const float v = std::acos(std::clamp(d.y, -1.0f, 1.0f)) / kPi;
        const int x = std::clamp(static_cast<int>(u * static_cast<float>(width)), 0, width - 1);
        const int y = std::clamp(static_cast<int>(v * static_cast<float>(height)), 0, height - 1);
        const float* texel =
            texels.data() + (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                             static_cast<std::size_t>(x)) *
                                channels;
        return glm::vec3(texel[0], texel[1], texel[2]);
    };
    return method == ShMethod::Stratified
               ? projectStratified(radiance, order, sideOf(samples), 0, job)
               : projectSobol(radiance, order, static_cast<std::uint32_t>(samples), 0, job);
}

} // namespace patina
