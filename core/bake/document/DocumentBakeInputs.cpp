#include "core/bake/document/DocumentBakeInputs.h"

#include "core/base/ById.h"
#include "core/document/Document.h"
#include "core/material/Material.h"

namespace patina {

BakeInputs bakeInputs(const Document& document) {
    BakeInputs inputs;
    const ById materials(document.materials);
    for (const MeshInstance& instance : document.meshes) {
        if (!instance.visible || !instance.mesh)
            continue;
        const Material* material = materials.find(instance.material);
        inputs.meshes.push_back(
            {instance.id, instance.material, instance.mesh, instance.placement.matrix(),
             material != nullptr && material->doubleSided,
             material != nullptr ? bakeSurface(*material) : BakeSurface{}, instance.name});
    }
    return inputs;
}

} // namespace patina
