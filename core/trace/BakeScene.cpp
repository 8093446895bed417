#include "core/trace/BakeScene.h"

#include "core/material/Material.h"

#include <algorithm>
#include <utility>

namespace patina {

Result<BakeScene> BakeScene::build(const BakeInputs& inputs, const JobContext& job) {
    Result<BakeGeometry> made = makeBakeGeometry(inputs, job);
    if (!made)
        return made.error();
    auto geometry = std::make_unique<const BakeGeometry>(*std::move(made));
    Result<RayScene> rays = RayScene::build(*geometry, job);
    if (!rays)
        return rays.error();
    const bool byChance = std::ranges::any_of(geometry->meshes, [](const BakeGeometryMesh& mesh) {
        return mesh.surface.alphaMode == AlphaMode::Blend;
    });
    return BakeScene{std::move(geometry), *std::move(rays), byChance};
}

} // namespace patina
