#include "tests/reference/ReferenceSweep.h"

#include "core/compare/Flip.h"
#include "core/document/ToneResponse.h"
#include "core/document/ViewChoices.h"
#include "core/math/ShRotation.h"
#include "core/math/Shading.h"
#include "core/math/SphericalHarmonics.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

namespace patina::test {
namespace {

using Pixels = std::vector<glm::dvec3>;

Pixels radianceOf(const SweepPixels& pixels, const SweepEnvironment& environment,
                  double rotationDeg, const glm::vec3& scale) {
    const auto coefficients = static_cast<std::size_t>(shCount(pixels.order));
    std::vector<glm::vec3> light(coefficients);
    ShRotation::aboutY(glm::radians(rotationDeg), pixels.order)
        .apply(std::span(environment.harmonics).first(coefficients), std::span(light));
    Pixels result;
    for (std::size_t p = 0; p < pixels.count(); ++p) {
        glm::dvec3 sum(0.0);
        for (glm::length_t c = 0; c < 3; ++c) {
            const auto plane = static_cast<std::size_t>(c);
            sum[c] = pixels.still[plane * pixels.count() + p];
            for (std::size_t i = 0; i < coefficients; ++i)
                sum[c] += double(scale[c]) * double(light[i][c]) *
                          double(pixels.transfer[(3 * i + plane) * pixels.count() + p]);
        }
        result.push_back(glm::max(sum, glm::dvec3(0.0)));
    }
    return result;
}

Luminance adaptedTo(const Pixels& radiance) {
    double sum = 0.0, darkest = 1e30, brightest = 0.0;
    for (const glm::dvec3& c : radiance) {
        const double l = shading::kLogDelta + double(shading::luminance(glm::vec3(c)));
        sum += std::log(l);
        darkest = std::min(darkest, l);
        brightest = std::max(brightest, l);
    }
    const auto average = float(std::exp(sum / double(radiance.size())));
    return {average, average, float(darkest), float(brightest)};
}

Image imageOf(const SweepPixels& pixels, const Pixels& shown) {
    Image image(pixels.width, pixels.height, 3, PixelType::F32, ColorEncoding::Linear);
    for (float& value : image.f32())
        value = 0.18f;
    for (std::size_t p = 0; p < shown.size(); ++p) {
        for (std::size_t c = 0; c < 3; ++c)
            image.f32()[3 * std::size_t{pixels.places[p]} + c] =
                float(shown[p][static_cast<glm::length_t>(c)]);
    }
    return image;
}

double contrast(const Pixels& shown) {
    std::vector<double> sorted;
    for (const glm::dvec3& c : shown)
        sorted.push_back(shading::luminance(glm::vec3(c)));
    std::ranges::sort(sorted);
    const auto rank = [&](double share) {
        return sorted[std::size_t(std::max(1.0, std::ceil(share * double(sorted.size())))) - 1];
    };
    return std::log2((rank(0.95) + 0.01) / (rank(0.05) + 0.01));
}

} // namespace

LightSweep referenceSweep(const SweepPixels& pixels,
                          const std::vector<SweepEnvironment>& environments,
                          const SweepSettings& settings) {
    LightSweep sweep;
    std::vector<Pixels> pictures, stops;
    const auto show = [&](const Pixels& radiance, Pixels* inStops) {
        const Luminance luminance =
            needsLuminance(settings.view) ? adaptedTo(radiance) : Luminance{};
        const float exposure = exposureScale(settings.view, luminance);
        Pixels shown;
        for (const glm::dvec3& c : radiance) {
            const glm::vec3 exposed = exposure * glm::vec3(c);
            shown.emplace_back(glm::clamp(
                shading::toneMap(exposed, toneCurve(settings.view, luminance)), 0.0f, 1.0f));
            if (inStops != nullptr)
                inStops->emplace_back(
                    std::log2(double(shading::luminance(exposed)) + 1.0 / 1024.0));
        }
        return shown;
    };
    for (std::size_t e = 0; e < environments.size(); ++e)
        for (int r = 0; r < settings.rotations; ++r) {
            LightScore& score = sweep.scores.emplace_back();
            score.light = {e, 360.0 * r / settings.rotations};
            pictures.push_back(
                show(radianceOf(pixels, environments[e], score.light.rotationDeg, settings.scale),
                     &stops.emplace_back()));
        }

    // The mean look, and how far lights are from each other.
    const auto all = double(pictures.size());
    Pixels reference(pixels.count(), glm::dvec3(0.0));
    sweep.sensitivity = Image(pixels.width, pixels.height, 1, PixelType::F32, ColorEncoding::Data);
    for (std::size_t p = 0; p < pixels.count(); ++p) {
        double mean = 0.0, variance = 0.0;
        for (std::size_t i = 0; i < pictures.size(); ++i) {
            reference[p] += pictures[i][p] / all;
            mean += stops[i][p].x / all;
        }
        for (const Pixels& of : stops)
            variance += (of[p].x - mean) * (of[p].x - mean) / all;
        sweep.sensitivity.f32()[pixels.places[p]] = float(std::sqrt(variance));
    }
    if (settings.reference)
        reference = show(radianceOf(pixels, environments[settings.reference->environment],
                                    settings.reference->rotationDeg, settings.scale),
                         nullptr);
    sweep.reference = imageOf(pixels, reference);
    sweep.referenceContrastStops = contrast(reference);

    for (std::size_t i = 0; i < pictures.size(); ++i) {
        LightScore& score = sweep.scores[i];
        const Image picture = imageOf(pixels, pictures[i]);
        double white = 0, black = 0;
        for (const glm::dvec3& light : pictures[i]) {
            const glm::vec3 code = shading::displayEncode(
                glm::vec3(light), static_cast<int>(settings.view.displayTransfer),
                settings.view.displayGamma);
            const auto most = std::lround(255.0f * std::max({code.x, code.y, code.z}));
            white += most == 255 ? 1 : 0;
            black += most == 0 ? 1 : 0;
        }
        score.clipped = {white / double(pixels.count()), black / double(pixels.count())};
        score.contrastStops = contrast(pictures[i]);
        score.lostContrast =
            std::max(0.0, 1.0 - score.contrastStops / sweep.referenceContrastStops);
        const Flip flip =
            *computeFlip(convertImage(picture, PixelType::F32, ColorEncoding::Srgb),
                         convertImage(sweep.reference, PixelType::F32, ColorEncoding::Srgb), {});
        std::vector<float> errors;
        for (const std::uint32_t place : pixels.places)
            errors.push_back(flip.error.values.f32()[place]);
        const auto largest = std::ranges::max_element(errors);
        score.difference.maxAt = std::size_t(largest - errors.begin());
        score.difference.max = *largest;
        const auto place = int(pixels.places[score.difference.maxAt]);
        score.worstPixel = {place % pixels.width, place / pixels.width};
        for (const float error : errors)
            score.difference.mean += error / double(errors.size());
        std::ranges::sort(errors, std::greater<>());
        const auto worst = std::size_t(std::max(1.0, std::round(0.001 * double(errors.size()))));
        for (std::size_t k = 0; k < worst; ++k)
            score.difference.worst += errors[k] / double(worst);
    }
    return sweep;
}

} // namespace patina::test
