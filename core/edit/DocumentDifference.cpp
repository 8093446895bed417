#include "core/edit/DocumentDifference.h"

#include "core/document/EnvironmentTitle.h"
#include "core/edit/Edit.h"
#include "core/edit/Parameters.h"
#include "core/light/Light.h"
#include "core/material/Material.h"

#include <fmt/format.h>
#include <map>
#include <optional>
#include <variant>

namespace patina {
namespace {

std::string shown(const ParameterInfo& info, const ParameterValue& value,
                  const Document& document) {
    if (info.type == ParameterType::Choice) {
        const auto index = static_cast<std::size_t>(std::get<int>(value));
        if (index < info.choiceLabels.size())
            return std::string(info.choiceLabels[index]);
    }
    if (info.type == ParameterType::Bool)
        return std::get<bool>(value) ? "on" : "off";
    if (info.type == ParameterType::Reference) {
        const Id id = static_cast<Id>(std::get<int>(value));
        const std::string name = id == 0 ? "none" : nameOf(document, {info.refersTo, id});
        if (!name.empty())
            return name;
    }
    if (info.type == ParameterType::Map) {
        const std::string& source = std::get<MapSlot>(value).source;
        return source.empty() ? "none" : source;
    }
    return formatParameterValue(info, value);
}

// Images are derived from their source, or read from it.
ParameterValue withoutPayload(ParameterValue value) {
    if (auto* slot = std::get_if<MapSlot>(&value)) {
        slot->image = nullptr;
        slot->problem.clear();
    }
    return value;
}

class Comparison {
  public:
    Comparison(const Document& before, const Document& after)
        : m_before(before)
        , m_after(after) {}

    void single(Scope scope, const std::string& name, bool ofScene = false) {
        values(scope, 0, name, ofScene);
    }

    template <class Elements>
    void list(Scope scope, const std::string& kind, const Elements& before, const Elements& after) {
        std::map<Id, std::string> names, gone;
        for (const auto& element : before)
            gone[element.id] = titleOf(element);
        for (const auto& element : after) {
            const std::string name = fmt::format("{} {}", kind, titleOf(element));
            if (gone.erase(element.id) > 0)
                values(scope, element.id, name);
            else
                found.push_back({name, {}, {}, "added"});
        }
        for (const auto& [id, name] : gone)
            found.push_back({fmt::format("{} {}", kind, name), {}, {}, "removed"});
    }

    std::vector<DocumentDifference> found;

  private:
    static std::string titleOf(const auto& element) { return element.name; }
    static std::string titleOf(const Environment& environment) {
        return environmentTitle(environment);
    }

    void values(Scope scope, Id id, const std::string& element, bool ofScene = false) {
        for (const ParameterInfo& info : parameters()) {
            if (info.scope != scope || info.ofScene != ofScene)
                continue;
            const ParameterValue before = withoutPayload(info.get(m_before, id));
            const ParameterValue after = withoutPayload(info.get(m_after, id));
            if (before == after)
                continue;
            const std::string_view unit = info.unitFor(m_after, id);
            std::string label(info.label);
            if (!unit.empty())
                label += fmt::format(" ({})", unit);
            std::string from = shown(info, before, m_before), to = shown(info, after, m_after);
            if (from == to) // a map's channel or placement
                to += " (adjusted)";
            found.push_back({element, std::move(label), std::move(from), std::move(to)});
        }
    }

    const Document& m_before;
    const Document& m_after;
};

std::vector<Softbox> softboxesOf(const Document& document) {
    std::vector<Softbox> all;
    for (const Environment& environment : document.environments)
        all.insert(all.end(), environment.softboxes.begin(), environment.softboxes.end());
    return all;
}

} // namespace

std::vector<DocumentDifference> differences(const Document& before, const Document& after) {
    Comparison comparison(before, after);
    comparison.list(Scope::Mesh, "Mesh", before.meshes, after.meshes);
    comparison.list(Scope::Material, "Material", before.materials, after.materials);
    comparison.list(Scope::Light, "Light", before.lights, after.lights);
    comparison.single(Scope::Environment, "Scene", true);
    comparison.list(Scope::Environment, "Environment", before.environments, after.environments);
    comparison.list(Scope::Softbox, "Softbox", softboxesOf(before), softboxesOf(after));
    comparison.single(Scope::Model, "Shading model");
    comparison.single(Scope::View, "View");
    if (before.view.camera != after.view.camera)
        comparison.found.push_back({"View", "Camera", {}, "moved"});
    return std::move(comparison.found);
}

} // namespace patina
