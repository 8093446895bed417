// One point of a surface under the lens: the numbers behind every plot of how it reflects, from the
// functions that shade the picture.
//
// The frame is the surface's: n = +z; directions are unit vectors that point away from it. Angles
// are radians from n; in a plane of incidence the light stands at negative angles, its mirror
// direction at positive ones.
#pragma once

#include "core/image/Image.h"
#include "core/light/Energy.h"
#include "core/material/ShadingModel.h"
#include "core/math/Shading.h"

#include <vector>

namespace patina {

enum class LensLobe { Both, Specular, Diffuse };

// The share of the light that comes back towards a viewer when it arrives evenly from all sides,
// three times. The first two are what image-based light uses, from the DFG table.
struct LensAlbedo {
    glm::vec3 single{0.0f}; // scattered once
    glm::vec3 multi{0.0f};  // with energy compensation
    glm::vec3 exact{0.0f};  // the model as it is: returnedFromLights() of core/light/Energy.h
};

class BrdfLens {
  public:
    // `dfgTable`: the renderer's (DfgTexels::ToTheEnds), of the model's distribution and
    // iblVisibility(); DfgTables has them.
    BrdfLens(const ShadingModel& model, const SurfacePoint& point, ImagePtr dfgTable);

    [[nodiscard]] const SurfacePoint& point() const { return m_point; }
    // Of lights: the square of the perceptual roughness, not below kMinPerceptualRoughness².
    [[nodiscard]] float alpha() const;

    // The surface as the shader makes it, with any normal n, and what the table holds for it:
    // scale, bias, tilt.
    [[nodiscard]] shading::SurfaceTerms surface(const glm::vec3& n, const glm::vec3& v) const;
    [[nodiscard]] glm::vec3 dfg(float NoV) const;

    // f_r in 1/sr; 0 where the light or the viewer is not above the surface.
    [[nodiscard]] glm::vec3 brdf(const glm::vec3& l, const glm::vec3& v, LensLobe lobe) const;

    // The factors of the specular lobe D G F / (4 N·L N·V). `theta`: of h from n for D (1/sr), of
    // v from h for F.
    [[nodiscard]] float distribution(float theta) const;
    [[nodiscard]] glm::vec3 fresnel(float theta) const;
    // Share of facets that both the light at `thetaL` and the viewer at `thetaV` see, in one plane
    // of incidence. Above 1 where the model's V does not come from masking (Kelemen).
    [[nodiscard]] float masking(float thetaL, float thetaV) const;

    [[nodiscard]] LensAlbedo albedo(float thetaV, LensLobe lobe) const;

  private:
    ShadingModel m_choices;
    shading::BrdfModel m_model;
    SurfacePoint m_point;
    ImagePtr m_dfgTable;
};

// Unit vector in the plane of incidence.
[[nodiscard]] glm::vec3 lensDirection(float theta);

// Angles -90°…90° in ascending order, in even steps and, because a smooth surface's highlight is
// narrower than any step, crowded around `peak`; `alpha` is the width of the highlight.
[[nodiscard]] std::vector<float> lensAngles(float peak, float alpha);

} // namespace patina
