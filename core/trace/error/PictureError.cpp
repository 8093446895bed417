#include "core/trace/error/PictureError.h"

#include "core/compare/Flip.h"
#include "core/document/DisplayedPicture.h"
#include "core/document/ToneResponse.h"
#include "core/document/View.h"
#include "core/math/Sampling.h"
#include "core/math/Shading.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/ext/scalar_constants.hpp>
#include <map>

namespace patina {
namespace {

constexpr double kWithin = 2.0;     // standard errors
constexpr double kKnown = 0.02;     // share of a pixel that they may be without hiding anything
constexpr double kDarkShare = 0.05; // of white: below that, relative errors count less

Image withoutAlpha(const Image& image) {
    if (image.channels() == 3)
        return image;
    Image result(image.width(), image.height(), 3, PixelType::F32, ColorEncoding::Linear);
    const auto in = image.f32();
    const auto out = result.f32();
    for (std::size_t i = 0, pixels = out.size() / 3; i < pixels; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            out[3 * i + c] = in[static_cast<std::size_t>(image.channels()) * i + c];
    return result;
}

std::vector<double> luminances(const Image& image) {
    const auto values = image.f32();
    std::vector<double> result(values.size() / 3);
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = static_cast<double>(
            shading::luminance({values[3 * i], values[3 * i + 1], values[3 * i + 2]}));
    return result;
}

// A number of the standard normal distribution, the same for a pixel every time (Box & Muller,
// "A Note on the Generation of Random Normal Deviates", 1958).
double normalDeviate(std::uint32_t pixel) {
    constexpr double kScale = 1.0 / 4294967296.0;
    const double u = (static_cast<double>(hash32(2 * pixel)) + 0.5) * kScale;
    const double v = static_cast<double>(hash32(2 * pixel + 1)) * kScale;
    return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * glm::pi<double>() * v);
}

// The traced picture as it might have come out just as well: each pixel brighter or darker by its
// standard error.
Image disturbed(const TracedPicture& traced, const std::vector<double>& luminance) {
    Image result = traced.radiance;
    const auto values = result.f32();
    const auto errors = traced.standardError.f32();
    for (std::size_t i = 0; i < luminance.size(); ++i) {
        if (!(luminance[i] > 0.0))
            continue;
        const double by = normalDeviate(static_cast<std::uint32_t>(i)) *
                          static_cast<double>(errors[i]) / luminance[i];
        const auto scale = static_cast<float>(std::max(1.0 + by, 0.0));
        for (std::size_t c = 0; c < 3; ++c)
            values[3 * i + c] *= scale;
    }
    return result;
}

// Sums over the pixels of a material.
struct Sums {
    std::size_t pixels = 0;
    double flip = 0.0, flipNoise = 0.0, drawn = 0.0, traced = 0.0, variance = 0.0, squares = 0.0;

    [[nodiscard]] ErrorScore score(Id material) const {
        ErrorScore score;
        score.material = material;
        score.pixels = pixels;
        if (pixels == 0)
            return score;
        const auto count = static_cast<double>(pixels);
        score.flip = flip / count;
        score.flipNoise = flipNoise / count;
        if (drawn > 0.0 && traced > 0.0) {
            score.biasEv = std::log2(drawn / traced);
            score.biasEvNoise = std::sqrt(variance) / traced / std::log(2.0);
        }
        score.relative = std::sqrt(std::max(squares / count, 0.0));
        return score;
    }
};

Image dataLike(const Image& image) {
    return Image(image.width(), image.height(), 1, PixelType::F32, ColorEncoding::Data);
}

} // namespace

double darkLuminance(const View& view, const Luminance& luminance) {
    return kDarkShare / std::max(static_cast<double>(exposureScale(view, luminance)), 1e-12);
}

Result<PictureError> pictureError(const Image& drawn, const TracedPicture& traced, const View& view,
                                  std::span<const Id> materials, const JobContext& job) {
    const int width = traced.radiance.width(), height = traced.radiance.height();
    if (drawn.width() != width || drawn.height() != height)
        return Error{ErrorKind::Usage,
                     fmt::format("the drawn picture has {} × {} pixels, the traced one {} × {}",
                                 drawn.width(), drawn.height(), width, height),
                     {},
                     {}};
    const Image opaque = withoutAlpha(drawn);
    const std::vector<double> shown = luminances(opaque), truth = luminances(traced.radiance);
    const Luminance luminance = luminanceOf(traced.radiance);

    const Result<Image> a = displayedPicture(opaque, view, luminance);
    if (!a)
        return a.error();
    const Result<Image> b = displayedPicture(traced.radiance, view, luminance);
    if (!b)
        return b.error();
    const Result<Image> noisy = displayedPicture(disturbed(traced, truth), view, luminance);
    if (!noisy)
        return noisy.error();
    Result<Flip> flip = computeFlip(*a, *b, job);
    if (!flip)
        return flip.error();
    const Result<Flip> flipNoise = computeFlip(*noisy, *b, job);
    if (!flipNoise)
        return flipNoise.error();

    PictureError error;
    error.exposure = dataLike(traced.radiance);
    error.relative = dataLike(traced.radiance);
    error.flip = std::move(flip->error.values);
    error.withinNoise.resize(truth.size());
    const double dark = darkLuminance(view, luminance);
    const bool tellsMaterials = materials.size() == truth.size();
    Sums all;
    std::map<Id, Sums> each;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const double difference = shown[i] - truth[i];
        const auto deviation = static_cast<double>(traced.standardError.f32()[i]);
        const double scale = truth[i] * truth[i] + dark * dark;
        if (!std::isfinite(difference))
            return Error{
                ErrorKind::InputBroken, "the drawn picture has values that are not finite", {}, {}};
        error.exposure.f32()[i] = static_cast<float>(
            std::log2((std::max(shown[i], 0.0) + dark) / (std::max(truth[i], 0.0) + dark)));
        error.relative.f32()[i] = static_cast<float>(std::abs(difference) / std::sqrt(scale));
        const double hidden = kWithin * deviation;
        error.withinNoise[i] =
            std::abs(difference) <= hidden && hidden > kKnown * std::sqrt(scale) ? 1 : 0;
        const auto add = [&](Sums& sums) {
            ++sums.pixels;
            sums.flip += static_cast<double>(error.flip.f32()[i]);
            sums.flipNoise += static_cast<double>(flipNoise->error.values.f32()[i]);
            sums.drawn += shown[i];
            sums.traced += truth[i];
            sums.variance += deviation * deviation;
            sums.squares += (difference * difference - deviation * deviation) / scale;
        };
        add(all);
        if (tellsMaterials && materials[i] != 0)
            add(each[materials[i]]);
    }
    error.whole = all.score(0);
    for (const auto& [material, sums] : each)
        error.materials.push_back(sums.score(material));
    std::ranges::stable_sort(error.materials, std::greater(), [](const ErrorScore& score) {
        return score.flip * static_cast<double>(score.pixels);
    });
    return error;
}

} // namespace patina
