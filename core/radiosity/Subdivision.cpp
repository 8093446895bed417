#include "core/radiosity/Subdivision.h"

#include "core/job/Parallel.h"
#include "core/math/Sampling.h"
#include "core/radiosity/PolygonFactor.h"
#include "core/radiosity/Reconstruction.h"
#include "core/trace/BakeInputs.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <utility>

namespace patina::radiosity {
namespace {

// Of the first elements' area: smaller ones are not looked at more closely for their shape alone.
constexpr double kLeastSpanning = 1.0 / 16.0;
// Standard errors of the light at corners, of which the largest less the least of four is two in
// the mean, and of what linear interpolation is off by (bend() / 3), that count as noise.
constexpr double kNoiseOfGradient = 3.0, kNoiseOfOrder = 1.0;
constexpr std::size_t kLookedAtSenders = 16;
constexpr std::uint32_t kPairs = 16; // of points, between an element and a sender

// Elements that reach from one border of what is smooth to another, as the two halves of a
// square: with no vertex in between, nothing tells how light differs on them.
std::vector<bool> spanning(const LitMesh& mesh, std::size_t elements) {
    const auto lightOf = [&](std::uint32_t vertex) { return mesh.vertices[vertex].light; };
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges; // how many triangles have it
    const auto forEachEdge = [&](const auto& visit) {
        for (const LitMesh::Triangle& triangle : mesh.triangles)
            for (std::size_t c = 0; c < 3; ++c)
                visit(std::minmax(
                    {lightOf(triangle.vertices[c]), lightOf(triangle.vertices[(c + 1) % 3])}));
    };
    forEachEdge([&](const auto& edge) { ++edges[edge]; });
    std::vector<bool> atBorder(mesh.lights, false);
    for (const auto& [edge, triangles] : edges)
        if (triangles == 1)
            atBorder[edge.first] = atBorder[edge.second] = true;
    std::vector<bool> result(elements, true);
    for (const LitMesh::Triangle& triangle : mesh.triangles)
        for (const std::uint32_t vertex : triangle.vertices)
            if (!atBorder[lightOf(vertex)])
                result[triangle.element] = false;
    return result;
}

// Most less least of the light at each element's vertices, W/m².
std::vector<double> differences(const LitMesh& mesh, const ElementMesh& elements,
                                const std::vector<glm::dvec3>& irradiance) {
    const std::vector<glm::dvec3> light = vertexLight(mesh, elements, irradiance);
    struct Range {
        double least = std::numeric_limits<double>::infinity(), most = 0.0;
    };
    std::vector<Range> ranges(elements.size());
    for (const LitMesh::Triangle& triangle : mesh.triangles)
        for (const std::uint32_t v : triangle.vertices) {
            const double value = magnitude(light[mesh.vertices[v].light]);
            Range& range = ranges[triangle.element];
            range.least = std::min(range.least, value);
            range.most = std::max(range.most, value);
        }
    std::vector<double> result;
    for (const Range& range : ranges)
        result.push_back(range.most > range.least ? range.most - range.least : 0.0);
    return result;
}

// Of each element those that light runs on to, ascending.
std::vector<std::vector<std::uint32_t>> neighboursOf(const LitMesh& mesh, std::size_t elements) {
    const auto unique = [](std::vector<std::uint32_t>& list) {
        std::ranges::sort(list);
        list.erase(std::unique(list.begin(), list.end()), list.end());
    };
    std::vector<std::vector<std::uint32_t>> at(mesh.lights), result(elements);
    for (const LitMesh::Triangle& triangle : mesh.triangles)
        for (const std::uint32_t v : triangle.vertices)
            at[mesh.vertices[v].light].push_back(triangle.element);
    for (std::vector<std::uint32_t>& list : at) {
        unique(list);
        for (const std::uint32_t e : list)
            for (const std::uint32_t other : list)
                if (other != e)
                    result[e].push_back(other);
    }
    for (std::vector<std::uint32_t>& list : result)
        unique(list);
    return result;
}

// By how much an element's light differs from what its neighbours' would be there if it ran
// linearly: of a plane through them by least squares, each by its area.
glm::dvec3 bend(const ElementMesh& elements, std::uint32_t element,
                const std::vector<std::uint32_t>& neighbours,
                const std::vector<glm::dvec3>& irradiance) {
    const glm::dvec3 normal = elements.face(element).normal;
    glm::vec3 tangent, bitangent;
    orthonormalBasis(glm::vec3(normal), tangent, bitangent);
    const glm::dvec3 x(tangent), y(bitangent), here = elements.centre(element);
    const auto placeOf = [&](std::uint32_t e) {
        const glm::dvec3 way = elements.centre(e) - here;
        return glm::dvec2(glm::dot(way, x), glm::dot(way, y));
    };
    double weights = 0.0;
    glm::dvec2 place(0.0);
    glm::dvec3 light(0.0);
    for (const std::uint32_t e : neighbours) {
        const double w = elements.area(e) * double{elements.exposed(e)};
        weights += w;
        place += w * placeOf(e);
        light += w * irradiance[e];
    }
    if (!(weights > 0.0)) // alone
        return glm::dvec3(0.0);
    place /= weights;
    light /= weights;
    double xx = 0.0, xy = 0.0, yy = 0.0;
    glm::dvec3 lx(0.0), ly(0.0);
    for (const std::uint32_t e : neighbours) {
        const double w = elements.area(e) * double{elements.exposed(e)};
        const glm::dvec2 d = placeOf(e) - place;
        const glm::dvec3 l = irradiance[e] - light;
        xx += w * d.x * d.x;
        xy += w * d.x * d.y;
        yy += w * d.y * d.y;
        lx += w * d.x * l;
        ly += w * d.y * l;
    }
    // Of neighbours in one row the slope across it is taken as none.
    const double least = 1e-6 * (xx + yy);
    xx += least;
    yy += least;
    const double det = xx * yy - xy * xy;
    if (det > 0.0) {
        const glm::dvec3 slopeX = (yy * lx - xy * ly) / det, slopeY = (xx * ly - xy * lx) / det;
        light -= place.x * slopeX + place.y * slopeY;
    }
    return irradiance[element] - light;
}

// Of a bowl that is 1 in the middle of an element (nextOrder()); 1 for what is no norm.
double normOver(DivisionRule rule, double area) {
    return rule == DivisionRule::L1   ? 2.0 / 3.0 * area
           : rule == DivisionRule::L2 ? 0.70 * std::sqrt(area)
                                      : 1.0;
}

// A norm, over each element, of what the quadratic interpolation adds to the linear one, W/m² times
// the norm's power of m². Of light that bends as a bowl in a grid of squares of edge h, ½κ(x² +
// y²), linear interpolation is off by κh²/4 in the middle; bend() is three times that; the mean of
// its size is 2/3, the root of its mean square .70 of it.
std::vector<double> nextOrder(const LitMesh& mesh, const ElementMesh& elements,
                              const std::vector<glm::dvec3>& irradiance, DivisionRule rule,
                              const JobContext& job) {
    const auto neighbours = neighboursOf(mesh, elements.size());
    std::vector<double> result(elements.size());
    parallelFor(job, elements.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto e = static_cast<std::uint32_t>(i);
            const double most = magnitude(bend(elements, e, neighbours[e], irradiance)) / 3.0;
            result[e] = normOver(rule, elements.area(e)) * most;
        }
    });
    return result;
}

