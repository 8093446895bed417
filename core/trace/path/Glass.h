// The share of a surface that light goes through, as paths meet it: a face of a solid dielectric
// body, or a thin wall with both of its faces. Smooth or rough (GGX, Smith). Formulas and sources:
// docs/maths/path-tracing.md.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>

namespace patina {

class TraceMaterial;
struct TracePoint;

struct GlassTerms {
    glm::vec3 n{0.0f, 1.0f, 0.0f}; // shading normal, unit, on the side of the viewer
    glm::vec3 v{0.0f, 1.0f, 0.0f}; // to the viewer, unit
    float NoV = 1.0f;              // above 0
    float alpha = 0.0f;            // of GGX; 0: smooth
    // Index behind the surface over that on the viewer's side; of a thin wall over that of both.
    float eta = 1.5f;
    bool thinWalled = false;
    glm::vec3 tint{1.0f}; // factor on what goes through
    float gain = 1.0f;    // makes up for light lost between rough facets

    // Without roughness light leaves in two directions only.
    [[nodiscard]] bool isSmooth() const { return alpha <= 0.0f; }
    // Light goes through without being refracted: the wall of a sheet, or no change of index.
    [[nodiscard]] bool isStraight() const { return thinWalled || eta == 1.0f; }
};

// How smooth glass is treated as smooth, and how close to 1 an index as 1: there is no rough
// refraction without a change of index, only light that goes on.
[[nodiscard]] float glassAlpha(float perceptualRoughness, float eta, bool thinWalled);
[[nodiscard]] float glassEta(float indexBehind, float indexBefore);

// Share of unpolarised light that the face, or both faces of a thin wall, reflect at that cosine
// to the facet.
[[nodiscard]] float glassReflectance(const GlassTerms& glass, float cosine);

// Where a path goes on.
struct GlassSample {
    glm::vec3 direction{0.0f, 1.0f, 0.0f}; // unit
    glm::vec3 weight{0.0f};                // of the radiance from there; 0: nowhere
    float pdf = 0.0f;                      // per steradian; 0: smooth, that direction alone
    bool through = false;                  // behind the surface
};

// `u` in [0, 1): x, y choose the facet, z whether light is reflected.
[[nodiscard]] GlassSample sampleGlass(const GlassTerms& glass, const glm::vec3& u);
// Of rough glass: the density of sampleGlass() at a direction on either side …
[[nodiscard]] float glassPdf(const GlassTerms& glass, const glm::vec3& l);
// … and radiance sent to the viewer of light of unit irradiance, facing it, from there.
[[nodiscard]] glm::vec3 evaluateGlass(const GlassTerms& glass, const glm::vec3& l);

// What goes through smooth, straight glass unrefracted, besides what the rest of the surface holds
// back.
[[nodiscard]] glm::vec3 straightTransmittance(const GlassTerms& glass);

// The solid bodies that a ray is in, outermost first.
class Media {
  public:
    struct Medium {
        const TraceMaterial* material = nullptr;
        float ior = 1.0f;
        friend bool operator==(const Medium&, const Medium&) = default;
    };

    // Null and 1: of air.
    [[nodiscard]] Medium innermost() const { return m_count > 0 ? m_media[m_count - 1] : Medium(); }
    void enter(const Medium& medium);
    // The innermost of that material, if there is one: meshes may be open.
    void leave(const TraceMaterial* material);
    // Through the face of a solid body of that index.
    void cross(const TracePoint& face, float ior);
    [[nodiscard]] bool contains(const TraceMaterial* material) const;

    // Share that is left after so many metres, which may be infinite, of what the ray is in.
    [[nodiscard]] glm::vec3 transmittance(float metres) const;

  private:
    static constexpr std::size_t kMost = 8; // more than that, one in the other, count as the last
    std::array<Medium, kMost> m_media;
    std::size_t m_count = 0;
};

} // namespace patina
