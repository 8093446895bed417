// Does a sampler draw with the density it claims?
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>

namespace patina {

// Draws from `sample` and compares the histogram over (cos theta, phi) with the integral of `pdf`
// (Pearson's χ² with 5 or more expected in a cell); also checks that the density integrates to
// `mass` over z >= zMin. Samples below zMin are the rest.
void checkSampler(const std::string& name, const std::function<glm::vec3(glm::vec2)>& sample,
                  const std::function<double(const glm::dvec3&)>& pdf, double zMin,
                  double mass = 1.0);

} // namespace patina
