// The links that hierarchical radiosity gathers an element's light over: its own, and those of the
// clusters that it is in.
#pragma once

#include "core/radiosity/document/LiveRadiosity.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace patina {

struct ElementLink {
    std::uint32_t element = radiosity::kNone; // at the other end; kNone: a cluster
    std::uint32_t elements = 1;               // of the cluster
    std::uint32_t receivers = 1;              // elements of the cluster that the link is of
    // Form factor to all of the other end: the mean over those receivers.
    double factor = 0.0;
    glm::dvec3 light{0.0};  // that comes over it, W/m²
    double share = 0.0;     // of what comes over all of them, 0…1
    glm::vec3 centre{0.0f}; // metres, world, of a sphere about the other end …
    float radius = 0.0f;    // … metres
};
// Sources have links of their own: those of the one whose bounced light counts most at the element.
struct ElementLinks {
    std::size_t source = 0;         // of live.sources
    double factorSum = 0.0;         // of all links: the share of all around that is linked
    std::vector<ElementLink> links; // the most light first
};
// Without links (another solver, or not solved yet): none.
[[nodiscard]] ElementLinks linksOf(const LiveRadiosity& live, std::uint32_t element);

// What arrives at an element over the links of all sources from each other one, W/m²; empty: there
// are none. Within a cluster light is as its elements send it.
[[nodiscard]] std::vector<glm::dvec3> lightOverLinks(const LiveRadiosity& live,
                                                     std::uint32_t element);
// Form factors from an element to each, as the links of linksOf() have them; empty: there are none.
[[nodiscard]] std::vector<double> factorsOverLinks(const LiveRadiosity& live,
                                                   std::uint32_t element);

} // namespace patina
