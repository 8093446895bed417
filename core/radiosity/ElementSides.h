// What stands on elements: on which side of it each of an element's points is, and where an element
// has to end so that it is on one side alone. One radiosity on both sides of a wall is light that
// leaks through it.
#pragma once

#include "core/radiosity/ElementMesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace patina::radiosity {

// Of an element's points; those that see one another along the element, over any number of others,
// are on one side.
struct ElementSides {
    static constexpr int kGrid = 8;             // points along an edge
    static constexpr int kBuried = -1;          // of a point within something else
    static constexpr double kLeastAbove = 4e-5; // scene units; four times kRayOffset
    std::array<int, kGrid * kGrid> of{};        // kBuried, or the number of a side
    std::vector<int> counts;                    // points of each side
    // Of ElementMesh::samplePosition().
    [[nodiscard]] static glm::vec2 point(int i, int k) {
        return {(static_cast<float>(i) + 0.5f) / kGrid, (static_cast<float>(k) + 0.5f) / kGrid};
    }
};
[[nodiscard]] ElementSides sidesOf(const ElementMesh& elements, std::uint32_t element,
                                   const RayScene& rays);

// Where quads have to be cut for walls without a thickness that stand on them along their rows or
// columns.
[[nodiscard]] std::vector<FaceCut> findCuts(const ElementMesh& elements, const RayScene& rays,
                                            const JobContext& job);
// Elements that such walls part into two sides or more, ascending.
[[nodiscard]] std::vector<std::uint32_t> findDivided(const ElementMesh& elements,
                                                     const RayScene& rays, const JobContext& job);

// Elements that such a wall parts from one beside them on their face, ascending; but for faces that
// are Face::fenced already.
[[nodiscard]] std::vector<std::uint32_t> findParted(const ElementMesh& elements,
                                                    const RayScene& rays, const JobContext& job);
// Whether one stands between two elements that are beside one another.
[[nodiscard]] bool isWallBetween(const ElementMesh& elements, std::uint32_t a, std::uint32_t b,
                                 const RayScene& rays);

} // namespace patina::radiosity
