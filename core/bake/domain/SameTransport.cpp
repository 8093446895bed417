#include "core/bake/domain/SameTransport.h"

#include "core/material/Material.h"

#include <algorithm>

namespace patina {
namespace {

bool sameMesh(const BakeMesh& a, const BakeMesh& b) {
    if (a.id != b.id || a.mesh != b.mesh || a.transform != b.transform ||
        a.doubleSided != b.doubleSided || a.surface.alphaMode != b.surface.alphaMode)
        return false;
    return a.surface.alphaMode == AlphaMode::Opaque ||
           (a.surface.opacity == b.surface.opacity &&
            a.surface.alphaCutoff == b.surface.alphaCutoff &&
            a.surface.baseColorMap == b.surface.baseColorMap);
}

} // namespace

bool sameTransport(const BakeInputs& a, const BakeInputs& b) {
    return std::equal(a.meshes.begin(), a.meshes.end(), b.meshes.begin(), b.meshes.end(),
                      [](const BakeMesh& x, const BakeMesh& y) { return sameMesh(x, y); });
}

} // namespace patina
