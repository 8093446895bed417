#include "core/document/Dirty.h"

#include "core/light/Light.h"
#include "core/material/Material.h"

#include <algorithm>
#include <tuple>
#include <unordered_map>
#include <unordered_set>

namespace patina {
namespace {

auto shape(const MeshInstance& m) {
    return std::tie(m.visible, m.mesh, m.placement);
}

// What of a material shadow maps show: an opaque one all of the mesh, a blended one nothing, a
// cut-out one what its opacity leaves.
bool cutsAlike(const Material& a, const Material& b) {
    if (a.alphaMode != b.alphaMode)
        return false;
    return a.alphaMode != AlphaMode::Mask || std::tie(a.opacity, a.alphaCutoff, a.baseColorMap) ==
                                                 std::tie(b.opacity, b.alphaCutoff, b.baseColorMap);
}

class Materials {
  public:
    explicit Materials(const Document& document) {
        for (const Material& material : document.materials)
            m_byId.emplace(material.id, &material);
    }
    [[nodiscard]] const Material* find(Id id) const {
        const auto found = m_byId.find(id);
        return found != m_byId.end() ? found->second : nullptr;
    }
    // A mesh whose material is not there shows the default one.
    [[nodiscard]] const Material& shown(Id id) const {
        static const Material kDefault;
        const Material* found = find(id);
        return found ? *found : kDefault;
    }

  private:
    std::unordered_map<Id, const Material*> m_byId;
};

// Of materials and environments: names are in no picture.
template <class Element>
bool sameButName(const Element& before, const Element& after) {
    if (before.name == after.name)
        return before == after;
    Element renamed = before;
    renamed.name = after.name;
    return renamed == after;
}

// Returns the materials that cut out other holes than before.
std::unordered_set<Id> compareMaterials(const Document& before, const Materials& known,
                                        const Document& after, const Materials& now, Dirty& dirty) {
    std::unordered_set<Id> otherHoles;
    const auto compare = [&](Id id) {
        const Material &old = known.shown(id), &shown = now.shown(id);
        if (!cutsAlike(old, shown))
            otherHoles.insert(id);
        dirty.places |= old.doubleSided != shown.doubleSided;
    };
    for (const Material& material : after.materials) {
        const Material* old = known.find(material.id);
        dirty.materialSet |= old == nullptr;
        if (old != nullptr && sameButName(*old, material))
            continue;
        dirty.materials.push_back(material.id);
        compare(material.id);
    }
    for (const Material& material : before.materials)
        if (now.find(material.id) == nullptr) {
            dirty.materialSet = true;
            compare(material.id);
        }
    return otherHoles;
}

// Whether shadow maps show the same of both, where the instances are others.
bool castAlike(const Document& before, const Materials& known, const Document& after,
               const Materials& now) {
    return std::ranges::equal(before.meshes, after.meshes,
                              [&](const MeshInstance& a, const MeshInstance& b) {
                                  return shape(a) == shape(b) &&
                                         cutsAlike(known.shown(a.material), now.shown(b.material));
                              });
}

bool sameInstance(const MeshInstance& a, const MeshInstance& b) {
    return a.id == b.id && a.material == b.material && shape(a) == shape(b);
}

// Of the environments, those alone that light the scene are asked for.
bool sameLight(const Document& before, const Document& after) {
    const Environment *a = before.secondEnvironment(), *b = after.secondEnvironment();
    return before.mix == after.mix && sameButName(before.environment(), after.environment()) &&
           (a == nullptr) == (b == nullptr) && (a == nullptr || sameButName(*a, *b));
}

bool sameView(const View& before, const View& after) {
    View moved = before;
    moved.camera = after.camera;
    return moved == after;
}

} // namespace

bool Dirty::any() const {
    return model || lights || environment || view || bakes || instances || casters || places ||
           materialSet || !materials.empty();
}

Dirty dirtyBetween(const Document& before, const Document& after) {
    Dirty dirty;
    dirty.model = before.model != after.model;
    dirty.lights = before.lights != after.lights;
    dirty.environment = !sameLight(before, after);
    dirty.view = !sameView(before.view, after.view);
    dirty.bakes = before.bakes != after.bakes;
    const Materials known(before), now(after);
    const std::unordered_set<Id> otherHoles = compareMaterials(before, known, after, now, dirty);
    dirty.instances = !std::ranges::equal(before.meshes, after.meshes, sameInstance);
    dirty.places |= dirty.instances;
    dirty.casters = dirty.instances ? !castAlike(before, known, after, now)
                                    : std::ranges::any_of(after.meshes, [&](const MeshInstance& m) {
                                          return otherHoles.contains(m.material);
                                      });
    return dirty;
}

} // namespace patina
