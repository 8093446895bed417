// The DFG table: directional albedo and mean direction of the specular lobe, precomputed over the
// view angle and the roughness for a choice of terms (docs/maths/ibl.md).
#pragma once

#include "core/image/Image.h"
#include "core/material/ShadingModel.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace patina {

// What the lobe f of D and V, single scattering, integrates to; theta is the angle of v from n.
//   x: scale = ∫ f/F (1 - Fc) cos, y: bias = ∫ f/F Fc cos, Fc = (1 - V·H)^5 (Karis 2013, eq. 8):
//      the albedo with Schlick's F is F0 x + y, the albedo E of a perfect mirror material x + y.
//   z: tilt of the mean direction m = ∫ f/F l cos / |…| from n towards the mirror direction R:
//      m is normalize(mix(n, R, tilt)). 0: along n; 1: along R; above 1: beyond it.

// One table entry, by Gauss-Legendre quadrature in double precision: within 1e-6 of the exact
// integral of GGX for N·V >= 0.05. NoV in 0…1, perceptualRoughness in 0…1; both are
// kept a little above 0, where the lobe has no density.
[[nodiscard]] glm::dvec3 integrateDfg(float NoV, float perceptualRoughness,
                                      Distribution distribution = Distribution::GGX,
                                      Visibility visibility = Visibility::SmithCorrelated);

// Scale and bias of the same by the table's own quadrature, within 5e-4 (1e-3 for N·V < 0.05), in
// some microseconds.
[[nodiscard]] glm::dvec2 estimateDfg(float NoV, float perceptualRoughness,
                                     Distribution distribution = Distribution::GGX,
                                     Visibility visibility = Visibility::SmithCorrelated);

// Where the texels of a table lie in 0…1.
enum class DfgTexels {
    // At (i + 0.5) / size, as everybody expects of a file: looked up at (N·V, perceptualRoughness)
    // as they are. The outermost half texels repeat their texel, E is 1.5 % high at N·V = r = 1.
    Inside,
    // At i / (size - 1), looked up through dfgTableUv() of shaders/shared/ibl.glsl: the renderer's.
    ToTheEnds
};

// size × size, F32, 3 channels as above; u = N·V, v = perceptualRoughness. Entries are within 5e-4
// of integrateDfg() (1e-3 for N·V < 0.05, 3e-3 for the tilt at N·V = 1): a shorter quadrature in
// single precision, SIMD. The result does not depend on the number of threads. `size`: at least 2.
[[nodiscard]] Image computeDfgTable(int size = 128, Distribution distribution = Distribution::GGX,
                                    Visibility visibility = Visibility::SmithCorrelated,
                                    DfgTexels texels = DfgTexels::Inside);

// The visibility whose table image-based light uses: the chosen one, but for the k = (r + 1)² / 8
// that Karis 2013 made for lights only; light from all sides takes his k = alpha / 2.
[[nodiscard]] Visibility iblVisibility(Visibility visibility);

} // namespace patina
