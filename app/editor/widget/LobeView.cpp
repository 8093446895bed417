#include "app/editor/widget/LobeView.h"

#include <QMouseEvent>
#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

namespace patina::editor {
namespace {

constexpr double kTurnPerPixel = 0.6, kDegreesPerKey = 5.0;
constexpr double kLowest = 2.0,
                 kHighest = 90.0; // of the camera: never from below

glm::vec3 directionOf(const QPointF& place) {
    const auto azimuth = static_cast<float>(glm::radians(place.x()));
    const auto theta = static_cast<float>(glm::radians(place.y()));
    return {std::sin(theta) * std::cos(azimuth), std::sin(theta) * std::sin(azimuth),
            std::cos(theta)};
}

} // namespace

LobeView::LobeView(TaskRunner& runner, const QString& title, QWidget* parent)
    : PictureFrame(runner, "lobe in space", title, Press::Drags, parent) {
    setHelp(tr("The lobe in space. Drag to look from another side, double-click to go back."));
    setAxes({{QStringLiteral("φ"), QStringLiteral("°"), -180.0, 180.0},
             {QStringLiteral("θₒ"), QStringLiteral("°"), 0.0, 90.0},
             {QStringLiteral("fᵣ"), QStringLiteral(" sr⁻¹")}});
}

void LobeView::setLobes(std::vector<Lobe> lobes, double incidenceDeg, const LobeScale& scale,
                        double peak) {
    m_lobes = std::move(lobes);
    m_incidenceDeg = incidenceDeg;
    m_scale = scale;
    m_peak = peak;
    m_axes[2].name = scale.cosine ? QStringLiteral("fᵣ·cos θₒ") : QStringLiteral("fᵣ");
    setLooks({m_lobes.begin(), m_lobes.end()});
}

QString LobeView::corner() const {
    return tr("peak %1").arg(m_axes[2].number(m_peak));
}

// --- Places --------------------------------------------------------------------------------------

double LobeView::valueAt(std::size_t lobe, const QPointF& place) const {
    const glm::vec3 l = lensDirection(static_cast<float>(-glm::radians(m_incidenceDeg)));
    const glm::vec3 v = directionOf(place);
    return double{
        lobeValue(m_lobes[lobe].lens->brdf(l, v, m_scale.lobe), std::max(v.z, 0.0f), m_scale)};
}

QPointF LobeView::pointOn(std::size_t lobe, const QPointF& place) const {
    const QRectF cell = cells()[lobe];
    const float radius =
        lobeRadius(static_cast<float>(valueAt(lobe, place)), static_cast<float>(m_peak), m_scale);
    return cell.topLeft() + lobePoint(m_camera, cell.size(), radius * directionOf(place));
}

QPointF LobeView::pointOf(const QPointF& place) const {
    return m_lobes.empty() ? QPointF() : pointOn(0, place);
}

// Where the pointer meets a lobe.
std::optional<QPointF> LobeView::placeAt(const QPointF& point) const {
    const int index = cellAt(point);
    if (index < 0)
        return std::nullopt;
    const QRectF cell = cells()[static_cast<std::size_t>(index)];
    const auto hit = lobeHit(*m_lobes[static_cast<std::size_t>(index)].mesh, m_camera, cell.size(),
                             point - cell.topLeft());
    if (!hit)
        return std::nullopt;
    const glm::dvec3 d = glm::normalize(glm::dvec3(*hit));
    return QPointF(m_axes[0].rounded(glm::degrees(std::atan2(d.y, d.x))),
                   m_axes[1].rounded(glm::degrees(std::acos(std::clamp(d.z, -1.0, 1.0)))));
}

QPointF LobeView::startPlace() const {
    return {0.0, m_axes[1].rounded(m_incidenceDeg)}; // the mirror direction
}

std::vector<PlotValue> LobeView::valuesAt(const QPointF& place) const {
    return looked([&](std::size_t i) { return valueAt(i, place); });
}

// --- Painting ------------------------------------------------------------------------------------

PictureFrame::Draw LobeView::drawer() const {
    return [lobes = m_lobes, camera = m_camera,
            incidence = static_cast<float>(glm::radians(m_incidenceDeg))](
               QPainter& painter, std::size_t index, const QRectF& cell, double ratio) {
        painter.drawImage(cell.topLeft(),
                          lobePicture(*lobes[index].mesh, camera, incidence, cell.size().toSize(),
                                      plotColor(lobes[index].look), ratio));
    };
}

void LobeView::paintProbe(QPainter& painter, const QPointF& place) const {
    for (std::size_t i = 0; i < m_lobes.size(); ++i)
        paintCross(painter, pointOn(i, place));
}

// --- The camera ----------------------------------------------------------------------------------

void LobeView::orbit(double yawDeg, double elevationDeg) {
    m_camera.yawDeg = std::remainder(m_camera.yawDeg + yawDeg, 360.0);
    m_camera.elevationDeg = std::clamp(m_camera.elevationDeg + elevationDeg, kLowest, kHighest);
    draw();
}

bool LobeView::moveHandle(const QPointF& way) {
    orbit(-kDegreesPerKey * way.x(), kDegreesPerKey * way.y());
    return true;
}

void LobeView::mousePressEvent(QMouseEvent* event) {
    m_last = event->position();
    PictureFrame::mousePressEvent(event);
}

void LobeView::mouseMoveEvent(QMouseEvent* event) {
    if (event->buttons().testFlag(Qt::LeftButton)) {
        const QPointF way = event->position() - m_last;
        m_last = event->position();
        orbit(-way.x() * kTurnPerPixel, way.y() * kTurnPerPixel);
    }
    PictureFrame::mouseMoveEvent(event);
}

void LobeView::mouseDoubleClickEvent(QMouseEvent*) {
    m_camera = {};
    draw();
}

} // namespace patina::editor
