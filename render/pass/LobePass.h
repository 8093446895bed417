// Draws a lobe over the displayed picture, translucent, and faint where the scene hides it.
#pragma once

#include "render/gl/Buffer.h"
#include "render/gl/VertexArray.h"
#include "render/pass/ScreenPasses.h"
#include "render/scene/SurfaceLobe.h"
#include "render/shader/ShaderLibrary.h"

namespace patina::render {

class LobePass {
  public:
    LobePass(gl::Context& context, ShaderLibrary& shaders)
        : m_context(context)
        , m_shaders(shaders) {}

    // Onto `canvas`, hidden by the depth of targets, which may have fewer pixels. `reach`: metres
    // to the lobe's peak. The frame's block is bound.
    Result<void> draw(const Canvas& canvas, const Targets& targets, const SurfaceLobe& lobe,
                      const glm::vec3& cameraPosition, float reach);

  private:
    void upload(const LobeMesh& mesh);
    // Triangles from the farthest to the nearest: each shines through those before it.
    void sort(const SurfaceLobe& lobe, const glm::vec3& toCamera);

    gl::Context& m_context;
    ShaderLibrary& m_shaders;
    std::shared_ptr<const LobeMesh> m_mesh; // that the buffers hold
    gl::Buffer m_vertices, m_indices;
    gl::VertexArray m_array;
    std::vector<std::pair<float, std::uint32_t>> m_order; // distance, first index
    std::vector<std::uint32_t> m_sorted;
};

} // namespace patina::render
