// Keeps the radiance that surfaces send out under transfer in step with the light, by a compute
// shader that runs when something it depends on has changed: a light that stands still costs
// frames nothing.
#pragma once

#include "core/math/SphericalHarmonics.h"
#include "render/pass/NearLightPass.h"
#include "render/scene/GpuScene.h"
#include "render/shader/ShaderLibrary.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <utility>
#include <vector>

namespace patina::render {

// In what light, and how.
struct RelightSettings {
    LightingMode lighting{};
    LightId light = kDocumentLight;
    bool bounces = true; // Prt: what came by way of other surfaces, too
};

class RelightPass {
  public:
    RelightPass(gl::Context& context, ShaderLibrary& shaders);

    // Exit radiance of all items in an environment and the lights of the scene; does nothing for
    // modes that need none. `frame`: of the lights near by; its buffer is bound.
    Result<void> update(GpuScene& scene, const RelightSettings& settings, const FrameBlock& frame);

    // Elements that have been computed since the beginning, to see that nothing is done in vain.
    [[nodiscard]] std::uint64_t elementsDone() const { return m_elementsDone; }
    [[nodiscard]] std::uint64_t nearElementsDone() const { return m_nearElementsDone; } // near by

    // Of shaders over the elements, for lights near by.
    [[nodiscard]] std::uint64_t nearDispatches() const { return m_near.dispatches(); }

    // Light that is no longer there.
    void removeLight(LightId light);

    // Whether lights near by came by way of a bake since the last call.
    [[nodiscard]] bool takeNearUse() { return std::exchange(m_nearUsed, false); }

  private:
    // Light from far away in so many bands: of how many depends what a point of light becomes.
    struct FarLight {
        std::vector<glm::vec3> coefficients;
        gl::Buffer block;
        std::uint64_t revision = 0;
        bool current = false; // in this update
    };
    FarLight& farLight(const GpuScene& scene, LightId light, int order);
    // Whether there was something to do.
    Result<bool> relight(GpuScene& scene, const DrawItem& item, const RelightSettings& settings);
    Result<void> relightNear(ExitRadiance& exit, const TransferWork& work,
                             const ExitRadiance::Sources& sources);
    Result<void> dispatch(const TransferWork& work, const ExitRadiance& exit, const FarLight& light,
                          bool adds);

    gl::Context& m_context;
    ShaderLibrary& m_shaders;
    NearLightPass m_near;
    TransferParts m_parts;
    std::map<std::pair<LightId, int>, FarLight> m_far; // by light and order
    std::uint64_t m_farRevision = 0;
    std::uint64_t m_elementsDone = 0, m_nearElementsDone = 0;
    bool m_nearUsed = false;
};

} // namespace patina::render
