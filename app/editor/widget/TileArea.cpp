#include "app/editor/widget/TileArea.h"

#include <QScrollBar>
#include <algorithm>

namespace patina::editor {
namespace {
constexpr int kGap = 6;
}

TileArea::TileArea(QSize smallestTile, QWidget* parent)
    : QScrollArea(parent)
    , m_smallest(smallestTile) {
    auto* body = new QWidget;
    body->setObjectName(QStringLiteral("panelContents"));
    setWidget(body);
    setFrameShape(QFrame::NoFrame);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    setFocusPolicy(Qt::NoFocus);
}

void TileArea::add(QWidget* tile) {
    tile->setParent(widget());
    tile->hide();
    m_tiles << tile;
}

void TileArea::setShown(const QList<QWidget*>& tiles) {
    m_shown = tiles;
    arrange();
    for (QWidget* tile : std::as_const(m_tiles))
        tile->setVisible(m_shown.contains(tile));
}

QSize TileArea::sizeHint() const {
    return {2 * m_smallest.width(), 2 * m_smallest.height()};
}

QSize TileArea::minimumSizeHint() const {
    return m_smallest;
}

void TileArea::resizeEvent(QResizeEvent* event) {
    QScrollArea::resizeEvent(event);
    arrange();
}

void TileArea::arrange() {
    const int count = static_cast<int>(m_shown.size());
    if (count == 0)
        return;
    const auto tileSize = [&](const QSize& room, int columns) {
        const int rows = (count + columns - 1) / columns;
        return QSize((room.width() - kGap * (columns - 1)) / columns,
                     (room.height() - kGap * (rows - 1)) / rows);
    };
    // Without scrolling, in the columns whose tiles are largest, if they are large enough.
    const QSize all = maximumViewportSize();
    int columns = 0, best = 0;
    for (int c = 1; c <= count; ++c) {
        const QSize size = tileSize(all, c);
        // A plot gains little from being wider than 3 : 2.
        const int gain = std::min(size.width() * 2, size.height() * 3);
        if (size.width() >= m_smallest.width() && size.height() >= m_smallest.height() &&
            gain > best) {
            best = gain;
            columns = c;
        }
    }
    QSize room = all, size;
    if (columns > 0) {
        size = tileSize(all, columns);
    } else {
        room.rwidth() -= verticalScrollBar()->sizeHint().width();
        columns = std::clamp((room.width() + kGap) / (m_smallest.width() + kGap), 1, count);
        size = tileSize(room, columns);
        // One row in view at a time is not cut off by the edge.
        const int rows = std::max(1, (room.height() + kGap) / (m_smallest.height() + kGap));
        size.setHeight(std::max((room.height() - kGap * (rows - 1)) / rows, m_smallest.height()));
    }
    const int rows = (count + columns - 1) / columns;
    widget()->resize(room.width(), std::max(rows * size.height() + kGap * (rows - 1), 1));
    verticalScrollBar()->setSingleStep(std::max(size.height() / 4, 1));
    for (int i = 0; i < count; ++i)
        m_shown[i]->setGeometry((i % columns) * (size.width() + kGap),
                                (i / columns) * (size.height() + kGap), size.width(),
                                size.height());
}

} // namespace patina::editor
