#include "core/bake/HemisphereSamples.h"

#include "core/base/Check.h"

#include <cmath>

namespace patina {

HemisphereSamples::HemisphereSamples(std::uint32_t seed, std::uint32_t first, std::uint32_t count,
                                     SampleMethod method)
    : m_first(first)
    , m_count(count)
    , m_method(method) {
    if (method != SampleMethod::Qmc)
        return;
    m_directions.resize(std::size_t{kSequences} * count);
    for (std::uint32_t sequence = 0; sequence < kSequences; ++sequence)
        for (std::uint32_t i = 0; i < count; ++i)
            m_directions[std::size_t{sequence} * count + i] =
                cosineHemisphere(sobolOwen2D(first + i, seedFor(seed, sequence)));
}

glm::mat3 HemisphereSamples::frame(const glm::vec3& normal, std::uint32_t elementSeed) {
    glm::vec3 t, b;
    orthonormalBasis(normal, t, b);
    // kSequences is a power of two: the bits above pick the angle.
    const float angle = static_cast<float>(elementSeed / kSequences) *
                        (2.0f * shading::kPi / (4294967296.0f / kSequences));
    const float cosine = std::cos(angle), sine = std::sin(angle);
    return {cosine * t + sine * b, cosine * b - sine * t, normal};
}

std::span<const glm::vec3> HemisphereSamples::drawn(std::uint32_t elementSeed,
                                                    std::vector<glm::vec3>& scratch) const {
    scratch.resize(m_count);
    const auto side = static_cast<std::uint32_t>(std::lround(std::sqrt(m_count)));
    CHECK(m_method == SampleMethod::Random || (m_first == 0 && side * side == m_count));
    for (std::uint32_t i = 0; i < m_count; ++i) {
        const std::uint32_t hash = seedFor(elementSeed, m_first + i);
        glm::vec2 u(detail::unitFloat(hash), detail::unitFloat(hash32(hash ^ 0x9e3779b9u)));
        if (m_method == SampleMethod::Stratified) // one in each cell of an N × N grid
            u = (u + glm::vec2(i % side, i / side)) / static_cast<float>(side);
        scratch[i] = cosineHemisphere(u);
    }
    return scratch;
}

} // namespace patina
