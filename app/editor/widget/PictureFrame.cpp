#include "app/editor/widget/PictureFrame.h"

#include <algorithm>
#include <cmath>

namespace patina::editor {
namespace {
constexpr double kPictureGap = 6.0;
} // namespace

PictureFrame::PictureFrame(TaskRunner& runner, const char* job, const QString& title, Press press,
                           QWidget* parent)
    : PlotFrame(title, Cursor::Both, press, parent)
    , m_job(runner, job) {
    QWidget::setCursor(Qt::OpenHandCursor);
}

void PictureFrame::setLooks(std::vector<Look> looks) {
    m_looks = std::move(looks);
    draw();
}

QRectF PictureFrame::area() const {
    return QRectF(rect()).adjusted(kPictureGap, plotTitleHeight(font()), -kPictureGap,
                                   -kPictureGap);
}

std::vector<QRectF> PictureFrame::cells(const QRectF& area, double unit) const {
    return plotCells(area, static_cast<int>(m_looks.size()), kPictureGap * unit);
}

int PictureFrame::cellAt(const QPointF& point) const {
    const std::vector<QRectF> all = cells();
    const auto distance = [&](const QRectF& cell) {
        const QPointF way = cell.center() - point;
        return QPointF::dotProduct(way, way);
    };
    const auto nearest = std::ranges::min_element(all, {}, distance);
    return nearest == all.end() ? -1 : static_cast<int>(nearest - all.begin());
}

double PictureFrame::nameHeight() const {
    return m_looks.size() > 1 ? std::ceil(QFontMetricsF(plotFont(font())).height()) : 0.0;
}

std::vector<PlotValue>
PictureFrame::looked(const std::function<double(std::size_t index)>& value) const {
    std::vector<PlotValue> values;
    for (std::size_t i = 0; i < m_looks.size(); ++i)
        values.push_back(
            {m_looks.size() > 1 ? m_looks[i].name : QString(), {value(i)}, m_looks[i].look});
    return values;
}

void PictureFrame::draw() {
    update();
    if (!isVisible() || m_looks.empty())
        return;
    const double ratio = devicePixelRatioF();
    const QSizeF size = area().size() * ratio;
    m_job.request([this, paint = drawer(), ratio, size,
                   places = cells(QRectF(QPointF(), size), ratio)](const JobContext&) {
        QImage picture(size.toSize(), QImage::Format_ARGB32_Premultiplied);
        picture.fill(Qt::transparent);
        QPainter painter(&picture);
        for (std::size_t i = 0; i < places.size(); ++i)
            paint(painter, i, places[i], ratio);
        painter.end();
        picture.setDevicePixelRatio(ratio);
        return [this, picture] {
            m_picture = picture;
            update();
        };
    });
}

void PictureFrame::paintValues(QPainter& painter) const {
    painter.drawImage(area().topLeft(), m_picture);
    if (m_looks.size() < 2)
        return;
    const QFontMetricsF metrics(painter.font());
    const std::vector<QRectF> places = cells();
    for (std::size_t i = 0; i < m_looks.size(); ++i) {
        const QRectF name(places[i].left(), places[i].top() + nameTop(), places[i].width(),
                          nameHeight());
        painter.setPen(plotColor(m_looks[i].look));
        painter.drawText(name, Qt::AlignHCenter | Qt::AlignTop,
                         metrics.elidedText(m_looks[i].name, Qt::ElideRight, name.width()));
    }
}

void PictureFrame::resizeEvent(QResizeEvent*) {
    draw();
}

void PictureFrame::showEvent(QShowEvent*) {
    draw();
}

} // namespace patina::editor
