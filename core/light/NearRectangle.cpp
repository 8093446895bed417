#include "core/light/NearRectangle.h"

#include "core/base/Check.h"
#include "core/math/ShRotation.h"
#include "core/math/Shading.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

namespace patina {
namespace {

// Columns of m = 0 are left out: nothing is there.
std::array<float, kRectangleTurnSize> turn(const glm::dvec3& x, const glm::dvec3& y,
                                           const glm::dvec3& z) {
    const ShRotation rotation(glm::dmat3(x, y, z), kMaxShOrder);
    std::array<float, kRectangleTurnSize> elements{};
    std::size_t next = 0;
    for (int l = 1; l < kMaxShOrder; ++l)
        for (int row = -l; row <= l; ++row)
            for (int m = -l; m <= l; ++m)
                if (m != 0)
                    elements[next++] = static_cast<float>(rotation.element(l, row, m));
    return elements;
}

glm::dvec3 anyPerpendicular(const glm::dvec3& unit) {
    const glm::dvec3 other =
        std::abs(unit.x) < 0.5 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    return glm::normalize(glm::cross(unit, other));
}

// In metres. A document may set a side to 0, which has no direction: what stands in for it is so
// small that nothing is lit by it. Its square is a normal float.
constexpr double kLeastHalf = 1e-12;

} // namespace

NearRectangle nearRectangle(const glm::vec3& center, const glm::vec3& halfX,
                            const glm::vec3& halfY) {
    NearRectangle rectangle;
    rectangle.center = center;
    const double lengthX = glm::length(glm::dvec3(halfX));
    const double lengthY = glm::length(glm::dvec3(halfY));
    rectangle.halfX = static_cast<float>(std::max(lengthX, kLeastHalf));
    rectangle.halfY = static_cast<float>(std::max(lengthY, kLeastHalf));
    const bool hasX = lengthX >= kLeastHalf, hasY = lengthY >= kLeastHalf;
    const glm::dvec3 x = hasX   ? glm::dvec3(halfX) / lengthX
                         : hasY ? anyPerpendicular(glm::dvec3(halfY) / lengthY)
                                : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 normal =
        hasY ? glm::normalize(glm::cross(x, glm::dvec3(halfY))) : anyPerpendicular(x);
    const glm::dvec3 y = glm::cross(normal, x);
    rectangle.x = glm::vec3(x);
    rectangle.y = glm::vec3(y);
    rectangle.normal = glm::vec3(normal);
    rectangle.turnFirst = turn(y, normal, x);
    rectangle.turnSecond = turn(normal, x, y);
    return rectangle;
}

void projectRectangle(const NearRectangle& rectangle, const glm::vec3& place, int order,
                      const std::array<float, kMaxShOrder>& window, std::span<float> out) {
    CHECK(order >= 1 && order <= kMaxShOrder);
    CHECK(out.size() >= static_cast<std::size_t>(shCount(order)));
    const glm::vec3 toCenter = rectangle.center - place;
    std::array<float, 64> first{}, second{}, sum{};
    const float seen = shading::rectangleSh(
        {glm::dot(toCenter, rectangle.x), glm::dot(toCenter, rectangle.y),
         glm::dot(toCenter, rectangle.normal)},
        {rectangle.halfX, rectangle.halfY}, order, first.data(), second.data());
    const float solidAngle = std::abs(seen);
    if (seen < 0.0f) {
        shading::shBasis64(glm::normalize(toCenter), sum.data());
        for (float& value : sum)
            value *= solidAngle;
    } else if (seen > 0.0f) {
        sum[0] = 0.282094791773878f * solidAngle; // Y_00
        std::size_t next = 0;
        for (int l = 1; l < order; ++l)
            for (int row = -l; row <= l; ++row)
                for (int m = -l; m <= l; ++m) {
                    if (m == 0)
                        continue;
                    const auto from = static_cast<std::size_t>(shIndex(l, m));
                    sum[static_cast<std::size_t>(shIndex(l, row))] +=
                        rectangle.turnFirst[next] * first[from] +
                        rectangle.turnSecond[next] * second[from];
                    ++next;
                }
    }
    std::array<float, 8> factor{};
    shading::rectangleFactors(solidAngle, order, window.data(), factor.data());
    shading::scaleBands(order, factor.data(), sum.data());
    std::copy_n(sum.begin(), shCount(order), out.begin());
}

} // namespace patina
