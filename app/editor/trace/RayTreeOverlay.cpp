#include "app/editor/trace/RayTreeOverlay.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/trace/RayTreeProbe.h"
#include "app/editor/trace/RayTreeTexts.h"
#include "app/editor/trace/ViewLines.h"
#include "app/editor/viewport/ViewportWidget.h"
#include "core/document/Document.h"

#include <algorithm>
#include <cmath>

namespace patina::editor {
namespace {

constexpr double kRayWidth = 1.6, kSelectedWidth = 3.2, kHalo = 2.0; // pixels
constexpr double kPointRadius = 2.6;
constexpr int kDimAlpha = 80;          // of 255, beside a selected ray
constexpr float kNormalLength = 0.05f; // of the camera's distance from its target

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
    if (event->type() == QEvent::Resize)
        setGeometry(m_viewport.rect());
    if (const auto at = m_click.follow(*event, m_probe.picks()))
        m_probe.pick({at->x() / std::max(m_viewport.width(), 1),
                      at->y() / std::max(m_viewport.height(), 1)});
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

// --- Painting ------------------------------------------------------------------------------------

glm::vec3 RayTreeOverlay::endOf(const RayNode& node) const {
    const bool ends = node.hit || !std::isinf(node.distance);
    return ends ? node.position : node.origin + m_reach * node.direction;
}

void RayTreeOverlay::paintRay(QPainter& painter, const ViewLines& view, const RayNode& node,
                              bool selected, bool dimmed) const {
    QColor color = rayColor(node), halo(tokens::kWell);
    if (dimmed)
        color.setAlpha(kDimAlpha);
    halo.setAlpha(dimmed ? kDimAlpha / 2 : 170);
    const double wide = selected ? kSelectedWidth : kRayWidth;
    const Qt::PenStyle style = node.end == RayEnd::Blocked ? Qt::DashLine : Qt::SolidLine;
    if (const auto line = view.line(node.origin, endOf(node))) {
        painter.setPen(QPen(halo, wide + kHalo, Qt::SolidLine, Qt::RoundCap));
        painter.drawLine(*line);
        painter.setPen(QPen(color, wide, style, Qt::RoundCap));
        painter.drawLine(*line);
    }
    if (!node.hit)
        return;
    if (const auto point = view.point(node.position)) {
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
    if (const auto line = view.line(
            node.position, node.position + kNormalLength * m_camera.distance * node.normal)) {
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
    const ViewLines view(m_camera, size());
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
                paintRay(painter, view, nodes[i], isSelected, !isSelected && selected >= 0);
        }
    };
    paint(false);
    paint(true); // over the others
}

} // namespace patina::editor
