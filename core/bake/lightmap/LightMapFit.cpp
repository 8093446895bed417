#include "core/bake/lightmap/LightMapFit.h"

#include "core/math/Sampling.h"
#include "core/math/SphericalHarmonics.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

namespace patina {
namespace {

using Matrix = std::array<std::array<double, kLightMapTerms>, kLightMapTerms>; // lower half

// Evenly over the hemisphere about +Z: exact for what products of two harmonics are, to 1e-3.
std::vector<glm::vec3> makeDirections() {
    constexpr int kRings = 8, kAround = 12;
    // Gauss-Legendre points would be exact in z; rings of equal area do here.
    std::vector<glm::vec3> directions;
    for (int ring = 0; ring < kRings; ++ring)
        for (int i = 0; i < kAround; ++i) {
            const float z = (static_cast<float>(ring) + 0.5f) / kRings;
            const float angle = 2.0f * shading::kPi *
                                (static_cast<float>(i) + 0.5f * static_cast<float>(ring % 2)) /
                                kAround;
            const float sine = std::sqrt(1.0f - z * z);
            directions.emplace_back(sine * std::cos(angle), sine * std::sin(angle), z);
        }
    return directions;
}

Matrix gramOf(const glm::vec3& normal) {
    static const std::vector<glm::vec3> kDirections = makeDirections();
    glm::vec3 t, b;
    orthonormalBasis(normal, t, b);
    Matrix gram{};
    for (const glm::vec3& d : kDirections) {
        const LightMapBasis y = lightMapBasis(glm::normalize(d.x * t + d.y * b + d.z * normal));
        for (std::size_t i = 0; i < kLightMapTerms; ++i)
            for (std::size_t j = 0; j <= i; ++j)
                gram[i][j] += static_cast<double>(y[i]) * static_cast<double>(y[j]);
    }
    for (auto& row : gram)
        for (double& value : row)
            value /= static_cast<double>(kDirections.size());
    return gram;
}

} // namespace

LightMapBasis lightMapBasis(const glm::vec3& mirrored) {
    LightMapBasis basis{};
    evaluateSh(kLightMapOrder, mirrored, basis);
    return basis;
}

std::array<glm::vec4, kLightMapTerms>
fitHemisphere(const glm::vec3& normal, const std::array<glm::vec4, kLightMapTerms>& moments,
              double ridge) {
    Matrix l = gramOf(normal);
    for (std::size_t i = 1; i < kLightMapTerms; ++i)
        l[i][i] += ridge * l[0][0];
    // Cholesky, in place of the lower half.
    for (std::size_t i = 0; i < kLightMapTerms; ++i)
        for (std::size_t j = 0; j <= i; ++j) {
            double sum = l[i][j];
            for (std::size_t k = 0; k < j; ++k)
                sum -= l[i][k] * l[j][k];
            l[i][j] = i == j ? std::sqrt(std::max(sum, 1e-12)) : sum / l[j][j];
        }
    std::array<glm::dvec4, kLightMapTerms> x{};
    for (std::size_t i = 0; i < kLightMapTerms; ++i) {
        x[i] = glm::dvec4(moments[i]);
        for (std::size_t k = 0; k < i; ++k)
            x[i] -= l[i][k] * x[k];
        x[i] /= l[i][i];
    }
    for (std::size_t i = kLightMapTerms; i-- > 0;) {
        for (std::size_t k = i + 1; k < kLightMapTerms; ++k)
            x[i] -= l[k][i] * x[k];
        x[i] /= l[i][i];
    }
    std::array<glm::vec4, kLightMapTerms> result{};
    std::ranges::transform(x, result.begin(), [](const glm::dvec4& v) { return glm::vec4(v); });
    return result;
}

} // namespace patina
