// Luminous rectangles on the sphere of directions: a photographer's softboxes seen from the model.
#pragma once

#include "core/image/Image.h"
#include "core/job/JobContext.h"
#include "core/light/Environment.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

namespace patina {

// Where a softbox is: a flat rectangle one unit away that faces the centre. `widthDeg` and
// `heightDeg` are the angles it is seen under along its middle; roll turns it counter-clockwise as
// seen from the centre.
class SoftboxShape {
  public:
    explicit SoftboxShape(const Softbox& softbox);

    // A direction in the rectangle's plane: x to the right as seen from the centre, y up, ±half()
    // at its edges. Nothing for directions that do not meet the plane.
    [[nodiscard]] std::optional<glm::dvec2> local(const glm::dvec3& direction) const;
    [[nodiscard]] glm::dvec3 direction(const glm::dvec2& local) const; // unit vector
    [[nodiscard]] glm::dvec2 half() const { return m_half; }
    [[nodiscard]] glm::dvec3 axis() const { return m_axis; }
    [[nodiscard]] glm::dvec3 right() const { return m_right; } // unit vectors along its sides
    [[nodiscard]] glm::dvec3 up() const { return m_up; }

    // Share of its radiance, 0…1: 1 inside, falling smoothly to 0 at the edges over `softness` of
    // the smaller half size.
    [[nodiscard]] double weight(const glm::dvec2& local) const;
    [[nodiscard]] double fade() const { return m_fade; } // width of that border, in the plane

  private:
    glm::dvec3 m_axis, m_right, m_up;
    glm::dvec2 m_half;
    double m_fade;
};

// Of the whole rectangle, with the formula for a pyramid: 4 asin(sin(width/2) sin(height/2)).
[[nodiscard]] double solidAngle(const Softbox& softbox);
// ∫ weight dω: less than solidAngle() by what its soft edge takes away.
[[nodiscard]] double luminousSolidAngle(const Softbox& softbox);

// Lat-long, F32, 3 channels, 2 height × height: the ambient radiance plus that of every enabled
// box. Edges are anti-aliased, and each box adds exactly radiance × luminousSolidAngle() however
// coarse the picture is. Meaningless after a cancel.
[[nodiscard]] Image softboxImage(std::span<const Softbox> softboxes, const glm::vec3& ambient,
                                 int height, const JobContext& job = {});

} // namespace patina
