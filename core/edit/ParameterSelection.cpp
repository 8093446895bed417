// Finding parameters and elements by the names that scripts use.
#include "core/base/Utf8.h"
#include "core/document/Document.h"
#include "core/document/EnvironmentTitle.h"
#include "core/edit/Parameters.h"
#include "core/light/Light.h"
#include "core/material/Material.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <numeric>
#include <utility>

namespace patina {
namespace {

constexpr std::size_t kSuggestions = 3;
constexpr std::size_t kLongestName = 256; // of what is compared and shown

// Levenshtein distance.
std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i + 1);
        for (std::size_t j = 0; j < b.size(); ++j)
            diagonal = std::exchange(row[j + 1], std::min({row[j + 1] + 1, row[j] + 1,
                                                           diagonal + (a[i] != b[j] ? 1u : 0u)}));
    }
    return row.back();
}

// The names nearest to what was typed, best first.
std::vector<std::string> nearest(std::string_view typed, std::vector<std::string> names) {
    typed = typed.substr(0, kLongestName);
    std::vector<std::pair<std::size_t, std::string>> ranked;
    for (std::string& name : names) {
        std::size_t distance = editDistance(typed, name);
        // "metallic" for "material.metallic": what follows the scope counts as much.
        if (const std::size_t dot = name.find('.'); dot != std::string::npos)
            distance = std::min(distance, editDistance(typed, name.substr(dot + 1)) + 1);
        ranked.emplace_back(distance, std::move(name));
    }
    std::stable_sort(ranked.begin(), ranked.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    if (ranked.size() > kSuggestions)
        ranked.resize(kSuggestions);
    std::vector<std::string> result;
    for (auto& [distance, name] : ranked)
        result.push_back(std::move(name));
    return result;
}

Error unknown(std::string_view kind, std::string_view typed, std::vector<std::string> names,
              std::string_view allNames) {
    return {ErrorKind::Usage,
            fmt::format("there is no {} \"{}\"; did you mean {}? {}", kind,
                        makeValidUtf8(typed.substr(0, kLongestName)),
                        fmt::join(nearest(typed, std::move(names)), ", "), allNames),
            {},
            {}};
}

const std::string& nameOfElement(const auto& element) {
    return element.name;
}
std::string nameOfElement(const Environment& environment) {
    return environmentTitle(environment);
}

template <class Elements>
void addTargets(const Elements& elements, Scope scope, const std::string_view* name,
                std::vector<Target>& targets) {
    for (const auto& element : elements)
        if (name == nullptr || nameOfElement(element) == *name)
            targets.push_back({scope, element.id});
}

template <class Elements>
std::vector<std::string> namesOf(const Elements& elements) {
    std::vector<std::string> names;
    for (const auto& element : elements)
        names.push_back(nameOfElement(element));
    return names;
}

std::vector<std::string> elementNames(const Document& document, Scope scope) {
    switch (scope) {
    case Scope::Material:
        return namesOf(document.materials);
    case Scope::Light:
        return namesOf(document.lights);
    case Scope::Mesh:
        return namesOf(document.meshes);
    case Scope::Softbox:
        return namesOf(document.environment().softboxes);
    case Scope::Environment:
        return namesOf(document.environments);
    case Scope::Model:
    case Scope::View:
        break;
    }
    return {};
}

std::vector<Target> findTargets(const Document& document, Scope scope,
                                const std::string_view* name) {
    std::vector<Target> targets;
    switch (scope) {
    case Scope::Material:
        addTargets(document.materials, scope, name, targets);
        break;
    case Scope::Light:
        addTargets(document.lights, scope, name, targets);
        break;
    case Scope::Mesh:
        addTargets(document.meshes, scope, name, targets);
        break;
    case Scope::Softbox:
        addTargets(document.environment().softboxes, scope, name, targets);
        break;
    case Scope::Environment:
        if (name != nullptr)
            addTargets(document.environments, scope, name, targets);
        else // the one that lights the scene
            targets.push_back({scope, 0});
        break;
    case Scope::Model:
    case Scope::View:
        targets.push_back({scope, 0});
        break;
    }
    return targets;
}

// "environment.secondRotationDeg" is environment.rotationDeg of the second one.
const ParameterInfo* ofSecond(std::string_view name) {
    constexpr std::string_view kPrefix = "environment.second";
    if (!name.starts_with(kPrefix) || name.size() == kPrefix.size())
        return nullptr;
    std::string rest(name.substr(kPrefix.size()));
    rest[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(rest[0])));
    const ParameterInfo* info = findParameter("environment." + rest);
    return info && !info->ofScene ? info : nullptr;
}

} // namespace

std::vector<Target> targetsNamed(const Document& document, Scope scope, std::string_view name) {
    return findTargets(document, scope, &name);
}

Result<ParameterSelection> selectParameter(const Document& document, std::string_view name) {
    // "light[Sun].intensity": what stands in brackets is the element's name, and may itself hold
    // brackets and dots; no parameter's name does.
    std::string parameterName(name);
    std::string_view elementName;
    bool named = false;
    const std::size_t open = name.find('[');
    const std::size_t close = name.rfind("].");
    if (open != std::string_view::npos && close != std::string_view::npos && open < close) {
        named = true;
        elementName = name.substr(open + 1, close - open - 1);
        parameterName = std::string(name.substr(0, open)) + std::string(name.substr(close + 1));
    }

    const ParameterInfo* info = findParameter(parameterName);
    if (info == nullptr && !named)
        if (const ParameterInfo* second = ofSecond(parameterName)) {
            if (document.secondEnvironment() == nullptr)
                return Error{ErrorKind::Usage,
                             fmt::format("{} changes nothing: the scene has no second environment; "
                                         "set environment.second first",
                                         parameterName),
                             {},
                             {}};
            return ParameterSelection{second, {{Scope::Environment, document.mix.second}}};
        }
    if (info == nullptr) {
        std::vector<std::string> names;
        for (const ParameterInfo& parameter : parameters())
            names.emplace_back(parameter.id);
        return unknown("parameter", parameterName, std::move(names),
                       "\"patina parameters\" lists them all");
    }

    const std::string_view kind = scopeName(info->scope);
    const bool single = info->ofScene || info->scope == Scope::View || info->scope == Scope::Model;
    if (named && single)
        return Error{
            ErrorKind::Usage,
            fmt::format("{} is one for the whole scene; write it without brackets", info->id),
            {},
            {}};
    ParameterSelection selection{
        info, findTargets(document, info->scope, named ? &elementName : nullptr)};
    if (!selection.targets.empty())
        return selection;

    std::vector<std::string> names = elementNames(document, info->scope);
    if (names.empty())
        return Error{ErrorKind::Usage,
                     fmt::format("{} changes nothing: the scene has no {}", info->id, kind),
                     {},
                     {}};
    return unknown(kind, elementName, std::move(names),
                   "\"patina info\" lists the names in a scene");
}

} // namespace patina
