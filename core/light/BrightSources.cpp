#include "core/light/BrightSources.h"

#include "core/light/Environment.h"
#include "core/light/LatLongGrid.h"
#include "core/light/Light.h"
#include "core/light/Orientation.h"
#include "core/math/Shading.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <utility>

namespace patina {
namespace {

constexpr int kPlaceRows = 90;       // 2° each: where to look
constexpr double kSourceEdge = 0.05; // of the peak over what is around it: still the source
constexpr double kReachDeg = 15.0;   // of a source from its brightest texel
constexpr double kRingFrom = 8.0, kRingTo = 16.0; // degrees: what is around it
constexpr int kRim = 2;          // texels around what is above that: covered in part, or filtered
constexpr int kFillPasses = 400; // of Gauss-Seidel over some hundred texels

double luminanceOf(const glm::vec3& color) {
    return static_cast<double>(shading::luminance(color));
}

// A picture that sources are removed from, with neighbours around the sphere.
class Panorama {
  public:
    explicit Panorama(const Image& image)
        : m_grid(image.width(), image.height())
        , m_image(image) {}

    [[nodiscard]] const LatLongGrid& grid() const { return m_grid; }
    [[nodiscard]] int width() const { return m_grid.width(); }
    [[nodiscard]] int height() const { return m_grid.height(); }
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width()) +
               static_cast<std::size_t>(x);
    }
    [[nodiscard]] glm::vec3 at(std::size_t texel) const {
        const auto samples = std::as_const(m_image).f32();
        return {samples[3 * texel], samples[3 * texel + 1], samples[3 * texel + 2]};
    }
    void set(std::size_t texel, const glm::vec3& color) {
        const auto samples = m_image.f32();
        for (int c = 0; c < 3; ++c)
            samples[3 * texel + static_cast<std::size_t>(c)] = color[c];
    }
    // Left, right, above, below; over a pole to the other side of it.
    [[nodiscard]] std::array<std::size_t, 4> neighbours(std::size_t texel) const {
        const int w = width(), x = static_cast<int>(texel) % w, y = static_cast<int>(texel) / w;
        const auto over = [&](int row) {
            return row >= 0 && row < height()
                       ? index(x, row)
                       : index((x + w / 2) % w, std::clamp(row, 0, height() - 1));
        };
        return {index((x + w - 1) % w, y), index((x + 1) % w, y), over(y - 1), over(y + 1)};
    }
    [[nodiscard]] glm::dvec3 direction(std::size_t texel) const {
        return m_grid.direction(static_cast<int>(texel) % width(),
                                static_cast<int>(texel) / width());
    }
    [[nodiscard]] double solidAngle(std::size_t texel) const {
        return m_grid.solidAngle(static_cast<int>(texel) / width());
    }
    [[nodiscard]] Image take() { return std::move(m_image); }

  private:
    LatLongGrid m_grid;
    Image m_image;
};

double luminanceSum(const Panorama& sky) {
    double sum = 0.0;
    for (int y = 0; y < sky.height(); ++y) {
        double row = 0.0;
        for (int x = 0; x < sky.width(); ++x)
            row += luminanceOf(sky.at(sky.index(x, y)));
        sum += row * sky.grid().solidAngle(y);
    }
    return sum;
}

