#include "core/document/ToneResponse.h"

#include "core/base/Check.h"
#include "core/document/View.h"
#include "core/document/ViewChoices.h"
#include "core/math/Shading.h"

#include <cmath>

namespace patina {

namespace {

// What the photographic operator multiplies luminance with.
float keyScale(const View& view, const Luminance& luminance) {
    const float key =
        view.reinhardAutoKey
            ? shading::reinhardAutoKey(luminance.adapted, luminance.darkest, luminance.brightest)
            : view.reinhardKey;
    return key / luminance.adapted;
}

} // namespace

bool needsLuminance(const View& view) {
    return view.exposureMode == ExposureMode::Automatic ||
           view.toneMap == ToneMap::ReinhardPhotographic;
}

float exposureScale(const View& view, const Luminance& luminance) {
    const bool automatic = view.exposureMode == ExposureMode::Automatic &&
                           view.toneMap != ToneMap::ReinhardPhotographic;
    return std::exp2(view.exposureEv) *
           (automatic ? shading::automaticExposure(luminance.adapted) : 1.0f);
}

float exposureInForce(const View& view, const Luminance& luminance) {
    const float key =
        view.toneMap == ToneMap::ReinhardPhotographic ? keyScale(view, luminance) : 1.0f;
    return std::log2(exposureScale(view, luminance) * key);
}

shading::ToneCurve toneCurve(const View& view, const Luminance& luminance) {
    CHECK(view.toneMap != ToneMap::OpenColorIo);
    return {static_cast<int>(view.toneMap), keyScale(view, luminance), view.reinhardWhite,
            view.exponentialK, view.reinhardPerChannel ? 1 : 0};
}

float displayedGrey(const View& view, const Luminance& luminance, float exposed) {
    return shading::displayEncode(shading::toneMap(glm::vec3(exposed), toneCurve(view, luminance)),
                                  static_cast<int>(view.displayTransfer), view.displayGamma)
        .y;
}

} // namespace patina
