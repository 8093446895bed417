// Shadow maps of directional lights and spots: one square of depths per light in a common texture,
// and a pyramid of the nearest and farthest depth over it that lets the surface shader skip what is
// wholly lit or wholly dark. A map is drawn again only when its light or the geometry has changed.
#pragma once

#include "render/gl/Framebuffer.h"
#include "render/scene/GpuScene.h"
#include "render/scene/ShadowView.h"
#include "render/shader/ShaderLibrary.h"

#include <array>
#include <span>

namespace patina::render {

inline constexpr int kShadowMapSize = 1024; // texels along the side of one map

void deleteSampler(unsigned id);

class ShadowPass {
  public:
    ShadowPass(gl::Context& context, ShaderLibrary& shaders);

    // Compiles what update() needs.
    Result<void> compile();
    // Brings the maps up to date. Leaves another framebuffer and frame block bound.
    Result<void> update(const GpuScene& scene);
    // The maps for the surface shader; nothing to bind while lights() is empty.
    void bind() const;
    void unbind() const; // the comparison, which other users of the unit would not expect

    // Ids of the lights that have a map, by slot: the first kMaxShadows that shine and cast.
    [[nodiscard]] std::span<const Id> lights() const { return {m_lights.data(), m_lightCount}; }
    [[nodiscard]] std::size_t mapsDrawn() const { return m_mapsDrawn; } // so far

  private:
    // What a map was drawn of.
    struct Slot {
        ShadowView view;
        std::uint64_t shapeRevision = 0;
        bool drawn = false;
    };

    Result<void> resize(int columns, int rows);
    Result<void> drawMap(const GpuScene& scene, const ShadowView& view, int x, int y);
    Result<void> drawPyramid(int x, int y);

    gl::Context& m_context;
    ShaderLibrary& m_shaders;
    gl::Buffer m_frameBlock, m_shadowBlock;
    gl::Texture m_depth, m_nearest, m_range;
    gl::Framebuffer m_target;
    gl::Handle<deleteSampler> m_compare;
    std::array<Slot, kMaxShadows> m_slots;
    std::array<Id, kMaxShadows> m_lights{};
    std::size_t m_lightCount = 0;
    std::size_t m_mapsDrawn = 0;
};

} // namespace patina::render
