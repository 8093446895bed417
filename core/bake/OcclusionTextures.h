// Ambient occlusion per texel of scenes whose textures do not fit into memory together: a few at a
// time, each as bakeAoTexel() makes it, to the bit.
#pragma once

#include "core/bake/transfer/Passes.h"
#include "core/trace/BakeScene.h"

#include <vector>

namespace patina {

class OcclusionTextures {
  public:
    // Errors: those of bakeAoTexel() that do not depend on a texture.
    static Result<OcclusionTextures> prepare(const BakeInputs& inputs, const AoSettings& settings,
                                             const JobContext& job);

    [[nodiscard]] std::size_t count() const { return m_materials.size(); } // of all textures
    [[nodiscard]] std::size_t done() const { return m_next; }
    // The next `count` of them, or those that are left. Errors: those of bakeAoTexel().
    Result<BakeArtifact> bakeNext(std::size_t count, const JobContext& job);

  private:
    OcclusionTextures(BakeScene scene, const AoSettings& settings, const PassSettings& passes,
                      const BakeInputs& inputs);

    BakeScene m_scene;
    AoSettings m_settings;
    PassSettings m_passes;
    BakeInputs m_inputs;
    Hash m_hash; // of the inputs
    std::vector<Id> m_materials;
    std::size_t m_next = 0; // material
};

} // namespace patina
