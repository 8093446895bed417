// Elements in a hierarchy of clusters: faces within clusters of faces, parts of a face within it.
// A cluster stands for all of its elements when light goes far. Smits, Arvo & Greenberg 1994,
// "A Clustering Algorithm for Radiosity in Complex Environments".
#pragma once

#include "core/radiosity/ElementMesh.h"
#include "core/radiosity/Problem.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace patina::radiosity {

class ClusterTree {
  public:
    struct Node {
        glm::vec3 centre{0.0f}; // of a sphere about it, scene units
        float radius = 0.0f;
        std::uint32_t firstLeaf = 0, leafCount = 0; // its elements, of leaves()
        std::uint32_t firstChild = kNone;           // kNone: it is an element
        std::uint32_t face = kNone;                 // that all of it is of; kNone: of several
        std::uint32_t childCount = 0;               // side by side; at most kMostChildren
        [[nodiscard]] bool isElement() const { return firstChild == kNone; }
    };
    static constexpr std::uint32_t kRoot = 0;
    static constexpr std::uint32_t kMostChildren = 4;

    // `areas`: Problem::areas of the elements, m². `elements` must outlive it.
    ClusterTree(const ElementMesh& elements, std::span<const double> areas);

    // Children stand after their parents, and side by side.
    [[nodiscard]] const std::vector<Node>& nodes() const { return m_nodes; }
    // Elements in the tree's order.
    [[nodiscard]] const std::vector<std::uint32_t>& leaves() const { return m_leaves; }
    [[nodiscard]] double area(const Node& node) const { // m²
        return m_areasBefore[node.firstLeaf + node.leafCount] - m_areasBefore[node.firstLeaf];
    }
    // An element of a node, as likely as its area says; `u` even in 0…1, and even again within the
    // element afterwards.
    [[nodiscard]] std::uint32_t sampleElement(const Node& node, float& u) const;

    [[nodiscard]] std::size_t memoryBytes() const;

  private:
    struct FaceItem {
        glm::vec3 centre;
        std::uint32_t face, first, count; // of elements sorted by face
    };
    // Both fill in a node and all below it; elements and faces are in any order before.
    void addFaces(std::uint32_t node, std::span<FaceItem> faces,
                  std::span<const std::uint32_t> elementsByFace);
    void addElements(std::uint32_t node, std::uint32_t first, std::uint32_t count,
                     std::uint32_t face);
    // The first of so many new nodes.
    std::uint32_t addChildren(std::uint32_t node, std::size_t count);
    void enclose();

    const ElementMesh& m_elements;
    std::vector<glm::vec3> m_centres; // of elements, while it is made
    std::vector<Node> m_nodes;
    std::vector<std::uint32_t> m_leaves;
    std::vector<double> m_areasBefore; // of the leaves before each, and of all
};

} // namespace patina::radiosity
