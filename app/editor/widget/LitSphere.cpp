#include "app/editor/widget/LitSphere.h"

#include "app/editor/style/Tokens.h"
#include "app/editor/widget/PlotStyle.h"

#include <QMouseEvent>
#include <algorithm>
#include <cmath>

namespace patina::editor {
namespace {
constexpr double kGap = 6.0;
} // namespace

LitSphere::LitSphere(TaskRunner& runner, const QString& title, QWidget* parent)
    : QWidget(parent)
    , m_title(title)
    , m_job(runner, "lit ball") {
    m_light.toLight = glm::normalize(glm::vec3(-0.75f, 0.75f, 0.6f));
    setCursor(Qt::OpenHandCursor);
    setAccessibleName(title);
    setAccessibleDescription(tr("The material on a ball, under one light of 3 lux and the scene's "
                                "environment. Drag the highlight to move the light."));
    setStatusTip(accessibleDescription());
}

QSize LitSphere::sizeHint() const {
    return {260, 200};
}
QSize LitSphere::minimumSizeHint() const {
    return {140, 110};
}

void LitSphere::setBalls(std::vector<Ball> balls) {
    m_balls = std::move(balls);
    draw();
}

void LitSphere::setEnvironment(std::shared_ptr<const IblMaps> maps, const Environment& environment,
                               const View& view) {
    m_light.maps = std::move(maps);
    m_light.rotationDeg = environment.rotationDeg;
    m_light.exposureEv = environment.exposureEv;
    m_light.view = view;
    draw();
}

void LitSphere::setMessage(const QString& message) {
    m_message = message;
    update();
}

QRectF LitSphere::area() const {
    return QRectF(rect()).adjusted(kGap, plotTitleHeight(font()), -kGap, -kGap);
}

// The largest square of each cell, below the name where there are several; `unit` pixels each.
std::vector<QRectF> LitSphere::squares(const QRectF& area, double unit) const {
    std::vector<QRectF> squares;
    const double name =
        m_balls.size() > 1 ? std::ceil(QFontMetricsF(plotFont(font())).height()) * unit : 0.0;
    for (const QRectF& cell : plotCells(area, static_cast<int>(m_balls.size()), kGap * unit)) {
        const double side = std::floor(std::min(cell.width(), cell.height() - name));
        squares.emplace_back(cell.center().x() - side / 2,
                             cell.top() + name + (cell.height() - name - side) / 2, side, side);
    }
    return squares;
}

void LitSphere::draw() {
    if (!isVisible() || m_balls.empty())
        return;
    const double ratio = devicePixelRatioF();
    const QSizeF size = area().size() * ratio;
    m_job.request([this, balls = m_balls, light = m_light, ratio, size,
                   places = squares(QRectF(QPointF(), size), ratio)](const JobContext&) {
        QImage picture(size.toSize(), QImage::Format_ARGB32_Premultiplied);
        picture.fill(Qt::transparent);
        QPainter painter(&picture);
        for (std::size_t i = 0; i < balls.size(); ++i)
            painter.drawImage(
                places[i].topLeft(),
                spherePicture(*balls[i].lens, light, static_cast<int>(places[i].width())));
        painter.end();
        picture.setDevicePixelRatio(ratio);
        return [this, picture] {
            m_picture = picture;
            update();
        };
    });
}

void LitSphere::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    paintPlotWell(painter, rect(), m_title);
    painter.setFont(plotFont(font()));
    if (!m_message.isEmpty()) {
        paintPlotMessage(painter, rect(), m_message);
        return;
    }
    painter.drawImage(area().topLeft(), m_picture);
    if (m_balls.size() < 2)
        return;
    const QFontMetricsF metrics(painter.font());
    const std::vector<QRectF> places = squares(area(), 1.0);
    for (std::size_t i = 0; i < m_balls.size(); ++i) {
        painter.setPen(plotColor(m_balls[i].look));
        const QRectF name(places[i].left(), places[i].top() - metrics.height() - 1.0,
                          places[i].width(), metrics.height());
        painter.drawText(name, Qt::AlignCenter,
                         metrics.elidedText(m_balls[i].name, Qt::ElideRight, name.width()));
    }
}

void LitSphere::resizeEvent(QResizeEvent*) {
    draw();
}

void LitSphere::showEvent(QShowEvent*) {
    draw();
}

void LitSphere::mousePressEvent(QMouseEvent* event) {
    if (event->button() == Qt::LeftButton)
        dragTo(event->position());
}

void LitSphere::mouseMoveEvent(QMouseEvent* event) {
    if (event->buttons() & Qt::LeftButton)
        dragTo(event->position());
}

// The highlight stands where the normal halves the angle between light and viewer.
void LitSphere::dragTo(const QPointF& point) {
    const std::vector<QRectF> places = squares(area(), 1.0);
    if (places.empty())
        return;
    const auto nearest =
        std::min_element(places.begin(), places.end(), [&](const QRectF& a, const QRectF& b) {
            const QPointF toA = a.center() - point, toB = b.center() - point;
            return QPointF::dotProduct(toA, toA) < QPointF::dotProduct(toB, toB);
        });
    const QPointF way = (point - nearest->center()) / (nearest->width() / 2.0);
    glm::vec2 at(static_cast<float>(way.x()), static_cast<float>(-way.y()));
    at *= std::min(1.0f, 0.95f / std::max(glm::length(at), 1e-6f));
    const glm::vec3 h(at, std::sqrt(1.0f - glm::dot(at, at)));
    m_light.toLight = 2.0f * h.z * h - glm::vec3(0.0f, 0.0f, 1.0f);
    draw();
}

} // namespace patina::editor
