#include "core/edit/Edit.h"

#include "core/base/Check.h"
#include "core/document/AbsentBake.h"
#include "core/document/EnvironmentTitle.h"
#include "core/edit/ResetValue.h"
#include "core/light/Light.h"
#include "core/material/Material.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>

namespace patina {
namespace {

// "Sun 2" → "Sun": the name that a number is appended to.
std::string baseName(const std::string& name) {
    const std::size_t last = name.find_last_not_of("0123456789");
    if (last == std::string::npos || last + 1 == name.size() || name[last] != ' ' || last == 0)
        return name;
    return name.substr(0, last);
}

std::string titleOf(const auto& element) {
    return element.name;
}
std::string titleOf(const Environment& environment) {
    return environmentTitle(environment);
}

template <class Elements>
std::string uniqueName(const Elements& elements, const std::string& name) {
    const auto taken = [&](const std::string& candidate) {
        return std::any_of(elements.begin(), elements.end(),
                           [&](const auto& element) { return titleOf(element) == candidate; });
    };
    std::string candidate = name;
    for (int number = 2; taken(candidate); ++number)
        candidate = fmt::format("{} {}", baseName(name), number);
    return candidate;
}

template <class Elements>
auto findIn(Elements& elements, Id id) {
    return std::find_if(elements.begin(), elements.end(),
                        [&](const auto& element) { return element.id == id; });
}

template <class Elements>
Id duplicate(Document& document, Elements& elements, Id id) {
    const auto original = findIn(elements, id);
    CHECK(original != elements.end());
    auto copy = *original;
    copy.id = document.takeId();
    copy.name = uniqueName(elements, copy.name);
    return elements.insert(std::next(original), std::move(copy))->id;
}

template <class Elements>
bool removeFrom(Elements& elements, Id id) {
    const auto found = findIn(elements, id);
    if (found == elements.end())
        return false;
    elements.erase(found);
    return true;
}

} // namespace

bool targetExists(const Document& document, const Target& target) {
    switch (target.scope) {
    case Scope::Material:
        return document.material(target.id) != nullptr;
    case Scope::Light:
        return document.light(target.id) != nullptr;
    case Scope::Mesh:
        return document.mesh(target.id) != nullptr;
    case Scope::Softbox:
        return document.softbox(target.id) != nullptr;
    case Scope::Environment:
        return document.environment(target.id) != nullptr;
    case Scope::Model:
    case Scope::View:
        return target.id == 0;
    }
    return false;
}

std::string nameOf(const Document& document, const Target& target) {
    switch (target.scope) {
    case Scope::Mesh:
        if (const MeshInstance* mesh = document.mesh(target.id))
            return mesh->name;
        break;
    case Scope::Material:
        if (const Material* material = document.material(target.id))
            return material->name;
        break;
    case Scope::Light:
        if (const Light* light = document.light(target.id))
            return light->name;
        break;
    case Scope::Softbox:
        if (const Softbox* softbox = document.softbox(target.id))
            return softbox->name;
        break;
    case Scope::Environment:
        if (const Environment* environment = document.environment(target.id))
            return environmentTitle(*environment);
        break;
    case Scope::Model:
    case Scope::View:
        break;
    }
    return {};
}

Change changeFor(const ParameterInfo& info, const Target& target) {
    return {info.affects, target};
}

bool leadsSomewhere(const Document& document, const ParameterInfo& info,
                    const ParameterValue& value) {
    if (info.type != ParameterType::Reference)
        return true;
    const Id id = static_cast<Id>(std::get<int>(value));
    return id == 0 ? info.mayBeNone : targetExists(document, {info.refersTo, id});
}

Result<Change> applyParameter(Document& document, const ParameterInfo& info, const Target& target,
                              const ParameterValue& value) {
    if (target.scope != info.scope || !targetExists(document, target))
        return Error{
            ErrorKind::Usage,
            fmt::format("{} cannot be set: the {} does not exist", info.id, scopeName(info.scope)),
            {},
            {}};
    const ParameterValue clamped = clampToRange(info, value);
    if (!leadsSomewhere(document, info, clamped))
        return Error{ErrorKind::Usage,
                     fmt::format("{} cannot be set: there is no {} with the id {}", info.id,
                                 scopeName(info.refersTo), std::get<int>(clamped)),
                     {},
                     {}};
    info.set(document, target.id, clamped);
    return changeFor(info, target);
}

std::vector<ParameterEdit> editsFor(const Document& document, const ParameterInfo& info,
                                    const Target& target, const ParameterValue& value) {
    CHECK(target.scope == info.scope && targetExists(document, target));
    const ParameterValue clamped = clampToRange(info, value);
    if (info.onSet)
        return info.onSet(document, target.id, clamped);
    if (const MapSlot* slot = std::get_if<MapSlot>(&clamped))
        return editsForMap(document, info, target, *slot);
    return {{&info, clamped}};
}

std::vector<ParameterEdit> editsTo(const Light& light) {
    Document scratch;
    scratch.lights.push_back(light);
    std::vector<ParameterEdit> edits;
    for (const ParameterInfo& info : parameters())
        if (info.scope == Scope::Light && info.type != ParameterType::Text)
            edits.push_back({&info, info.get(scratch, light.id)});
    return edits;
}

std::vector<ParameterEdit> editsForMap(const Document& document, const ParameterInfo& map,
                                       const Target& target, const MapSlot& slot) {
    CHECK(map.type == ParameterType::Map && targetExists(document, target));
    std::vector<ParameterEdit> edits;
    const bool isFirst = !std::get<MapSlot>(map.get(document, target.id)).assigned();
    const auto number =
        std::find_if(parameters().begin(), parameters().end(),
                     [&](const ParameterInfo& info) { return mapOf(info) == &map; });
    if (isFirst && slot.assigned() && number != parameters().end()) {
        const ParameterValue neutral = neutralFactor(*number);
        if (number->get(document, target.id) != neutral)
            edits.push_back({&*number, neutral});
    }
    edits.push_back({&map, slot});
    return edits;
}

std::string uniqueMaterialName(const Document& document, const std::string& name) {
    return uniqueName(document.materials, name);
}
std::string uniqueLightName(const Document& document, const std::string& name) {
    return uniqueName(document.lights, name);
}
std::string uniqueMeshName(const Document& document, const std::string& name) {
    return uniqueName(document.meshes, name);
}

std::string uniqueSoftboxName(const Document& document, const std::string& name) {
    return uniqueName(document.environment().softboxes, name);
}

Id addMaterial(Document& document, Material material) {
    material.id = document.takeId();
    material.name = uniqueMaterialName(document, material.name);
    return document.materials.emplace_back(std::move(material)).id;
}

Id addLight(Document& document, Light light) {
    light.id = document.takeId();
    light.name = uniqueLightName(document, light.name);
    return document.lights.emplace_back(std::move(light)).id;
}

Id duplicateMaterial(Document& document, Id material) {
    return duplicate(document, document.materials, material);
}
Id duplicateLight(Document& document, Id light) {
    return duplicate(document, document.lights, light);
}
Id duplicateMesh(Document& document, Id mesh) {
    const MeshInstance* original = document.mesh(mesh);
    CHECK(original != nullptr);
    MeshInstance copy = *original;
    copy.id = document.takeId();
    copy.name = uniqueMeshName(document, copy.name);
    return document.meshes.emplace_back(std::move(copy)).id;
}

namespace {

void takeIds(Document& document, Environment& environment) {
    environment.id = document.takeId();
    for (Softbox& softbox : environment.softboxes)
        softbox.id = document.takeId();
}

} // namespace

Id addEnvironment(Document& document, Environment environment) {
    if (document.environments.size() >= kMaxEnvironments)
        return 0;
    takeIds(document, environment);
    if (!environment.name.empty())
        environment.name = uniqueName(document.environments, environment.name);
    return document.environments.emplace_back(std::move(environment)).id;
}

Id duplicateEnvironment(Document& document, Id environment) {
    if (document.environments.size() >= kMaxEnvironments)
        return 0;
    const auto original = findIn(document.environments, environment);
    CHECK(original != document.environments.end());
    Environment copy = *original;
    takeIds(document, copy);
    copy.name = uniqueName(document.environments, environmentTitle(copy));
    return document.environments.insert(std::next(original), std::move(copy))->id;
}

void fadeTo(Document& document, Id environment) {
    const Target scene{Scope::Environment, 0};
    for (const ParameterEdit& edit : editsFor(document, *findParameter("environment.second"), scene,
                                              static_cast<int>(environment)))
        edit.info->set(document, scene.id, edit.value);
}

bool removeEnvironment(Document& document, Id environment) {
    const auto found = findIn(document.environments, environment);
    if (found == document.environments.end() || document.environments.size() == 1)
        return false;
    EnvironmentMix& mix = document.mix;
    if (mix.first == environment) {
        const auto next = std::next(found);
        const Id neighbour = next != document.environments.end() ? next->id : std::prev(found)->id;
        mix.first = mix.second != 0 ? mix.second : neighbour;
        mix.second = 0;
    } else if (mix.second == environment) {
        mix.second = 0;
    }
    document.environments.erase(found);
    return true;
}

Id addSoftbox(Document& document, Softbox softbox) {
    if (document.environment().softboxes.size() >= kMaxSoftboxes)
        return 0;
    softbox.id = document.takeId();
    softbox.name = uniqueSoftboxName(document, softbox.name);
    return document.environment().softboxes.emplace_back(std::move(softbox)).id;
}
Id duplicateSoftbox(Document& document, Id softbox) {
    const auto holder =
        std::ranges::find_if(document.environments, [&](const Environment& environment) {
            return findIn(environment.softboxes, softbox) != environment.softboxes.end();
        });
    CHECK(holder != document.environments.end());
    if (holder->softboxes.size() >= kMaxSoftboxes)
        return 0;
    return duplicate(document, holder->softboxes, softbox);
}
bool removeSoftbox(Document& document, Id softbox) {
    return std::ranges::any_of(document.environments, [&](Environment& environment) {
        return removeFrom(environment.softboxes, softbox);
    });
}

bool removeMaterial(Document& document, Id material) {
    if (!removeFrom(document.materials, material))
        return false;
    for (MeshInstance& mesh : document.meshes) {
        if (mesh.material != material)
            continue;
        mesh.material =
            document.materials.empty() ? addMaterial(document, {}) : document.materials.front().id;
    }
    return true;
}

bool removeLight(Document& document, Id light) {
    return removeFrom(document.lights, light);
}

bool removeMesh(Document& document, Id mesh) {
    return removeFrom(document.meshes, mesh);
}

void replaceLook(Document& document, Id material, const Material& look) {
    Material* target = document.material(material);
    CHECK(target != nullptr);
    Material replaced = look;
    replaced.id = target->id;
    replaced.name = target->name;
    *target = std::move(replaced);
}

void attachBake(Document& document, BakeArtifactPtr bake) {
    CHECK(bake != nullptr);
    const auto place = std::ranges::find_if(
        document.bakes, [&](const BakeArtifactPtr& other) { return other->kind >= bake->kind; });
    if (place != document.bakes.end() && (*place)->kind == bake->kind)
        *place = std::move(bake);
    else
        document.bakes.insert(place, std::move(bake));
}

bool removeBake(Document& document, BakeKind kind) {
    return std::erase_if(document.bakes,
                         [&](const BakeArtifactPtr& bake) { return bake->kind == kind; }) > 0;
}

BakeArtifactPtr findBake(const Document& document, BakeKind kind) {
    const auto found =
        std::find_if(document.bakes.begin(), document.bakes.end(),
                     [&](const BakeArtifactPtr& bake) { return bake->kind == kind; });
    return found == document.bakes.end() || isAbsent(**found) ? nullptr : *found;
}

int bakedBounces(const Document& document) {
    int bounces = 0;
    for (const BakeArtifactPtr& bake : document.bakes)
        if (bake->transfer == TransferKind::Interreflected && holdsTransfer(bake->kind))
            bounces = std::max(bounces, std::max(bake->bounces, 1));
    return bounces;
}

bool hasTransfer(const Document& document) {
    return std::any_of(
        document.bakes.begin(), document.bakes.end(),
        [](const BakeArtifactPtr& bake) { return holdsTransfer(bake->kind) && !isAbsent(*bake); });
}

} // namespace patina
