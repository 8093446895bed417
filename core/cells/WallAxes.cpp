#include "core/cells/WallAxes.h"

#include "core/document/EnvironmentTitle.h"
#include "core/document/Snapshot.h"
#include "core/document/Source.h"
#include "core/edit/Edit.h"
#include "core/library/Library.h"
#include "core/light/Light.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <set>
#include <utility>

namespace patina {
namespace {

constexpr auto kMostValues = static_cast<int>(kMostOnWallSide * kMostOnWallSide);

Error axisUsage(std::string message) {
    return {ErrorKind::Usage, std::move(message), {}, {}};
}

const library::Entry* findBuiltin(const std::string& name) {
    const std::string plain = isBuiltin(name) ? builtinName(name) : name;
    const auto& entries = library::materials();
    const auto found = std::ranges::find(entries, plain, &library::Entry::name);
    return found != entries.end() ? &*found : nullptr;
}

// What is nobody's number is as short as it can be: 15, 0.5, 0.167.
std::vector<std::string> numberTexts(const std::vector<float>& values, int decimals) {
    const auto texts = [&](int digits) {
        std::vector<std::string> result;
        for (const float value : values)
            result.push_back(fmt::format("{:.{}f}", value == 0.0f ? 0.0f : value, digits));
        return result;
    };
    const auto isExact = [&](int digits) {
        const double scale = std::pow(10.0, digits);
        return std::ranges::all_of(values, [&](float value) {
            const double scaled = static_cast<double>(value) * scale;
            return std::abs(scaled - std::round(scaled)) <= 1e-6 * std::max(1.0, std::abs(scaled));
        });
    };
    const auto isDistinct = [&](int digits) {
        const std::vector<std::string> all = texts(digits);
        return std::set(all.begin(), all.end()).size() == all.size();
    };
    int digits = 0;
    while (digits < decimals && !isExact(digits))
        ++digits;
    // Thirds and sevenths: two digits say enough, unless two values look alike then.
    if (!isExact(digits))
        digits = std::min(digits, 2);
    constexpr int kMostDigits = 7; // a float has no more
    while (digits < kMostDigits && !isDistinct(digits))
        ++digits;
    return texts(digits);
}

void give(Cell& cell, const ParameterInfo& info, std::span<const Target> targets,
          const ParameterValue& value) {
    for (const Target& target : targets) {
        CellEdit& own = cell.own.emplace_back();
        own.target = target;
        own.info = &info;
        own.value = value;
    }
}

std::string withUnit(const std::string& number, std::string_view unit) {
    return fmt::format("{}{}{}", number, unit.empty() || unit == "°" ? "" : " ", unit);
}

} // namespace

WallAxis environmentAxis(const Document& document, std::span<const Id> environments) {
    WallAxis axis{"Environment", {}};
    for (const Id id : environments)
        axis.entries.push_back({environmentTitle(*document.environment(id)), {id, {}, {}}});
    return axis;
}

Result<Id> materialNamed(Document& document, const std::string& name) {
    if (!isBuiltin(name))
        for (const Target& found : targetsNamed(document, Scope::Material, name))
            return found.id;
    if (const library::Entry* entry = findBuiltin(name)) {
        Result<Material> material = library::material(entry->name);
        if (!material)
            return material.error();
        return addMaterial(document, std::move(*material));
    }
    std::vector<std::string> own, builtin;
    for (const Material& material : document.materials)
        own.push_back(fmt::format("\"{}\"", material.name));
    for (const library::Entry& entry : library::materials())
        builtin.push_back(entry.name);
    return axisUsage(fmt::format(
        "there is no material \"{}\"; the scene has {}; built in are {}", name,
        own.empty() ? "none" : fmt::format("{}", fmt::join(own, ", ")), fmt::join(builtin, ", ")));
}

WallAxis materialAxis(const Document& document, std::span<const Id> materials,
                      std::span<const Id> meshes) {
    const ParameterInfo* info = findParameter("mesh.material");
    WallAxis axis{"Material", {}};
    std::vector<Target> targets;
    for (const MeshInstance& mesh : document.meshes)
        if (meshes.empty() ? mesh.visible : std::ranges::find(meshes, mesh.id) != meshes.end())
            targets.push_back({Scope::Mesh, mesh.id});
    for (const Id material : materials) {
        WallEntry& entry = axis.entries.emplace_back();
        entry.caption = document.material(material)->name;
        give(entry.cell, *info, targets, static_cast<int>(material));
    }
    return axis;
}

WallAxis snapshotAxis(const Document& document, std::span<const Id> snapshots) {
    WallAxis axis{"Snapshot", {}};
    for (const Id id : snapshots) {
        WallEntry& entry = axis.entries.emplace_back();
        entry.caption = document.snapshot(id)->name;
        entry.cell.snapshot = id;
    }
    return axis;
}

Result<std::vector<Id>> snapshotsNamed(const Document& document,
                                       std::span<const std::string> names) {
    std::vector<Id> ids;
    if (document.snapshots.empty())
        return axisUsage("the scene has no snapshots: keep some in the Snapshots dock of the "
                         "editor and save the project");
    for (const std::string& name : names) {
        const auto found = std::ranges::find(document.snapshots, name, &Snapshot::name);
        if (found == document.snapshots.end()) {
            std::vector<std::string> known;
            for (const Snapshot& snapshot : document.snapshots)
                known.push_back(fmt::format("\"{}\"", snapshot.name));
            return axisUsage(fmt::format("there is no snapshot \"{}\"; the project has {}", name,
                                         fmt::join(known, ", ")));
        }
        ids.push_back(found->id);
    }
    return ids;
}

Result<WallAxis> choiceAxis(const Document& document, std::string_view parameter,
                            std::span<const std::string> choices) {
    const Result<ParameterSelection> selection = selectParameter(document, parameter);
    if (!selection)
        return selection.error();
    const ParameterInfo& info = *selection->info;
    if (info.type != ParameterType::Choice)
        return axisUsage(fmt::format("{} is no choice of one among several", info.id));
    WallAxis axis{std::string(info.label), {}};
    for (const std::string& name : choices) {
        Result<ParameterValue> value = parseParameterValue(info, name);
        if (!value)
            return value.error();
        const auto index = static_cast<std::size_t>(std::get<int>(*value));
        WallEntry& entry = axis.entries.emplace_back();
        entry.caption = info.choiceLabels[index];
        give(entry.cell, info, selection->targets, *value);
    }
    return axis;
}

Result<Wedge> parseWedge(std::string_view text) {
    // What stands in brackets may hold any sign; numbers hold none of these.
    const std::size_t equals = text.rfind('=');
    const auto wrong = [&] {
        return axisUsage(fmt::format("a wedge is NAME=FROM:TO:COUNT, for example "
                                     "material.perceptualRoughness=0:1:5, not \"{}\"",
                                     text));
    };
    if (equals == std::string_view::npos || equals == 0)
        return wrong();
    Wedge wedge;
    wedge.parameter = text.substr(0, equals);
    std::string_view rest = text.substr(equals + 1);
    std::array<std::string_view, 3> parts;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const std::size_t colon = rest.find(':');
        if ((colon == std::string_view::npos) != (i + 1 == parts.size()))
            return wrong();
        parts[i] = rest.substr(0, colon);
        rest.remove_prefix(std::min(rest.size(), parts[i].size() + 1));
    }
    const auto read = [](std::string_view part, auto& number) {
        const auto [end, code] = std::from_chars(part.data(), part.data() + part.size(), number);
        return code == std::errc() && end == part.data() + part.size();
    };
    if (!read(parts[0], wedge.from) || !read(parts[1], wedge.to) || !read(parts[2], wedge.count) ||
        !std::isfinite(wedge.from) || !std::isfinite(wedge.to))
        return wrong();
    if (wedge.count < 2 || wedge.count > kMostValues || wedge.from == wedge.to)
        return axisUsage(
            fmt::format("a wedge has 2 to {} different values: {} asks for {} from {} to "
                        "{}",
                        kMostValues, wedge.parameter, wedge.count, wedge.from, wedge.to));
    return wedge;
}

