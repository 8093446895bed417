// Open edges of elements: where the light of a surface does not run on over the edge.
#pragma once

#include "core/radiosity/Reconstruction.h"
#include "core/trace/path/TraceScene.h"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace patina {

struct ElementEdge {
    std::uint32_t element = 0;
    std::array<glm::dvec3, 2> ends{};      // scene units
    std::array<std::uint32_t, 2> lights{}; // LitMesh::Vertex::light there
    glm::dvec3 outward{0.0};               // unit, in the element's plane, away from it
    [[nodiscard]] glm::dvec3 middle() const { return 0.5 * (ends[0] + ends[1]); }
    [[nodiscard]] double length() const; // scene units
};

// In the order of the triangles. Edges of no length are left out.
[[nodiscard]] std::vector<ElementEdge> openEdges(const radiosity::LitMesh& mesh,
                                                 const TraceScene& scene);

} // namespace patina
