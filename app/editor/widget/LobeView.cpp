#include "app/editor/widget/LobeView.h"

#include "app/editor/style/FocusRing.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/widget/PlotStyle.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

namespace patina::editor {
namespace {
constexpr double kDegreesPerPixel = 0.6;
constexpr double kLowest = 2.0, kHighest = 90.0; // of the camera: never from below
constexpr double kGap = 6.0;
} // namespace

LobeView::LobeView(TaskRunner& runner, const QString& title, QWidget* parent)
    : QWidget(parent)
    , m_title(title)
    , m_job(runner, "lobe in space") {
    setFocusPolicy(Qt::StrongFocus);
    setCursor(Qt::OpenHandCursor);
    setAccessibleName(title);
    setAccessibleDescription(
        tr("The lobe in space. Drag to look from another side, double-click to go back."));
    setStatusTip(accessibleDescription());
}

QSize LobeView::sizeHint() const {
    return {260, 200};
}
QSize LobeView::minimumSizeHint() const {
    return {140, 110};
}

void LobeView::setLobes(std::vector<Lobe> lobes, double incidenceDeg, const QString& peak) {
    m_lobes = std::move(lobes);
    m_incidenceDeg = incidenceDeg;
    m_peak = peak;
    draw();
}

void LobeView::setMessage(const QString& message) {
    m_message = message;
    update();
}

QRectF LobeView::area() const {
    return QRectF(rect()).adjusted(kGap, plotTitleHeight(font()), -kGap, -kGap);
}

void LobeView::draw() {
    if (!isVisible() || m_lobes.empty())
        return;
    const double ratio = devicePixelRatioF();
    const QRectF all = area();
    m_job.request([this, lobes = m_lobes, camera = m_camera, ratio, all,
                   incidence =
                       static_cast<float>(glm::radians(m_incidenceDeg))](const JobContext&) {
        QImage picture((all.size() * ratio).toSize(), QImage::Format_ARGB32_Premultiplied);
        picture.fill(Qt::transparent);
        QPainter painter(&picture);
        const std::vector<QRectF> cells = plotCells(QRectF(QPointF(), all.size() * ratio),
                                                    static_cast<int>(lobes.size()), kGap * ratio);
        for (std::size_t i = 0; i < lobes.size(); ++i)
            painter.drawImage(cells[i].topLeft(), lobePicture(*lobes[i].mesh, camera, incidence,
                                                              cells[i].size().toSize(),
                                                              plotColor(lobes[i].look), ratio));
        painter.end();
        picture.setDevicePixelRatio(ratio);
        return [this, picture] {
            m_picture = picture;
            update();
        };
    });
}

void LobeView::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    paintPlotWell(painter, rect(), m_title);
    const double title = QFontMetricsF(font()).horizontalAdvance(m_title) + 20.0;
    painter.setFont(plotFont(font()));
    if (!m_message.isEmpty()) {
        paintPlotMessage(painter, rect(), m_message);
        return;
    }
    painter.drawImage(area().topLeft(), m_picture);
    const QFontMetricsF metrics(painter.font());
    painter.setPen(QColor(tokens::kTextDim));
    const double w = metrics.horizontalAdvance(m_peak);
    if (width() - 8.0 - w > title)
        painter.drawText(QPointF(width() - 8.0 - w, 5.0 + QFontMetricsF(font()).ascent()), m_peak);
    if (m_lobes.size() > 1) {
        const std::vector<QRectF> cells = plotCells(area(), static_cast<int>(m_lobes.size()), kGap);
        for (std::size_t i = 0; i < m_lobes.size(); ++i) {
            painter.setPen(plotColor(m_lobes[i].look));
            painter.drawText(
                cells[i].adjusted(2, 0, -2, 0), Qt::AlignHCenter | Qt::AlignTop,
                metrics.elidedText(m_lobes[i].name, Qt::ElideRight, cells[i].width() - 4.0));
        }
    }
    if (hasFocus()) {
        painter.setPen(QColor(tokens::kFocus));
        painter.setBrush(Qt::NoBrush);
        painter.drawRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), tokens::kRadius,
                                tokens::kRadius);
    }
}

void LobeView::resizeEvent(QResizeEvent*) {
    draw();
}

void LobeView::showEvent(QShowEvent*) {
    draw();
}

void LobeView::orbit(double yawDeg, double elevationDeg) {
    m_camera.yawDeg = std::remainder(m_camera.yawDeg + yawDeg, 360.0);
    m_camera.elevationDeg = std::clamp(m_camera.elevationDeg + elevationDeg, kLowest, kHighest);
    draw();
}

void LobeView::mousePressEvent(QMouseEvent* event) {
    m_last = event->position();
}

void LobeView::mouseMoveEvent(QMouseEvent* event) {
    if (!(event->buttons() & Qt::LeftButton))
        return;
    const QPointF way = event->position() - m_last;
    m_last = event->position();
    orbit(-way.x() * kDegreesPerPixel, way.y() * kDegreesPerPixel);
}

void LobeView::mouseDoubleClickEvent(QMouseEvent*) {
    m_camera = {};
    draw();
}

void LobeView::keyPressEvent(QKeyEvent* event) {
    constexpr double kStep = 5.0;
    switch (event->key()) {
    case Qt::Key_Left:
        return orbit(kStep, 0);
    case Qt::Key_Right:
        return orbit(-kStep, 0);
    case Qt::Key_Up:
        return orbit(0, kStep);
    case Qt::Key_Down:
        return orbit(0, -kStep);
    default:
        QWidget::keyPressEvent(event);
    }
}

} // namespace patina::editor
