#include "core/bake/transfer/WorkOrder.h"

#include <algorithm>
#include <array>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <numeric>

namespace patina {
namespace {

enum Sight : std::uint8_t { Seen, TurnedAway, OutOfPicture };

// Half a range beside the picture's edge still counts: neighbours are interpolated into it.
constexpr float kMargin = 1.1f;

Sight sightOf(const BakePoint& point, const BakeView& view) {
    const glm::vec4 clip = view.worldToClip * glm::vec4(point.origin, 1.0f);
    const float edge = kMargin * clip.w;
    if (!(clip.w > 0.0f && std::abs(clip.x) <= edge && std::abs(clip.y) <= edge))
        return OutOfPicture;
    return glm::dot(point.normal, view.eye - point.origin) > 0.0f ? Seen : TurnedAway;
}

Sight sightOf(std::span<const BakePoint> points, const BakeView& view) {
    Sight best = OutOfPicture;
    const std::size_t last = points.size() - 1;
    for (const std::size_t i : {std::size_t{0}, last / 4, last / 2, last - last / 4, last})
        best = std::min(best, sightOf(points[i], view));
    return best;
}

} // namespace

std::optional<BakeView> toSceneUnits(const std::optional<BakeView>& view,
                                     const BakeGeometry& geometry) {
    if (!view)
        return std::nullopt;
    BakeView result;
    result.eye = glm::vec3((glm::dvec3(view->eye) - geometry.centre) * geometry.unitsPerMetre);
    const glm::dmat4 toWorld = glm::scale(glm::translate(glm::dmat4(1.0), geometry.centre),
                                          glm::dvec3(1.0 / geometry.unitsPerMetre));
    result.worldToClip = glm::mat4(glm::dmat4(view->worldToClip) * toWorld);
    return result;
}

std::vector<std::uint32_t> workOrder(std::span<const BakePoint> points,
                                     std::span<const PointRange> ranges,
                                     const std::optional<BakeView>& view) {
    std::vector<std::uint32_t> order(ranges.size());
    std::iota(order.begin(), order.end(), 0u);
    if (!view)
        return order;
    std::vector<Sight> sights(ranges.size(), OutOfPicture);
    for (std::size_t r = 0; r < ranges.size(); ++r)
        if (ranges[r].count > 0)
            sights[r] = sightOf(points.subspan(ranges[r].first, ranges[r].count), *view);
    std::ranges::stable_sort(order, {}, [&](std::uint32_t r) { return sights[r]; });
    return order;
}

} // namespace patina
