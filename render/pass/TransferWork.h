// Elements under transfer, vertices or texels, that compute shaders light: in parts that views of
// buffers can hold.
#pragma once

#include "core/math/SphericalHarmonics.h"
#include "render/gl/BufferView.h"
#include "render/scene/TransferValues.h"

#include <algorithm>
#include <cstddef>
#include <epoxy/gl.h>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

namespace patina::render {

inline constexpr std::size_t kTransferGroup = 64; // local_size_x of relight.comp, nearlight.comp
inline constexpr int kVertexVectors = 3;          // of GpuMesh::vertices
inline constexpr int kTexelPlaceVectors = 2;      // of GpuScene::texelPlaces()

struct TransferWork {
    const gl::Buffer& elements; // coefficients; openSky: vertices
    int elementVectors = 0;
    const gl::Buffer* bounced = nullptr; // three times as many vectors; null: none
    std::size_t count = 0;
    int order = 0;
    bool openSky = false;
    glm::mat3 normalToWorld{1.0f};
    // Positions and normals, as in the mesh's vertices or TexelPlace.
    const gl::Buffer* places = nullptr;
    int placeVectors = 1;
    glm::mat4 placeToWorld{1.0f};
    const NearShareBuffers* nearShares = nullptr; // null: none

    [[nodiscard]] int vectors() const { return (shCount(order) + 3) / 4; }
};

// Bytes of `vectors` vec4 for each of so many elements.
[[nodiscard]] constexpr std::size_t elementBytes(std::size_t elements, int vectors) {
    return elements * static_cast<std::size_t>(vectors) * sizeof(glm::vec4);
}

// Shows parts of the work's buffers to a shader (units 0, 1, 2) and calls dispatch(first, count)
// for each, which sets what is left and runs.
class TransferParts {
  public:
    explicit TransferParts(gl::Context& context)
        : m_elements(context, "elements")
        , m_bounced(context, "bounced elements")
        , m_places(context, "places of elements") {}

    template <class Dispatch>
    void run(const TransferWork& work, Dispatch dispatch) {
        constexpr unsigned kElementsUnit = 0, kBouncedUnit = 1, kPlacesUnit = 2;
        constexpr std::size_t kMost = 1024 * 1024; // of a dispatch: no driver has too few groups
        // Whole groups keep the alignment of views.
        const int bounced = work.bounced ? 3 * work.vectors() : 0;
        const int widest = std::max({work.elementVectors, bounced, work.placeVectors});
        const std::size_t most = std::clamp(gl::BufferView::maxBytes() / elementBytes(1, widest) /
                                                kTransferGroup * kTransferGroup,
                                            kTransferGroup, kMost);
        for (std::size_t first = 0; first < work.count; first += most) {
            const std::size_t part = std::min(most, work.count - first);
            const auto show = [&](const gl::BufferView& view, const gl::Buffer& buffer, int each,
                                  unsigned unit) {
                view.show(buffer, elementBytes(first, each), elementBytes(part, each));
                view.bind(unit);
            };
            show(m_elements, work.elements, work.elementVectors, kElementsUnit);
            if (work.bounced)
                show(m_bounced, *work.bounced, bounced, kBouncedUnit);
            if (work.places)
                show(m_places, *work.places, work.placeVectors, kPlacesUnit);
            dispatch(static_cast<int>(first), static_cast<int>(part));
            glDispatchCompute(static_cast<GLuint>((part + kTransferGroup - 1) / kTransferGroup), 1,
                              1);
        }
    }

  private:
    gl::BufferView m_elements, m_bounced, m_places;
};

} // namespace patina::render
