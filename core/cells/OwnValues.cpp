#include "core/cells/OwnValues.h"

#include <algorithm>

namespace patina {
namespace {

auto isOf(const Target& target, const ParameterInfo* info) {
    return
        [target, info](const CellEdit& edit) { return edit.target == target && edit.info == info; };
}

std::vector<OwnValues>::iterator ownOf(std::vector<OwnValues>& own, const WallCell& cell) {
    return std::ranges::find(own, cell.shared, &OwnValues::of);
}

CellOwn& addedOwnOf(std::vector<OwnValues>& own, const WallCell& cell) {
    const auto found = ownOf(own, cell);
    return found != own.end() ? found->own : own.emplace_back(OwnValues{cell.shared, {}}).own;
}

void dropEmpty(std::vector<OwnValues>& own) {
    std::erase_if(own, [](const OwnValues& one) { return one.own.isEmpty(); });
}

} // namespace

std::vector<WallCell> cellsOf(const Wall& wall, std::span<const OwnValues> own) {
    std::vector<WallCell> cells = cellsOf(wall);
    for (WallCell& cell : cells) {
        const auto found = std::ranges::find(own, cell.shared, &OwnValues::of);
        if (found == own.end())
            continue;
        cell.own = found->own;
        Cell above;
        above.environment = cell.own.element(CellElement::Environment);
        above.material = cell.own.element(CellElement::Material);
        above.snapshot = cell.own.element(CellElement::Snapshot);
        above.own = cell.own.values;
        cell.cell = combined(cell.shared, above);
    }
    return cells;
}

void setOwnElement(std::vector<OwnValues>& own, const WallCell& cell, CellElement element, Id id) {
    addedOwnOf(own, cell).element(element) = id;
    dropEmpty(own);
}

void setOwnValue(std::vector<OwnValues>& own, const WallCell& cell, const CellEdit& value) {
    std::vector<CellEdit>& values = addedOwnOf(own, cell).values;
    const auto known = std::ranges::find_if(values, isOf(value.target, value.info));
    if (known != values.end())
        *known = value;
    else
        values.push_back(value);
}

void linkValue(std::vector<OwnValues>& own, const WallCell& cell, const Target& target,
               const ParameterInfo& info) {
    const auto found = ownOf(own, cell);
    if (found == own.end())
        return;
    std::erase_if(found->own.values, isOf(target, &info));
    dropEmpty(own);
}

} // namespace patina
