#include "core/document/Document.h"

#include "core/base/Check.h"
#include "core/document/Snapshot.h"
#include "core/light/Light.h"
#include "core/material/Material.h"

#include <algorithm>
#include <utility>

namespace patina {
namespace {

template <class Elements>
auto* findById(Elements& elements, Id id) {
    const auto found = std::find_if(elements.begin(), elements.end(),
                                    [&](const auto& element) { return element.id == id; });
    return found == elements.end() ? nullptr : &*found;
}

} // namespace

Document::Document() {
    Environment& first = environments.emplace_back();
    mix.first = first.id = takeId();
}

// Here, where materials, lights and snapshots are known.
Document::Document(const Document& other) = default;
Document::Document(Document&& other) noexcept = default;
Document& Document::operator=(const Document& other) = default;
Document& Document::operator=(Document&& other) noexcept = default;
Document::~Document() = default;
bool Document::operator==(const Document& other) const = default;

const Material* Document::material(Id id) const {
    return findById(materials, id);
}
Material* Document::material(Id id) {
    return findById(materials, id);
}
const Light* Document::light(Id id) const {
    return findById(lights, id);
}
Light* Document::light(Id id) {
    return findById(lights, id);
}
const Environment& Document::environment() const {
    const Environment* first = findById(environments, mix.first);
    CHECK(first != nullptr);
    return *first;
}
Environment& Document::environment() {
    return const_cast<Environment&>(std::as_const(*this).environment());
}
const Environment* Document::secondEnvironment() const {
    return mix.second == 0 ? nullptr : findById(environments, mix.second);
}
Environment* Document::secondEnvironment() {
    return mix.second == 0 ? nullptr : findById(environments, mix.second);
}
const Environment* Document::environment(Id id) const {
    return id == 0 ? &environment() : findById(environments, id);
}
Environment* Document::environment(Id id) {
    return id == 0 ? &environment() : findById(environments, id);
}
const Softbox* Document::softbox(Id id) const {
    for (const Environment& environment : environments)
        if (const Softbox* found = findById(environment.softboxes, id))
            return found;
    return nullptr;
}
Softbox* Document::softbox(Id id) {
    return const_cast<Softbox*>(std::as_const(*this).softbox(id));
}
const MeshInstance* Document::mesh(Id id) const {
    return findById(meshes, id);
}
MeshInstance* Document::mesh(Id id) {
    return findById(meshes, id);
}

const Snapshot* Document::snapshot(Id id) const {
    return findById(snapshots, id);
}

Bounds Document::bounds() const {
    Bounds result;
    for (const MeshInstance& instance : meshes)
        if (instance.visible && instance.mesh)
            result.add(instance.mesh->bounds().transformed(instance.placement.matrix()));
    return result;
}

std::size_t Document::triangleCount() const {
    std::size_t count = 0;
    for (const MeshInstance& instance : meshes)
        if (instance.visible && instance.mesh)
            count += instance.mesh->triangleCount();
    return count;
}

} // namespace patina
