#include "core/export/Variants.h"

#include "core/document/Snapshot.h"
#include "core/material/Material.h"

#include <algorithm>

namespace patina {
namespace {

const Material& defaultMaterial() {
    static const Material kDefault;
    return kDefault;
}

const Material* materialIn(const Look& look, Id id) {
    const auto found = std::ranges::find_if(
        look.materials, [&](const auto& material) { return material->id == id; });
    return found != look.materials.end() ? found->get() : &defaultMaterial();
}

bool looksTheSame(const Material& a, const Material& b) {
    Material renamed = a;
    renamed.id = b.id;
    renamed.name = b.name;
    return renamed == b;
}

} // namespace

std::vector<const Material*> variantsOf(const Document& document, const MeshInstance& mesh) {
    const Material* shown = document.material(mesh.material);
    std::vector<const Material*> variants;
    for (const Snapshot& snapshot : document.snapshots) {
        const Look& look = *snapshot.look;
        const auto there = std::ranges::find(look.meshes, mesh.id, &MeshLook::id);
        const Material* variant =
            there != look.meshes.end() ? materialIn(look, there->material) : nullptr;
        if (variant != nullptr && looksTheSame(*variant, shown ? *shown : defaultMaterial()))
            variant = nullptr;
        variants.push_back(variant);
    }
    return variants;
}

bool hasMaterialVariants(const Document& document) {
    return !document.snapshots.empty() &&
           std::ranges::any_of(document.meshes, [&](const MeshInstance& mesh) {
               return std::ranges::any_of(variantsOf(document, mesh),
                                          [](const Material* variant) { return variant; });
           });
}

} // namespace patina
