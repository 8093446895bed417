#include "core/radiosity/ElementSides.h"

#include "core/job/Parallel.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

namespace patina::radiosity {
namespace {

constexpr double kAboveShare = 0.01; // of an element's size that its points stand above it
constexpr std::size_t kSidesGrain = 64;
constexpr int kLines = 4;           // rays along each way over an element
constexpr double kInset = 2e-3;     // of an element: where these begin, off what its edges touch
constexpr double kStraight = 1e-3;  // of an element: how far a line may be off its rows or columns
constexpr double kThin = 1e-3;      // of a way: what is as thick is not without thickness
constexpr double kLeastPart = 1e-3; // of an element; less is no part of its own

double sizeOf(const ElementMesh& elements, std::uint32_t element) { // scene units
    return std::sqrt(elements.area(element)) / elements.metresPerUnit();
}

double heightAbove(const ElementMesh& elements, std::uint32_t element) {
    return std::max(kAboveShare * sizeOf(elements, element), ElementSides::kLeastAbove);
}

// A place of an element, 0…1 along each edge, on its face. Of a triangle those with a sum above 1
// lie beyond it.
glm::dvec2 onFace(const ElementMesh& elements, std::uint32_t element, const glm::dvec2& at) {
    const ElementMesh::Node& node = elements.node(element);
    return glm::dvec2(node.origin) + at * glm::dvec2(node.extent);
}

// The way from one place of an element to another one, just above it.
struct Way {
    glm::dvec3 from, to;
};

Way wayOver(const ElementMesh& elements, std::uint32_t element, const glm::dvec2& from,
            const glm::dvec2& to) {
    const Face& face = elements.face(element);
    const glm::dvec3 up = heightAbove(elements, element) * face.normal;
    return {positionOn(face, onFace(elements, element, from)) + up,
            positionOn(face, onFace(elements, element, to)) + up};
}

OcclusionRay rayAlong(const Way& way) {
    OcclusionRay ray;
    ray.origin = glm::vec3(way.from);
    ray.direction = glm::vec3(glm::normalize(way.to - way.from));
    ray.maxDistance = static_cast<float>(glm::length(way.to - way.from));
    return ray;
}

// How far along a way a wall without thickness is, 0…1; nothing: there is none, or something that
// looks otherwise from its two ends.
std::optional<double> wallAcross(const Way& way, const RayScene& rays) {
    std::array<ClosestRay, 2> asked;
    asked[0].ray = rayAlong(way);
    asked[1].ray = rayAlong({way.to, way.from});
    rays.intersect(asked);
    if (asked[0].mesh == ClosestRay::kNothing || asked[1].mesh == ClosestRay::kNothing)
        return std::nullopt;
    const double length = glm::length(way.to - way.from);
    const double from = double{asked[0].ray.maxDistance} / length,
                 to = 1.0 - double{asked[1].ray.maxDistance} / length;
    return std::abs(from - to) < kThin ? std::optional(0.5 * (from + to)) : std::nullopt;
}

std::vector<std::uint32_t> marked(const std::vector<std::uint8_t>& elements) {
    std::vector<std::uint32_t> result;
    for (std::uint32_t e = 0; e < elements.size(); ++e)
        if (elements[e] != 0)
            result.push_back(e);
    return result;
}

// A few rays, for most elements have nothing on them. What has a thickness buries a part of the
// element, which has light from one side then, or is wider than that.
bool mayBeCrossed(const ElementMesh& elements, std::uint32_t element, const RayScene& rays) {
    if (elements.exposed(element) < 1.0f)
        return false;
    constexpr double a = kInset, b = 1.0 - kInset;
    std::vector<Way> ways;
    if (elements.face(element).cornerCount == 4)
        ways = {wayOver(elements, element, {a, a}, {b, b}),
                wayOver(elements, element, {b, a}, {a, b}),
                wayOver(elements, element, {a, 0.5}, {b, 0.5}),
                wayOver(elements, element, {0.5, a}, {0.5, b})};
    else
        ways = {wayOver(elements, element, {a, a}, {0.5, 0.5}),
                wayOver(elements, element, {b - a, a}, {a, 0.5}),
                wayOver(elements, element, {a, b - a}, {0.5, a})};
    std::vector<OcclusionRay> asked;
    for (const Way& way : ways)
        asked.push_back(rayAlong(way));
    rays.occlude(asked);
    return std::ranges::any_of(asked, &OcclusionRay::occluded);
}

// Where something stands across all rows of an element (`up`: its columns), on the face; nothing:
// it does not, or not straight.
std::optional<double> cutOf(const ElementMesh& elements, std::uint32_t element, bool up,
                            const RayScene& rays) {
    const Face& face = elements.face(element);
    const ElementMesh::Node& node = elements.node(element);
    const auto place = [&](double along, double line) {
        return up ? glm::dvec2(line, along) : glm::dvec2(along, line);
    };
    const auto coordinate = [&](const glm::dvec2& at) { return up ? at.y : at.x; };
    const double origin = up ? double{node.origin.y} : double{node.origin.x},
                 extent = up ? double{node.extent.y} : double{node.extent.x};
    double sum = 0.0, least = 1.0, most = 0.0;
    for (int i = 0; i < kLines; ++i) {
        const double line = (i + 0.5) / kLines;
        const Way way = wayOver(elements, element, place(kInset, line), place(1.0 - kInset, line));
        const std::optional<double> along = wallAcross(way, rays);
        if (!along)
            return std::nullopt;
        const glm::dvec3 met = glm::mix(way.from, way.to, *along);
        const double at = (coordinate(coordinatesOn(face, met)) - origin) / extent;
        sum += at;
        least = std::min(least, at);
        most = std::max(most, at);
    }
    const double middle = sum / kLines;
    if (most - least > kStraight || middle < kLeastPart || middle > 1.0 - kLeastPart)
        return std::nullopt;
    return origin + middle * extent;
}

} // namespace

ElementSides sidesOf(const ElementMesh& elements, std::uint32_t element, const RayScene& rays) {
    constexpr std::size_t kGrid = ElementSides::kGrid;
    const glm::dvec3 normal = elements.face(element).normal;
    const double above = heightAbove(elements, element);
    std::array<glm::dvec3, kGrid * kGrid> points{};
    ElementSides sides;
    for (int i = 0; i < ElementSides::kGrid; ++i)
        for (int k = 0; k < ElementSides::kGrid; ++k) {
            const auto at = static_cast<std::size_t>(i * ElementSides::kGrid + k);
            const glm::dvec3 on = elements.samplePosition(element, ElementSides::point(i, k));
            points[at] = on + above * normal;
            if (elements.isBuried(element, on, rays))
                sides.of[at] = ElementSides::kBuried;
        }
    struct Neighbours {
        std::size_t a, b;
    };
    std::vector<Neighbours> pairs;
    std::vector<OcclusionRay> between;
    const auto ask = [&](std::size_t a, std::size_t b) {
        if (sides.of[a] == ElementSides::kBuried || sides.of[b] == ElementSides::kBuried)
            return;
        between.push_back(rayAlong({points[a], points[b]}));
        pairs.push_back({a, b});
    };
    for (std::size_t i = 0; i < kGrid; ++i)
        for (std::size_t k = 0; k < kGrid; ++k) {
            if (i + 1 < kGrid)
                ask(i * kGrid + k, (i + 1) * kGrid + k);
            if (k + 1 < kGrid)
                ask(i * kGrid + k, i * kGrid + k + 1);
        }
    rays.occlude(between);
    // Union by the lower number.
    std::array<std::size_t, kGrid * kGrid> root{};
    std::iota(root.begin(), root.end(), std::size_t{0});
    const auto find = [&](std::size_t at) {
        while (root[at] != at)
            at = root[at];
        return at;
    };
    for (std::size_t p = 0; p < pairs.size(); ++p)
        if (!between[p].occluded()) {
            const std::size_t a = find(pairs[p].a), b = find(pairs[p].b);
            root[std::max(a, b)] = std::min(a, b);
        }
    std::map<std::size_t, int> numbers;
    for (std::size_t at = 0; at < root.size(); ++at) {
        if (sides.of[at] == ElementSides::kBuried)
            continue;
        const auto [number, added] =
            numbers.try_emplace(find(at), static_cast<int>(numbers.size()));
        if (added)
            sides.counts.push_back(0);
        sides.of[at] = number->second;
        ++sides.counts[static_cast<std::size_t>(number->second)];
    }
    return sides;
}

std::vector<FaceCut> findCuts(const ElementMesh& elements, const RayScene& rays,
                              const JobContext& job) {
    std::vector<std::array<std::optional<double>, 2>> found(elements.size());
    parallelFor(job, elements.size(), kSidesGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t e = begin; e < end; ++e) {
            const auto element = static_cast<std::uint32_t>(e);
            if (elements.face(element).cornerCount != 4 || !mayBeCrossed(elements, element, rays))
                continue;
            for (const bool up : {false, true})
                found[e][up ? 1 : 0] = cutOf(elements, element, up, rays);
        }
    });
    std::vector<FaceCut> cuts;
    for (std::uint32_t e = 0; e < elements.size(); ++e)
        for (const bool up : {false, true})
            if (const std::optional<double>& at = found[e][up ? 1 : 0])
                cuts.push_back({elements.node(e).face, up, static_cast<float>(*at)});
    // A wall crosses a row of elements, all at one place but for rounding.
    std::ranges::sort(cuts, [](const FaceCut& a, const FaceCut& b) {
        return std::tie(a.face, a.row, a.at) < std::tie(b.face, b.row, b.at);
    });
    const auto same = [&](const FaceCut& a, const FaceCut& b) {
        return a.face == b.face && a.row == b.row && b.at - a.at < FaceCut::kSame;
    };
    cuts.erase(std::unique(cuts.begin(), cuts.end(), same), cuts.end());
    return cuts;
}

