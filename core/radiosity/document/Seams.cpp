#include "core/job/Parallel.h"
#include "core/radiosity/ElementSides.h"
#include "core/radiosity/document/ElementEdges.h"
#include "core/radiosity/document/LeaksAndSeams.h"
#include "core/trace/BakeInputs.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace patina {

using namespace radiosity;

namespace {

constexpr double kNearShare = 0.05; // of an element's size: how far away another edge may be
constexpr double kLeastNear = 2e-4; // and at least, scene units
constexpr double kSameWay = 0.94;   // cosine between normals of one smooth surface: 20°
constexpr double kMeeting = 1e-5;   // scene units: edges that are nearer meet
constexpr std::size_t kSeamGrain = 64;

class SeamSearch {
  public:
    SeamSearch(const SolvedElements& solved, const JobContext& job)
        : m_solved(solved)
        , m_triangles(solved.elements.size()) {
        std::vector<glm::dvec3> irradiance;
        for (std::uint32_t e = 0; e < solved.elements.size(); ++e)
            irradiance.push_back(solved.lit.irradiance(solved.solution, e));
        if (!job.cancelled())
            m_light = vertexLight(solved.mesh, solved.elements, irradiance);
        for (std::uint32_t t = 0; t < solved.mesh.triangles.size(); ++t)
            m_triangles[solved.mesh.triangles[t].element].push_back(t);
    }

    [[nodiscard]] std::optional<LightSeam> at(const ElementEdge& edge) const {
        const ElementMesh& elements = m_solved.elements;
        const Face& face = elements.face(edge.element);
        const double size = std::sqrt(elements.area(edge.element)) / elements.metresPerUnit();
        const double nearby = std::max(kNearShare * size, kLeastNear);
        // Down onto what lies beyond the edge.
        const glm::dvec3 beyond = edge.middle() + nearby * edge.outward;
        const ClosestRay ray = m_solved.scene.closest(glm::vec3(beyond + nearby * face.normal),
                                                      glm::vec3(-face.normal));
        if (ray.mesh == ClosestRay::kNothing ||
            !(std::abs(double{ray.ray.maxDistance} - nearby) < nearby))
            return std::nullopt;
        const std::uint32_t other = elements.met(ray);
        if (other == kNone || other == edge.element)
            return std::nullopt;
        const Face& otherFace = elements.face(other);
        const TraceScene& scene = m_solved.scene;
        // What stands between them parts them by right.
        if (face.fenced && isWallBetween(elements, edge.element, other, *scene.rays()))
            return std::nullopt;
        if (glm::dot(face.normal, otherFace.normal) < kSameWay ||
            scene.materialOf(face.mesh) != scene.materialOf(otherFace.mesh))
            return std::nullopt;
        const auto beside = nearestOn(other, edge.middle());
        if (!beside || !(beside->distance < nearby))
            return std::nullopt;
        const glm::dvec3 here = 0.5 * (m_light[edge.lights[0]] + m_light[edge.lights[1]]);
        const double first = magnitude(m_solved.lit.problem.reflectance[edge.element] * here),
                     second = magnitude(m_solved.lit.problem.reflectance[other] * beside->light);
        LightSeam seam;
        seam.jump = std::abs(first - second);
        seam.share = seam.jump / std::max({first, second, 1e-300});
        if (!(seam.share >= kLeastJump))
            return std::nullopt;
        seam.element = edge.element;
        seam.other = other;
        seam.width =
            beside->distance > kMeeting ? beside->distance * elements.metresPerUnit() : 0.0;
        seam.length = edge.length() * elements.metresPerUnit();
        seam.sameMesh = face.mesh == otherFace.mesh;
        seam.place = scene.toWorld(glm::vec3(edge.middle()));
        return seam;
    }

  private:
    struct Nearest {
        double distance = 0.0; // scene units
        glm::dvec3 light{0.0}; // interpolated there, W/m²
    };

    // On the edges of an element's triangles, and so on its own.
    [[nodiscard]] std::optional<Nearest> nearestOn(std::uint32_t element,
                                                   const glm::dvec3& point) const {
        std::optional<Nearest> best;
        for (const std::uint32_t t : m_triangles[element])
            for (std::size_t k = 0; k < 3; ++k) {
                const LitMesh::Triangle& triangle = m_solved.mesh.triangles[t];
                const LitMesh::Vertex &a = m_solved.mesh.vertices[triangle.vertices[k]],
                                      &b = m_solved.mesh.vertices[triangle.vertices[(k + 1) % 3]];
                const glm::dvec3 from(m_solved.scene.toScene(glm::dvec3(a.position))),
                    to(m_solved.scene.toScene(glm::dvec3(b.position)));
                const glm::dvec3 along = to - from;
                const double length2 = glm::dot(along, along);
                const double at =
                    length2 > 0.0 ? std::clamp(glm::dot(point - from, along) / length2, 0.0, 1.0)
                                  : 0.0;
                const double distance = glm::length(from + at * along - point);
                if (!best || distance < best->distance)
                    best = Nearest{distance, (1.0 - at) * m_light[a.light] + at * m_light[b.light]};
            }
        return best;
    }

    const SolvedElements& m_solved;
    std::vector<glm::dvec3> m_light;                     // by LitMesh::Vertex::light, W/m²
    std::vector<std::vector<std::uint32_t>> m_triangles; // of each element
};

} // namespace

Result<std::vector<LightSeam>> findSeams(const SolvedElements& solved, const JobContext& job) {
    job.setActivity("looking for seams");
    const SeamSearch search(solved, job);
    if (job.cancelled())
        return bakeCancelled();
    const std::vector<ElementEdge> edges = openEdges(solved.mesh, solved.scene);
    std::vector<std::optional<LightSeam>> found(edges.size());
    parallelFor(job, edges.size(), kSeamGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            found[i] = search.at(edges[i]);
    });
    if (job.cancelled())
        return bakeCancelled();
    // Each side finds the other; the larger jump is kept.
    std::map<std::pair<std::uint32_t, std::uint32_t>, LightSeam> pairs;
    for (const std::optional<LightSeam>& seam : found) {
        if (!seam)
            continue;
        const auto key = std::minmax(seam->element, seam->other);
        const auto [kept, added] = pairs.try_emplace({key.first, key.second}, *seam);
        if (!added && seam->jump > kept->second.jump)
            kept->second = *seam;
    }
    std::vector<LightSeam> seams;
    for (const auto& [key, seam] : pairs)
        seams.push_back(seam);
    std::ranges::stable_sort(seams, [](const LightSeam& a, const LightSeam& b) {
        return a.jump != b.jump ? a.jump > b.jump : a.element < b.element;
    });
    return seams;
}

Result<LeaksAndSeams> findLeaksAndSeams(const LiveRadiosity& live, const JobContext& job) {
    // The lights of live.scene have a power of 1.
    const auto scene = TraceScene::build(live.inputs, job, live.scene.get());
    if (!scene)
        return scene.error();
    const SolvedElements solved{*scene,
                                live.elements(),
                                live.shape->mesh,
                                live.lit,
                                live.solution,
                                live.settings.lightSamples,
                                live.settings.factors.seed};
    auto leaks = findLeaks(solved, job.part(0.0, 0.7));
    if (!leaks)
        return leaks.error();
    auto seams = findSeams(solved, job.part(0.7, 1.0));
    if (!seams)
        return seams.error();
    return LeaksAndSeams{*std::move(leaks), *std::move(seams)};
}

} // namespace patina
