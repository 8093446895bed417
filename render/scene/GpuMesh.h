// A mesh on the GPU: one buffer for the vertices, one for the indices.
#pragma once

#include "core/mesh/Mesh.h"
#include "render/gl/Buffer.h"
#include "render/gl/VertexArray.h"

namespace patina::render {

struct GpuMesh {
    gl::Buffer vertices, indices;
    gl::VertexArray array;
    int indexCount = 0;
    std::size_t vertexCount = 0;
    Bounds bounds;
};

// Attributes as in shaders/surface.vert: 0 position, 1 normal, 2 tangent, 3 uv.
[[nodiscard]] GpuMesh makeGpuMesh(gl::Context& context, const Mesh& mesh);

} // namespace patina::render
