#include "core/trace/error/SeenMaterials.h"

#include "core/job/Parallel.h"
#include "core/trace/path/Eye.h"

namespace patina {
namespace {

constexpr int kMostLookedThrough = 256; // backs, as of paths

Id materialSeen(const TraceScene& scene, const glm::vec3& origin, const glm::vec3& direction) {
    ClosestRay hit = scene.closest(origin, direction);
    for (int backs = 0; hit.mesh != ClosestRay::kNothing && backs < kMostLookedThrough; ++backs) {
        const TracePoint point = scene.pointAt(hit);
        if (point.hasSurface())
            return scene.materialOf(point.mesh);
        hit = scene.closest(TraceScene::origin(point, true), direction);
    }
    return 0;
}

} // namespace

std::vector<Id> seenMaterials(const TraceScene& scene, const TraceView& view,
                              const JobContext& job) {
    const auto width = static_cast<std::size_t>(view.width);
    std::vector<Id> seen(width * static_cast<std::size_t>(view.height), 0);
    const Eye eye(scene, view);
    parallelFor(
        job, static_cast<std::size_t>(view.height), 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t y = begin; y < end && !job.stopping(); ++y)
                for (std::size_t x = 0; x < width; ++x)
                    seen[y * width + x] = materialSeen(
                        scene, eye.origin(),
                        eye.direction(static_cast<int>(x), static_cast<int>(y), glm::vec2(0.5f)));
        });
    if (job.cancelled())
        seen.clear();
    return seen;
}

} // namespace patina
