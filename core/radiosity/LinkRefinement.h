// Links: pairs of clusters of which each stands for all of its elements as far as the other is
// concerned, refined where that would be too wrong. Hanrahan, Salzman & Aupperle 1991, "A Rapid
// Hierarchical Radiosity Algorithm"; weighted by brightness as there ("BF refinement").
#pragma once

#include "core/job/JobContext.h"
#include "core/radiosity/ClusterTree.h"
#include "core/radiosity/FormFactors.h"
#include "core/trace/RayScene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace patina::radiosity {

// Of two nodes, or of a node and itself. Light goes both ways.
struct Link {
    std::uint32_t a = 0, b = 0;
    // Mean and standard deviation of cos cos' V / (π r²) over pairs of points, 1/m²: times b's area
    // the form factor from a to b. Of two elements the mean is exact but for V.
    float kernel = 0.0f, deviation = 0.0f;
};

class LinkRefinement {
  public:
    // All must outlive it. `pairs`: of points, of each two nodes.
    LinkRefinement(const ElementMesh& elements, const RayScene& rays, const ClusterTree& tree,
                   int pairs, std::uint32_t seed);

    // Of the root with itself, refined.
    void link(std::span<const float> brightness, double allowed, std::vector<Link>& links,
              const JobContext& job) const;
    // Replaces links that are too wrong by finer ones. How many were.
    std::size_t refine(std::span<const float> brightness, double allowed, std::vector<Link>& links,
                       const JobContext& job) const;
    // Power that a link is expected to be wrong by, W. `brightness`: of each node, root mean square
    // of its radiosities, W/m².
    [[nodiscard]] double error(const Link& link, std::span<const float> brightness) const;

  private:
    struct Pair {
        std::uint32_t a, b;
    };
    enum class Decision : std::uint8_t { Unseen, Link, Split };
    struct Candidate {
        Pair pair{};
        Decision decision = Decision::Unseen;
        float kernel = 0.0f, deviation = 0.0f;
    };
    class Batch;

    void refinePairs(std::vector<Pair> pending, std::span<const float> brightness, double allowed,
                     std::vector<Link>& links, const JobContext& job) const;
    void split(const Pair& pair, std::vector<Pair>& pending) const;

    const ElementMesh& m_elements;
    const RayScene& m_rays;
    const ClusterTree& m_tree;
    int m_pairs;
    std::uint32_t m_seed;
};

} // namespace patina::radiosity