// The brightest texel of the place with the most light: a lone texel of a noisy picture is none.
std::size_t brightestTexel(const Panorama& sky) {
    const int rows = std::min(kPlaceRows, sky.height()), columns = 2 * rows;
    std::vector<double> light(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
    std::vector<double> area(light.size());
    const auto placeOf = [&](int x, int y) {
        return static_cast<std::size_t>(y * rows / sky.height()) *
                   static_cast<std::size_t>(columns) +
               static_cast<std::size_t>(x * columns / sky.width());
    };
    for (int y = 0; y < sky.height(); ++y)
        for (int x = 0; x < sky.width(); ++x) {
            const std::size_t place = placeOf(x, y);
            light[place] += luminanceOf(sky.at(sky.index(x, y))) * sky.grid().solidAngle(y);
            area[place] += sky.grid().solidAngle(y);
        }
    // Over as much as a place at the horizon has: towards the poles places are small.
    double most = -1.0;
    std::size_t brightest = 0;
    const double whole = *std::ranges::max_element(area);
    for (std::size_t place = 0; place < light.size(); ++place)
        if (const double mean = light[place] / std::max(area[place], 0.1 * whole); mean > most) {
            most = mean;
            brightest = place;
        }
    std::size_t texel = 0;
    double peak = -1.0;
    for (int y = 0; y < sky.height(); ++y)
        for (int x = 0; x < sky.width(); ++x)
            if (placeOf(x, y) == brightest)
                if (const double value = luminanceOf(sky.at(sky.index(x, y))); value > peak) {
                    peak = value;
                    texel = sky.index(x, y);
                }
    return texel;
}

// Calls `use` with each texel at most `degrees` from a direction.
template <class Use>
void forAround(const Panorama& sky, const glm::dvec3& centre, double degrees, Use use) {
    const double polar = std::acos(std::clamp(centre.y, -1.0, 1.0)), reach = glm::radians(degrees);
    const glm::ivec2 rows = sky.grid().rowsBetween(polar - reach, polar + reach);
    const double least = std::cos(reach);
    for (int y = rows.x; y < rows.y; ++y)
        for (int x = 0; x < sky.width(); ++x) {
            const std::size_t texel = sky.index(x, y);
            if (const double cosine = glm::dot(sky.direction(texel), centre); cosine >= least)
                use(texel, cosine);
        }
}

double luminanceAround(const Panorama& sky, const glm::dvec3& centre) {
    std::vector<double> ring;
    const double inside = std::cos(glm::radians(kRingFrom));
    forAround(sky, centre, kRingTo, [&](std::size_t texel, double cosine) {
        if (cosine <= inside)
            ring.push_back(luminanceOf(sky.at(texel)));
    });
    if (ring.empty())
        return 0.0;
    const auto middle = ring.begin() + static_cast<std::ptrdiff_t>(ring.size() / 2);
    std::ranges::nth_element(ring, middle);
    return *middle;
}

// What is connected with the peak and bright enough, and a rim of texels that it covers in part.
std::vector<std::size_t> regionOf(const Panorama& sky, std::size_t peak, double threshold) {
    const glm::dvec3 centre = sky.direction(peak);
    const double least = std::cos(glm::radians(kReachDeg));
    std::vector<bool> seen(static_cast<std::size_t>(sky.width()) *
                           static_cast<std::size_t>(sky.height()));
    std::vector<std::size_t> region{peak};
    seen[peak] = true;
    // The neighbours of region[from …] that `belongs` says yes to; returns where they begin.
    const auto grow = [&](std::size_t from, const auto& belongs) {
        const std::size_t end = region.size();
        for (std::size_t i = from; i < end; ++i)
            for (const std::size_t neighbour : sky.neighbours(region[i]))
                if (!seen[neighbour] && belongs(neighbour)) {
                    seen[neighbour] = true;
                    region.push_back(neighbour);
                }
        return end;
    };
    const auto isBright = [&](std::size_t texel) {
        return luminanceOf(sky.at(texel)) >= threshold &&
               glm::dot(sky.direction(texel), centre) >= least;
    };
    for (std::size_t from = 0; from < region.size();)
        from = grow(from, isBright);
    for (int rim = 0; rim < kRim; ++rim)
        grow(0, [](std::size_t) { return true; });
    std::ranges::sort(region);
    return region;
}

// The picture in the region as if it went on from around it.
void fillRegion(Panorama& sky, const std::vector<std::size_t>& region) {
    const auto isInside = [&](std::size_t texel) {
        return std::ranges::binary_search(region, texel);
    };
    glm::dvec3 border(0.0);
    int count = 0;
    std::vector<std::array<std::size_t, 4>> around;
    for (const std::size_t texel : region) {
        around.push_back(sky.neighbours(texel));
        for (const std::size_t neighbour : around.back())
            if (!isInside(neighbour)) {
                border += glm::dvec3(sky.at(neighbour));
                ++count;
            }
    }
    const glm::vec3 start =
        count > 0 ? glm::vec3(border / static_cast<double>(count)) : glm::vec3(0.0f);
    for (const std::size_t texel : region)
        sky.set(texel, start);
    for (int pass = 0; pass < kFillPasses; ++pass)
        for (std::size_t i = 0; i < region.size(); ++i) {
            glm::vec3 mean(0.0f);
            for (const std::size_t neighbour : around[i])
                mean += sky.at(neighbour);
            sky.set(region[i], 0.25f * mean);
        }
}

// Removes the source around the peak from the sky.
BrightSource takeOut(Panorama& sky, std::size_t peak) {
    const double around = luminanceAround(sky, sky.direction(peak));
    const double highest = luminanceOf(sky.at(peak));
    const std::vector<std::size_t> region =
        regionOf(sky, peak, around + kSourceEdge * std::max(highest - around, 0.0));
    std::vector<glm::vec3> before;
    for (const std::size_t texel : region)
        before.push_back(sky.at(texel));
    fillRegion(sky, region);

    BrightSource source;
    source.isClear = highest > kClearContrast * around;
    glm::dvec3 towards(0.0);
    double light = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < region.size(); ++i) {
        // Nothing becomes brighter than it was.
        const glm::vec3 left = glm::min(sky.at(region[i]), before[i]);
        sky.set(region[i], left);
        const glm::vec3 taken = before[i] - left;
        const double y = luminanceOf(taken), angle = sky.solidAngle(region[i]);
        towards += y * angle * sky.direction(region[i]);
        light += y * angle;
        squares += y * y * angle;
    }
    if (!(glm::length(towards) > 1e-9 * light)) { // nothing, or from all sides of a tiny picture
        for (std::size_t i = 0; i < region.size(); ++i)
            sky.set(region[i], before[i]);
        return source;
    }
    source.toSource = glm::normalize(towards);
    for (std::size_t i = 0; i < region.size(); ++i) {
        const double cosine = glm::dot(sky.direction(region[i]), source.toSource);
        source.irradiance +=
            glm::dvec3(before[i] - sky.at(region[i])) * cosine * sky.solidAngle(region[i]);
    }
    // Of a disc: Ω = 2π (1 - cos(δ/2)); (∫L)² / ∫L² is the solid angle of an even radiance.
    const double solidAngle = light * light / squares;
    source.diameterDeg = glm::degrees(
        2.0 * std::acos(std::clamp(1.0 - solidAngle / (2.0 * std::numbers::pi), -1.0, 1.0)));
    source.shareOfLight = light;
    return source;
}

} // namespace

