// What single cells of a wall have of their own, on top of what their column and row give them:
// another environment, or another rotation of it, say.
#pragma once

#include "core/cells/Wall.h"

#include <span>
#include <vector>

namespace patina {

struct OwnValues {
    Cell of; // as the axes make it: a cell keeps its values wherever it comes to stand
    CellOwn own;
    friend bool operator==(const OwnValues&, const OwnValues&) = default;
};

// As cellsOf(wall), each with its own elements and values: WallCell::own, which WallCell::cell
// contains.
[[nodiscard]] std::vector<WallCell> cellsOf(const Wall& wall, std::span<const OwnValues> own);

// Gives a cell of cellsOf() an environment, material or snapshot of its own; 0: takes it away.
void setOwnElement(std::vector<OwnValues>& own, const WallCell& cell, CellElement element, Id id);
// Gives a cell of cellsOf() a value of its own, or another one.
void setOwnValue(std::vector<OwnValues>& own, const WallCell& cell, const CellEdit& value);
// Takes it away: the cell shows what its column, its row and the document say. Nothing where it has
// none.
void linkValue(std::vector<OwnValues>& own, const WallCell& cell, const Target& target,
               const ParameterInfo& info);

} // namespace patina
