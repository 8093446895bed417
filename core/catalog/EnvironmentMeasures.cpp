#include "core/catalog/EnvironmentMeasures.h"

#include "core/light/BrightSources.h"
#include "core/light/DominantLight.h"
#include "core/light/EnvironmentResample.h"
#include "core/light/LatLongGrid.h"
#include "core/light/LightSides.h"
#include "core/math/Shading.h"
#include "core/math/SphericalHarmonics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <utility>

namespace patina {
namespace {

// A sun keeps its light and its direction at texels of .7°, and is found four times as fast as at
// those of kMeasuredWidth.
constexpr int kSourceWidth = 512;

// Bands up to the eighth are as smooth as 45° / 2; patches of 1.4° are integrated exactly.
constexpr int kHarmonicsWidth = 256;

// A plateau at the top is clipping from so many texels on, where it is this much brighter than the
// mean: a uniform picture is at its largest value everywhere, and is not clipped.
constexpr int kClippedTexels = 8;
constexpr double kClippedContrast = 4.0;

glm::vec3 texelOf(const Image& image, int x, int y) {
    const std::size_t at =
        3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width()) +
             static_cast<std::size_t>(x));
    const std::span<const float> samples = image.f32();
    return {samples[at], samples[at + 1], samples[at + 2]};
}

// How luminance is spread over the sphere, in steps of 1/64 stop: each value is in the middle of
// its step, so that two quantiles of a uniform picture are equal.
class LuminanceHistogram {
  public:
    void add(double luminance, double solidAngle) {
        m_area += solidAngle;
        m_light += luminance * solidAngle;
        const double step = luminance > 0.0 ? (std::log2(luminance) - kLowest) * kPerStop : 0.0;
        Bin& bin = m_bins[static_cast<std::size_t>(std::clamp(step, 0.0, kBins - 1.0))];
        bin.area += solidAngle;
        bin.light += luminance * solidAngle;
    }
    // log2 of the luminance below which a share of the sphere, or of its light, lies.
    [[nodiscard]] double quantileOfArea(double share) const {
        return quantile(share * m_area, &Bin::area);
    }
    [[nodiscard]] double quantileOfLight(double share) const {
        return quantile(share * m_light, &Bin::light);
    }

  private:
    struct Bin {
        double area = 0.0, light = 0.0;
    };
    static constexpr double kLowest = -40.0, kPerStop = 64.0;
    static constexpr int kBins = 80 * 64; // up to 2^40

    [[nodiscard]] double quantile(double wanted, double Bin::*weight) const {
        double sum = 0.0;
        for (std::size_t i = 0; i < m_bins.size(); ++i) {
            sum += m_bins[i].*weight;
            if (sum >= wanted && m_bins[i].*weight > 0.0)
                return kLowest + (static_cast<double>(i) + 0.5) / kPerStop;
        }
        return kLowest;
    }

    std::array<Bin, kBins> m_bins{};
    double m_area = 0.0, m_light = 0.0;
};

// Mean colour, range and clipping: what takes one look at each texel.
void measureTexels(const Image& picture, EnvironmentMeasures& measures) {
    const LatLongGrid grid(picture.width(), picture.height());
    LuminanceHistogram histogram;
    glm::dvec3 color(0.0);
    float largest = 0.0f;
    for (int y = 0; y < picture.height(); ++y) {
        glm::dvec3 row(0.0);
        for (int x = 0; x < picture.width(); ++x) {
            const glm::vec3 radiance = texelOf(picture, x, y);
            row += glm::dvec3(radiance);
            largest = std::max({largest, radiance.x, radiance.y, radiance.z});
            histogram.add(static_cast<double>(shading::luminance(radiance)), grid.solidAngle(y));
        }
        color += row * grid.solidAngle(y);
    }
    constexpr double kSphere = 4.0 * std::numbers::pi;
    measures.meanColor = color / kSphere;
    measures.meanLuminance = static_cast<double>(shading::luminance(glm::vec3(measures.meanColor)));
    if (!(measures.meanLuminance > 0.0))
        return;
    measures.temperature = colorTemperature(measures.meanColor);
    measures.medianLuminance = std::exp2(histogram.quantileOfArea(0.5));
    measures.rangeStops = std::clamp(
        histogram.quantileOfLight(0.99) - histogram.quantileOfArea(0.01), 0.0, kMostStops);
    if (static_cast<double>(largest) < kClippedContrast * measures.meanLuminance)
        return;
    int texels = 0;
    double area = 0.0;
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x) {
            const glm::vec3 radiance = texelOf(picture, x, y);
            if (std::max({radiance.x, radiance.y, radiance.z}) == largest) {
                ++texels;
                area += grid.solidAngle(y);
            }
        }
    if (texels >= kClippedTexels)
        measures.clippedShare = area / kSphere;
}

void measureSides(const Image& picture, EnvironmentMeasures& measures) {
    const LightSides sides(picture);
    if (sides.isBlack())
        return;
    const LitSide key = sides.brightest();
    const double fill = sides.irradianceAway(key.normal);
    measures.keyToFill = fill * kMostKeyToFill > key.irradiance
                             ? std::max(1.0, key.irradiance / fill)
                             : kMostKeyToFill;
    const glm::dvec2 angles = anglesFromDirection(key.normal);
    measures.keyAzimuthDeg = angles.x;
    measures.keyElevationDeg = angles.y;
}

void measureDominantLight(std::span<const glm::vec3> harmonics, EnvironmentMeasures& measures) {
    std::array<glm::vec3, 9> irradiance;
    std::copy_n(harmonics.begin(), irradiance.size(), irradiance.begin());
    convolveWithCosine(irradiance);
    const glm::dvec2 angles = anglesFromDirection(glm::dvec3(dominantLight(irradiance).toLight));
    measures.dominantAzimuthDeg = angles.x;
    measures.dominantElevationDeg = angles.y;
    measures.directionality = static_cast<double>(directionality(irradiance));
}

} // namespace

MeasuredEnvironment measureLight(const Image& environment, const JobContext& job) {
    MeasuredEnvironment result;
    EnvironmentMeasures& measures = result.measures;
    const Image picture = shrinkLatLong(environment, kMeasuredWidth);
    measureTexels(picture, measures);
    const Image half = shrinkLatLong(picture, kSourceWidth);
    const Image small = shrinkLatLong(half, kHarmonicsWidth);
    measureSides(small, measures);
    result.harmonics = projectLatLong(small, kMaxShOrder, job);
    measureDominantLight(result.harmonics, measures);
    BrightSources bright = extractBrightSources(half, 1, job);
    if (!bright.sources.empty() && measures.meanLuminance > 0.0) {
        const BrightSource& found = bright.sources.front();
        const glm::dvec2 angles = anglesFromDirection(found.toSource);
        measures.source = BrightestSource{found.shareOfLight, angles.x, angles.y, found.diameterDeg,
                                          found.isClear};
    }
    result.withoutSource = std::move(bright.picture);
    return result;
}

} // namespace patina
