#include "core/cells/Wall.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <utility>

namespace patina {
namespace {

constexpr std::size_t kReadableRow = 6; // cells beside each other that need no wrap

Error usage(std::string message) {
    return {ErrorKind::Usage, std::move(message), {}, {}};
}

// "studio", "studio (2)": two files of one name.
void distinguish(std::vector<WallEntry>& entries) {
    std::map<std::string, int> seen;
    for (WallEntry& entry : entries)
        if (const int count = ++seen[entry.caption]; count > 1)
            entry.caption += fmt::format(" ({})", count);
}

// Rows as full as each other: seven are four and three.
std::size_t readableWidth(std::size_t count) {
    const std::size_t rows = std::min((count + kReadableRow - 1) / kReadableRow, kMostOnWallSide);
    return (count + rows - 1) / rows;
}

// The parameter that both set in one element, so that columns would show what rows say; null: none.
const ParameterInfo* inBoth(const WallAxis& a, const WallAxis& b) {
    for (const WallEntry& first : a.entries)
        for (const CellEdit& one : first.cell.own)
            for (const WallEntry& second : b.entries)
                for (const CellEdit& other : second.cell.own)
                    if (one.target == other.target && one.info == other.info)
                        return one.info;
    return nullptr;
}

} // namespace

Result<Wall> makeWall(std::vector<WallAxis> axes, std::size_t gridWidth) {
    constexpr const char* kCompared =
        "environments, materials, lighting modes, snapshots or values of a parameter";
    if (axes.empty())
        return usage(fmt::format("choose what the columns or rows compare: {}", kCompared));
    if (axes.size() > 2)
        return usage(fmt::format("columns and rows compare two things, not {}; leave out all but "
                                 "two of {}",
                                 axes.size(), kCompared));
    for (WallAxis& axis : axes) {
        if (axis.entries.empty())
            return usage(fmt::format("\"{}\" has nothing to show on a wall", axis.title));
        distinguish(axis.entries);
    }
    if (axes.size() == 2)
        if (const ParameterInfo* both = inBoth(axes[0], axes[1]))
            return usage(fmt::format("columns and rows would both set {}; compare something else "
                                     "in one of them",
                                     both->id));
    const auto showsSnapshots = [](const WallAxis& axis) {
        return std::ranges::any_of(axis.entries,
                                   [](const WallEntry& entry) { return entry.cell.snapshot != 0; });
    };
    if (axes.size() == 2 && showsSnapshots(axes[0]) && showsSnapshots(axes[1]))
        return usage("columns and rows would both show snapshots; compare something else in one "
                     "of them");
    Wall wall;
    wall.columns = std::move(axes[0]);
    const std::size_t count = wall.columns.entries.size();
    if (axes.size() == 2) {
        wall.rows = std::move(axes[1]);
        wall.width = count;
        wall.height = wall.rows.entries.size();
    } else {
        wall.width = gridWidth > 0 ? std::min(gridWidth, count) : readableWidth(count);
        wall.height = (count + wall.width - 1) / wall.width;
    }
    if (std::max(wall.width, wall.height) > kMostOnWallSide)
        return usage(fmt::format("a wall has at most {0} × {0} cells, and this one would have {1} "
                                 "× {2}; show fewer at a time",
                                 kMostOnWallSide, wall.width, wall.height));
    return wall;
}

std::vector<WallCell> cellsOf(const Wall& wall) {
    std::vector<WallCell> cells;
    const std::vector<WallEntry>&columns = wall.columns.entries, &rows = wall.rows.entries;
    const auto add = [&](std::size_t column, std::size_t row, std::vector<std::string> captions,
                         const Cell& cell) {
        cells.push_back({column, row, std::move(captions), cell, cell, {}});
    };
    if (!wall.isTable()) {
        for (std::size_t i = 0; i < columns.size(); ++i)
            add(i % wall.width, i / wall.width, {columns[i].caption}, columns[i].cell);
        return cells;
    }
    for (std::size_t row = 0; row < rows.size(); ++row)
        for (std::size_t column = 0; column < columns.size(); ++column)
            add(column, row, {columns[column].caption, rows[row].caption},
                combined(columns[column].cell, rows[row].cell));
    return cells;
}

} // namespace patina
