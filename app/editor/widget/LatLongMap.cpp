#include "app/editor/widget/LatLongMap.h"

#include "core/light/LatLongGrid.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace patina::editor {
namespace {

constexpr double kReach = 9;        // device-independent pixels around a handle
constexpr double kEdgeHandles = 34; // a side at least this long has a handle in its middle
constexpr double kRollDistance = 18;
constexpr double kMinSideDeg = 0.5, kMaxSideDeg = 170; // as in the parameter table

// In half sizes: -1, 0 or 1 along x (right) and y (up).
glm::dvec2 placeOf(SoftboxHandle handle) {
    switch (handle) {
    case SoftboxHandle::Left:
        return {-1, 0};
    case SoftboxHandle::Right:
        return {1, 0};
    case SoftboxHandle::Top:
        return {0, 1};
    case SoftboxHandle::Bottom:
        return {0, -1};
    case SoftboxHandle::TopLeft:
        return {-1, 1};
    case SoftboxHandle::TopRight:
        return {1, 1};
    case SoftboxHandle::BottomLeft:
        return {-1, -1};
    case SoftboxHandle::BottomRight:
        return {1, -1};
    case SoftboxHandle::None:
    case SoftboxHandle::Body:
    case SoftboxHandle::Roll:
        break;
    }
    return {0, 0};
}

// Angle about the softbox's centre, counter-clockwise from the right of an unrolled one.
double angleAbout(const Softbox& softbox, const glm::dvec3& direction) {
    Softbox level = softbox;
    level.rollDeg = 0;
    const SoftboxShape shape(level);
    return glm::degrees(
        std::atan2(glm::dot(direction, shape.up()), glm::dot(direction, shape.right())));
}

} // namespace

double wrapDeg(double degrees) {
    return degrees - 360.0 * std::floor((degrees + 180.0) / 360.0);
}

double LatLongMap::shift() const {
    const double turns =
        (m_centerDeg - m_rotationDeg) / 360.0 - 0.5; // files have 180° in the middle
    return (turns - std::floor(turns)) * m_area.width();
}

QPointF LatLongMap::point(const glm::dvec3& direction) const {
    const glm::dvec2 a = anglesFromDirection(direction);
    const double u = 0.5 - (a.x + m_rotationDeg - m_centerDeg) / 360.0;
    return {m_area.left() + (u - std::floor(u)) * m_area.width(),
            m_area.top() + (90.0 - a.y) / 180.0 * m_area.height()};
}

glm::dvec2 LatLongMap::angles(const QPointF& point) const {
    const double u = (point.x() - m_area.left()) / m_area.width();
    const double v = (point.y() - m_area.top()) / m_area.height();
    return {wrapDeg((0.5 - u) * 360.0 - m_rotationDeg + m_centerDeg),
            std::clamp(90.0 - 180.0 * v, -90.0, 90.0)};
}

glm::dvec3 LatLongMap::direction(const QPointF& point) const {
    const glm::dvec2 a = angles(point);
    return directionFromAngles(a.x, a.y);
}

glm::dvec2 LatLongMap::anglesOfWay(const QPointF& way) const {
    return {-360.0 * way.x() / m_area.width(), -180.0 * way.y() / m_area.height()};
}

QPainterPath LatLongMap::path(const std::vector<glm::dvec3>& directions) const {
    // Unwrapped: each point as near to the one before as whole turns allow.
    const double width = m_area.width();
    QPolygonF line;
    for (const glm::dvec3& d : directions) {
        QPointF p = point(d);
        if (!line.isEmpty())
            p.rx() -= width * std::round((p.x() - line.back().x()) / width);
        line << p;
    }
    QPainterPath once;
    once.addPolygon(line);
    QPainterPath path;
    for (const int turn : {-1, 0, 1})
        path.addPath(once.translated(turn * width, 0));
    return path;
}

QPainterPath LatLongMap::outline(const SoftboxShape& shape) const {
    constexpr int kSteps = 24; // of a side: straight lines are curves in this map
    const glm::dvec2 h = shape.half();
    const glm::dvec2 corners[] = {{-h.x, h.y}, {h.x, h.y}, {h.x, -h.y}, {-h.x, -h.y}, {-h.x, h.y}};
    std::vector<glm::dvec3> directions;
    for (int side = 0; side < 4; ++side)
        for (int i = 0; i <= kSteps; ++i)
            directions.push_back(shape.direction(
                glm::mix(corners[side], corners[side + 1], static_cast<double>(i) / kSteps)));
    return path(directions);
}