// Adds, of the elements that send most, what partlyHidden() finds of sources.
void addHiddenSenders(const TraceScene& scene, const ElementMesh& elements,
                      const std::vector<glm::dvec3>& radiosity, std::uint32_t seed,
                      const JobContext& job, std::vector<double>& hidden) {
    std::vector<std::pair<double, std::uint32_t>> senders; // power
    for (std::uint32_t e = 0; e < elements.size(); ++e)
        senders.emplace_back(-elements.area(e) * magnitude(radiosity[e]), e);
    std::ranges::sort(senders);
    senders.resize(std::min(senders.size(), kLookedAtSenders));
    parallelFor(job, elements.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end && !job.cancelled(); ++i) {
            const auto e = static_cast<std::uint32_t>(i);
            const glm::dvec3 normal = elements.face(e).normal;
            // Of all elements of a face together: each of them may be seen wholly or not at all.
            std::map<std::uint32_t, std::pair<double, double>> ofFaces; // seen, hidden
            for (const auto& [power, sender] : senders) {
                const double light =
                    magnitude(radiosity[sender]) *
                    pointToPolygon(elements.centre(e), normal, elements.polygon(sender));
                if (sender == e || !(light > 0.0))
                    continue;
                std::uint32_t seen = 0, pairs = 0;
                for (std::uint32_t k = 0; k < kPairs; ++k) {
                    const glm::vec4 u = sobolOwen4D(k, seedFor(seed ^ sender, e));
                    const glm::dvec3 from =
                        elements.samplePosition(e, {u.x, u.y}) + double{kRayOffset} * normal;
                    const glm::dvec3 way = elements.samplePosition(sender, {u.z, u.w}) +
                                           double{kRayOffset} * elements.face(sender).normal - from;
                    if (!(glm::dot(way, normal) > 0.0) ||
                        !(glm::dot(way, elements.face(sender).normal) < 0.0))
                        continue;
                    ++pairs;
                    const double distance = glm::length(way);
                    seen += scene.occluded(glm::vec3(from), glm::vec3(way / distance),
                                           static_cast<float>(distance - 0.5 * double{kRayOffset}))
                                ? 0
                                : 1;
                }
                if (pairs == 0)
                    continue;
                auto& [shown, rest] = ofFaces[elements.node(sender).face];
                shown += light * seen / pairs;
                rest += light * (pairs - seen) / pairs;
            }
            for (const auto& [face, light] : ofFaces)
                hidden[e] += std::min(light.first, light.second);
        }
    });
}

} // namespace

