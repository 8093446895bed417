#include "app/editor/widget/DirectionAxes.h"

#include "core/light/LatLongGrid.h"

#include <cmath>

namespace patina::editor {
namespace {
double within180(double degrees) {
    return degrees > 180.0 ? degrees - 360.0 : degrees;
}
} // namespace

// Azimuth grows to the left; it has no seam where the picture has none.
std::vector<PlotAxis> directionAxes(const PlotAxis& value) {
    const QString degrees = QStringLiteral("°");
    return {{PlotFrame::tr("azimuth"), degrees, 360.0, 0.0},
            {PlotFrame::tr("elevation"), degrees, -90.0, 90.0},
            value};
}

QPointF placeOf(const glm::dvec3& direction) {
    const glm::dvec2 angles = anglesFromDirection(direction);
    return {angles.x < 0.0 ? angles.x + 360.0 : angles.x, angles.y};
}

glm::vec3 directionAt(const QPointF& place) {
    return glm::vec3(directionFromAngles(within180(place.x()), place.y()));
}

QString directionText(const QPointF& place) {
    return PlotFrame::tr("azimuth %1°, elevation %2°")
        .arg(plotNumber(within180(place.x()), 4), plotNumber(place.y()));
}

} // namespace patina::editor
