#include "core/edit/Looks.h"

#include "core/edit/Edit.h"
#include "core/light/Light.h"
#include "core/material/Material.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <utility>

namespace patina {
namespace {

template <class Element>
const Element* elementOf(const std::vector<std::shared_ptr<const Element>>& elements, Id id) {
    const auto found =
        std::ranges::find_if(elements, [&](const auto& element) { return element->id == id; });
    return found == elements.end() ? nullptr : found->get();
}

bool looksHas(const Look& look, const Target& target) {
    switch (target.scope) {
    case Scope::Material:
        return elementOf(look.materials, target.id) != nullptr;
    case Scope::Light:
        return elementOf(look.lights, target.id) != nullptr;
    case Scope::Environment:
        return target.id == 0 || elementOf(look.environments, target.id) != nullptr;
    case Scope::Softbox:
        return std::ranges::any_of(look.environments, [&](const auto& environment) {
            return std::ranges::any_of(environment->softboxes, [&](const Softbox& softbox) {
                return softbox.id == target.id;
            });
        });
    case Scope::Mesh:
        return std::ranges::any_of(look.meshes,
                                   [&](const MeshLook& mesh) { return mesh.id == target.id; });
    case Scope::Model:
    case Scope::View:
        return true;
    }
    return false;
}

Id idOf(const Softbox& softbox) {
    return softbox.id;
}
template <class Element>
Id idOf(const std::shared_ptr<const Element>& element) {
    return element->id;
}

// Where `id` of `order` belongs among `elements`: behind the nearest one before it that is there.
template <class Element, class Order>
auto placeFor(std::vector<Element>& elements, const Order& order, Id id) {
    auto place = elements.begin();
    for (const auto& before : order) {
        if (idOf(before) == id)
            break;
        const auto found = std::ranges::find(elements, idOf(before), &Element::id);
        if (found != elements.end())
            place = std::next(found);
    }
    return place;
}

class Restoring {
  public:
    Restoring(Document& document, const Look& look)
        : m_document(document)
        , m_look(look)
        , m_values(elementsOf(look)) {}

    void elements(std::span<const LookDifference> differences) {
        for (const LookDifference& one : differences)
            if (one.info == nullptr && looksHas(m_look, one.target))
                ensure(one.target);
    }

    void values(std::span<const LookDifference> differences) {
        for (const LookDifference& one : differences)
            if (one.info != nullptr)
                value(*one.info, one.target);
        keepMixSound();
    }

    void removals(std::span<const LookDifference> differences) {
        for (const LookDifference& one : differences) {
            if (one.info != nullptr || looksHas(m_look, one.target))
                continue;
            if (one.target.scope == Scope::Light)
                removeLight(m_document, one.target.id);
            if (one.target.scope == Scope::Softbox)
                removeSoftbox(m_document, one.target.id);
        }
    }

  private:
    // The element is there again, as the look has it, unless it is there anyway.
    void ensure(const Target& target) {
        if (targetExists(m_document, target) || !looksHas(m_look, target))
            return;
        const Id id = target.id;
        switch (target.scope) {
        case Scope::Material:
            m_document.materials.insert(placeFor(m_document.materials, m_look.materials, id),
                                        *elementOf(m_look.materials, id));
            break;
        case Scope::Light:
            m_document.lights.insert(placeFor(m_document.lights, m_look.lights, id),
                                     *elementOf(m_look.lights, id));
            break;
        case Scope::Environment:
            m_document.environments.insert(
                placeFor(m_document.environments, m_look.environments, id),
                withImage(*elementOf(m_look.environments, id)));
            break;
        case Scope::Softbox:
            for (const auto& environment : m_look.environments)
                for (const Softbox& softbox : environment->softboxes)
                    if (softbox.id == id)
                        ensureSoftbox(*environment, softbox);
            break;
        case Scope::Mesh:
        case Scope::Model:
        case Scope::View:
            break;
        }
    }

