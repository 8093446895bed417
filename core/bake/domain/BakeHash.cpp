#include "core/bake/domain/BakeHash.h"

#include "core/material/Material.h"

#include <map>

namespace patina {

// Materials count by the order of their first use: which meshes share a texture matters, ids do
// not, so that a scene opened again finds its bakes fresh.
Hash hashBakeInputs(const BakeInputs& inputs) {
    Hasher hasher;
    std::map<Id, std::uint32_t> materials;
    for (const BakeMesh& mesh : inputs.meshes) {
        const auto next = static_cast<std::uint32_t>(materials.size());
        hasher.value(materials.try_emplace(mesh.material, next).first->second);
        hasher.value(mesh.mesh ? hashMesh(*mesh.mesh) : Hash{});
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 4; ++row)
                hasher.value(mesh.transform[column][row]);
        hashCoverage(hasher, mesh.surface);
    }
    return hasher.finish();
}

Hash hashBakeAlbedo(const BakeInputs& inputs) {
    Hasher hasher;
    for (const BakeMesh& mesh : inputs.meshes) {
        hasher.value(static_cast<std::uint32_t>(mesh.doubleSided));
        hashAlbedo(hasher, mesh.surface);
    }
    return hasher.finish();
}

} // namespace patina
