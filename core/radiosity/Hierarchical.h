// Hierarchical radiosity: light goes between clusters of elements, as coarse as each pair of them
// allows, and within each cluster up and down ("push and pull"). Hanrahan, Salzman & Aupperle 1991;
// clusters: Smits, Arvo & Greenberg 1994.
#pragma once

#include "core/base/Result.h"
#include "core/job/JobContext.h"
#include "core/radiosity/ClusterTree.h"
#include "core/radiosity/ElementMesh.h"
#include "core/radiosity/LinkRefinement.h"
#include "core/radiosity/Problem.h"
#include "core/radiosity/Solve.h"
#include "core/trace/RayScene.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace patina::radiosity {

struct HierarchySettings {
    // Share of the emitted power that a link may be expected to be wrong by. The
    // radiosities are then within 3 % of those of gathering, in the mean over the area.
    double linkError = 3e-7;
    int pairs = 8; // of points, that decide over two clusters, and over the visibility of elements
    std::uint32_t seed = 0;
    friend bool operator==(const HierarchySettings&, const HierarchySettings&) = default;
};

// What a solution was gathered over. Links refer to nodes of the tree, whose elements are those
// that were solved.
struct HierarchyLinks {
    std::shared_ptr<const ClusterTree> tree; // null before
    std::vector<Link> links;
};

// `settings.residual` and `.maxIterations` (sweeps over all links) end it; its solver is not looked
// at. The report's factorBytes are those of the links. Errors: InputBroken where nothing emits
// light; Cancelled. `kept` receives the links, and their tree unless it is there already, of
// the same elements and areas.
Result<Solved> solveHierarchical(const Problem& problem, const ElementMesh& elements,
                                 const RayScene& rays, const HierarchySettings& hierarchy,
                                 const SolveSettings& settings, const JobContext& job,
                                 const SolveObserver& observer = {},
                                 HierarchyLinks* kept = nullptr);

} // namespace patina::radiosity
