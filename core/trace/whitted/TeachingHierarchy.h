// A bounding volume hierarchy that counts what rays test, with boxes that can be looked at.
// Embree's own, which pictures are traced with, shows neither.
#pragma once

#include "core/job/JobContext.h"
#include "core/trace/BakeGeometry.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

namespace patina {

class TeachingHierarchy {
  public:
    struct Box {
        glm::vec3 low{std::numeric_limits<float>::infinity()};
        glm::vec3 high{-std::numeric_limits<float>::infinity()}; // scene units
    };
    struct Tests {
        std::uint64_t boxes = 0, triangles = 0;
    };

    // Over all triangles: axis-aligned boxes divided where the surface area heuristic is least
    // (MacDonald & Booth 1990) among kBins planes of the longest axis (Wald 2007), down to kLeaf
    // triangles. A job that is cancelled leaves it unfinished.
    static TeachingHierarchy build(const BakeGeometry& geometry, const JobContext& job);

    // What finding the first triangle before `distance` takes, nearer boxes first. Alpha is not
    // looked at.
    [[nodiscard]] Tests count(const glm::vec3& origin, const glm::vec3& direction,
                              float distance) const;
    [[nodiscard]] std::size_t triangleCount() const { return m_triangles.size(); } // without it
    [[nodiscard]] std::size_t boxCount() const { return m_nodes.size(); }
    [[nodiscard]] int levels() const { return m_levels; }
    // Those of a level, and the leaves above it; level 0 is the scene's.
    [[nodiscard]] std::vector<Box> boxes(int level) const;

    static constexpr int kBins = 16;
    static constexpr std::uint32_t kLeaf = 4; // triangles that are not divided

  private:
    struct Triangle {
        glm::vec3 a, ab, ac; // a corner and the sides from there
    };
    struct Node {
        Box box;
        std::uint32_t first = 0; // of its triangles, or of its two children
        std::uint32_t count = 0; // of triangles; 0: has children
        int level = 0;
    };

    std::vector<Triangle> m_triangles; // leaf by leaf
    std::vector<Node> m_nodes;
    int m_levels = 0;
};

} // namespace patina
