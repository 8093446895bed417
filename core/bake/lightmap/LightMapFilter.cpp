#include "core/bake/lightmap/LightMapFilter.h"

#include "core/job/Parallel.h"
#include "core/math/Shading.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

namespace patina {
namespace {

using Texel = LightMapTexture::Texel;

// Dammertz, Sewtz, Hanika & Lensch 2010, "Edge-Avoiding À-Trous Wavelet Transform for fast Global
// Illumination Filtering": B3 spline, steps of 1, 2 …; with the variances of Schied et al. 2017,
// "Spatiotemporal Variance-Guided Filtering", for how much values may differ.
constexpr std::array<float, 3> kSpline = {3.0f / 8.0f, 1.0f / 4.0f, 1.0f / 16.0f};
constexpr int kSteps = 3;
constexpr float kSameNormal = 64.0f; // power of the cosine between normals
constexpr float kDeviations = 2.0f;  // that values may differ by
// Neighbours that a texel is measured by: so many, and as much of its surface.
constexpr std::size_t kFewest = 5;
constexpr float kMostlySame = 0.2f;

// Which vectors a variance speaks of; hidden shares are the last numbers of those of radiance.
enum Group { kIrradiance, kRadiance, kHidden, kGroups };

float guideOf(const Texel& texel, Group group) {
    const auto& values = texel.values;
    return group == kIrradiance ? shading::luminance(glm::vec3(values[0]))
           : group == kRadiance ? shading::luminance(glm::vec3(values[1]))
                                : values[1].w;
}

// Neighbours of known texels, within the texture, which repeats.
template <class Visit>
void forEachNeighbour(const LightMapTexture& from, int x, int y, int radius, int step,
                      const Visit& visit) {
    const auto wrapped = [side = from.side](int i) { return (i % side + side) % side; };
    for (int dy = -radius; dy <= radius; ++dy)
        for (int dx = -radius; dx <= radius; ++dx) {
            const Texel& other = from.at(wrapped(x + dx * step), wrapped(y + dy * step));
            if (other.normal != glm::vec3(0.0f))
                visit(other, dx, dy);
        }
}

// Neighbours in the texture may be anywhere in the scene: those of the same smooth surface lie in
// its tangent plane, not farther than a few texels.
float sameSurface(const Texel& texel, const Texel& other, float reach) {
    const glm::vec3 to = other.position - texel.position;
    const float distance = glm::length(to);
    if (distance > reach)
        return 0.0f;
    const float cosine = std::max(glm::dot(texel.normal, other.normal), 0.0f);
    const float above = std::abs(glm::dot(texel.normal, to));
    return std::pow(cosine, kSameNormal) * std::exp(-4.0f * above / std::max(reach, 1e-12f));
}

// Size of a texel on the surface about there: the median of the distances to those beside it.
float texelSize(const LightMapTexture& from, int x, int y) {
    std::array<float, 8> distances{};
    std::size_t count = 0;
    const Texel& texel = from.at(x, y);
    forEachNeighbour(from, x, y, 1, 1, [&](const Texel& other, int dx, int dy) {
        if (dx != 0 || dy != 0)
            distances[count++] = glm::distance(other.position, texel.position) /
                                 std::sqrt(static_cast<float>(dx * dx + dy * dy));
    });
    if (count == 0)
        return 0.0f;
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(count / 2);
    std::nth_element(distances.begin(), middle,
                     distances.begin() + static_cast<std::ptrdiff_t>(count));
    return *middle;
}

// A texel that one path has made much brighter or darker than all those about it on its surface
// takes their mean.
Texel calmed(const LightMapTexture& from, int x, int y) {
    const Texel& texel = from.at(x, y);
    const float reach = 2.12f * texelSize(from, x, y);
    std::array<const Texel*, 8> beside{};
    std::size_t count = 0;
    forEachNeighbour(from, x, y, 1, 1, [&](const Texel& other, int, int) {
        if (&other != &texel && sameSurface(texel, other, reach) > kMostlySame)
            beside[count++] = &other;
    });
    Texel result = texel;
    if (count < kFewest)
        return result;
    for (const Group group : {kIrradiance, kRadiance, kHidden}) {
        std::array<float, 8> guides;
        guides.fill(std::numeric_limits<float>::infinity()); // where there are fewer
        for (std::size_t i = 0; i < count; ++i)
            guides[i] = guideOf(*beside[i], group);
        std::sort(guides.begin(), guides.end());
        // The outermost of them may stand out as well.
        const float low = guides[1], high = guides[count - 2];
        const float guide = guideOf(texel, group);
        if (guide >= low - (high - low) && guide <= high + (high - low))
            continue;
        Texel mean;
        float used = 0.0f;
        for (std::size_t i = 0; i < count; ++i) {
            const float other = guideOf(*beside[i], group);
            if (other < low || other > high)
                continue;
            for (std::size_t v = 0; v < mean.values.size(); ++v)
                mean.values[v] += beside[i]->values[v];
            mean.variance[group] += beside[i]->variance[group];
            used += 1.0f;
        }
        for (std::size_t v = 0; v < mean.values.size(); ++v) {
            const glm::vec4 value = mean.values[v] / used;
            if (v == 0 || v + 1 == mean.values.size()) {
                if (group == kIrradiance)
                    result.values[v] = value;
            } else if (group == kRadiance) {
                result.values[v] = glm::vec4(glm::vec3(value), result.values[v].w);
            } else if (group == kHidden) {
                result.values[v].w = value.w;
            }
        }
        result.variance[group] = mean.variance[group] / used;
    }
    return result;
}

Texel filtered(const LightMapTexture& from, int x, int y, int step) {
    const Texel& texel = from.at(x, y);
    // 1.5 times the diagonal of what the kernel covers.
    const float reach = 1.5f * 2.83f * static_cast<float>(step) * texelSize(from, x, y);
    // One sample's variance is noisy itself.
    glm::vec3 variance(0.0f);
    float weights = 0.0f;
    forEachNeighbour(from, x, y, 1, 1, [&](const Texel& other, int, int) {
        variance += other.variance;
        weights += 1.0f;
    });
    variance /= weights;

    Texel sum = texel;
    std::array<float, kGroups> total{};
    sum.values = {};
    sum.variance = glm::vec3(0.0f);
    forEachNeighbour(from, x, y, 2, step, [&](const Texel& other, int dx, int dy) {
        const float shape = kSpline[static_cast<std::size_t>(std::abs(dx))] *
                            kSpline[static_cast<std::size_t>(std::abs(dy))] *
                            (&other == &texel ? 1.0f : sameSurface(texel, other, reach));
        if (!(shape > 0.0f))
            return;
        std::array<float, kGroups> weight{};
        for (const Group group : {kIrradiance, kRadiance, kHidden}) {
            const float difference = guideOf(other, group) - guideOf(texel, group);
            const float allowed = kDeviations * std::sqrt(std::max(variance[group], 0.0f)) + 1e-6f;
            weight[group] = shape * std::exp(-std::abs(difference) / allowed);
            total[group] += weight[group];
            sum.variance[group] += weight[group] * weight[group] * other.variance[group];
        }
        sum.values.front() += weight[kIrradiance] * other.values.front();
        sum.values.back() += weight[kIrradiance] * other.values.back();
        for (std::size_t j = 1; j <= kLightMapTerms; ++j)
            sum.values[j] += glm::vec4(weight[kRadiance] * glm::vec3(other.values[j]),
                                       weight[kHidden] * other.values[j].w);
    });
    sum.values.front() /= total[kIrradiance];
    sum.values.back() /= total[kIrradiance];
    for (std::size_t j = 1; j <= kLightMapTerms; ++j)
        sum.values[j] = glm::vec4(glm::vec3(sum.values[j]) / total[kRadiance],
                                  sum.values[j].w / total[kHidden]);
    for (const Group group : {kIrradiance, kRadiance, kHidden})
        sum.variance[group] /= total[group] * total[group];
    return sum;
}

} // namespace

void filterLightMap(LightMapTexture& texture, const JobContext& job) {
    LightMapTexture next = texture;
    const auto replace = [&](const auto& texelOf) {
        parallelFor(job, static_cast<std::size_t>(texture.side), 4,
                    [&](std::size_t first, std::size_t last) {
                        for (int y = static_cast<int>(first); y < static_cast<int>(last); ++y)
                            for (int x = 0; x < texture.side; ++x)
                                if (texture.at(x, y).normal != glm::vec3(0.0f))
                                    next.at(x, y) = texelOf(x, y);
                    });
        std::swap(texture, next);
    };
    replace([&](int x, int y) { return calmed(texture, x, y); });
    for (int i = 0; i < kSteps; ++i)
        replace([&](int x, int y) { return filtered(texture, x, y, 1 << i); });
}

} // namespace patina
