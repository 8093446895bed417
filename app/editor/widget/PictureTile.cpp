#include "app/editor/widget/PictureTile.h"

#include "app/editor/style/Tokens.h"

namespace patina::editor {
namespace {
constexpr int kWrapped = Qt::AlignHCenter | Qt::AlignTop | Qt::TextWordWrap;
} // namespace

PictureTile::PictureTile(const QString& title, const PlotAxis& quantity, QWidget* parent)
    : PlotFrame(title, Cursor::Both, Press::Nothing, parent) {
    setAxes(directionAxes(quantity));
}

void PictureTile::setPicture(const QImage& picture, const QString& note, Reader reader) {
    m_picture = picture;
    m_note = note;
    m_reader = std::move(reader);
    setDescription(note);
    setStatusTip(note);
    update();
}

// --- Places --------------------------------------------------------------------------------------

QRectF PictureTile::noteArea() const {
    const double wide = width() - 12;
    const double lines = QFontMetricsF(plotFont(font()))
                             .boundingRect(QRectF(0, 0, wide, 1e4), kWrapped, m_note)
                             .height();
    return {6, height() - lines - 4, wide, lines + 1};
}

QRectF PictureTile::area() const {
    const double top = plotTitleHeight(font()) + 2;
    const QRectF room(6, top, width() - 12, std::max(noteArea().top() - 3 - top, 1.0));
    const QSizeF size = QSizeF(m_picture.size()).scaled(room.size(), Qt::KeepAspectRatio);
    return {room.center() - QPointF(size.width(), size.height()) / 2, size};
}

std::optional<QPointF> PictureTile::placeAt(const QPointF& point) const {
    return area().contains(point) ? PlotFrame::placeAt(point) : std::nullopt;
}

std::vector<PlotValue> PictureTile::valuesAt(const QPointF& place) const {
    return {{{}, m_reader(directionAt(place))}};
}

void PictureTile::paintValues(QPainter& painter) const {
    painter.drawImage(area(), m_picture);
    painter.setPen(QColor(tokens::kTextDim));
    painter.drawText(noteArea(), kWrapped, m_note);
}

} // namespace patina::editor