std::string_view name(DivisionRule rule) {
    switch (rule) {
    case DivisionRule::Gradient:
        return "gradient";
    case DivisionRule::Visibility:
        return "visibility";
    case DivisionRule::L1:
        return "l1";
    case DivisionRule::L2:
        return "l2";
    case DivisionRule::Linf:
        break;
    }
    return "linf";
}

Result<std::vector<std::uint32_t>> tooCoarse(const TraceScene& scene, const ElementMesh& elements,
                                             const SceneProblem& lit, const Solution& solution,
                                             const SceneProblemSettings& light,
                                             const DivisionSettings& settings,
                                             const JobContext& job) {
    const LitMesh mesh = litMesh(elements, *scene.geometry(), *scene.rays());
    std::vector<glm::dvec3> irradiance;
    double mean = 0.0, area = 0.0;
    for (std::uint32_t e = 0; e < elements.size(); ++e) {
        irradiance.push_back(lit.irradiance(solution, e));
        mean += lit.problem.areas[e] * magnitude(irradiance.back());
        area += lit.problem.areas[e];
    }
    mean /= area > 0.0 ? area : 1.0;

    std::vector<double> found;
    double unit = 1.0; // of what is found, by W/m²
    double ofNoise = 0.0;
    switch (settings.rule) {
    case DivisionRule::Gradient:
        found = differences(mesh, elements, irradiance);
        ofNoise = kNoiseOfGradient;
        break;
    case DivisionRule::Visibility: {
        auto hidden = partlyHidden(scene, elements, light, job);
        if (!hidden)
            return hidden.error();
        found = *std::move(hidden);
        addHiddenSenders(scene, elements, solution.radiosity, light.seed, job, found);
        break;
    }
    case DivisionRule::L1:
        unit = settings.firstArea;
        found = nextOrder(mesh, elements, irradiance, settings.rule, job);
        ofNoise = kNoiseOfOrder;
        break;
    case DivisionRule::L2:
        unit = std::sqrt(settings.firstArea);
        found = nextOrder(mesh, elements, irradiance, settings.rule, job);
        ofNoise = kNoiseOfOrder;
        break;
    case DivisionRule::Linf:
        found = nextOrder(mesh, elements, irradiance, settings.rule, job);
        ofNoise = kNoiseOfOrder;
        break;
    }
    if (job.cancelled())
        return bakeCancelled();

    std::vector<bool> unknown(elements.size(), false);
    if (settings.first)
        unknown = spanning(mesh, elements.size());
    std::vector<std::uint32_t> result;
    for (std::uint32_t e = 0; e < elements.size(); ++e) {
        const double allowed =
            settings.share * unit *
            (std::max(magnitude(irradiance[e]), mean) + magnitude(settings.ambient));
        const double noise =
            settings.noise.empty()
                ? 0.0
                : ofNoise * normOver(settings.rule, elements.area(e)) * settings.noise[e];
        const bool looked = unknown[e] && elements.area(e) >= kLeastSpanning * settings.firstArea;
        if (elements.exposed(e) > 0.0f && (looked || found[e] > allowed + noise))
            result.push_back(e);
    }
    return result;
}

} // namespace patina::radiosity
