#include "core/radiosity/FaceItems.h"

#include "core/material/Material.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

namespace patina::radiosity {
namespace {

// Of the longest edge: how far a quad may be from a parallelogram for its coordinates to be linear.
constexpr double kParallel = 1e-6;

} // namespace

PointView::PointView(const ElementMesh& elements, std::uint32_t sender, const glm::vec3& from,
                     const glm::mat3& axes)
    : ownFace(elements.sender(sender).face)
    , eye(from + kRayOffset * axes[2])
    , frame(axes) {}

FaceItems::Seen::Seen(const Face& face, const Item& item, const PointView& view)
    : m_face(face)
    , m_view(view)
    , m_isLinear(item.isLinear)
    , m_plane(view.planeOf(face, view.distanceTo(face))) {
    if (!m_isLinear)
        return;
    const glm::dvec3 eye = view.eye - face.corners[0];
    m_x = item.alongX * view.frame + glm::dot(item.alongX, eye) * m_plane;
    m_y = item.alongY * view.frame + glm::dot(item.alongY, eye) * m_plane;
}

glm::dvec2 FaceItems::Seen::at(const glm::dvec3& direction) const {
    const double nearness = glm::dot(m_plane, direction);
    if (m_isLinear)
        return glm::dvec2(glm::dot(m_x, direction), glm::dot(m_y, direction)) / nearness;
    return coordinatesOn(m_face, m_view.eye + m_view.frame * (direction / nearness));
}

FaceItems::FaceItems(const ElementMesh& elements)
    : m_elements(elements) {
    const std::vector<BakeGeometryMesh>& meshes = elements.geometry().meshes;
    m_coverages.resize(meshes.size());
    for (std::size_t m = 0; m < meshes.size(); ++m)
        if (meshes[m].surface.alphaMode != AlphaMode::Opaque)
            m_coverages[m] = std::make_unique<const Coverage>(meshes[m].surface);
    for (const Face& face : elements.faces()) {
        Item& item = m_items.emplace_back();
        item.hasOtherSide = elements.divides(face.mesh, face.triangles[0], !face.back);
        item.coverage = m_coverages[face.mesh].get();
        item.surface = item.coverage != nullptr ? &meshes[face.mesh].surface : nullptr;
        const std::array<glm::dvec3, 4>& c = face.corners;
        const glm::dvec3 x = c[1] - c[0], y = c[face.cornerCount - 1] - c[0];
        const double off = face.cornerCount == 3 ? 0.0 : glm::length(c[0] - c[1] + c[2] - c[3]);
        item.isLinear = off <= kParallel * std::max(glm::length(x), glm::length(y));
        const glm::dvec3 acrossX = glm::cross(y, face.normal), acrossY = glm::cross(face.normal, x);
        item.alongX = acrossX / glm::dot(acrossX, x);
        item.alongY = acrossY / glm::dot(acrossY, y);
    }
    std::vector<std::uint32_t> counts(m_items.size(), 0);
    for (std::uint32_t e = 0; e < elements.size(); ++e) {
        const std::uint32_t face = elements.node(e).face;
        m_items[face].onlyElement = counts[face]++ == 0 ? e : kNone;
    }
}

} // namespace patina::radiosity
