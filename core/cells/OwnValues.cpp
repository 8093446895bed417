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

} // namespace

std::vector<WallCell> cellsOf(const Wall& wall, std::span<const OwnValues> own) {
    std::vector<WallCell> cells = cellsOf(wall);
    for (WallCell& cell : cells) {
        const auto found = std::ranges::find(own, cell.shared, &OwnValues::of);
        if (found == own.end())
            continue;
        cell.own = found->values;
        Cell above;
        above.own = found->values;
        cell.cell = combined(cell.shared, above);
    }
    return cells;
}

void setOwnValue(std::vector<OwnValues>& own, const WallCell& cell, const CellEdit& value) {
    auto found = ownOf(own, cell);
    if (found == own.end())
        found = own.insert(own.end(), OwnValues{cell.shared, {}});
    const auto known = std::ranges::find_if(found->values, isOf(value.target, value.info));
    if (known != found->values.end())
        *known = value;
    else
        found->values.push_back(value);
}

void linkValue(std::vector<OwnValues>& own, const WallCell& cell, const Target& target,
               const ParameterInfo& info) {
    const auto found = ownOf(own, cell);
    if (found == own.end())
        return;
    std::erase_if(found->values, isOf(target, &info));
    if (found->values.empty())
        own.erase(found);
}

} // namespace patina
