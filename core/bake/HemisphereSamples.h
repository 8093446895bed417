// The directions of one pass: cosine-weighted hemispheres from a few Owen-scrambled Sobol'
// sequences, computed once; each element picks a sequence and turns it about its normal by an angle
// of its own. A turned net is as evenly spread as the net itself, and costs nine multiplications
// per direction instead of a hundred.
#pragma once

#include "core/math/Sampling.h"

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace patina {

class HemisphereSamples {
  public:
    static constexpr std::uint32_t kSequences = 16;

    // Points `first` … `first + count` of every sequence.
    HemisphereSamples(std::uint32_t seed, std::uint32_t first, std::uint32_t count);

    // Directions around +z, density cos / pi, of the sequence that `elementSeed` picks.
    [[nodiscard]] std::span<const glm::vec3> sequence(std::uint32_t elementSeed) const {
        return {m_directions.data() + std::size_t{elementSeed % kSequences} * m_count, m_count};
    }
    // The frame that takes them to the world: third column `normal`, turned by the element's angle.
    [[nodiscard]] static glm::mat3 frame(const glm::vec3& normal, std::uint32_t elementSeed);

  private:
    std::uint32_t m_count;
    std::vector<glm::vec3> m_directions;
};

} // namespace patina
