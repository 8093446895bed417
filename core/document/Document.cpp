#include "core/document/Document.h"

#include <algorithm>

namespace patina {
namespace {

template <class Elements>
auto* findById(Elements& elements, Id id) {
    const auto found = std::find_if(elements.begin(), elements.end(),
                                    [&](const auto& element) { return element.id == id; });
    return found == elements.end() ? nullptr : &*found;
}

} // namespace

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
const Softbox* Document::softbox(Id id) const {
    return findById(environment.softboxes, id);
}
Softbox* Document::softbox(Id id) {
    return findById(environment.softboxes, id);
}
const MeshInstance* Document::mesh(Id id) const {
    return findById(meshes, id);
}
MeshInstance* Document::mesh(Id id) {
    return findById(meshes, id);
}

Bounds Document::bounds() const {
    Bounds result;
    for (const MeshInstance& instance : meshes)
        if (instance.visible && instance.mesh)
            result.add(instance.mesh->bounds().transformed(instance.transform));
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
