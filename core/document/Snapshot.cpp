#include "core/document/Snapshot.h"

#include "core/document/Document.h"
#include "core/light/Light.h"
#include "core/material/Material.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace patina {
namespace {

template <class Element>
using Shared = std::vector<std::shared_ptr<const Element>>;

template <class Element>
bool sameElements(const Shared<Element>& a, const Shared<Element>& b) {
    return std::ranges::equal(
        a, b, [](const auto& one, const auto& other) { return one == other || *one == *other; });
}

const Material& kept(const Material& material) {
    return material;
}
const Light& kept(const Light& light) {
    return light;
}
Environment kept(Environment environment) {
    environment.image = nullptr;
    return environment;
}

template <class Element>
Shared<Element> sharedElements(const std::vector<Element>& elements, const Shared<Element>* like) {
    std::unordered_map<Id, const std::shared_ptr<const Element>*> known;
    if (like != nullptr)
        for (const auto& element : *like)
            known.emplace(element->id, &element);
    Shared<Element> shared;
    shared.reserve(elements.size());
    for (const Element& element : elements) {
        const auto& one = kept(element);
        const auto found = known.find(element.id);
        if (found != known.end() && **found->second == one)
            shared.push_back(*found->second);
        else
            shared.push_back(std::make_shared<const Element>(one));
    }
    return shared;
}

template <class Element>
void copyElements(const Shared<Element>& shared, std::vector<Element>& elements) {
    elements.clear();
    elements.reserve(shared.size());
    for (const auto& element : shared)
        elements.push_back(*element);
}

} // namespace

bool operator==(const Look& a, const Look& b) {
    return a.model == b.model && a.view == b.view && a.mix == b.mix && a.meshes == b.meshes &&
           sameElements(a.materials, b.materials) && sameElements(a.lights, b.lights) &&
           sameElements(a.environments, b.environments);
}

bool operator==(const Snapshot& a, const Snapshot& b) {
    const bool samePicture =
        a.picture == b.picture || (a.picture && b.picture && *a.picture == *b.picture);
    return a.id == b.id && a.name == b.name && samePicture &&
           (a.look == b.look || *a.look == *b.look);
}

LookPtr lookOf(const Document& document, const Look* like) {
    auto look = std::make_shared<Look>();
    look->materials = sharedElements(document.materials, like ? &like->materials : nullptr);
    look->lights = sharedElements(document.lights, like ? &like->lights : nullptr);
    look->environments =
        sharedElements(document.environments, like ? &like->environments : nullptr);
    look->meshes.reserve(document.meshes.size());
    for (const MeshInstance& mesh : document.meshes)
        look->meshes.push_back({mesh.id, mesh.name, mesh.material, mesh.visible});
    look->mix = document.mix;
    look->mix.blended = nullptr;
    look->model = document.model;
    look->view = document.view;
    return look;
}

Document elementsOf(const Look& look) {
    Document document;
    copyElements(look.materials, document.materials);
    copyElements(look.lights, document.lights);
    copyElements(look.environments, document.environments);
    document.meshes.reserve(look.meshes.size());
    for (const MeshLook& mesh : look.meshes) {
        MeshInstance& instance = document.meshes.emplace_back();
        instance.id = mesh.id;
        instance.name = mesh.name;
        instance.material = mesh.material;
        instance.visible = mesh.visible;
    }
    document.mix = look.mix;
    document.model = look.model;
    document.view = look.view;
    return document;
}

} // namespace patina
