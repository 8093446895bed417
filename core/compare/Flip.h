// FLIP: what a viewer notices who flips between two pictures on one screen, 0 (nothing) to 1 at
// every pixel. LDR-FLIP: Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström & Fairchild, "FLIP:
// A Difference Evaluator for Alternating Images", Proc. ACM CGIT 3(2), 2020. HDR-FLIP: Andersson,
// Nilsson, Shirley & Akenine-Möller, "Visualizing Errors in Rendered High Dynamic Range Images",
// Eurographics Short Papers 2021. The formulas stand in docs/maths/metrics.md.
#pragma once

#include "core/base/Result.h"
#include "core/compare/ErrorMap.h"
#include "core/image/Image.h"
#include "core/job/JobContext.h"

#include <optional>

namespace patina {

// The viewer of both papers: 0.7 m before a screen 0.7 m wide of 3840 pixels, 0.7 · 3840 / 0.7 ·
// π/180. All of Patina's scores are of this one, so that they can be compared.
inline constexpr double kFlipPixelsPerDegree = 67.02064327658225;

// The exposures at which HDR-FLIP looks at both pictures, in stops, evenly spaced from start to
// stop.
struct FlipExposures {
    double start = 0, stop = 0;
    int count = 1;
    friend bool operator==(const FlipExposures&, const FlipExposures&) = default;
};

// Start: the largest luminance of the reference is mapped to 0.85 by the papers' tone curve; stop:
// its median is (the upper one of an even number; where half of the pixels and more are black, the
// median of the others). Their number is max(2, ⌈stop - start⌉). A black reference is seen at
// exposure 0 alone.
[[nodiscard]] FlipExposures flipExposures(const Image& reference);

struct FlipSettings {
    double pixelsPerDegree = kFlipPixelsPerDegree; // 1…400
    std::optional<FlipExposures> exposures;        // of HDR-FLIP; empty: flipExposures(reference)
};

struct Flip {
    ErrorMap error;                         // its mean is the score
    std::optional<FlipExposures> exposures; // those used by HDR-FLIP; empty: it was LDR-FLIP
};

// HDR-FLIP where either image is linear floats, LDR-FLIP otherwise. Grey is taken as equal
// channels, alpha is not seen, what is below 0 (and for LDR-FLIP above 1) is cut there; beyond its
// border a picture goes on with the pixels of the border. LDR-FLIP is symmetric; HDR-FLIP is for
// given exposures. Exactly 0 where all around is the same. The result does not depend on the number
// of threads. Errors: Usage for images of other sizes or of more than four channels, InputBroken
// for NaN and infinity, Cancelled.
Result<Flip> computeFlip(const Image& image, const Image& reference, const JobContext& job,
                         const FlipSettings& settings = {});

// What an LDR-FLIP consists of, each alone: F32 Data, one channel.
struct FlipTerms {
    Image color; // ΔE_c: how different filtered colours look, 0…1
    Image edge;  // |‖∇‖ - ‖∇‖| of the two pictures' edges …
    Image point; // … and of their points; ΔE_f = √(max(edge, point) / √2), ΔE = ΔE_c^(1 - ΔE_f)
};

// Of any two images: linear light is cut to 0…1 as a display would. Errors as above.
Result<FlipTerms> computeFlipTerms(const Image& image, const Image& reference,
                                   const JobContext& job,
                                   double pixelsPerDegree = kFlipPixelsPerDegree);

} // namespace patina
