#include "core/job/Parallel.h"
#include "core/math/Sampling.h"
#include "core/radiosity/ElementSides.h"
#include "core/radiosity/RayFactors.h"
#include "core/radiosity/document/ElementEdges.h"
#include "core/radiosity/document/LeaksAndSeams.h"
#include "core/trace/BakeInputs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <optional>

namespace patina {

using namespace radiosity;

namespace {

constexpr int kGrid = ElementSides::kGrid;
constexpr double kLeastContrast = 0.1; // of light on two sides that counts
constexpr double kTouching = 5e-5;     // scene units; ends that are nearer to a surface touch it
constexpr int kDivisions = 2;          // in four, of an element whose sides are compared
constexpr int kSideRays = 64;          // from each of these parts
constexpr std::size_t kLeakGrain = 64;

double elementSize(const ElementMesh& elements, std::uint32_t element) { // scene units
    return std::sqrt(elements.area(element)) / elements.metresPerUnit();
}

// Irradiance of parts of elements, W/m²: straight, and what other elements send.
class PartLight {
  public:
    PartLight(const SolvedElements& solved, ElementMesh parts, std::vector<std::uint32_t> parents)
        : m_solved(solved)
        , m_parts(std::move(parts))
        , m_parents(std::move(parents))
        , m_factors(m_parts, *solved.scene.rays(), {FactorMethod::Rays, kSideRays, solved.seed})
        , m_direct(m_parts.size()) {}

    // Of the parts that `wanted` marks. Errors: Cancelled.
    Result<void> find(const std::vector<bool>& wanted, const JobContext& job) {
        for (std::uint32_t p = 0; p < m_parts.size(); ++p)
            if (!wanted[p])
                m_direct.set(p, glm::dvec3(0.0));
        SceneProblemSettings settings;
        settings.lightSamples = m_solved.lightSamples;
        settings.seed = m_solved.seed;
        return m_direct.complete(m_solved.scene, m_parts, settings, {}, job);
    }
    [[nodiscard]] glm::dvec3 at(std::uint32_t part) const {
        FactorRow row;
        m_factors.row(part, row);
        glm::dvec3 sum = m_direct.irradiance(part);
        // What glows is direct light already.
        for (const FactorRow::Share& share : row.shares) {
            const std::uint32_t other = m_parents[share.element];
            sum += double{share.factor} *
                   (m_solved.lit.radiosity(m_solved.solution, other) - m_solved.lit.glow[other]);
        }
        return sum;
    }
    [[nodiscard]] const ElementMesh& parts() const { return m_parts; }

