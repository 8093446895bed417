#include "core/cells/ReferencePicture.h"

#include "core/base/Check.h"
#include "core/compare/FitImage.h"
#include "core/document/DisplayedPicture.h"
#include "core/image/Srgb.h"
#include "core/math/Shading.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string>

namespace patina {
namespace {

constexpr double kProportions = 0.01;

glm::vec3 pixelOf(const Image& image, int x, int y) {
    if (image.channels() < 3)
        return glm::vec3(image.sample(x, y, 0));
    return {image.sample(x, y, 0), image.sample(x, y, 1), image.sample(x, y, 2)};
}

// sample() of integers is 0…1 as stored.
glm::vec3 linearPixel(const Image& image, int x, int y, bool radiance) {
    const glm::vec3 value = pixelOf(image, x, y);
    if (radiance)
        return value;
    return {srgbToLinear(value.r), srgbToLinear(value.g), srgbToLinear(value.b)};
}

double meanLuminance(const Image& image, bool radiance) {
    double sum = 0.0;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            sum += static_cast<double>(shading::luminance(linearPixel(image, x, y, radiance)));
    return sum / (static_cast<double>(image.width()) * image.height());
}

Image colorsOf(const Image& picture) {
    Image colors(picture.width(), picture.height(), 3, PixelType::F32, ColorEncoding::Linear);
    float* out = colors.f32().data();
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x)
            for (int c = 0; c < 3; ++c)
                *out++ = pixelOf(picture, x, y)[c];
    return colors;
}

} // namespace

bool isRadiance(const Image& picture) {
    return picture.type() == PixelType::F32;
}

bool hasOtherProportions(const Image& picture, int width, int height) {
    const double own = static_cast<double>(picture.width()) / picture.height();
    const double wanted = static_cast<double>(width) / height;
    return std::abs(own / wanted - 1.0) > kProportions;
}

Result<ReferencePicture> referencePicture(const Image& picture, const Image& cell, const View& view,
                                          const ReferenceSettings& settings) {
    CHECK(!picture.empty() && !cell.empty());
    const int width = cell.width(), height = cell.height();
    const bool radiance = isRadiance(picture);
    if (!settings.stretch && hasOtherProportions(picture, width, height))
        return Error{ErrorKind::Usage,
                     fmt::format("its proportions are others: {} × {}, the cell has {} × {}; "
                                 "stretch it, or give the cell its proportions",
                                 picture.width(), picture.height(), width, height),
                     {},
                     {}};
    ReferencePicture result;
    const auto note = [&](const std::string& text) {
        result.note += result.note.empty() ? text : ", " + text;
    };
    // Integers are averaged in linear light, too: their encoding is sRGB.
    Image encoded = picture;
    if (!radiance)
        encoded.setEncoding(ColorEncoding::Srgb);
    const Image fitted = fitImage(encoded, width, height);
    if (picture.width() != width || picture.height() != height)
        note(fmt::format("{} × {} {} to {} × {}", picture.width(), picture.height(),
                         hasOtherProportions(picture, width, height) ? "stretched" : "fitted",
                         width, height));

    float factor = 1.0f;
    if (settings.matchExposure) {
        const double own = meanLuminance(fitted, radiance), wanted = meanLuminance(cell, radiance);
        if (own > 0.0 && wanted > 0.0)
            factor = static_cast<float>(wanted / own);
        result.matchedEv = std::log2(factor);
        note(fmt::format("exposure matched by {:+.2f} EV", result.matchedEv));
    }

    if (radiance) {
        Image colors = colorsOf(fitted);
        Luminance luminance;
        if (needsLuminance(view))
            luminance = luminanceOf(colors);
        for (float& sample : colors.f32())
            sample *= factor;
        Result<Image> displayed = displayedPicture(colors, view, luminance);
        if (!displayed)
            return displayed.error();
        result.displayed = *std::move(displayed);
        return result;
    }
    result.displayed = Image(width, height, 3, PixelType::U8, ColorEncoding::Srgb);
    std::uint8_t* out = result.displayed.u8().data();
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            glm::vec3 shown = pixelOf(fitted, x, y);
            if (factor != 1.0f) {
                const glm::vec3 linear = linearPixel(fitted, x, y, false) * factor;
                shown = {linearToSrgb(std::min(linear.r, 1.0f)),
                         linearToSrgb(std::min(linear.g, 1.0f)),
                         linearToSrgb(std::min(linear.b, 1.0f))};
            }
            for (int c = 0; c < 3; ++c)
                *out++ =
                    static_cast<std::uint8_t>(std::clamp(shown[c], 0.0f, 1.0f) * 255.0f + 0.5f);
        }
    return result;
}

} // namespace patina
