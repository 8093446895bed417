#include "core/trace/whitted/RayCountImages.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <string>

namespace patina {
namespace {

constexpr std::array kRayCounts = {
    RayCountInfo{RayCountKind::Rays, "rays", "Rays"},
    RayCountInfo{RayCountKind::Depth, "rayDepth", "Depth of the ray tree"},
    RayCountInfo{RayCountKind::BoxTests, "boxTests", "Boxes tested"},
    RayCountInfo{RayCountKind::TriangleTests, "triangleTests", "Triangles tested"},
    RayCountInfo{RayCountKind::TriangleTestsWithout, "triangleTestsWithout",
                 "Triangles tested without a hierarchy"}};

float valueOf(RayCountKind kind, const RayCounts& counts, std::size_t triangles) {
    switch (kind) {
    case RayCountKind::Rays:
        return static_cast<float>(counts.rays);
    case RayCountKind::Depth:
        return static_cast<float>(counts.depth);
    case RayCountKind::BoxTests:
        return static_cast<float>(counts.boxTests);
    case RayCountKind::TriangleTests:
        return static_cast<float>(counts.triangleTests);
    case RayCountKind::TriangleTestsWithout:
        break;
    }
    return static_cast<float>(counts.rays) * static_cast<float>(triangles);
}

} // namespace

std::span<const RayCountInfo> rayCountInfos() {
    return kRayCounts;
}

Result<std::vector<const RayCountInfo*>> parseRayCounts(std::string_view text) {
    std::array<bool, kRayCounts.size()> wanted{};
    for (std::string_view left = text; !left.empty() || text.empty();) {
        const std::size_t comma = std::min(left.find(','), left.size());
        const std::string_view name = left.substr(0, comma);
        left.remove_prefix(std::min(comma + 1, left.size()));
        const auto found = std::ranges::find(kRayCounts, name, &RayCountInfo::id);
        if (name == "all") {
            wanted.fill(true);
        } else if (found != kRayCounts.end()) {
            wanted[static_cast<std::size_t>(found - kRayCounts.begin())] = true;
        } else if (name != "beauty") {
            std::string names = "all, beauty";
            for (const RayCountInfo& info : kRayCounts)
                names += fmt::format(", {}", info.id);
            return Error{
                ErrorKind::Usage,
                fmt::format("\"{}\" is no output of --renderer whitted; there are {}", name, names),
                {},
                {}};
        }
    }
    std::vector<const RayCountInfo*> chosen;
    for (std::size_t i = 0; i < kRayCounts.size(); ++i)
        if (wanted[i])
            chosen.push_back(&kRayCounts[i]);
    return chosen;
}

bool needHierarchy(std::span<const RayCountInfo* const> chosen) {
    return std::ranges::any_of(chosen, [](const RayCountInfo* info) {
        return info->kind == RayCountKind::BoxTests || info->kind == RayCountKind::TriangleTests;
    });
}

Image rayCountImage(RayCountKind kind, const RayCountMap& map, int width, int height,
                    std::size_t triangles) {
    Image image(width, height, 1, PixelType::F32, ColorEncoding::Linear);
    image.setChannelNames({"Y"});
    std::ranges::transform(map.pixels(), image.f32().begin(), [&](const RayCounts& counts) {
        return valueOf(kind, counts, triangles);
    });
    return image;
}

} // namespace patina
