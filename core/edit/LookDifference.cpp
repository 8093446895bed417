#include "core/edit/LookDifference.h"

#include "core/document/Document.h"
#include "core/document/EnvironmentTitle.h"
#include "core/edit/ComparedValue.h"
#include "core/light/Light.h"
#include "core/material/Material.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace patina {
namespace {

class LookComparison {
  public:
    LookComparison(const Look& a, const Look& b)
        : m_a(elementsOf(a))
        , m_b(elementsOf(b)) {}

    // Elements that both looks share are equal without a look at their values.
    template <class Element>
    void list(Scope scope, std::string_view kind,
              const std::vector<std::shared_ptr<const Element>>& a,
              const std::vector<std::shared_ptr<const Element>>& b) {
        std::unordered_map<Id, const std::shared_ptr<const Element>*> before;
        for (const auto& element : a)
            before.emplace(element->id, &element);
        for (const auto& element : b) {
            const std::string name = fmt::format("{} {}", kind, titleOf(*element));
            const auto known = before.find(element->id);
            if (known == before.end())
                whole({scope, element->id}, name, false);
            else if (*known->second != element)
                values({scope, element->id}, name);
            if (known != before.end())
                before.erase(known);
        }
        for (const auto& element : a)
            if (before.contains(element->id))
                whole({scope, element->id}, fmt::format("{} {}", kind, titleOf(*element)), true);
    }

    void softboxes(const Look& a, const Look& b) {
        std::unordered_map<Id, const Softbox*> before;
        for (const auto& environment : a.environments)
            for (const Softbox& softbox : environment->softboxes)
                before.emplace(softbox.id, &softbox);
        for (const auto& environment : b.environments)
            for (const Softbox& softbox : environment->softboxes) {
                const std::string name = fmt::format("Softbox {}", softbox.name);
                const auto known = before.find(softbox.id);
                if (known == before.end())
                    whole({Scope::Softbox, softbox.id}, name, false);
                else if (*known->second != softbox)
                    values({Scope::Softbox, softbox.id}, name);
                if (known != before.end())
                    before.erase(known);
            }
        for (const auto& environment : a.environments)
            for (const Softbox& softbox : environment->softboxes)
                if (before.contains(softbox.id))
                    whole({Scope::Softbox, softbox.id}, fmt::format("Softbox {}", softbox.name),
                          true);
    }

    void meshes(const Look& a, const Look& b) {
        std::unordered_map<Id, const MeshLook*> before;
        for (const MeshLook& mesh : a.meshes)
            before.emplace(mesh.id, &mesh);
        for (const MeshLook& mesh : b.meshes)
            if (const auto known = before.find(mesh.id);
                known != before.end() && *known->second != mesh)
                values({Scope::Mesh, mesh.id}, fmt::format("Mesh {}", mesh.name));
    }

    void values(const Target& target, const std::string& element, bool ofScene = false) {
        for (const ParameterInfo& info : parameters()) {
            if (info.scope != target.scope || info.ofScene != ofScene || !isOfLook(info))
                continue;
            ParameterValue a = withoutPayload(info.get(m_a, target.id));
            ParameterValue b = withoutPayload(info.get(m_b, target.id));
            if (a == b)
                continue;
            LookDifference& one = found.emplace_back();
            one.target = target;
            one.info = &info;
            one.element = element;
            one.label = comparedLabel(info, m_b, target.id);
            one.textA = comparedText(info, a, m_a);
            one.textB = comparedText(info, b, m_b);
            if (one.textA == one.textB) // a map's channel or placement
                one.textB += " (adjusted)";
            one.a = std::move(a);
            one.b = std::move(b);
        }
    }

    std::vector<LookDifference> found;

  private:
    static const std::string& titleOf(const Material& material) { return material.name; }
    static const std::string& titleOf(const Light& light) { return light.name; }
    static std::string titleOf(const Environment& environment) {
        return environmentTitle(environment);
    }

    void whole(const Target& target, const std::string& element, bool inA) {
        LookDifference& one = found.emplace_back();
        one.target = target;
        one.inA = inA;
        one.inB = !inA;
        one.element = element;
        one.textA = inA ? "there" : "not there";
        one.textB = inA ? "not there" : "there";
    }

    const Document m_a, m_b;
};

} // namespace

bool isOfLook(const ParameterInfo& info) {
    constexpr std::array<std::string_view, 4> kOfCamera = {"view.fovDeg", "view.depthOfField",
                                                           "view.fStop", "view.focusDistance"};
    if (info.scope == Scope::Mesh && info.group == "Place")
        return false; // where things stand is no part of a look
    return !info.id.ends_with(".name") &&
           std::find(kOfCamera.begin(), kOfCamera.end(), info.id) == kOfCamera.end();
}

std::vector<LookDifference> differencesOf(const Look& a, const Look& b) {
    LookComparison comparison(a, b);
    comparison.meshes(a, b);
    comparison.list(Scope::Material, "Material", a.materials, b.materials);
    comparison.list(Scope::Light, "Light", a.lights, b.lights);
    comparison.values({Scope::Environment, 0}, "Scene", true);
    comparison.list(Scope::Environment, "Environment", a.environments, b.environments);
    comparison.softboxes(a, b);
    comparison.values({Scope::Model, 0}, "Shading model");
    comparison.values({Scope::View, 0}, "View");
    return std::move(comparison.found);
}

} // namespace patina
