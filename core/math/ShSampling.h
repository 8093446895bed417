// Projection of functions onto spherical harmonics by sampling them.
#pragma once

#include "core/job/JobContext.h"
#include "core/math/SphericalHarmonics.h"

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

namespace patina {

// Called from several threads.
using SphereFunction = std::function<glm::vec3(const glm::vec3& direction)>;

// c_i = ∫ f Y_i dω ≈ 4pi / N Σ f Y_i. Both depend on the seed alone, not on the number of threads,
// and are meaningless after a cancel.

// The classical method: one random point in each of side × side cells of the square that maps to
// the sphere by equal areas. Green 2003, "Spherical Harmonic Lighting: The Gritty Details". side >=
// 1; error ~ 1/N for what is smooth, ~ N^-3/4 across edges.
[[nodiscard]] std::vector<glm::vec3> projectStratified(const SphereFunction& f, int order, int side,
                                                       std::uint32_t seed,
                                                       const JobContext& job = {});
// The first `count` >= 1 points of an Owen-scrambled Sobol' sequence (sobolOwen2D), best at powers
// of two.
[[nodiscard]] std::vector<glm::vec3> projectSobol(const SphereFunction& f, int order,
                                                  std::uint32_t count, std::uint32_t seed,
                                                  const JobContext& job = {});

} // namespace patina
