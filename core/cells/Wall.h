// Cells beside and above each other: every column with every row.
#pragma once

#include "core/cells/Cell.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace patina {

inline constexpr std::size_t kMostOnWallSide = 8; // of columns, and of rows

struct WallEntry {
    std::string caption;
    Cell cell; // what the cells of this column or row have of their own
    friend bool operator==(const WallEntry&, const WallEntry&) = default;
};

struct WallAxis {
    std::string title; // "Roughness"
    std::vector<WallEntry> entries;
    friend bool operator==(const WallAxis&, const WallAxis&) = default;
};

struct Wall {
    WallAxis columns;
    WallAxis rows; // without entries: the columns' alone, in reading order
    std::size_t width = 0, height = 0;

    [[nodiscard]] bool isTable() const { return !rows.entries.empty(); }
    friend bool operator==(const Wall&, const Wall&) = default;
};

// Of one axis, which wraps into a grid, or two: columns and rows. `gridWidth` of one; 0: chosen, a
// row of up to six. Captions that two entries share are numbered. Usage error for none, more than
// two, an axis without entries, a parameter that both set, more than kMostOnWallSide a side.
[[nodiscard]] Result<Wall> makeWall(std::vector<WallAxis> axes, std::size_t gridWidth = 0);

// What a cell can have of its own beside values.
enum class CellElement { Environment, Material, Snapshot };
inline constexpr std::array kCellElements{CellElement::Environment, CellElement::Material,
                                          CellElement::Snapshot};

struct CellOwn {
    std::array<Id, kCellElements.size()> elements{}; // by CellElement; 0: linked
    std::vector<CellEdit> values;                    // at most one of each parameter of an element

    [[nodiscard]] Id& element(CellElement which) {
        return elements[static_cast<std::size_t>(which)];
    }
    [[nodiscard]] Id element(CellElement which) const {
        return elements[static_cast<std::size_t>(which)];
    }
    [[nodiscard]] bool isEmpty() const { return *this == CellOwn(); }
    friend bool operator==(const CellOwn&, const CellOwn&) = default;
};

struct WallCell {
    std::size_t column = 0, row = 0;
    std::vector<std::string> captions; // of its column and row, or its only one
    Cell cell;                         // all that it has of its own
    Cell shared;                       // of it what its column and row give it
    CellOwn own;                       // and the rest (OwnValues.h)
    friend bool operator==(const WallCell&, const WallCell&) = default;
};
[[nodiscard]] std::vector<WallCell> cellsOf(const Wall& wall); // row by row

} // namespace patina
