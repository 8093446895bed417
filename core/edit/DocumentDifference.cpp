#include "core/edit/DocumentDifference.h"

#include "core/document/EnvironmentTitle.h"
#include "core/document/Snapshot.h"
#include "core/edit/ComparedValue.h"
#include "core/edit/Parameters.h"
#include "core/light/Light.h"
#include "core/material/Material.h"

#include <fmt/format.h>
#include <map>

namespace patina {
namespace {

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

    // Their looks never change: there are others, or other names.
    void snapshots() {
        std::map<Id, std::string> gone;
        for (const Snapshot& snapshot : m_before.snapshots)
            gone[snapshot.id] = snapshot.name;
        for (const Snapshot& snapshot : m_after.snapshots) {
            const std::string element = "Snapshot " + snapshot.name;
            const auto known = gone.find(snapshot.id);
            if (known == gone.end()) {
                found.push_back({element, {}, {}, "added"});
                continue;
            }
            if (known->second != snapshot.name)
                found.push_back({element, "Name", known->second, snapshot.name});
            gone.erase(known);
        }
        for (const auto& [id, name] : gone)
            found.push_back({"Snapshot " + name, {}, {}, "removed"});
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
            std::string label = comparedLabel(info, m_after, id);
            std::string from = comparedText(info, before, m_before);
            std::string to = comparedText(info, after, m_after);
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
    comparison.snapshots();
    return std::move(comparison.found);
}

} // namespace patina
