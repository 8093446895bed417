#include "core/radiosity/ParaboloidFactors.h"

#include "core/math/Sampling.h"

#include <algorithm>
#include <array>
#include <bit>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <vector>

namespace patina::radiosity {
namespace {

// The item buffer of one point: of each texel the face that is nearest, and how near it is.
class ParaboloidItems {
  public:
    ParaboloidItems(const ParaboloidMap& map, const FaceItems& faces, const PointView& view,
                    std::span<std::uint32_t> items)
        : m_map(map)
        , m_faces(faces)
        , m_view(view)
        , m_fill(map)
        , m_items(items)
        , m_nearness(items.size(), 0.0f)
        , m_seed(0x9e3779b9u) {
        std::fill(items.begin(), items.end(), PointFactors::kOutside);
        for (const glm::vec3 eye(view.eye); const float c : {eye.x, eye.y, eye.z})
            m_seed = hash32(m_seed ^ std::bit_cast<std::uint32_t>(c));
    }

    void draw(std::uint32_t index) {
        const Face& face = m_faces.face(index);
        const FaceItems::Item& item = m_faces.item(index);
        const double distance = m_view.distanceTo(face);
        const bool front = distance < 0.0;
        if (index == m_view.ownFace || distance == 0.0 || (!front && item.hasOtherSide))
            return;
        std::array<glm::dvec3, 4> corners;
        bool above = false;
        for (std::size_t k = 0; k < face.cornerCount; ++k) {
            corners[k] = (face.corners[k] - m_view.eye) * m_view.frame; // by its transpose
            above = above || corners[k].z > 0.0;
        }
        if (!above)
            return;
        const glm::dvec3 plane = m_view.planeOf(face, distance);
        const std::uint32_t drawn = front ? index : PointFactors::kBack;
        for (const ParaboloidFill::Span& span :
             m_fill.cover({corners.data(), face.cornerCount}, front)) {
            const std::size_t row =
                static_cast<std::size_t>(span.row) * static_cast<std::size_t>(m_map.resolution());
            // How near the plane is, 1 / t along ParaboloidMap::direction(): along a row a
            // polynomial of x.
            const double y = m_map.centre(span.row);
            const double constant = 2.0 * plane.y * y + plane.z * (1.0 - y * y);
            for (int column = span.first; column < span.end; ++column) {
                const std::size_t texel = row + static_cast<std::size_t>(column);
                const double x = m_map.centre(column);
                const auto near = static_cast<float>(constant + x * (2.0 * plane.x - plane.z * x));
                const bool isNearer = near > m_nearness[texel];
                if (item.coverage == nullptr) { // without a branch on what is there
                    m_nearness[texel] = isNearer ? near : m_nearness[texel];
                    m_items[texel] = isNearer ? drawn : m_items[texel];
                } else if (isNearer && isSolid(index, texel, {x, y})) {
                    m_nearness[texel] = near;
                    m_items[texel] = drawn;
                }
            }
        }
    }

  private:
    [[nodiscard]] bool isSolid(std::uint32_t index, std::size_t texel, const glm::dvec2& at) const {
        const glm::dvec2 on = m_faces.seen(index, m_view).at(ParaboloidMap::direction(at));
        const std::uint32_t chance =
            hash32(m_seed ^ hash32(static_cast<std::uint32_t>(texel) ^ hash32(index)));
        return m_faces.item(index).coverage->solidAt(glm::vec2(uvOn(m_faces.face(index), on)),
                                                     detail::unitFloat(chance));
    }

    const ParaboloidMap& m_map;
    const FaceItems& m_faces;
    const PointView& m_view;
    ParaboloidFill m_fill;
    std::span<std::uint32_t> m_items;
    std::vector<float> m_nearness;
    std::uint32_t m_seed; // of what is blended
};

} // namespace

void ParaboloidFactors::look(std::uint32_t sender, const glm::vec3& from, const glm::mat3& frame,
                             std::span<std::uint32_t> seen) const {
    const PointView view(m_elements, sender, from, frame);
    ParaboloidItems items(m_map, m_faces, view, seen);
    for (std::uint32_t face = 0; face < m_faces.size(); ++face)
        items.draw(face);
    const auto columns = static_cast<std::size_t>(m_map.resolution());
    for (int row = 0; row < m_map.resolution(); ++row) {
        const double y = m_map.centre(row);
        m_faces.toElements(
            view, seen.subspan(static_cast<std::size_t>(row) * columns, columns),
            [&](std::size_t column) {
                return ParaboloidMap::direction({m_map.centre(static_cast<int>(column)), y});
            });
    }
}

} // namespace patina::radiosity
