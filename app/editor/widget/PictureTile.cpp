#include "app/editor/widget/PictureTile.h"

#include "app/editor/style/Tokens.h"
#include "app/editor/widget/PlotStyle.h"

#include <QPainter>

namespace patina::editor {

PictureTile::PictureTile(const QString& title, QWidget* parent)
    : QWidget(parent)
    , m_title(title) {
    setAccessibleName(title);
}

void PictureTile::setTitle(const QString& title) {
    m_title = title;
    setAccessibleName(title);
    update();
}

void PictureTile::setPicture(const QImage& picture, const QString& note) {
    m_picture = picture;
    m_note = note;
    setAccessibleDescription(note);
    setToolTip(note);
    update();
}

void PictureTile::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    paintPlotWell(painter, rect(), m_title);
    const QFont small = plotFont(font());
    const QFontMetricsF metrics(small);
    constexpr int kWrapped = Qt::AlignHCenter | Qt::AlignTop | Qt::TextWordWrap;
    const double width = this->width() - 12;
    const double lines = metrics.boundingRect(QRectF(0, 0, width, 1e4), kWrapped, m_note).height();
    const QRectF below(6, height() - lines - 4, width, lines + 1);
    const QRectF area = QRectF(rect()).adjusted(6, plotTitleHeight(font()) + 2, -6, -lines - 7);
    if (!m_picture.isNull() && area.height() > 0) {
        const QSizeF size = QSizeF(m_picture.size()).scaled(area.size(), Qt::KeepAspectRatio);
        painter.drawImage(QRectF(area.center() - QPointF(size.width(), size.height()) / 2, size),
                          m_picture);
    }
    painter.setFont(small);
    painter.setPen(QColor(tokens::kTextDim));
    painter.drawText(below, kWrapped, m_note);
}

} // namespace patina::editor
