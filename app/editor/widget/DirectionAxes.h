// Directions of the world as places of a plot, as lat-long pictures lie: azimuth across, elevation
// up, -Z in the middle.
#pragma once

#include "app/editor/widget/PlotFrame.h"

#include <glm/vec3.hpp>

namespace patina::editor {

// With `value` as the third.
[[nodiscard]] std::vector<PlotAxis> directionAxes(const PlotAxis& value);
[[nodiscard]] QPointF placeOf(const glm::dvec3& direction);
[[nodiscard]] glm::vec3 directionAt(const QPointF& place); // unit vector
[[nodiscard]] QString directionText(const QPointF& place); // "azimuth −60°, elevation 25°"

} // namespace patina::editor
