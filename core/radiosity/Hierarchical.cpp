#include "core/radiosity/Hierarchical.h"

#include "core/job/Parallel.h"
#include "core/radiosity/ClusterTree.h"
#include "core/radiosity/LinkRefinement.h"
#include "core/trace/BakeInputs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <utility>
#include <vector>

namespace patina::radiosity {
namespace {

// Links are first refined for the light that is there before any bounce, for what is allowed times
// these, and for all of the light after each round of sweeps ("multigridding", 1991, section 4.3).
constexpr std::array kCoarseness{16.0, 4.0, 1.0, 1.0};
// Of the residual that sweeps end at, before the last round.
constexpr double kRoughly = 0.05;

float largestOf(const glm::vec3& v) {
    return std::max({v.x, v.y, v.z});
}

// The light of all nodes.
class ClusterLight {
  public:
    ClusterLight(const Problem& problem, const ClusterTree& tree)
        : m_problem(problem)
        , m_tree(tree)
        , m_radiosity(tree.nodes().size(), glm::vec3(0.0f))
        , m_irradiance(tree.nodes().size(), glm::vec3(0.0f))
        , m_brightness(tree.nodes().size(), 0.0f) {
        for (std::size_t i = 0; i < tree.nodes().size(); ++i)
            if (const auto& node = tree.nodes()[i]; node.isElement())
                m_radiosity[i] = glm::vec3(problem.emission[elementOf(node)]);
        pull();
    }

    // One bounce over all links, and within the tree. Σ A |change| by Σ A E: what B lacked of
    // being a solution. Of all elements `largest` has the largest change, W/m².
    double sweep(std::span<const Link> links, glm::dvec3& largest) {
        std::ranges::fill(m_irradiance, glm::vec3(0.0f));
        for (const Link& link : links) {
            const auto &a = m_tree.nodes()[link.a], &b = m_tree.nodes()[link.b];
            m_irradiance[link.a] +=
                link.kernel * static_cast<float>(m_tree.area(b)) * m_radiosity[link.b];
            if (link.a != link.b)
                m_irradiance[link.b] +=
                    link.kernel * static_cast<float>(m_tree.area(a)) * m_radiosity[link.a];
        }
        // Children stand after their parents.
        double change = 0.0;
        largest = glm::dvec3(0.0);
        for (std::size_t i = 0; i < m_tree.nodes().size(); ++i) {
            const auto& node = m_tree.nodes()[i];
            for (std::uint32_t k = 0; k < node.childCount; ++k)
                m_irradiance[node.firstChild + k] += m_irradiance[i];
            if (!node.isElement())
                continue;
            const std::uint32_t e = elementOf(node);
            const glm::vec3 radiosity(m_problem.emission[e] +
                                      m_problem.reflectance[e] * glm::dvec3(m_irradiance[i]));
            const glm::dvec3 difference = glm::abs(glm::dvec3(radiosity - m_radiosity[i]));
            change += m_problem.areas[e] * magnitude(difference);
            largest = glm::max(largest, difference);
            m_radiosity[i] = radiosity;
        }
        pull();
        const double emitted = emittedPower(m_problem);
        return emitted > 0.0 ? change / emitted : 0.0;
    }

    [[nodiscard]] std::span<const float> brightness() const { return m_brightness; }

    [[nodiscard]] Solution solution() const {
        Solution result;
        result.radiosity.resize(m_problem.size());
        result.irradiance.resize(m_problem.size());
        for (std::size_t i = 0; i < m_tree.nodes().size(); ++i)
            if (const auto& node = m_tree.nodes()[i]; node.isElement()) {
                result.radiosity[elementOf(node)] = glm::dvec3(m_radiosity[i]);
                result.irradiance[elementOf(node)] = glm::dvec3(m_irradiance[i]);
            }
        return result;
    }

    [[nodiscard]] std::size_t memoryBytes() const {
        return (m_radiosity.capacity() + m_irradiance.capacity()) * sizeof(glm::vec3) +
               m_brightness.capacity() * sizeof(float);
    }

  private:
    [[nodiscard]] std::uint32_t elementOf(const ClusterTree::Node& node) const {
        return m_tree.leaves()[node.firstLeaf];
    }

