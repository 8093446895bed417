#include "core/bake/lightmap/LightMapFit.h"

#include "core/math/SphericalHarmonics.h"

#include <cmath>

namespace patina {

LightMapBasis lightMapBasis(const glm::vec3& mirrored) {
    LightMapBasis basis{};
    evaluateSh(kLightMapOrder, mirrored, basis);
    return basis;
}

void LightMapFit::add(const LightMapBasis& basis, double weight) {
    for (std::size_t i = 0; i < kLightMapTerms; ++i)
        for (std::size_t j = 0; j <= i; ++j)
            m_gram[i][j] += weight * static_cast<double>(basis[i]) * static_cast<double>(basis[j]);
    m_weight += weight;
}

std::optional<std::array<glm::dvec4, kLightMapTerms>>
LightMapFit::solve(const std::array<glm::dvec4, kLightMapTerms>& moments, double ridge) const {
    if (!(m_weight > 0.0))
        return std::nullopt;
    // Cholesky, in place of the lower half. The constant is charged as little as keeps the matrix
    // positive.
    auto l = m_gram;
    for (std::size_t i = 0; i < kLightMapTerms; ++i)
        l[i][i] += (i == 0 ? 1e-6 : ridge) * m_gram[0][0];
    for (std::size_t i = 0; i < kLightMapTerms; ++i)
        for (std::size_t j = 0; j <= i; ++j) {
            double sum = l[i][j];
            for (std::size_t k = 0; k < j; ++k)
                sum -= l[i][k] * l[j][k];
            if (i == j) {
                if (!(sum > 0.0))
                    return std::nullopt;
                l[i][i] = std::sqrt(sum);
            } else {
                l[i][j] = sum / l[j][j];
            }
        }
    std::array<glm::dvec4, kLightMapTerms> x = moments;
    for (std::size_t i = 0; i < kLightMapTerms; ++i) {
        for (std::size_t k = 0; k < i; ++k)
            x[i] -= l[i][k] * x[k];
        x[i] /= l[i][i];
    }
    for (std::size_t i = kLightMapTerms; i-- > 0;) {
        for (std::size_t k = i + 1; k < kLightMapTerms; ++k)
            x[i] -= l[k][i] * x[k];
        x[i] /= l[i][i];
    }
    return x;
}

} // namespace patina
