#include "core/trace/BakeScene.h"

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
    return BakeScene{std::move(geometry), *std::move(rays)};
}

} // namespace patina