  private:
    const SolvedElements& m_solved;
    ElementMesh m_parts;
    std::vector<std::uint32_t> m_parents;
    RayFactors m_factors;
    DirectLight m_direct;
};

// The side of most of an element's points near a position; kBuried: of none.
int sideAt(const ElementMesh& elements, std::uint32_t element, const ElementSides& sides,
           const glm::dvec3& position) {
    double nearest = 0.0;
    int side = ElementSides::kBuried;
    for (int i = 0; i < kGrid; ++i)
        for (int k = 0; k < kGrid; ++k) {
            const int of = sides.of[static_cast<std::size_t>(i * kGrid + k)];
            const double distance =
                glm::length(elements.samplePosition(element, ElementSides::point(i, k)) - position);
            if (of != ElementSides::kBuried &&
                (side == ElementSides::kBuried || distance < nearest)) {
                nearest = distance;
                side = of;
            }
        }
    return side;
}

struct DividedElement {
    std::uint32_t element;
    ElementSides sides;
};

std::optional<LightLeak> leakOf(const SolvedElements& solved, const DividedElement& divided,
                                const std::vector<std::uint32_t>& ownParts,
                                const PartLight& light) {
    const ElementMesh& elements = solved.elements;
    const std::size_t count = divided.sides.counts.size();
    std::vector<glm::dvec3> sums(count, glm::dvec3(0.0));
    std::vector<double> areas(count, 0.0);
    for (const std::uint32_t part : ownParts) {
        if (!(light.parts().exposed(part) > 0.0f))
            continue;
        const int side =
            sideAt(elements, divided.element, divided.sides, light.parts().centre(part));
        if (side == ElementSides::kBuried)
            continue;
        const double area = light.parts().area(part);
        sums[static_cast<std::size_t>(side)] += area * light.at(part);
        areas[static_cast<std::size_t>(side)] += area;
    }
    // Sides as large as their points say, with the light of the parts that are theirs.
    const double exposed =
        elements.area(divided.element) * double{elements.exposed(divided.element)};
    const int points = std::accumulate(divided.sides.counts.begin(), divided.sides.counts.end(), 0);
    glm::dvec3 mean(0.0);
    double least = 0.0, most = 0.0, known = 0.0;
    bool first = true;
    std::size_t smallest = 0;
    const auto areaOf = [&](std::size_t side) {
        return exposed * static_cast<double>(divided.sides.counts[side]) / points;
    };
    for (std::size_t side = 0; side < count; ++side) {
        if (!(areas[side] > 0.0))
            continue; // narrower than a part
        sums[side] /= areas[side];
        mean += areaOf(side) * sums[side];
        known += areaOf(side);
        const double size = magnitude(sums[side]);
        least = first ? size : std::min(least, size);
        most = first ? size : std::max(most, size);
        if (first || divided.sides.counts[side] < divided.sides.counts[smallest])
            smallest = side;
        first = false;
    }
    if (first || !(most - least >= kLeastContrast * most) || !(most > 0.0))
        return std::nullopt;
    mean /= known;
    LightLeak leak;
    leak.kind = LightLeak::Kind::Divided;
    leak.element = divided.element;
    leak.share = static_cast<double>(divided.sides.counts[smallest]) / points;
    const glm::dvec3 reflectance = solved.lit.problem.reflectance[divided.element];
    for (std::size_t side = 0; side < count; ++side)
        if (areas[side] > 0.0)
            leak.power += 0.5 * areaOf(side) * magnitude(reflectance * (sums[side] - mean));
    glm::dvec3 middle(0.0);
    for (int i = 0; i < kGrid; ++i)
        for (int k = 0; k < kGrid; ++k)
            if (divided.sides.of[static_cast<std::size_t>(i * kGrid + k)] ==
                static_cast<int>(smallest))
                middle += elements.samplePosition(divided.element, ElementSides::point(i, k));
    leak.place = solved.scene.toWorld(
        glm::vec3(middle / static_cast<double>(divided.sides.counts[smallest])));
    return leak.power > 0.0 ? std::optional(leak) : std::nullopt;
}

Result<void> addDivided(const SolvedElements& solved, std::vector<LightLeak>& leaks,
                        const JobContext& job) {
    const std::size_t count = solved.elements.size();
    std::vector<std::optional<ElementSides>> found(count);
    parallelFor(job, count, kLeakGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t e = begin; e < end; ++e)
            if (ElementSides sides =
                    sidesOf(solved.elements, static_cast<std::uint32_t>(e), *solved.scene.rays());
                sides.counts.size() > 1)
                found[e] = std::move(sides);
    });
    if (job.cancelled())
        return bakeCancelled();
    std::vector<DividedElement> divided;
    for (std::uint32_t e = 0; e < count; ++e)
        if (found[e])
            divided.push_back({e, *std::move(found[e])});
    if (divided.empty())
        return {};
    // Smaller elements in the place of those that are divided.
    ElementMesh parts = solved.elements;
    std::vector<std::uint32_t> parents(count);
    std::iota(parents.begin(), parents.end(), 0u);
    for (int round = 0; round < kDivisions; ++round) {
        std::vector<std::uint32_t> which;
        for (std::uint32_t p = 0; p < parts.size(); ++p)
            if (std::ranges::binary_search(divided, parents[p], {}, &DividedElement::element))
                which.push_back(p);
        const std::vector<std::uint32_t> before = parts.divide(which);
        std::vector<std::uint32_t> now;
        for (const std::uint32_t old : before)
            now.push_back(parents[old]);
        parents = std::move(now);
    }
    parts.findBuried(*solved.scene.rays(), job);
    std::vector<bool> wanted(parts.size());
    std::vector<std::vector<std::uint32_t>> ownParts(divided.size());
    for (std::uint32_t p = 0; p < parts.size(); ++p) {
        const auto owner =
            std::ranges::lower_bound(divided, parents[p], {}, &DividedElement::element);
        wanted[p] = owner != divided.end() && owner->element == parents[p];
        if (wanted[p])
            ownParts[static_cast<std::size_t>(owner - divided.begin())].push_back(p);
    }
    PartLight light(solved, std::move(parts), std::move(parents));
    if (Result<void> done = light.find(wanted, job); !done)
        return done;
    std::vector<std::optional<LightLeak>> result(divided.size());
    parallelFor(job, divided.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            result[i] = leakOf(solved, divided[i], ownParts[i], light);
    });
    if (job.cancelled())
        return bakeCancelled();
    for (const std::optional<LightLeak>& leak : result)
        if (leak)
            leaks.push_back(*leak);
    return {};
}

