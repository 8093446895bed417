// Where the cells of a wall and their captions lie in the viewport.
#pragma once

#include "core/cells/Wall.h"

#include <QFontMetrics>
#include <QRect>
#include <QSize>
#include <QString>
#include <optional>
#include <vector>

namespace patina::editor {

class WallState;

[[nodiscard]] QString captionOf(const WallCell& cell); // of its column and row

struct WallLayout {
    struct Caption {
        QRect place;
        QString text; // in full; what does not fit is elided
        Qt::Alignment alignment;
        std::vector<std::size_t> of; // cells
    };
    QSize size;
    std::vector<QRect> cells; // device-independent pixels; null: not shown
    std::vector<Caption> captions;

    // Cells fill `size`, apart from captions and gaps; all on whole device pixels.
    static WallLayout of(const WallState& wall, const QSize& size, const QFontMetrics& metrics);
    [[nodiscard]] std::optional<std::size_t> cellAt(const QPointF& position) const;
    // The one that is shown closest to a position; nothing: none is shown.
    [[nodiscard]] std::optional<std::size_t> closestCell(const QPointF& position) const;
    // That cell, or at a caption all that it is of: a column, a row. None elsewhere.
    [[nodiscard]] std::vector<std::size_t> cellsAt(const QPointF& position) const;
    [[nodiscard]] QRect areaOf(const std::vector<std::size_t>& cells) const; // around them
};

} // namespace patina::editor
