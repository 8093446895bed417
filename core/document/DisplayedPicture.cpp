#include "core/document/DisplayedPicture.h"

#include "core/base/Check.h"
#include "core/document/View.h"
#include "core/document/ViewChoices.h"
#include "core/math/Shading.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace patina {

Luminance luminanceOf(const Image& radiance) {
    CHECK(radiance.type() == PixelType::F32 && radiance.channels() >= 3);
    const auto channels = static_cast<std::size_t>(radiance.channels());
    const auto samples = radiance.f32();
    double logs = 0.0, weights = 0.0;
    Luminance result;
    result.darkest = std::numeric_limits<float>::max();
    result.brightest = 0.0f;
    for (std::size_t i = 0; i < samples.size(); i += channels) {
        const float alpha = channels > 3 ? samples[i + 3] : 1.0f;
        if (!(alpha > 0.0f))
            continue;
        const glm::vec3 color = glm::vec3(samples[i], samples[i + 1], samples[i + 2]) / alpha;
        const float value = shading::kLogDelta + shading::luminance(color);
        logs += static_cast<double>(alpha) * std::log(static_cast<double>(value));
        weights += static_cast<double>(alpha);
        result.darkest = std::min(result.darkest, value);
        result.brightest = std::max(result.brightest, value);
    }
    if (!(weights > 0.0))
        return {};
    result.logAverage = static_cast<float>(std::exp(logs / weights));
    result.adapted = result.logAverage;
    return result;
}

Result<Image> displayedPicture(const Image& radiance, const View& view,
                               const Luminance& luminance) {
    CHECK(radiance.type() == PixelType::F32 && radiance.channels() >= 3);
    if (view.toneMap == ToneMap::OpenColorIo)
        return Error{ErrorKind::Usage,
                     "linear values cannot be shown by OpenColorIO here; choose another tone curve",
                     {},
                     {}};
    const int channels = std::min(radiance.channels(), 4);
    const auto stride = static_cast<std::size_t>(radiance.channels());
    Image shown(radiance.width(), radiance.height(), channels, PixelType::U8, ColorEncoding::Srgb);
    const auto in = radiance.f32();
    std::uint8_t* out = shown.u8().data();
    const float exposure = exposureScale(view, luminance);
    const shading::ToneCurve curve = toneCurve(view, luminance);
    const auto code = [](float value) {
        return static_cast<std::uint8_t>(std::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f);
    };
    for (std::size_t i = 0; i < in.size(); i += stride) {
        const float alpha = channels > 3 ? in[i + 3] : 1.0f;
        glm::vec3 color(0.0f);
        if (alpha > 0.0f)
            color = glm::vec3(in[i], in[i + 1], in[i + 2]) * (exposure / alpha);
        color = shading::displayEncode(shading::toneMap(shading::finiteRadiance(color), curve),
                                       static_cast<int>(view.displayTransfer), view.displayGamma);
        for (int c = 0; c < 3; ++c)
            *out++ = code(color[c]);
        if (channels > 3)
            *out++ = code(alpha);
    }
    return shown;
}

} // namespace patina
