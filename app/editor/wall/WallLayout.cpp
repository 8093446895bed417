#include "app/editor/wall/WallLayout.h"

#include "app/editor/document/QtText.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/wall/WallState.h"

#include <QStringList>
#include <algorithm>
#include <cmath>

namespace patina::editor {
namespace {

constexpr int kCellGap = 4;
constexpr int kMostRowHead = 4; // captions of rows take a fourth of the width at most

// The pieces of `length` from `start` that `count` cells with gaps between them get, as equal as
// whole pixels allow.
QPair<int, int> piece(int start, int length, std::size_t count, std::size_t index) {
    const int n = static_cast<int>(count), i = static_cast<int>(index);
    const int free = std::max(length - kCellGap * (n - 1), n);
    const int from = free * i / n, to = free * (i + 1) / n;
    return {start + from + i * kCellGap, to - from};
}

} // namespace

QString captionOf(const WallCell& cell) {
    QStringList parts;
    for (const std::string& part : cell.captions)
        parts << toQString(part);
    return parts.join(QStringLiteral("  ·  "));
}

WallLayout WallLayout::of(const WallState& state, const QSize& size, const QFontMetrics& metrics) {
    WallLayout layout;
    layout.size = size;
    const Wall& wall = state.wall();
    const std::vector<WallCell>& cells = state.cells();
    if (cells.empty())
        return layout;
    const int line = metrics.height() + tokens::kGap;
    layout.cells.resize(cells.size());
    if (const auto enlarged = state.enlarged()) {
        layout.cells[*enlarged] = {0, line, size.width(), std::max(size.height() - line, 1)};
        const auto compared = state.compared();
        if (compared)
            layout.cells[*compared] = layout.cells[*enlarged];
        layout.captions.push_back(
            {{0, 0, size.width(), line},
             compared ? QStringLiteral("A  %1      B  %2")
                            .arg(captionOf(cells[*enlarged]), captionOf(cells[*compared]))
                      : captionOf(cells[*enlarged]),
             Qt::AlignCenter,
             {*enlarged}});
        return layout;
    }
    QRect room(QPoint(0, 0), size);
    if (wall.isTable()) {
        int head = 0;
        for (const WallEntry& entry : wall.rows.entries)
            head = std::max(head, metrics.horizontalAdvance(toQString(entry.caption)));
        head = std::min(head + 2 * tokens::kGap, size.width() / kMostRowHead);
        room.adjust(head, line, 0, 0);
    }
    const int below = wall.isTable() ? 0 : line; // a caption for each cell of a grid
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const auto [x, width] = piece(room.left(), room.width(), wall.width, cells[i].column);
        const auto [y, height] = piece(room.top(), room.height(), wall.height, cells[i].row);
        layout.cells[i] = {x, y, width, std::max(height - below, 1)};
        if (below > 0)
            layout.captions.push_back(
                {{x, y + height - below, width, below}, captionOf(cells[i]), Qt::AlignCenter, {i}});
    }
    if (!wall.isTable())
        return layout;
    const auto cellsWhere = [&](auto place, std::size_t at) {
        std::vector<std::size_t> found;
        for (std::size_t i = 0; i < cells.size(); ++i)
            if (cells[i].*place == at)
                found.push_back(i);
        return found;
    };
    for (std::size_t i = 0; i < wall.width; ++i) {
        const auto [x, width] = piece(room.left(), room.width(), wall.width, i);
        layout.captions.push_back({{x, 0, width, line},
                                   toQString(wall.columns.entries[i].caption),
                                   Qt::AlignCenter,
                                   cellsWhere(&WallCell::column, i)});
    }
    for (std::size_t i = 0; i < wall.height; ++i) {
        const auto [y, height] = piece(room.top(), room.height(), wall.height, i);
        layout.captions.push_back({{tokens::kGap / 2, y, room.left() - tokens::kGap, height},
                                   toQString(wall.rows.entries[i].caption),
                                   Qt::AlignRight | Qt::AlignVCenter,
                                   cellsWhere(&WallCell::row, i)});
    }
    return layout;
}

std::optional<std::size_t> WallLayout::cellAt(const QPointF& position) const {
    for (std::size_t i = 0; i < cells.size(); ++i)
        if (cells[i].contains(position.toPoint()))
            return i;
    return std::nullopt;
}

std::optional<std::size_t> WallLayout::closestCell(const QPointF& position) const {
    std::optional<std::size_t> closest;
    double least = 0.0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (cells[i].isNull())
            continue;
        const QRectF cell(cells[i]);
        const double x = std::clamp(position.x(), cell.left(), cell.right()) - position.x();
        const double y = std::clamp(position.y(), cell.top(), cell.bottom()) - position.y();
        if (const double distance = std::hypot(x, y); !closest || distance < least) {
            closest = i;
            least = distance;
        }
    }
    return closest;
}

std::vector<std::size_t> WallLayout::cellsAt(const QPointF& position) const {
    if (const auto cell = cellAt(position))
        return {*cell};
    for (const Caption& caption : captions)
        if (caption.place.contains(position.toPoint()))
            return caption.of;
    return {};
}

QRect WallLayout::areaOf(const std::vector<std::size_t>& indices) const {
    QRect area;
    for (const std::size_t cell : indices)
        area = area.united(cells[cell]);
    return area;
}

} // namespace patina::editor