// The radiosity of what a ray meets, W/m²; black: nothing, or a side that only absorbs.
glm::dvec3 seenAlong(const SolvedElements& solved, const glm::dvec3& from, const glm::dvec3& way,
                     double& distance) {
    const ClosestRay ray = solved.scene.closest(glm::vec3(from), glm::vec3(way));
    distance = double{ray.ray.maxDistance};
    if (ray.mesh == ClosestRay::kNothing)
        return glm::dvec3(0.0);
    const std::uint32_t met = solved.elements.met(ray);
    return met == kNone ? glm::dvec3(0.0) : solved.lit.radiosity(solved.solution, met);
}

// Whether the face of an element goes on beyond its edge: to another one there light does not run
// on because of what stands between them.
bool isWithinFace(const SolvedElements& solved, const ElementEdge& edge) {
    const Face& face = solved.elements.face(edge.element);
    const glm::dvec2 at =
        coordinatesOn(face, edge.middle() + ElementSides::kLeastAbove * edge.outward);
    return at.x > 0.0 && at.y > 0.0 &&
           (face.cornerCount == 4 ? at.x < 1.0 && at.y < 1.0 : at.x + at.y < 1.0);
}

std::optional<LightLeak> gapAt(const SolvedElements& solved, const ElementEdge& edge) {
    const glm::dvec3 normal = solved.elements.face(edge.element).normal;
    const double size = elementSize(solved.elements, edge.element);
    if (solved.elements.face(edge.element).fenced && isWithinFace(solved, edge))
        return std::nullopt;
    // Beside the element's own plane, so as not to meet what it is a part of.
    const glm::dvec3 start =
        edge.middle() + ElementSides::kLeastAbove * normal - double{kRayOffset} * edge.outward;
    const ClosestRay ray = solved.scene.closest(glm::vec3(start), glm::vec3(edge.outward));
    const double width = double{ray.ray.maxDistance} - double{kRayOffset};
    if (ray.mesh == ClosestRay::kNothing || !(width > kTouching) || !(width < size))
        return std::nullopt;
    const glm::dvec3 middle = edge.middle() + 0.5 * width * edge.outward;
    double front = 0.0, back = 0.0;
    const glm::dvec3 before = seenAlong(solved, middle, normal, front),
                     behind = seenAlong(solved, middle, -normal, back);
    // Open on both sides: else it is a groove.
    if (!(std::min(front, back) > width))
        return std::nullopt;
    const double difference = magnitude(before - behind);
    if (!(difference >= kLeastContrast * std::max(magnitude(before), magnitude(behind))) ||
        !(difference > 0.0))
        return std::nullopt;
    const double metres = solved.elements.metresPerUnit();
    LightLeak leak;
    leak.element = edge.element;
    leak.width = width * metres;
    leak.power = leak.width * edge.length() * metres * difference;
    leak.place = solved.scene.toWorld(glm::vec3(middle));
    return leak;
}

} // namespace

Result<std::vector<LightLeak>> findLeaks(const SolvedElements& solved, const JobContext& job) {
    job.setActivity("looking for leaks");
    std::vector<LightLeak> leaks;
    if (Result<void> done = addDivided(solved, leaks, job); !done)
        return done.error();
    const std::vector<ElementEdge> edges = openEdges(solved.mesh, solved.scene);
    std::vector<std::optional<LightLeak>> gaps(edges.size());
    parallelFor(job, edges.size(), kLeakGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            gaps[i] = gapAt(solved, edges[i]);
    });
    if (job.cancelled())
        return bakeCancelled();
    for (const std::optional<LightLeak>& gap : gaps)
        if (gap)
            leaks.push_back(*gap);
    std::ranges::stable_sort(leaks, [](const LightLeak& a, const LightLeak& b) {
        return a.power != b.power ? a.power > b.power : a.element < b.element;
    });
    return leaks;
}

} // namespace patina
