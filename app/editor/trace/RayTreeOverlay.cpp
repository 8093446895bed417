#include "app/editor/trace/RayTreeOverlay.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/trace/RayTreeProbe.h"
#include "app/editor/trace/RayTreeTexts.h"
#include "app/editor/viewport/ViewportWidget.h"
#include "core/document/Document.h"

#include <QApplication>
#include <QMouseEvent>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace patina::editor {
namespace {

constexpr double kRayWidth = 1.6, kSelectedWidth = 3.2, kHalo = 2.0; // pixels
constexpr double kPointRadius = 2.6;
constexpr int kDimAlpha = 80;          // of 255, beside a selected ray
constexpr float kNormalLength = 0.05f; // of the camera's distance from its target
constexpr float kNearest = 1e-3f;      // of that, too: what is nearer is cut off

} // namespace

RayTreeOverlay::RayTreeOverlay(RayTreeProbe& probe, DocumentController& controller,
                               ViewportWidget& viewport)
    : QWidget(&viewport)
    , m_probe(probe)
    , m_controller(controller)
    , m_viewport(viewport) {
    setObjectName(QStringLiteral("rayTreeOverlay"));
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setAttribute(Qt::WA_NoSystemBackground);
    setAccessibleName(tr("Rays of the chosen pixel"));
    setGeometry(viewport.rect());
    hide();
    viewport.installEventFilter(this);
    connect(&probe, &RayTreeProbe::changed, this, &RayTreeOverlay::follow);
    connect(&probe, &RayTreeProbe::selectionChanged, this, qOverload<>(&QWidget::update));
    connect(&viewport, &ViewportWidget::frameRendered, this, [this] {
        if (isVisible() && m_camera != m_controller.document().view.camera)
            update();
    });
}

void RayTreeOverlay::follow() {
    setVisible(m_probe.isWanted() && m_probe.shown() != nullptr);
    setAccessibleDescription(isVisible() ? tr("%1 rays are drawn").arg(drawnRays()) : QString());
    update();
}

bool RayTreeOverlay::eventFilter(QObject*, QEvent* event) {
    if (event->type() == QEvent::Resize) {
        setGeometry(m_viewport.rect());
        return false;
    }
    if (event->type() != QEvent::MouseButtonPress && event->type() != QEvent::MouseMove &&
        event->type() != QEvent::MouseButtonRelease)
        return false;
    const auto* mouse = static_cast<const QMouseEvent*>(event);
    if (event->type() == QEvent::MouseButtonPress) {
        const bool plain = mouse->button() == Qt::LeftButton && mouse->modifiers() == 0;
        m_press = plain && m_probe.picks() ? std::optional(mouse->position()) : std::nullopt;
    } else if (m_press && (mouse->position() - *m_press).manhattanLength() >=
                              QApplication::startDragDistance()) {
        m_press.reset(); // the camera moves
    } else if (m_press && event->type() == QEvent::MouseButtonRelease) {
        m_probe.pick({m_press->x() / std::max(m_viewport.width(), 1),
                      m_press->y() / std::max(m_viewport.height(), 1)});
        m_press.reset();
    }
    return false;
}

int RayTreeOverlay::drawnRays() const {
    if (!m_probe.shown())
        return 0;
    const auto nodes = m_probe.shown()->tree.nodes();
    int count = 0;
    for (auto i = static_cast<std::size_t>(m_probe.cameraRayOf(m_probe.selected()));
         i < nodes.size() && (count == 0 || nodes[i].kind != RayKind::Camera); ++i)
        count += wasCast(nodes[i].end) ? 1 : 0;
    return count;
}

// --- Where things are ----------------------------------------------------------------------------

glm::vec3 RayTreeOverlay::inView(const glm::vec3& world) const {
    const glm::vec3 from = world - m_camera.position();
    return {glm::dot(from, m_camera.right()), glm::dot(from, m_camera.up()),
            glm::dot(from, m_camera.forward())};
}

