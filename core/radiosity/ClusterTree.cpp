#include "core/radiosity/ClusterTree.h"

#include "core/radiosity/AnalyticFactors.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

namespace patina::radiosity {
namespace {

struct Extent {
    glm::vec3 low{std::numeric_limits<float>::infinity()};
    glm::vec3 high{-std::numeric_limits<float>::infinity()};
    void add(const glm::vec3& point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    [[nodiscard]] glm::length_t longestAxis() const {
        const glm::vec3 size = high - low;
        return size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    }
};

// Sorts items along the longest extent of their centres, and each half again along its own: up to
// four groups, none of them empty. `centreOf`, `indexOf`: of an item; the latter breaks ties.
template <class Item, class CentreOf, class IndexOf>
std::vector<std::span<Item>> groupsOf(std::span<Item> items, const CentreOf& centreOf,
                                      const IndexOf& indexOf) {
    const auto sorted = [&](std::span<Item> part) {
        Extent extent;
        for (const Item& item : part)
            extent.add(centreOf(item));
        const glm::length_t axis = extent.longestAxis();
        std::ranges::sort(part, [&](const Item& a, const Item& b) {
            const float here = centreOf(a)[axis], there = centreOf(b)[axis];
            return here != there ? here < there : indexOf(a) < indexOf(b);
        });
    };
    sorted(items);
    std::vector<std::span<Item>> groups;
    const std::size_t half = items.size() / 2;
    for (const std::span<Item> part : {items.first(half), items.subspan(half)}) {
        sorted(part);
        const std::size_t quarter = part.size() / 2;
        for (const std::span<Item> group : {part.first(quarter), part.subspan(quarter)})
            if (!group.empty())
                groups.push_back(group);
    }
    return groups;
}

} // namespace

ClusterTree::ClusterTree(const ElementMesh& elements, std::span<const double> areas)
    : m_elements(elements) {
    std::vector<std::uint32_t> byFace(elements.size());
    std::iota(byFace.begin(), byFace.end(), 0u);
    std::ranges::stable_sort(byFace, {}, [&](std::uint32_t e) { return elements.node(e).face; });
    m_centres.resize(elements.size());
    std::vector<FaceItem> faces;
    for (std::uint32_t i = 0; i < byFace.size(); ++i) {
        const std::uint32_t face = elements.node(byFace[i]).face;
        m_centres[byFace[i]] = glm::vec3(elements.centre(byFace[i]));
        if (faces.empty() || faces.back().face != face) {
            const Face& of = elements.faces()[face];
            glm::dvec3 sum(0.0);
            for (std::size_t k = 0; k < of.cornerCount; ++k)
                sum += of.corners[k];
            faces.push_back({glm::vec3(sum / static_cast<double>(of.cornerCount)), face, i, 0});
        }
        ++faces.back().count;
    }
    m_leaves.reserve(elements.size());
    m_nodes.emplace_back();
    addFaces(kRoot, faces, byFace);
    m_nodes.shrink_to_fit();
    std::vector<glm::vec3>().swap(m_centres);
    m_areasBefore.reserve(elements.size() + 1);
    m_areasBefore.push_back(0.0);
    for (const std::uint32_t e : m_leaves)
        m_areasBefore.push_back(m_areasBefore.back() + areas[e]);
    enclose();
}

std::uint32_t ClusterTree::addChildren(std::uint32_t node, std::size_t count) {
    const auto first = static_cast<std::uint32_t>(m_nodes.size());
    m_nodes.resize(m_nodes.size() + count);
    m_nodes[node].firstChild = first;
    m_nodes[node].childCount = static_cast<std::uint32_t>(count);
    return first;
}

void ClusterTree::addFaces(std::uint32_t node, std::span<FaceItem> faces,
                           std::span<const std::uint32_t> elementsByFace) {
    const auto first = static_cast<std::uint32_t>(m_leaves.size());
    if (faces.size() == 1) {
        const auto elements = elementsByFace.subspan(faces[0].first, faces[0].count);
        m_leaves.insert(m_leaves.end(), elements.begin(), elements.end());
        addElements(node, first, faces[0].count, faces[0].face);
        return;
    }
    const auto groups = groupsOf(
        faces, [](const FaceItem& item) { return item.centre; },
        [](const FaceItem& item) { return item.face; });
    const std::uint32_t child = addChildren(node, groups.size());
    for (std::uint32_t k = 0; k < groups.size(); ++k)
        addFaces(child + k, groups[k], elementsByFace);
    m_nodes[node].firstLeaf = first;
    m_nodes[node].leafCount = static_cast<std::uint32_t>(m_leaves.size()) - first;
}

void ClusterTree::addElements(std::uint32_t node, std::uint32_t first, std::uint32_t count,
                              std::uint32_t face) {
    m_nodes[node].firstLeaf = first;
    m_nodes[node].leafCount = count;
    m_nodes[node].face = face;
    if (count == 1)
        return;
    const auto groups = groupsOf(
        std::span(m_leaves).subspan(first, count), [this](std::uint32_t e) { return m_centres[e]; },
        [](std::uint32_t e) { return e; });
    const std::uint32_t child = addChildren(node, groups.size());
    for (std::uint32_t k = 0; k < groups.size(); ++k) {
        const auto size = static_cast<std::uint32_t>(groups[k].size());
        addElements(child + k, first, size, face);
        first += size;
    }
}

void ClusterTree::enclose() {
    for (std::size_t i = m_nodes.size(); i-- > 0;) {
        Node& node = m_nodes[i];
        if (node.isElement()) {
            const ElementSphere sphere = sphereOf(m_elements, m_leaves[node.firstLeaf]);
            node.centre = glm::vec3(sphere.centre);
            node.radius = static_cast<float>(sphere.radius);
            continue;
        }
        const std::span<const Node> children(m_nodes.data() + node.firstChild, node.childCount);
        Extent extent;
        for (const Node& child : children) {
            extent.add(child.centre - child.radius);
            extent.add(child.centre + child.radius);
        }
        node.centre = 0.5f * (extent.low + extent.high);
        for (const Node& child : children)
            node.radius =
                std::max(node.radius, glm::length(child.centre - node.centre) + child.radius);
    }
}

std::uint32_t ClusterTree::sampleElement(const Node& node, float& u) const {
    const auto begin = m_areasBefore.begin() + node.firstLeaf;
    const double wanted = *begin + double{u} * area(node);
    const auto above = std::upper_bound(begin + 1, begin + node.leafCount, wanted);
    const auto leaf = static_cast<std::size_t>(above - m_areasBefore.begin()) - 1;
    const double size = m_areasBefore[leaf + 1] - m_areasBefore[leaf];
    u = size > 0.0 ? static_cast<float>(std::clamp((wanted - m_areasBefore[leaf]) / size, 0.0, 1.0))
                   : 0.5f;
    return m_leaves[leaf];
}

std::size_t ClusterTree::memoryBytes() const {
    return m_nodes.capacity() * sizeof(Node) + m_leaves.capacity() * sizeof(std::uint32_t) +
           m_areasBefore.capacity() * sizeof(double);
}

} // namespace patina::radiosity
