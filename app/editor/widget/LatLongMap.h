// Where directions lie in a lat-long picture on the screen. Angles are those of the environment
// itself; the picture shows them turned with it, so that what stands behind the model stays put.
#pragma once

#include "core/light/Softboxes.h"

#include <QPainterPath>
#include <QPointF>
#include <QRectF>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace patina::editor {

class LatLongMap {
  public:
    LatLongMap() = default;
    // `centerDeg`: the azimuth in the world that the middle shows.
    LatLongMap(const QRectF& area, double rotationDeg, double centerDeg)
        : m_area(area)
        , m_rotationDeg(rotationDeg)
        , m_centerDeg(centerDeg) {}

    [[nodiscard]] const QRectF& area() const { return m_area; }
    // How far the picture as it is in files is moved to the right, 0…width.
    [[nodiscard]] double shift() const;

    [[nodiscard]] QPointF point(const glm::dvec3& direction) const;
    [[nodiscard]] glm::dvec3 direction(const QPointF& point) const;
    [[nodiscard]] glm::dvec2 angles(const QPointF& point) const; // azimuth, elevation, degrees
    // What a way on the screen is in degrees of azimuth and elevation.
    [[nodiscard]] glm::dvec2 anglesOfWay(const QPointF& way) const;

    // A closed line through directions, drawn as often as the seam asks for.
    [[nodiscard]] QPainterPath path(const std::vector<glm::dvec3>& directions) const;
    [[nodiscard]] QPainterPath outline(const SoftboxShape& shape) const;

  private:
    QRectF m_area;
    double m_rotationDeg = 0, m_centerDeg = 180;
};

// The parts of a selected softbox that can be taken.
enum class SoftboxHandle {
    None,
    Body,
    Left,
    Right,
    Top,
    Bottom,
    TopLeft,
    TopRight,
    BottomLeft,
    BottomRight,
    Roll
};

struct SoftboxHandlePoint {
    SoftboxHandle handle;
    QPointF point;
};
// The squares at corners and, where there is room for them, edges; the circle that rolls comes
// last.
[[nodiscard]] std::vector<SoftboxHandlePoint> handlesOf(const Softbox& softbox,
                                                        const LatLongMap& map);
// The nearest handle within reach of `point`, or None.
[[nodiscard]] SoftboxHandle handleAt(const Softbox& softbox, const LatLongMap& map,
                                     const QPointF& point);
// What `start` becomes when the handle, taken at `from`, is dragged to `to`. The centre stays where
// it is unless the body is dragged. `keepShape`: width and height keep their proportion; roll snaps
// to 15°.
[[nodiscard]] Softbox draggedSoftbox(const Softbox& start, SoftboxHandle handle,
                                     const LatLongMap& map, const QPointF& from, const QPointF& to,
                                     bool keepShape);

// Into -180 … 180.
[[nodiscard]] double wrapDeg(double degrees);

} // namespace patina::editor