    // From the elements up: means by area, and of the brightest colour the root mean square.
    void pull() {
        for (std::size_t i = m_tree.nodes().size(); i-- > 0;) {
            const auto& node = m_tree.nodes()[i];
            if (node.isElement()) {
                m_brightness[i] = largestOf(m_radiosity[i]);
                continue;
            }
            glm::dvec3 sum(0.0);
            double squares = 0.0;
            for (std::uint32_t k = node.firstChild; k < node.firstChild + node.childCount; ++k) {
                const double area = m_tree.area(m_tree.nodes()[k]);
                sum += area * glm::dvec3(m_radiosity[k]);
                squares += area * double{m_brightness[k]} * double{m_brightness[k]};
            }
            const double area = m_tree.area(node);
            m_radiosity[i] = area > 0.0 ? glm::vec3(sum / area) : glm::vec3(0.0f);
            m_brightness[i] = area > 0.0 ? static_cast<float>(std::sqrt(squares / area)) : 0.0f;
        }
    }

    const Problem& m_problem;
    const ClusterTree& m_tree;
    std::vector<glm::vec3> m_radiosity, m_irradiance; // W/m²
    std::vector<float> m_brightness;
};

} // namespace

Result<Solved> solveHierarchical(const Problem& problem, const ElementMesh& elements,
                                 const RayScene& rays, const HierarchySettings& hierarchy,
                                 const SolveSettings& settings, const JobContext& job,
                                 const SolveObserver& observer, HierarchyLinks* kept) {
    const double emitted = emittedPower(problem);
    if (!(emitted > 0.0))
        return darkness(problem);
    job.setActivity("building clusters");
    const std::shared_ptr<const ClusterTree> shared =
        kept != nullptr && kept->tree
            ? kept->tree
            : std::make_shared<const ClusterTree>(elements, problem.areas);
    const ClusterTree& tree = *shared;
    ClusterLight light(problem, tree);
    const LinkRefinement refinement(elements, rays, tree, hierarchy.pairs, hierarchy.seed);
    std::vector<Link> links;
    SolveReport report;
    LinkReport& counts = report.links.emplace();
    counts.treeBytes = tree.memoryBytes() + light.memoryBytes();
    glm::dvec3 largest(0.0);
    bool goOn = true;
    for (std::size_t round = 0; round < kCoarseness.size() && goOn; ++round) {
        const JobContext part = job.part(static_cast<double>(round) / kCoarseness.size(),
                                         static_cast<double>(round + 1) / kCoarseness.size());
        part.setActivity(fmt::format("linking clusters, round {}", round + 1));
        const double allowed = kCoarseness[round] * hierarchy.linkError * emitted;
        if (round == 0) {
            refinement.link(light.brightness(), allowed, links, part);
            counts.first = links.size();
        } else if (refinement.refine(light.brightness(), allowed, links, part) == 0 &&
                   report.converged) {
            break;
        }
        if (job.cancelled())
            return bakeCancelled();
        part.setActivity("gathering light");
        const bool last = round + 1 == kCoarseness.size();
        const double wanted = kCoarseness[round] > 1.0 && !last
                                  ? std::max(kRoughly, settings.residual)
                                  : settings.residual;
        for (bool enough = false; goOn && !enough;) {
            report.residual = light.sweep(links, largest);
            ++report.iterations;
            report.history.push_back(report.residual);
            enough = report.residual <= wanted;
            report.converged = report.residual <= settings.residual;
            const bool spent =
                settings.maxIterations > 0 && report.iterations >= settings.maxIterations;
            const bool observed = !observer || observer(report.iterations, report.residual,
                                                        [&] { return light.solution(); });
            goOn = observed && !spent && !job.stopping();
            if (job.cancelled())
                return bakeCancelled();
        }
        part.setProgress(1.0);
    }
    report.factorBytes = links.capacity() * sizeof(Link);
    counts.last = links.size();
    if (kept != nullptr)
        *kept = {shared, std::move(links)};
    report.bound = unsolvedBound(problem, largest);
    Solution solution = light.solution();
    report.meanRadiosity = meanRadiosity(problem, solution.radiosity);
    return Solved{std::move(solution), std::move(report)};
}

} // namespace patina::radiosity
