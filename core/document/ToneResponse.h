// What a view does to light, on the CPU: the formulas of the GPU's tone mapping
// (shaders/shared/tonemap.glsl) with a view's settings, for plots and tests.
#pragma once

namespace patina {

struct View;

namespace shading {
struct ToneCurve;
}

// How bright a picture is on the whole, and what the eye is used to meanwhile. Relative luminances,
// never 0: kLogDelta of shaders/shared/tonemap.glsl is added to each.
struct Luminance {
    float logAverage = 0.18f; // exp(mean(log(delta + L))) of the picture, pixels weighted by alpha
    float adapted = 0.18f;    // what the eye is used to, on its way to logAverage
    float darkest = 0.18f, brightest = 0.18f;

    [[nodiscard]] bool adapting() const { return adapted != logAverage; }
    friend bool operator==(const Luminance&, const Luminance&) = default;
};

// Whether the picture depends on its own luminance.
[[nodiscard]] bool needsLuminance(const View& view);

// The factor on radiance before the tone curve: 2^EV, times the automatic exposure where it is on.
// (The photographic operator exposes by its key, inside of the curve.)
[[nodiscard]] float exposureScale(const View& view, const Luminance& luminance);

// The whole exposure in EV: exposureScale() and what the photographic operator's key adds.
[[nodiscard]] float exposureInForce(const View& view, const Luminance& luminance);

// The tone curve for toneMap() of core/math/Shading.h. Not for ToneMap::OpenColorIo.
[[nodiscard]] shading::ToneCurve toneCurve(const View& view, const Luminance& luminance);

// The value, 0…1, that the display is sent for grey of this radiance after exposure. Not for
// ToneMap::OpenColorIo: DisplayTransform::curve has that.
[[nodiscard]] float displayedGrey(const View& view, const Luminance& luminance, float exposed);

} // namespace patina
