#include "core/edit/ParameterReference.h"

#include "core/base/Check.h"
#include "core/edit/Parameters.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace patina {
namespace {

// Single precision, so that 0.8f is written as 0.8.
using Json = nlohmann::basic_json<nlohmann::ordered_map, std::vector, std::string, bool,
                                  std::int64_t, std::uint64_t, float>;

std::string_view typeName(ParameterType type) {
    switch (type) {
    case ParameterType::Bool:
        return "bool";
    case ParameterType::Float:
        return "float";
    case ParameterType::Color:
        return "color";
    case ParameterType::Vector:
        return "vector";
    case ParameterType::Choice:
        return "choice";
    case ParameterType::Text:
        return "text";
    case ParameterType::Map:
        return "map";
    case ParameterType::Reference:
        return "reference";
    }
    CHECK(false);
    return {};
}

std::string scopeTitle(Scope scope) {
    switch (scope) {
    case Scope::Material:
        return "Materials";
    case Scope::Light:
        return "Lights";
    case Scope::Environment:
        return "Environment";
    case Scope::View:
        return "View";
    case Scope::Mesh:
        return "Meshes";
    case Scope::Softbox:
        return "Softboxes";
    case Scope::Model:
        return "Shading model";
    }
    CHECK(false);
    return {};
}

bool isNumeric(const ParameterInfo& info) {
    return info.type == ParameterType::Float || info.type == ParameterType::Color ||
           info.type == ParameterType::Vector;
}

std::string defaultText(const ParameterInfo& info) {
    if (info.type == ParameterType::Reference)
        return {};
    return formatParameterValue(info, info.defaultValue());
}

constexpr std::string_view kIntroduction = R"(# Parameters

Every value that can be edited, with the name it has in scripts (`patina render … --set NAME=VALUE`)
and, without the part before the first dot, in project files. This page is written by
`patina parameters --markdown`; the table itself is `core/edit/Parameters.cpp`.

A name alone means every material, light or mesh: `material.metallic`. One is chosen by its name in
brackets: `material[Body].metallic`, `light[Sun].intensity`. Of environments a name alone means the one that
lights the scene, `environment.secondRotationDeg` is the second one's. Colours are linear sRGB, unless written
`#rrggbb`. Values outside the range are refused.
)";

} // namespace

std::string parametersAsMarkdown() {
    std::string page(kIntroduction);
    const ParameterInfo* previous = nullptr;
    for (const ParameterInfo& info : parameters()) {
        if (previous == nullptr || previous->scope != info.scope)
            page +=
                fmt::format("\n## {}\n\n| name | | value | default | |\n|---|---|---|---|---|\n",
                            scopeTitle(info.scope));
        std::string name = fmt::format("`{}`", info.id);
        if (!info.alias.empty())
            name += fmt::format(" or `{}`", info.alias);
        std::string expected = describeExpected(info);
        if (!info.unit.empty() && !info.wraps)
            expected += fmt::format(" {}", info.unit);
        std::string fallback = defaultText(info);
        if (!fallback.empty())
            fallback = fmt::format("`{}`", fallback);
        page += fmt::format("| {} | {} | {} | {} | {} |\n", name, info.label, expected, fallback,
                            info.help);
        previous = &info;
    }
    return page;
}

std::string parametersAsJson() {
    Json list = Json::array();
    for (const ParameterInfo& info : parameters()) {
        Json entry;
        entry["id"] = std::string(info.id);
        if (!info.alias.empty())
            entry["alias"] = std::string(info.alias);
        entry["label"] = std::string(info.label);
        entry["group"] = std::string(info.group);
        entry["scope"] = std::string(scopeName(info.scope));
        entry["type"] = std::string(typeName(info.type));
        if (info.type != ParameterType::Reference)
            entry["default"] = defaultText(info);
        if (isNumeric(info)) {
            entry["hardRange"] = Json::array({info.hardMin, info.hardMax});
            entry["softRange"] = Json::array({info.softMin, info.softMax});
        }
        if (!info.unit.empty())
            entry["unit"] = std::string(info.unit);
        for (const std::string_view& name : info.choices)
            entry["choices"].push_back(std::string(name));
        entry["help"] = std::string(info.help);
        list.push_back(std::move(entry));
    }
    return Json{{"parameters", std::move(list)}}.dump(2) + "\n";
}

} // namespace patina