QPointF RayTreeOverlay::project(const glm::vec3& view) const {
    const float scale = 0.5f * static_cast<float>(height()) /
                        (std::tan(0.5f * glm::radians(m_camera.fovDeg)) * view.z);
    return {0.5 * width() + static_cast<double>(scale * view.x),
            0.5 * height() - static_cast<double>(scale * view.y)};
}

std::optional<QPointF> RayTreeOverlay::placeOf(const glm::vec3& world) const {
    const glm::vec3 view = inView(world);
    if (view.z < kNearest * m_camera.distance)
        return std::nullopt;
    return project(view);
}

// What of it is in front of the viewer.
std::optional<QLineF> RayTreeOverlay::lineOf(const glm::vec3& from, const glm::vec3& to) const {
    glm::vec3 a = inView(from), b = inView(to);
    const float nearest = kNearest * m_camera.distance;
    if (a.z < nearest && b.z < nearest)
        return std::nullopt;
    const auto cut = [nearest](const glm::vec3& outside, const glm::vec3& inside) {
        return inside + (outside - inside) * ((inside.z - nearest) / (inside.z - outside.z));
    };
    if (a.z < nearest)
        a = cut(a, b);
    if (b.z < nearest)
        b = cut(b, a);
    return QLineF(project(a), project(b));
}

glm::vec3 RayTreeOverlay::endOf(const RayNode& node) const {
    const bool ends = node.hit || !std::isinf(node.distance);
    return ends ? node.position : node.origin + m_reach * node.direction;
}

// --- Painting ------------------------------------------------------------------------------------

void RayTreeOverlay::paintRay(QPainter& painter, const RayNode& node, bool selected,
                              bool dimmed) const {
    QColor color = rayColor(node), halo(tokens::kWell);
    if (dimmed)
        color.setAlpha(kDimAlpha);
    halo.setAlpha(dimmed ? kDimAlpha / 2 : 170);
    const double wide = selected ? kSelectedWidth : kRayWidth;
    const Qt::PenStyle style = node.end == RayEnd::Blocked ? Qt::DashLine : Qt::SolidLine;
    if (const auto line = lineOf(node.origin, endOf(node))) {
        painter.setPen(QPen(halo, wide + kHalo, Qt::SolidLine, Qt::RoundCap));
        painter.drawLine(*line);
        painter.setPen(QPen(color, wide, style, Qt::RoundCap));
        painter.drawLine(*line);
    }
    if (!node.hit)
        return;
    if (const auto point = placeOf(node.position)) {
        const double radius = kPointRadius + (selected ? 1.5 : 0.0);
        painter.setPen(QPen(halo, 1.2));
        painter.setBrush(color);
        painter.drawEllipse(*point, radius, radius);
    }
    if (node.kind == RayKind::Shadow) // what is in the way matters, and not how it lies
        return;
    QColor normal(tokens::kAccent);
    if (dimmed)
        normal.setAlpha(kDimAlpha);
    if (const auto line = lineOf(node.position,
                                 node.position + kNormalLength * m_camera.distance * node.normal)) {
        painter.setPen(QPen(halo, kRayWidth + kHalo));
        painter.drawLine(*line);
        painter.setPen(QPen(normal, kRayWidth));
        painter.drawLine(*line);
    }
}

void RayTreeOverlay::paintEvent(QPaintEvent*) {
    if (!m_probe.shown())
        return;
    m_camera = m_controller.document().view.camera;
    m_reach = 2.0f * std::max(m_controller.document().bounds().radius(), 0.5f * m_camera.distance);
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const auto nodes = m_probe.shown()->tree.nodes();
    const int selected = m_probe.selected();
    const auto first = static_cast<std::size_t>(m_probe.cameraRayOf(selected));
    const auto paint = [&](bool marked) {
        for (std::size_t i = first; i < nodes.size(); ++i) {
            if (i > first && nodes[i].kind == RayKind::Camera)
                break;
            const bool isSelected = static_cast<int>(i) == selected;
            if (isSelected == marked && wasCast(nodes[i].end))
                paintRay(painter, nodes[i], isSelected, !isSelected && selected >= 0);
        }
    };
    paint(false);
    paint(true); // over the others
}

} // namespace patina::editor
