#include "core/light/NearRectangle.h"

#include "core/base/Check.h"
#include "core/math/ShRotation.h"
#include "core/math/Shading.h"

#include <algorithm>
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

} // namespace

NearRectangle nearRectangle(const glm::vec3& center, const glm::vec3& halfX,
                            const glm::vec3& halfY) {
    NearRectangle rectangle;
    rectangle.center = center;
    rectangle.halfX = glm::length(halfX);
    rectangle.halfY = glm::length(halfY);
    CHECK(rectangle.halfX > 0.0f && rectangle.halfY > 0.0f);
    const glm::dvec3 x = glm::normalize(glm::dvec3(halfX));
    const glm::dvec3 normal = glm::normalize(glm::cross(x, glm::dvec3(halfY)));
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
