// Surfaces of revolution with rounded edges: a profile is turned about the +Y axis, and each range
// of it becomes one chart of the UV layout.
#pragma once

#include "core/mesh/Mesh.h"

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace patina::library {

// A point of a profile in the (radius, height) half-plane. The surface's outside lies to the right
// when walking along the profile with +Y up and the radius growing to the right.
struct ProfilePoint {
    double radius = 0, height = 0;
    double normalRadius = 1, normalHeight = 0; // unit
    double length = 0;                         // metres along the profile from its start
};
using Profile = std::vector<ProfilePoint>;

struct ProfileCorner {
    double radius, height;
    double fillet = 0.0; // radius of the arc that replaces the corner
};
// A polygon line whose corners are rounded. Straight parts are divided so that no step is longer
// than `maxStep`, arcs so that no step turns by more than `arcStepDeg`. The first and last corner
// are not rounded; all others need a fillet.
Profile roundedProfile(std::span<const ProfileCorner> corners, double maxStep, double arcStepDeg);

// A half circle around the origin, from the south pole to the north pole.
Profile sphereProfile(double radius, int rings);

// Fills normals (outside to the right) and lengths from the positions of a smooth, dense profile.
void finishSmoothProfile(Profile& profile);

// Where a range of the profile goes in the unit square.
struct Chart {
    enum class Kind {
        Strip, // angle along u over the whole width, profile length along v
        Disc   // unrolled around the axis: distance from it = profile length
    };
    Kind kind = Kind::Strip;
    glm::dvec2 origin{0.0};     // Strip: top-left corner; Disc: centre
    glm::dvec2 size{1.0};       // Strip only
    double scale = 1.0;         // Disc: UV units per metre
    double startDistance = 0.0; // Disc: profile length between the axis and the range's inner end
};

struct Placement {
    glm::dmat3 rotation{1.0};
    glm::dvec3 offset{0.0};
};

// Appends points [first, last] of the profile, turned in `segments` steps. Points on the axis
// become one vertex per triangle (Strip) or a single one (Disc). Positions of equal profile points
// and angles are equal bit by bit, so that ranges join without cracks.
void addLathe(Mesh& mesh, const Profile& profile, std::size_t first, std::size_t last, int segments,
              const Chart& chart, const Placement& placement);

} // namespace patina::library
