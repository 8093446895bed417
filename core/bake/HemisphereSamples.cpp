#include "core/bake/HemisphereSamples.h"

#include <cmath>

namespace patina {

HemisphereSamples::HemisphereSamples(std::uint32_t seed, std::uint32_t first, std::uint32_t count)
    : m_count(count)
    , m_directions(std::size_t{kSequences} * count) {
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

} // namespace patina
