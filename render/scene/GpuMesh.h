// A mesh on the GPU: one buffer for the vertices, one for the indices.
#pragma once

#include "core/mesh/Mesh.h"
#include "render/gl/Buffer.h"
#include "render/gl/VertexArray.h"

#include <vector>

namespace patina::render {

struct GpuMesh {
    gl::Buffer vertices, indices;
    gl::VertexArray array;
    int indexCount = 0;
    // Fewer triangles for small pictures, after the others in the buffer, finest first; none: the
    // mesh is simple enough as it is.
    struct Coarse {
        int first = 0, count = 0; // indices
        float cell = 0.0f;        // no vertex is farther away than this cube's diagonal
    };
    std::vector<Coarse> coarse;
    std::size_t vertexCount = 0;
    Bounds bounds;
    // Of each lot of so many triangles, in the order of the buffer.
    static constexpr int kLot = 1024;
    std::vector<Bounds> lots;
};

// Attributes as in shaders/surface.vert: 0 position, 1 normal, 2 tangent, 3 uv. `reduced`: with
// coarse triangles, where there are many, which takes a while.
[[nodiscard]] GpuMesh makeGpuMesh(gl::Context& context, const Mesh& mesh, bool reduced = true);

} // namespace patina::render