Result<WallAxis> valueAxis(const Document& document, const ParameterInfo& info,
                           std::span<const Target> targets, float from, float to, int count,
                           bool named) {
    if (info.type != ParameterType::Float)
        return axisUsage(fmt::format("a wedge is of numbers, and {} expects {}", info.id,
                                     describeExpected(info)));
    if (count < 2 || count > kMostValues || from == to)
        return axisUsage(fmt::format("a wedge has 2 to {} different values: {} asks for {} from {} "
                                     "to {}",
                                     kMostValues, info.id, count, from, to));
    for (const float end : {from, to})
        if (!info.wraps && !(end >= info.hardMin && end <= info.hardMax))
            return axisUsage(
                fmt::format("{} expects {}, not {}", info.id, describeExpected(info), end));
    std::vector<float> values;
    for (int i = 0; i < count; ++i) {
        // Both ends exactly as they were given.
        const float t = static_cast<float>(i) / static_cast<float>(count - 1);
        values.push_back((1.0f - t) * from + t * to);
    }
    const std::vector<std::string> texts = numberTexts(values, info.decimals);
    const std::string_view unit = info.unitFor(document, targets.front().id);
    // A wedge says whose values it shows: of one of several, or of the only one there is.
    const Scope scope = targets.front().scope;
    std::string name;
    if (targets.size() > 1)
        name = scope == Scope::Mesh ? "all meshes" : fmt::format("all {}s", scopeName(scope));
    else if (named || scope == Scope::Material || scope == Scope::Light || scope == Scope::Mesh)
        name = nameOf(document, targets.front());
    WallAxis axis{
        name.empty() ? std::string(info.label) : fmt::format("{} of {}", info.label, name), {}};
    for (std::size_t i = 0; i < values.size(); ++i) {
        WallEntry& entry = axis.entries.emplace_back();
        entry.caption = withUnit(texts[i], unit);
        give(entry.cell, info, targets, values[i]);
    }
    return axis;
}

Result<WallAxis> wedgeAxis(const Document& document, const Wedge& wedge) {
    const Result<ParameterSelection> selection = selectParameter(document, wedge.parameter);
    if (!selection)
        return selection.error();
    const bool named = wedge.parameter.find('[') != std::string::npos;
    return valueAxis(document, *selection->info, selection->targets, wedge.from, wedge.to,
                     wedge.count, named);
}

} // namespace patina