BrightSources extractBrightSources(const Image& environment, int count, const JobContext& job) {
    BrightSources result;
    Panorama sky(environment);
    const double whole = luminanceSum(sky);
    for (int i = 0; i < std::min(count, kMostBrightSources) && !job.cancelled(); ++i) {
        BrightSource source = takeOut(sky, brightestTexel(sky));
        if (source.shareOfLight <= 0.0)
            break; // what is left is black, or even
        source.shareOfLight /= whole;
        result.sources.push_back(source);
    }
    if (!job.cancelled())
        result.picture = sky.take();
    return result;
}

Light lightOf(const BrightSource& source, const Environment& environment) {
    Light light;
    light.type = LightType::Directional;
    light.name = "Sun";
    const Orientation stands = orientationOf(environment);
    // The rotation is added to the angle: exact where nothing is tilted.
    const glm::dvec2 angles = anglesFromDirection(
        stands.isLevel() ? glm::dvec3(source.toSource)
                         : Orientation{0.0f, stands.tiltDeg, stands.rollDeg}.matrix() *
                               glm::dvec3(source.toSource));
    light.azimuthDeg = std::remainder(static_cast<float>(angles.x) + stands.rotationDeg, 360.0f);
    light.elevationDeg = static_cast<float>(angles.y);
    const glm::vec3 irradiance =
        glm::vec3(source.irradiance) * environment.tint * std::exp2(environment.exposureEv);
    light.intensity = std::max({irradiance.r, irradiance.g, irradiance.b});
    light.color = light.intensity > 0.0f ? irradiance / light.intensity : glm::vec3(1.0f);
    light.shadowSoftness = static_cast<float>(source.diameterDeg);
    return light;
}

} // namespace patina
