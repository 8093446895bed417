// What item buffers of a scene show: its faces, seen from a point, and which element of a face a
// direction meets. Faces are drawn instead of their elements, whose corners agree to single
// precision only: between those a texel could see through.
#pragma once

#include "core/radiosity/ElementMesh.h"
#include "core/trace/BakeSurface.h"

#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

namespace patina::radiosity {

// A point above an element or a patch, and the axes of a map of what it sees.
struct PointView {
    std::uint32_t ownFace = kNone; // of the sender: never seen
    glm::dvec3 eye{0.0};           // scene units
    glm::dmat3 frame{1.0};         // z: the sender's normal

    // `from` on a sender; the eye is kRayOffset above it, as rays start.
    PointView(const ElementMesh& elements, std::uint32_t sender, const glm::vec3& from,
              const glm::mat3& axes);

    // Of the plane of a face, along its normal: < 0 where the eye is in front of it.
    [[nodiscard]] double distanceTo(const Face& face) const {
        return glm::dot(face.normal, face.corners[0] - eye);
    }
    // p · direction, for a direction in the map's axes, is 1 / t where eye + t · direction is on
    // the face's plane, at `distance`, not 0.
    [[nodiscard]] glm::dvec3 planeOf(const Face& face, double distance) const {
        return face.normal * frame / distance; // by the transpose of the frame
    }
};

class FaceItems {
  public:
    struct Item {
        std::uint32_t onlyElement = kNone; // of a face that is not divided
        // It is a face of its own, which is drawn where this one is seen from behind. Else backs
        // only absorb.
        bool hasOtherSide = false;
        // Of a face that is not solid everywhere; both or none.
        const Coverage* coverage = nullptr;
        const BakeSurface* surface = nullptr;
        // Of triangles and parallelograms, whose coordinates are linear: their gradients.
        bool isLinear = false;
        glm::dvec3 alongX{0.0}, alongY{0.0};
    };
    // Where directions from a point meet a face.
    class Seen {
      public:
        // The point is not in the face's plane.
        Seen(const Face& face, const Item& item, const PointView& view);
        // Coordinates on the face; `direction` in the view's axes, of any length.
        [[nodiscard]] glm::dvec2 at(const glm::dvec3& direction) const;

      private:
        const Face& m_face;
        const PointView& m_view;
        bool m_isLinear;
        glm::dvec3 m_plane;
        glm::dvec3 m_x{0.0}, m_y{0.0}; // linear coordinates times p · direction, likewise
    };

    // `elements` must outlive it, and not be divided meanwhile.
    explicit FaceItems(const ElementMesh& elements);

    [[nodiscard]] std::size_t size() const { return m_items.size(); }
    [[nodiscard]] const Face& face(std::uint32_t index) const { return m_elements.faces()[index]; }
    [[nodiscard]] const Item& item(std::uint32_t index) const { return m_items[index]; }
    [[nodiscard]] Seen seen(std::uint32_t index, const PointView& view) const {
        return {face(index), item(index), view};
    }
    // Replaces each face of `items` by its element; what is no face's number stays.
    // `directionOf(i)`: of items[i], as Seen::at() takes it.
    template <class DirectionOf>
    void toElements(const PointView& view, std::span<std::uint32_t> items,
                    const DirectionOf& directionOf) const {
        for (std::size_t i = 0; i < items.size();) {
            const std::uint32_t index = items[i];
            std::size_t end = i + 1; // neighbours mostly show the same face
            while (end < items.size() && items[end] == index)
                ++end;
            if (index < size() && item(index).onlyElement != kNone) {
                for (; i < end; ++i)
                    items[i] = item(index).onlyElement;
            } else if (index < size()) {
                const Seen on = seen(index, view);
                for (; i < end; ++i)
                    items[i] = m_elements.elementAt(index, on.at(directionOf(i)));
            }
            i = end;
        }
    }

  private:
    const ElementMesh& m_elements;
    std::vector<Item> m_items;                                // of each face
    std::vector<std::unique_ptr<const Coverage>> m_coverages; // of some meshes
};

} // namespace patina::radiosity
