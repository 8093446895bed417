#include "app/editor/widget/LitSphere.h"

#include "app/editor/style/Tokens.h"

#include <algorithm>
#include <cmath>

namespace patina::editor {
namespace {

constexpr double kHighlightStep = 0.05; // of the highlight, with the keys
constexpr float kRim = 0.9995f;         // seen at grazing angles, never from behind

QPointF within(const QPointF& place, double radius) {
    const double length = std::hypot(place.x(), place.y());
    return place * std::min(1.0, radius / std::max(length, 1e-6));
}

glm::vec3 normalAt(const QPointF& place) {
    const QPointF inside = within(place, double{kRim});
    const glm::vec2 at(static_cast<float>(inside.x()), static_cast<float>(inside.y()));
    return {at, std::sqrt(std::max(1.0f - glm::dot(at, at), 0.0f))};
}

} // namespace

LitSphere::LitSphere(TaskRunner& runner, const QString& title, QWidget* parent)
    : PictureFrame(runner, "lit ball", title, Press::Drags, parent) {
    setHelp(tr("The material on a ball, under one light of 3 lux and the scene's environment. Drag "
               "the highlight to move the light."));
    setAxes({{QStringLiteral("x"), {}, -1.0, 1.0},
             {QStringLiteral("y"), {}, -1.0, 1.0},
             {tr("luminance"), tr(" cd/m²")}});
    // The highlight stands where the normal halves the angle between light and viewer.
    m_light.toLight = glm::normalize(glm::vec3(-0.75f, 0.75f, 0.6f));
    const glm::vec3 half = glm::normalize(m_light.toLight + glm::vec3(0.0f, 0.0f, 1.0f));
    m_highlight = {double{half.x}, double{half.y}};
}

void LitSphere::setBalls(std::vector<Ball> balls) {
    m_balls = std::move(balls);
    setLooks({m_balls.begin(), m_balls.end()});
}

void LitSphere::setEnvironment(std::shared_ptr<const IblMaps> maps, const Environment& environment,
                               const View& view) {
    m_light.maps = std::move(maps);
    m_light.orientation = orientationOf(environment);
    m_light.exposureEv = environment.exposureEv;
    m_light.view = view;
    draw();
}

// --- The light -----------------------------------------------------------------------------------

void LitSphere::setHighlight(const QPointF& place) {
    m_highlight = within(place, 0.95);
    const glm::vec3 half = normalAt(m_highlight);
    m_light.toLight = 2.0f * half.z * half - glm::vec3(0.0f, 0.0f, 1.0f);
    draw();
}

bool LitSphere::pick(const QPointF& place, Qt::KeyboardModifiers) {
    setHighlight(place);
    return true;
}

bool LitSphere::moveHandle(const QPointF& way) {
    setHighlight(m_highlight + kHighlightStep * way);
    return true;
}

// --- Places --------------------------------------------------------------------------------------

std::vector<QRectF> LitSphere::cells(const QRectF& area, double unit) const {
    std::vector<QRectF> squares;
    const double name = nameHeight() * unit;
    for (const QRectF& cell : PictureFrame::cells(area, unit)) {
        const double side = std::floor(std::min(cell.width(), cell.height() - name));
        squares.emplace_back(cell.center().x() - side / 2,
                             cell.top() + name + (cell.height() - name - side) / 2, side, side);
    }
    return squares;
}

QPointF LitSphere::pointOf(const QPointF& place) const {
    const std::vector<QRectF> squares = PictureFrame::cells();
    if (squares.empty())
        return {};
    return squares.front().center() +
           squares.front().width() / 2.0 * QPointF(place.x(), -place.y());
}

std::optional<QPointF> LitSphere::placeAt(const QPointF& point) const {
    const int cell = cellAt(point);
    if (cell < 0)
        return std::nullopt;
    const QRectF square = PictureFrame::cells()[static_cast<std::size_t>(cell)];
    const QPointF way = (point - square.center()) / (square.width() / 2.0);
    return within({way.x(), -way.y()}, 1.0);
}

QPointF LitSphere::allowed(const QPointF& place) const {
    const double widest = std::sqrt(std::max(1.0 - place.y() * place.y(), 0.0));
    const double told = std::floor(1000.0 * widest) / 1000.0; // so that steps lead back
    return {std::clamp(place.x(), -told, told), place.y()};
}

std::vector<PlotValue> LitSphere::valuesAt(const QPointF& place) const {
    const glm::vec3 n = normalAt(place);
    return looked([&](std::size_t i) {
        return double{shading::luminance(sphereRadiance(*m_balls[i].lens, m_light, n))};
    });
}

// --- Painting ------------------------------------------------------------------------------------

PictureFrame::Draw LitSphere::drawer() const {
    return [balls = m_balls, light = m_light](QPainter& painter, std::size_t index,
                                              const QRectF& cell, double) {
        painter.drawImage(cell.topLeft(),
                          spherePicture(*balls[index].lens, light, static_cast<int>(cell.width())));
    };
}

void LitSphere::paintProbe(QPainter& painter, const QPointF& place) const {
    const QPointF way = pointOf(place) - pointOf({});
    for (const QRectF& square : PictureFrame::cells())
        paintCross(painter, square.center() + way);
}

} // namespace patina::editor
