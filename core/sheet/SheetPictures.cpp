#include "core/sheet/SheetPictures.h"

#include "core/base/Limits.h"
#include "core/document/EnvironmentTitle.h"
#include "core/document/ViewChoices.h"
#include "core/edit/Parameters.h"
#include "core/light/Light.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <set>
#include <utility>

namespace patina::sheet {
namespace {

// "Studio, Gold": unlike any other part's.
std::string partName(const WallCell& cell, std::set<std::string>& taken) {
    const std::string wanted = fmt::format("{}", fmt::join(cell.captions, ", "));
    std::string name = wanted;
    for (int number = 2; !taken.insert(name).second; ++number)
        name = fmt::format("{} ({})", wanted, number);
    return name;
}

bool setsEnvironment(const WallAxis& axis) {
    return std::ranges::any_of(axis.entries,
                               [](const WallEntry& entry) { return entry.cell.environment != 0; });
}

bool showsSnapshots(const WallAxis& axis) {
    return std::ranges::any_of(axis.entries,
                               [](const WallEntry& entry) { return entry.cell.snapshot != 0; });
}

bool sets(const WallAxis& axis, const ParameterInfo* info) {
    return std::ranges::any_of(axis.entries, [&](const WallEntry& entry) {
        return std::ranges::any_of(entry.cell.own,
                                   [&](const CellEdit& edit) { return edit.info == info; });
    });
}

} // namespace

Image pictureOf(const WallSheet& sheet, const Wall& wall, const std::vector<WallCell>& cells,
                std::vector<DrawnCell>& drawn) {
    Image paper = sheet.draw(wall);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (!drawn[i].problem.empty()) {
            sheet.drawProblem(paper, cells[i], "No picture: " + drawn[i].problem);
            continue;
        }
        const glm::ivec2 place = sheet.place(cells[i]);
        paste(paper, place.x, place.y, drawn[i].picture);
        drawn[i].picture = {};
    }
    return paper;
}

std::vector<ImagePart> partsOf(const std::vector<WallCell>& cells, std::vector<DrawnCell>& drawn) {
    std::vector<ImagePart> parts;
    std::set<std::string> names;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (!drawn[i].problem.empty())
            continue;
        ImagePart& part = parts.emplace_back();
        part.name = drawn[i].part = partName(cells[i], names);
        part.image = std::move(drawn[i].picture);
        part.attributes = std::move(drawn[i].attributes);
    }
    return parts;
}

Result<void> checkPartsFit(std::size_t cells, int width, int height) {
    const std::size_t bytes = cells * static_cast<std::size_t>(width) *
                              static_cast<std::size_t>(height) * 4 * sizeof(float);
    if (bytes <= limits::kMaxImageBytes)
        return {};
    return Error{ErrorKind::Usage,
                 fmt::format("the cells would take more than {} MiB, which no picture may; choose "
                             "a smaller size for them",
                             limits::kMaxImageBytes >> 20),
                 {},
                 {}};
}

std::string commonText(const Wall& wall, const Document& document) {
    std::vector<std::string> parts{wall.isTable()
                                       ? fmt::format("{} × {}", wall.columns.title, wall.rows.title)
                                       : wall.columns.title};
    if (showsSnapshots(wall.columns) || showsSnapshots(wall.rows))
        return parts.front(); // they may differ in anything
    const View& view = document.view;
    const auto common = [&](const char* name) {
        const ParameterInfo* info = findParameter(name);
        return !sets(wall.columns, info) && !sets(wall.rows, info);
    };
    const auto choice = [&](const char* name, int value) {
        if (common(name))
            parts.emplace_back(findParameter(name)->choiceLabels[static_cast<std::size_t>(value)]);
    };
    if (!setsEnvironment(wall.columns) && !setsEnvironment(wall.rows))
        parts.push_back(environmentTitle(document.environment()));
    if (view.lighting != LightingMode::Ibl)
        choice("view.lighting", static_cast<int>(view.lighting));
    choice("view.toneMap", static_cast<int>(view.toneMap));
    if (!common("view.exposureEv"))
        return fmt::format("{}", fmt::join(parts, "  ·  "));
    if (view.exposureMode == ExposureMode::Automatic)
        parts.emplace_back("automatic exposure");
    else if (view.exposureEv != 0.0f)
        parts.push_back(fmt::format("{:+.3g} EV", view.exposureEv));
    return fmt::format("{}", fmt::join(parts, "  ·  "));
}

} // namespace patina::sheet