    void ensureSoftbox(const Environment& of, const Softbox& softbox) {
        ensure({Scope::Environment, of.id}); // it may bring the softbox along
        Environment& environment = *m_document.environment(of.id);
        if (m_document.softbox(softbox.id) == nullptr)
            environment.softboxes.insert(placeFor(environment.softboxes, of.softboxes, softbox.id),
                                         softbox);
    }

    // Generated ones get theirs when they are resolved.
    static Environment withImage(Environment environment) {
        if (environment.kind == EnvironmentKind::Image)
            environment.image = environment.fileImage;
        return environment;
    }

    void value(const ParameterInfo& info, const Target& target) {
        if (!looksHas(m_look, target))
            return;
        ensure(target);
        if (!targetExists(m_document, target))
            return;
        const ParameterValue wanted = info.get(m_values, target.id);
        if (info.type == ParameterType::Reference && std::get<int>(wanted) != 0)
            ensure({info.refersTo, static_cast<Id>(std::get<int>(wanted))});
        if (!leadsSomewhere(m_document, info, wanted))
            return;
        info.set(m_document, target.id, wanted);
        // What a file's pixels are depends on both.
        if (info.id == "environment.layout")
            copy("environment.image", target.id);
        if (info.id == "environment.image")
            copy("environment.layout", target.id);
    }

    void copy(std::string_view parameter, Id id) {
        const ParameterInfo& info = *findParameter(parameter);
        info.set(m_document, id, info.get(m_values, id));
    }

    void keepMixSound() {
        if (m_document.mix.first != m_document.mix.second)
            return;
        for (const Id id : {m_look.mix.first, m_look.mix.second})
            if (id != 0)
                ensure({Scope::Environment, id});
        m_document.mix.first = m_look.mix.first;
        m_document.mix.second = m_look.mix.second;
    }

    Document& m_document;
    const Look& m_look;
    const Document m_values;
};

} // namespace

std::string whyNotRestored(const Document& document, const Look& look,
                           const LookDifference& difference) {
    const Target& target = difference.target;
    if (!looksHas(look, target)) {
        if (target.scope == Scope::Material || target.scope == Scope::Environment)
            return "came later and is kept: nothing of the snapshot shows it";
        return difference.info == nullptr ? std::string() : "is not in the snapshot";
    }
    if (target.scope == Scope::Mesh && document.mesh(target.id) == nullptr)
        return "is no longer in the scene: snapshots hold no geometry";
    if (target.scope == Scope::Environment && document.environment(target.id) == nullptr &&
        document.environments.size() >= kMaxEnvironments)
        return fmt::format("was removed, and there are {} environments, the most a scene has; "
                           "remove one first",
                           kMaxEnvironments);
    return {};
}

void restoreLook(Document& document, const Look& look,
                 std::span<const LookDifference> differences) {
    std::vector<LookDifference> possible;
    for (const LookDifference& one : differences)
        if (whyNotRestored(document, look, one).empty())
            possible.push_back(one);
    Restoring restoring(document, look);
    restoring.elements(possible);
    restoring.values(possible);
    restoring.removals(possible);
}

Document withLook(Document document, const Look& look) {
    const LookPtr now = lookOf(document, &look);
    restoreLook(document, look, differencesOf(look, *now));
    return document;
}

std::string uniqueSnapshotName(const Document& document, std::string_view name) {
    const auto taken = [&](const std::string& candidate) {
        return std::ranges::any_of(document.snapshots, [&](const Snapshot& snapshot) {
            return snapshot.name == candidate;
        });
    };
    std::string candidate = name.empty() ? std::string("Snapshot 1") : std::string(name);
    for (int number = 2; taken(candidate); ++number)
        candidate =
            fmt::format("{} {}", name.empty() ? std::string_view("Snapshot") : name, number);
    return candidate;
}

} // namespace patina
