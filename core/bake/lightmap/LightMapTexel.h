// Light at one texel of a light map: paths from its places on the surface, and what they come to.
#pragma once

#include "core/bake/domain/BakeRequest.h"
#include "core/bake/lightmap/LightMapFilter.h"
#include "core/light/EnvironmentLookup.h"
#include "core/trace/path/LightPath.h"
#include "core/trace/path/TraceScene.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>

namespace patina {

// Sums over the samples so far.
struct LightMapSums {
    glm::vec3 irradiance{0.0f}; // of both
    glm::vec3 open{0.0f};       // directions that nothing hides, over the cosine
    float visible = 0.0f;       // their number
    // Of each harmonic: radiance of what hides the lobe, and how much of it is hidden.
    std::array<glm::vec4, kLightMapTerms> specular{};
    // Of squares: luminance of the irradiance, of the lobe's light of surfaces, its hidden share;
    // and what the last two are of the views so far.
    glm::vec3 squares{0.0f};
    glm::vec2 means{0.0f};
    float views = 0.0f;
};
// As floats, one after another: so PassState::values keeps them.
inline constexpr std::size_t kLightMapSumFloats = 49;
static_assert(sizeof(LightMapSums) == kLightMapSumFloats * sizeof(float) &&
              std::is_trivially_copyable_v<LightMapSums>);

// Belongs to one thread.
class LightMapTexel {
  public:
    // Both outlive it.
    LightMapTexel(const TraceScene& scene, const EnvironmentLookup& imageLight, std::uint32_t seed);

    // Samples `first` … `first` + `count` - 1 of texel number `index`, shared out among its places.
    void trace(std::span<const TracePoint> places, std::uint32_t index, std::uint32_t first,
               std::uint32_t count, LightMapSums& sums);
    // What the first `count` samples come to; of the specular lobe the means of its values times
    // the harmonics, to be fitted by fitHemisphere().
    [[nodiscard]] LightMapTexture::Texel
    finish(std::span<const TracePoint> places, std::uint32_t count, const LightMapSums& sums) const;

    [[nodiscard]] std::uint64_t rays() const {
        return m_path.rays() + m_indirect.rays() + m_rays;
    } // so far

  private:
    // A view of a place from outside; nothing where it is of the surface's back.
    [[nodiscard]] std::optional<shading::SurfaceTerms>
    look(const TracePoint& place, std::uint32_t index, std::uint32_t sample) const;
    // What image-based light has for the lobe, over its albedo.
    [[nodiscard]] glm::vec3 drawnLight(const shading::SurfaceTerms& terms) const;
    [[nodiscard]] bool isOpen(const TracePoint& place, const glm::vec3& direction);
    void traceDiffuse(const TracePoint& place, std::uint32_t index, std::uint32_t sample,
                      LightMapSums& sums);
    void traceSpecular(const TracePoint& place, const shading::SurfaceTerms& terms,
                       std::uint32_t index, std::uint32_t sample, LightMapSums& sums);

    const TraceScene& m_scene;
    const EnvironmentLookup& m_imageLight;
    std::uint32_t m_seed;
    LightPath m_path, m_indirect; // from the texel, from what its rays meet
    std::uint64_t m_rays = 0;
};

} // namespace patina
