#include "core/light/LightSides.h"

#include "core/light/EnvironmentResample.h"
#include "core/light/LatLongGrid.h"
#include "core/math/Shading.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace patina {

LightSides::LightSides(const Image& environment) {
    constexpr int kWidth = 64;
    const Image small = shrinkLatLong(environment, kWidth);
    const LatLongGrid grid(small.width(), small.height());
    for (int y = 0; y < grid.height(); ++y)
        for (int x = 0; x < grid.width(); ++x) {
            const glm::vec4 radiance = small.linear(x, y);
            const double light = shading::luminance(shading::finiteRadiance(glm::vec3(radiance)));
            if (light > 0.0)
                m_patches.push_back({grid.direction(x, y), light * grid.solidAngle(y)});
        }
}

double LightSides::irradiance(const glm::dvec3& normal) const {
    double sum = 0.0;
    for (const Patch& patch : m_patches)
        sum += patch.light * std::max(0.0, glm::dot(patch.direction, normal));
    return sum;
}

double LightSides::irradianceAway(const glm::dvec3& normal) const {
    double sum = 0.0;
    for (const Patch& patch : m_patches)
        sum += patch.light * (1.0 - glm::dot(patch.direction, normal));
    return 0.25 * sum;
}

// The best of a coarse grid, then ever smaller steps from there.
LitSide LightSides::extreme(double sign) const {
    const LatLongGrid coarse(12);
    LitSide best{{0.0, -1.0, 0.0}, irradiance({0.0, -1.0, 0.0})};
    const auto offer = [&](const glm::dvec3& normal) {
        const double value = irradiance(normal);
        if (!(sign * value < sign * best.irradiance))
            return false;
        best = {normal, value};
        return true;
    };
    for (int y = 0; y < coarse.height(); ++y)
        for (int x = 0; x < coarse.width(); ++x)
            offer(coarse.direction(x, y));
    for (double step = 0.13; step > 0.002;) { // radians
        const glm::dvec3 from = best.normal;
        const glm::dvec3 across =
            std::abs(from.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
        const glm::dvec3 right = glm::normalize(glm::cross(across, from)),
                         up = glm::cross(from, right);
        bool moved = false;
        for (const glm::dvec3& way : {right, -right, up, -up})
            moved = offer(glm::normalize(from + step * way)) || moved;
        if (!moved)
            step *= 0.5;
    }
    return best;
}

} // namespace patina
