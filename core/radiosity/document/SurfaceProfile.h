// Radiosity along a line over a surface, element by element: the plot of a wall.
#pragma once

#include "core/radiosity/document/LiveRadiosity.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace patina {

enum class ProfileWay {
    Across, // level; of a floor or ceiling along x
    Up,     // at right angles to that; of a floor or ceiling along z, towards the viewer
};

struct SurfaceProfile {
    struct Piece {
        double from, to; // metres along the surface; the chosen element's middle is 0
        std::uint32_t element;
    };
    glm::vec3 way{0.0f};       // unit, at the chosen element
    std::vector<Piece> pieces; // ascending; they touch
};

// The line goes through the element's middle and on over its neighbours, round what is curved, as
// far as the mesh has elements and its normal turns by less than 60° from one to the next.
[[nodiscard]] SurfaceProfile profileOver(const LiveRadiosity& live, std::uint32_t element,
                                         ProfileWay way);

} // namespace patina
