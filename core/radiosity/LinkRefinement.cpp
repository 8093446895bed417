#include "core/radiosity/LinkRefinement.h"

#include "core/job/Parallel.h"
#include "core/math/Sampling.h"
#include "core/radiosity/AnalyticFactors.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

namespace patina::radiosity {
namespace {

// Pairs whose rays are cast together, and pairs that are decided before the next ones are looked
// at: the last found first, so that few are ever waiting.
constexpr std::size_t kPairsPerBatch = 32, kPairsPerRound = 1 << 15;
// What two nodes could exchange at most, nothing between them, by what is allowed: above this they
// are divided without sampling points, none of which may happen to see anything.
constexpr double kMostPotential = 64.0;
// Below what is allowed nothing can go wrong: so few pairs of points will do.
constexpr int kFewPairs = 4;

} // namespace

// Some candidates on their way to a decision.
class LinkRefinement::Batch {
  public:
    Batch(const LinkRefinement& of, std::span<const float> brightness, double allowed)
        : m_of(of)
        , m_brightness(brightness)
        , m_allowed(allowed) {}

    void decide(std::span<Candidate> candidates) {
        m_samples.clear();
        m_rays.clear();
        for (std::size_t i = 0; i < candidates.size(); ++i)
            begin(candidates[i], i);
        m_of.m_rays.occlude(m_rays);
        for (std::size_t s = 0; s < m_samples.size();) {
            const std::size_t i = m_samples[s].candidate;
            double count = 0.0, sum = 0.0, squares = 0.0;
            for (; s < m_samples.size() && m_samples[s].candidate == i; ++s) {
                const Sample& sample = m_samples[s];
                const bool seen = sample.ray != kNone && !m_rays[sample.ray].occluded();
                const double value = seen ? sample.value : 0.0;
                count += 1.0;
                sum += value;
                squares += value * value;
            }
            const double mean = sum / count;
            end(candidates[i], mean, std::sqrt(std::max(0.0, squares / count - mean * mean)));
        }
    }

  private:
    struct Sample {
        std::size_t candidate;
        double value;      // cos cos' / (π r²), 1/m²
        std::uint32_t ray; // kNone: they face away from one another
    };
    struct Point {
        glm::dvec3 position, normal;
        bool buried;
    };
    using Node = ClusterTree::Node;

    [[nodiscard]] const Node& node(std::uint32_t index) const { return m_of.m_tree.nodes()[index]; }

    // What the two would be wrong by for a kernel that is wrong by 1/m².
    [[nodiscard]] double weight(const Pair& pair) const {
        return m_of.m_tree.area(node(pair.a)) * m_of.m_tree.area(node(pair.b)) *
               double{std::max(m_brightness[pair.a], m_brightness[pair.b])};
    }

    // Whether all of `other` lies behind the plane of `flat`.
    [[nodiscard]] bool isBehind(const Node& flat, const Node& other) const {
        if (flat.face == kNone)
            return false;
        const Face& face = m_of.m_elements.faces()[flat.face];
        const double height = glm::dot(face.normal, glm::dvec3(other.centre) - face.corners[0]);
        double reach = double{other.radius};
        if (other.face != kNone) { // a disc
            const double cosine = glm::dot(face.normal, m_of.m_elements.faces()[other.face].normal);
            reach *= std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
        }
        constexpr double kSamePlane = 1e-5; // scene units
        return height + reach <= kSamePlane;
    }

    void begin(Candidate& candidate, std::size_t index) {
        const Pair pair = candidate.pair;
        const Node &a = node(pair.a), &b = node(pair.b);
        if ((a.face != kNone && a.face == b.face) || isBehind(a, b) || isBehind(b, a) ||
            !(m_of.m_tree.area(a) > 0.0 && m_of.m_tree.area(b) > 0.0)) {
            candidate.decision = Decision::Unseen;
            return;
        }
        const double metres = m_of.m_elements.metresPerUnit();
        if (a.isElement() && b.isElement()) {
            const std::uint32_t first = m_of.m_tree.leaves()[a.firstLeaf],
                                second = m_of.m_tree.leaves()[b.firstLeaf];
            const double between = visibleExchange(
                m_of.m_elements, m_of.m_rays, {FactorMethod::Analytic, m_of.m_pairs, m_of.m_seed},
                first, {glm::dvec3(a.centre), double{a.radius}}, second,
                {glm::dvec3(b.centre), double{b.radius}});
            end(candidate, between * metres * metres / (m_of.m_tree.area(a) * m_of.m_tree.area(b)),
                0.0);
            return;
        }
        const double gap =
            (double{glm::length(b.centre - a.centre)} - double{a.radius} - double{b.radius}) *
            metres;
        const double potential =
            gap > 0.0 ? weight(pair) / (std::numbers::pi * gap * gap) : m_allowed * 1e30;
        if (potential > kMostPotential * m_allowed) {
            candidate.decision = Decision::Split;
            return;
        }
        addSamples(pair, index,
                   potential <= m_allowed ? std::min(kFewPairs, m_of.m_pairs) : m_of.m_pairs);
    }

    void end(Candidate& candidate, double kernel, double deviation) const {
        const bool elements =
            node(candidate.pair.a).isElement() && node(candidate.pair.b).isElement();
        if (!elements && deviation * weight(candidate.pair) > m_allowed) {
            candidate.decision = Decision::Split;
            return;
        }
        candidate.decision = kernel > 0.0 ? Decision::Link : Decision::Unseen;
        candidate.kernel = static_cast<float>(kernel);
        candidate.deviation = static_cast<float>(deviation);
    }