std::vector<std::uint32_t> findDivided(const ElementMesh& elements, const RayScene& rays,
                                       const JobContext& job) {
    std::vector<std::uint8_t> divided(elements.size(), 0);
    parallelFor(job, elements.size(), kSidesGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t e = begin; e < end; ++e) {
            const auto element = static_cast<std::uint32_t>(e);
            divided[e] = mayBeCrossed(elements, element, rays) &&
                                 sidesOf(elements, element, rays).counts.size() > 1
                             ? 1
                             : 0;
        }
    });
    return marked(divided);
}

std::vector<std::uint32_t> findParted(const ElementMesh& elements, const RayScene& rays,
                                      const JobContext& job) {
    std::vector<std::uint8_t> parted(elements.size(), 0);
    parallelFor(job, elements.size(), kSidesGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t e = begin; e < end; ++e) {
            const auto element = static_cast<std::uint32_t>(e);
            const std::uint32_t face = elements.node(element).face;
            if (elements.face(element).fenced)
                continue; // is known
            for (const glm::dvec2& beyond : {glm::dvec2(1.01, 0.4), glm::dvec2(0.4, 1.01)}) {
                const glm::dvec2 at = onFace(elements, element, beyond);
                const bool inside = elements.face(element).cornerCount == 4
                                        ? at.x < 1.0 && at.y < 1.0
                                        : at.x > 0.0 && at.y > 0.0 && at.x + at.y < 1.0;
                if (inside && isWallBetween(elements, element, elements.elementAt(face, at), rays))
                    parted[e] = 1;
            }
        }
    });
    return marked(parted);
}

bool isWallBetween(const ElementMesh& elements, std::uint32_t a, std::uint32_t b,
                   const RayScene& rays) {
    if (elements.exposed(a) < 1.0f || elements.exposed(b) < 1.0f)
        return false; // below what buries it light runs on
    const auto above = [&](std::uint32_t element) {
        return elements.centre(element) +
               heightAbove(elements, element) * elements.face(element).normal;
    };
    return wallAcross({above(a), above(b)}, rays).has_value();
}

} // namespace patina::radiosity
