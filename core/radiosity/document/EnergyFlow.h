// Who lights an element, and where its light goes: the terms of its equation, by what sends or
// receives them.
#pragma once

#include "core/radiosity/document/LiveRadiosity.h"

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace patina {

struct FlowShare {
    enum class Kind { Glow, Sky, Light, Lights, Mesh, Element, Escaped, Absorbed };
    Kind kind = Kind::Mesh;
    Id id = 0;                 // Light::id, or MeshInstance::id, also of Kind::Element
    std::uint32_t element = 0; // Kind::Element
    double share = 0.0;        // of all that arrives, or leaves; 0…1
    glm::dvec3 light{0.0};     // W/m² of the element
    // Where it comes from or goes to, weighted by the light: metres, world. Nothing: from far away.
    std::optional<glm::vec3> place;
};

// What arrives at an element of `live` under `solution`: straight from each source, and by way of
// the elements of each mesh. The largest first, by the sum of the colours.
[[nodiscard]] std::vector<FlowShare> arrivingLight(const LiveRadiosity& live,
                                                   const radiosity::Solution& solution,
                                                   std::uint32_t element);
// The same element by element, but of those that send it most at most `count`; shares are of all
// that arrives.
[[nodiscard]] std::vector<FlowShare> largestSenders(const LiveRadiosity& live,
                                                    const radiosity::Solution& solution,
                                                    std::uint32_t element, std::size_t count);
// Where the light goes that leaves it, or of a patch that it is in, as the patch sends it; what
// meets backs is Absorbed, what leaves the scene Escaped. The largest first.
[[nodiscard]] std::vector<FlowShare>
leavingLight(const LiveRadiosity& live, const radiosity::Solution& solution, std::uint32_t element);

// Of an element, metres, world.
[[nodiscard]] glm::vec3 elementCentre(const LiveRadiosity& live, std::uint32_t element);
[[nodiscard]] std::vector<glm::vec3> elementOutline(const LiveRadiosity& live,
                                                    std::uint32_t element);
// Of what shoots: an element, or a patch.
[[nodiscard]] std::vector<glm::vec3> senderOutline(const LiveRadiosity& live, std::uint32_t sender);
// The element that a ray meets first, through backs that are not there; from `origin` (metres,
// world) along a unit vector.
[[nodiscard]] std::optional<std::uint32_t>
elementAlong(const LiveRadiosity& live, const glm::vec3& origin, const glm::vec3& direction);

} // namespace patina
