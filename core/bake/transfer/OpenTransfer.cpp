#include "core/bake/transfer/OpenTransfer.h"

#include "core/math/SphericalHarmonics.h"

namespace patina {

OpenTransfer::OpenTransfer(int order)
    : m_order(order) {
    for (int l = 0; l < order; ++l)
        m_cosine[static_cast<std::size_t>(l)] =
            static_cast<float>(cosineConvolution(l) / cosineConvolution(0));
}

void OpenTransfer::subtract(const glm::vec3& normal, std::span<float> values) const {
    std::array<float, shCount(kMaxShOrder)> basis;
    evaluateSh(m_order, normal, std::span<float>(basis));
    for (std::size_t l = 0, i = 0; l < static_cast<std::size_t>(m_order); ++l)
        for (; i < (l + 1) * (l + 1); ++i)
            values[i] = m_cosine[l] * basis[i] - values[i];
}

} // namespace patina