std::vector<SoftboxHandlePoint> handlesOf(const Softbox& softbox, const LatLongMap& map) {
    const SoftboxShape shape(softbox);
    const auto pointAt = [&](const glm::dvec2& place) {
        return map.point(shape.direction(place * shape.half()));
    };
    const auto distance = [&](const QPointF& a, const QPointF& b) {
        const double width = map.area().width();
        double x = a.x() - b.x();
        x -= width * std::round(x / width);
        return std::hypot(x, a.y() - b.y());
    };
    std::vector<SoftboxHandlePoint> handles;
    using enum SoftboxHandle;
    for (const SoftboxHandle corner : {TopLeft, TopRight, BottomLeft, BottomRight})
        handles.push_back({corner, pointAt(placeOf(corner))});
    const bool tall = distance(handles[0].point, handles[2].point) > kEdgeHandles;
    const bool wide = distance(handles[0].point, handles[1].point) > kEdgeHandles;
    for (const SoftboxHandle edge : {Left, Right, Top, Bottom})
        if (edge == Left || edge == Right ? tall : wide)
            handles.push_back({edge, pointAt(placeOf(edge))});

    // Beyond the middle of the top edge, at a fixed distance on the screen.
    const double perDegree = map.area().height() / 180.0;
    const double beyondDeg = 0.5 * softbox.heightDeg + kRollDistance / perDegree;
    const double top = std::tan(glm::radians(std::min(beyondDeg, 88.0)));
    handles.push_back({Roll, map.point(shape.direction({0.0, top}))});
    return handles;
}

SoftboxHandle handleAt(const Softbox& softbox, const LatLongMap& map, const QPointF& point) {
    SoftboxHandle nearest = SoftboxHandle::None;
    double best = kReach;
    for (const SoftboxHandlePoint& handle : handlesOf(softbox, map)) {
        const QPointF way = handle.point - point;
        const double distance = std::hypot(way.x(), way.y());
        if (distance < best) {
            best = distance;
            nearest = handle.handle;
        }
    }
    return nearest;
}

Softbox draggedSoftbox(const Softbox& start, SoftboxHandle handle, const LatLongMap& map,
                       const QPointF& from, const QPointF& to, bool keepShape) {
    Softbox result = start;
    if (handle == SoftboxHandle::None)
        return result;
    if (handle == SoftboxHandle::Body) {
        const glm::dvec2 way = map.anglesOfWay(to - from);
        result.azimuthDeg = static_cast<float>(wrapDeg(start.azimuthDeg + way.x));
        result.elevationDeg =
            static_cast<float>(std::clamp(start.elevationDeg + way.y, -90.0, 90.0));
        return result;
    }
    if (handle == SoftboxHandle::Roll) {
        const double turned =
            angleAbout(start, map.direction(to)) - angleAbout(start, map.direction(from));
        double roll = wrapDeg(start.rollDeg + turned);
        if (keepShape)
            roll = wrapDeg(15.0 * std::round(roll / 15.0));
        result.rollDeg = static_cast<float>(roll);
        return result;
    }

    // Sides: the mouse is on the edge, so half the size is the angle between it and the middle.
    const glm::dvec2 place = placeOf(handle);
    const SoftboxShape shape(start);
    const glm::dvec2 grabbed = shape.local(map.direction(from)).value_or(place * shape.half());
    const std::optional<glm::dvec2> now = shape.local(map.direction(to));
    glm::dvec2 sizeDeg(start.widthDeg, start.heightDeg);
    for (int axis = 0; axis < 2; ++axis) {
        if (place[axis] == 0.0)
            continue;
        // Taken a little beside the edge it stays beside it by as much.
        const double slack = grabbed[axis] * place[axis] - shape.half()[axis];
        const double half = now ? (*now)[axis] * place[axis] - slack : 1e9;
        sizeDeg[axis] = std::clamp(2.0 * glm::degrees(std::atan(half)), kMinSideDeg, kMaxSideDeg);
    }
    if (keepShape && place.x != 0.0 && place.y != 0.0) {
        const glm::dvec2 before(start.widthDeg, start.heightDeg);
        const glm::dvec2 factors = sizeDeg / before;
        const double factor =
            std::clamp(std::max(factors.x, factors.y), kMinSideDeg / std::min(before.x, before.y),
                       kMaxSideDeg / std::max(before.x, before.y));
        sizeDeg = before * factor;
    }
    result.widthDeg = static_cast<float>(sizeDeg.x);
    result.heightDeg = static_cast<float>(sizeDeg.y);
    return result;
}

} // namespace patina::editor
