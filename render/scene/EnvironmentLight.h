// The surroundings on the GPU: prefiltered radiance, DFG table, lat-long background, and the SH
// coefficients turned and scaled for the frame.
#pragma once

#include "core/document/Document.h"
#include "core/light/Ibl.h"
#include "render/gl/Texture.h"
#include "render/scene/Blocks.h"

#include <map>
#include <utility>

namespace patina::render {

class EnvironmentLight {
  public:
    explicit EnvironmentLight(gl::Context& context); // a grey sky until setIbl()

    void setIbl(const IblMaps& maps);
    // Terms of the specular lobe that the DFG table is for: 25 ms (GGX) to 130 ms of processor time
    // when they are new, nothing when they have been in use before.
    void setModel(const ShadingModel& model);
    // The picture behind the scene; null: grey.
    void setBackground(const ImagePtr& image);

    // Rotation, exposure and coefficients of the environment for this frame.
    void fill(const Environment& environment, FrameBlock& frame) const;

    // A CubeAtlas; its side and levels are in the frame's block.
    [[nodiscard]] const gl::Texture& prefiltered() const { return m_prefiltered; }
    [[nodiscard]] const gl::Texture& dfg() const { return *m_dfg; }
    [[nodiscard]] const gl::Texture& background() const { return m_background; }
    [[nodiscard]] std::size_t memoryBytes() const; // of the textures
    // Texels of the last setIbl() that exceeded 65504, the largest half float.
    [[nodiscard]] std::size_t clampedTexels() const { return m_clampedTexels; }

  private:
    gl::Context& m_context;
    gl::Texture m_prefiltered, m_background;
    // By D and V, 128 KiB each: switching models to and fro, as one does to compare, is free.
    std::map<std::pair<Distribution, Visibility>, gl::Texture> m_dfgTables;
    const gl::Texture* m_dfg = nullptr; // one of them
    ImagePtr m_backgroundImage;
    std::array<glm::vec3, 9> m_irradianceSh{};
    std::array<glm::vec3, kMaxTransferCount> m_radianceSh{};
    int m_prefilteredSide = 1, m_prefilteredLevels = 1;
    std::size_t m_clampedTexels = 0;
};

// Irradiance coefficients as FrameBlock has them, times its radianceScale: 16 bits relative to the
// largest.
void packIrradiance(const std::array<glm::vec3, 9>& coefficients, FrameBlock& frame);

// Light of the same radiance from everywhere, as setIbl() takes it.
[[nodiscard]] IblMaps uniformIbl(const glm::vec3& radiance);

} // namespace patina::render
