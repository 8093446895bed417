#include "core/catalog/EnvironmentThumbnail.h"

#include "core/light/Environment.h"
#include "core/light/EnvironmentMapping.h"
#include "core/light/EnvironmentResample.h"
#include "core/math/Shading.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <numbers>

namespace patina {
namespace {

// A black picture stays black, whatever is divided by its mean.
constexpr double kLeastMean = 1e-9;

double meanOf(const Image& picture) {
    const Result<EnvironmentMapping> mapping =
        EnvironmentMapping::create(EnvironmentLayout::LatLong, {picture.width(), picture.height()});
    if (!mapping)
        return 0.0;
    const glm::dvec3 flux = environmentFlux(picture, *mapping);
    return static_cast<double>(shading::luminance(glm::vec3(flux))) / (4.0 * std::numbers::pi);
}

} // namespace

Image environmentThumbnail(const Image& environment, const Image& withoutSource) {
    const Image small = shrinkLatLong(environment, kThumbnailWidth);
    const Image smallWithout = shrinkLatLong(withoutSource, kThumbnailWidth);
    const float scale =
        shading::kMiddleGrey / static_cast<float>(std::max(meanOf(smallWithout), kLeastMean));
    Image thumbnail(kThumbnailWidth, kThumbnailHeight, 3, PixelType::U8, ColorEncoding::Srgb);
    std::size_t at = 0;
    for (int y = 0; y < kThumbnailHeight; ++y)
        for (int x = 0; x < kThumbnailWidth; ++x) {
            // A picture that is smaller than its thumbnail is enlarged without blur.
            const glm::vec3 radiance(small.linear(x * small.width() / kThumbnailWidth,
                                                  y * small.height() / kThumbnailHeight));
            const glm::vec3 shown = shading::srgbEncode(glm::clamp(
                shading::toneMapPbrNeutral(shading::finiteRadiance(radiance * scale)), 0.0f, 1.0f));
            for (int c = 0; c < 3; ++c)
                thumbnail.u8()[at++] = static_cast<std::uint8_t>(shown[c] * 255.0f + 0.5f);
        }
    return thumbnail;
}

} // namespace patina
