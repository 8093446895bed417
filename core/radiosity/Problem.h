// The equation of radiosity, B_i = E_i + ρ_i Σ_j F_ij B_j, but for its form factors.
// Goral et al. 1984, "Modeling the Interaction of Light Between Diffuse Surfaces".
#pragma once

#include "core/radiosity/Patches.h"

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace patina::radiosity {

// Of every element, linear sRGB.
struct Problem {
    std::vector<double> areas;           // m²
    std::vector<glm::dvec3> reflectance; // ρ, 0…1; of all of them times their factors below 1
    // E: what leaves without having come from another element, W/m² (π times the radiance): what
    // glows, and the light of lights and sky that is reflected for the first time.
    std::vector<glm::dvec3> emission;
    Patches patches = {}; // empty: each element shoots alone

    [[nodiscard]] std::size_t size() const { return areas.size(); }
    // What shoots: elements or patches. Rows of factors are theirs.
    [[nodiscard]] std::size_t senders() const { return patches.empty() ? size() : patches.size(); }
};

// visit(element) of each element of a sender.
template <class Visit>
void forElementsOf(const Problem& problem, std::uint32_t sender, const Visit& visit) {
    if (problem.patches.empty())
        return visit(sender);
    for (const std::uint32_t element : problem.patches.elementsOf(sender))
        visit(element);
}

// m² of each sender.
[[nodiscard]] std::vector<double> senderAreas(const Problem& problem);
// Means over each sender of what elements have.
[[nodiscard]] std::vector<glm::dvec3> senderMeans(const Problem& problem,
                                                  std::span<const glm::dvec3> ofElements);

// Sum over the colours, of size rather than sign.
[[nodiscard]] inline double magnitude(const glm::dvec3& v) {
    return (v.x < 0 ? -v.x : v.x) + (v.y < 0 ? -v.y : v.y) + (v.z < 0 ? -v.z : v.z);
}

// Σ A E over elements and colours.
[[nodiscard]] double emittedPower(const Problem& problem);

// Mean by area of the colour that has most, W/m².
[[nodiscard]] double meanRadiosity(const Problem& problem, std::span<const glm::dvec3> radiosity);

// What is known of a solution. Irradiance is kept, too: black surfaces have it, and textures are
// lit by it.
struct Solution {
    std::vector<glm::dvec3> radiosity;  // B
    std::vector<glm::dvec3> irradiance; // H; B = E + ρ H
};

} // namespace patina::radiosity