    Point pointOf(const Node& node, float u, float v, float w) const {
        const std::uint32_t element = m_of.m_tree.sampleElement(node, u);
        Point point;
        point.position = m_of.m_elements.samplePosition(element, {v, w});
        point.normal = m_of.m_elements.face(element).normal;
        point.buried = m_of.m_elements.isBuried(element, point.position, m_of.m_rays);
        return point;
    }

    void addSamples(const Pair& pair, std::size_t index, int count) {
        const Node &a = node(pair.a), &b = node(pair.b);
        const std::uint32_t seed = seedFor(seedFor(m_of.m_seed, pair.a), pair.b);
        const double metres = m_of.m_elements.metresPerUnit();
        for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(count); ++i) {
            const glm::vec4 u = sobolOwen4D(i, seed);
            const glm::vec2 within = sobolOwen2D(i, seedFor(seed, 1));
            const Point x = pointOf(a, within.x, u.x, u.y), y = pointOf(b, within.y, u.z, u.w);
            Sample sample{index, 0.0, kNone};
            const glm::dvec3 from = x.position + double{kRayOffset} * x.normal,
                             way = y.position + double{kRayOffset} * y.normal - from;
            const double length2 = glm::dot(way, way);
            const double cosX = glm::dot(x.normal, way), cosY = -glm::dot(y.normal, way);
            if (!x.buried && !y.buried && cosX > 0.0 && cosY > 0.0 && length2 > 0.0) {
                const double length = std::sqrt(length2);
                sample.value =
                    cosX * cosY / (std::numbers::pi * length2 * length2 * metres * metres);
                sample.ray = static_cast<std::uint32_t>(m_rays.size());
                OcclusionRay& ray = m_rays.emplace_back();
                ray.origin = glm::vec3(from);
                ray.direction = glm::vec3(way / length);
                ray.maxDistance =
                    static_cast<float>(std::max(0.0, length - 0.5 * double{kRayOffset}));
            }
            m_samples.push_back(sample);
        }
    }

    const LinkRefinement& m_of;
    std::span<const float> m_brightness;
    double m_allowed;
    std::vector<Sample> m_samples;
    std::vector<OcclusionRay> m_rays;
};

LinkRefinement::LinkRefinement(const ElementMesh& elements, const RayScene& rays,
                               const ClusterTree& tree, int pairs, std::uint32_t seed)
    : m_elements(elements)
    , m_rays(rays)
    , m_tree(tree)
    , m_pairs(pairs)
    , m_seed(seed) {}

double LinkRefinement::error(const Link& link, std::span<const float> brightness) const {
    return double{link.deviation} * m_tree.area(m_tree.nodes()[link.a]) *
           m_tree.area(m_tree.nodes()[link.b]) *
           double{std::max(brightness[link.a], brightness[link.b])};
}

void LinkRefinement::split(const Pair& pair, std::vector<Pair>& pending) const {
    const auto &a = m_tree.nodes()[pair.a], &b = m_tree.nodes()[pair.b];
    if (pair.a == pair.b) {
        for (std::uint32_t i = 0; i < a.childCount; ++i)
            for (std::uint32_t k = i; k < a.childCount; ++k)
                pending.push_back({a.firstChild + i, a.firstChild + k});
        return;
    }
    const bool first = !a.isElement() && (b.isElement() || a.radius >= b.radius);
    const auto& divided = first ? a : b;
    for (std::uint32_t i = 0; i < divided.childCount; ++i) {
        const std::uint32_t child = divided.firstChild + i;
        pending.push_back(first ? Pair{child, pair.b} : Pair{pair.a, child});
    }
}

void LinkRefinement::refinePairs(std::vector<Pair> pending, std::span<const float> brightness,
                                 double allowed, std::vector<Link>& links,
                                 const JobContext& job) const {
    std::vector<Candidate> candidates;
    while (!pending.empty() && !job.cancelled()) {
        const std::size_t count = std::min(pending.size(), kPairsPerRound);
        candidates.assign(count, {});
        for (std::size_t i = 0; i < count; ++i)
            candidates[i].pair = pending[pending.size() - count + i];
        pending.resize(pending.size() - count);
        const std::size_t batches = (count + kPairsPerBatch - 1) / kPairsPerBatch;
        parallelFor(job, batches, 1, [&](std::size_t begin, std::size_t end) {
            Batch batch(*this, brightness, allowed);
            for (std::size_t i = begin; i < end; ++i) {
                const std::size_t from = i * kPairsPerBatch;
                batch.decide(
                    std::span(candidates).subspan(from, std::min(kPairsPerBatch, count - from)));
            }
        });
        for (const Candidate& candidate : candidates) {
            if (candidate.decision == Decision::Split)
                split(candidate.pair, pending);
            else if (candidate.decision == Decision::Link)
                links.push_back(
                    {candidate.pair.a, candidate.pair.b, candidate.kernel, candidate.deviation});
        }
    }
}

void LinkRefinement::link(std::span<const float> brightness, double allowed,
                          std::vector<Link>& links, const JobContext& job) const {
    refinePairs({{ClusterTree::kRoot, ClusterTree::kRoot}}, brightness, allowed, links, job);
}

std::size_t LinkRefinement::refine(std::span<const float> brightness, double allowed,
                                   std::vector<Link>& links, const JobContext& job) const {
    std::vector<Pair> pending;
    std::size_t refined = 0;
    std::erase_if(links, [&](const Link& link) {
        if (error(link, brightness) <= allowed)
            return false;
        split({link.a, link.b}, pending);
        ++refined;
        return true;
    });
    refinePairs(std::move(pending), brightness, allowed, links, job);
    return refined;
}

} // namespace patina::radiosity
