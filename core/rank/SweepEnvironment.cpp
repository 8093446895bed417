#include "core/rank/SweepEnvironment.h"

#include "core/base/Check.h"
#include "core/job/Parallel.h"
#include "core/light/LightSides.h"
#include "core/math/ShRotation.h"
#include "core/math/SphericalHarmonics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

namespace patina {
namespace {

constexpr int kAngles = 64; // sampled; ⟨R(θ) a, b⟩ has no more than 7 waves around the circle
constexpr double kNoRotation = 1e-4; // relative difference at 0° below which no angle is looked for

using Harmonics = std::span<const glm::vec3>;

double squaredNorm(Harmonics a) {
    double sum = 0.0;
    for (const glm::vec3& c : a)
        sum += glm::dot(glm::dvec3(c), glm::dvec3(c));
    return sum;
}

// What no rotation changes: the norm of each band and colour.
using BandNorms = std::array<glm::dvec3, kMaxShOrder>;

BandNorms bandNorms(Harmonics a) {
    BandNorms norms{};
    for (int l = 0; l < kMaxShOrder; ++l) {
        glm::dvec3 sum(0.0);
        for (int m = -l; m <= l; ++m) {
            const glm::dvec3 c(a[static_cast<std::size_t>(shIndex(l, m))]);
            sum += c * c;
        }
        norms[static_cast<std::size_t>(l)] = glm::sqrt(sum);
    }
    return norms;
}

double relativeDifference(Harmonics rotated, Harmonics b, double norm) {
    double sum = 0.0;
    for (std::size_t i = 0; i < b.size(); ++i) {
        const glm::dvec3 d = glm::dvec3(rotated[i]) - glm::dvec3(b[i]);
        sum += glm::dot(d, d);
    }
    return norm > 0.0 ? std::sqrt(sum / norm) : 0.0;
}

class RotationFinder {
  public:
    RotationFinder() {
        for (int i = 0; i < kAngles; ++i)
            m_rotations.push_back(ShRotation::aboutY(angleOf(i), kMaxShOrder));
    }

    // The rotation about +Y that takes `a` nearest to `b`.
    [[nodiscard]] SameEnvironment nearest(Harmonics a, Harmonics b) const {
        const double norm = squaredNorm(b);
        SameEnvironment result;
        result.difference = relativeDifference(a, b, norm);
        if (result.difference < kNoRotation)
            return result;
        std::vector<glm::vec3> rotated(b.size());
        const auto differenceAt = [&](double angle) {
            ShRotation::aboutY(angle, kMaxShOrder).apply(a, std::span(rotated));
            return relativeDifference(rotated, b, norm);
        };
        double best = 0.0, least = result.difference;
        for (int i = 0; i < kAngles; ++i) {
            m_rotations[static_cast<std::size_t>(i)].apply(a, std::span(rotated));
            if (const double d = relativeDifference(rotated, b, norm); d < least) {
                least = d;
                best = angleOf(i);
            }
        }
        // Golden section between the neighbours of the best sample.
        const double golden = 0.5 * (std::sqrt(5.0) - 1.0), gap = angleOf(1);
        double low = best - gap, high = best + gap;
        double x1 = high - golden * (high - low), x2 = low + golden * (high - low);
        double d1 = differenceAt(x1), d2 = differenceAt(x2);
        while (high - low > 1e-5) {
            if (d1 < d2) {
                high = std::exchange(x2, x1);
                d2 = d1;
                x1 = high - golden * (high - low);
                d1 = differenceAt(x1);
            } else {
                low = std::exchange(x1, x2);
                d1 = d2;
                x2 = low + golden * (high - low);
                d2 = differenceAt(x2);
            }
        }
        const double angle = 0.5 * (low + high);
        result.difference = differenceAt(angle);
        const double degrees = angle * 180.0 / std::numbers::pi;
        result.rotationDeg = static_cast<float>(degrees - 360.0 * std::floor(degrees / 360.0));
        return result;
    }

  private:
    static double angleOf(int i) { return 2.0 * std::numbers::pi * i / kAngles; }

    std::vector<ShRotation> m_rotations;
};

bool mayBeSame(const BandNorms& a, const BandNorms& b, double tolerance) {
    for (std::size_t l = 0; l < a.size(); ++l) {
        const glm::dvec3 d = glm::abs(a[l] - b[l]);
        if (std::max({d.x, d.y, d.z}) > tolerance)
            return false;
    }
    return true;
}

} // namespace

bool SweepEnvironment::blackFromOneSide() const {
    return !black && darkestShare < kBlackSideShare;
}

SweepEnvironment measureEnvironment(std::string name, const Image& image, const JobContext& job) {
    SweepEnvironment environment;
    environment.name = std::move(name);
    environment.texels = hashImage(image);
    environment.harmonics = projectLatLong(image, kMaxShOrder, job);
    const LightSides sides(image);
    environment.black = sides.isBlack();
    if (!environment.black) {
        const LitSide dark = sides.darkest();
        environment.darkestShare = dark.irradiance / sides.brightest().irradiance;
        environment.darkestSide = glm::vec3(dark.normal);
    }
    return environment;
}

std::vector<std::optional<SameEnvironment>>
findSameEnvironments(std::span<const SweepEnvironment> environments, const JobContext& job) {
    std::vector<std::optional<SameEnvironment>> same(environments.size());
    std::vector<BandNorms> norms;
    std::vector<double> lengths;
    for (const SweepEnvironment& environment : environments) {
        CHECK(environment.harmonics.size() == static_cast<std::size_t>(shCount(kMaxShOrder)));
        norms.push_back(bandNorms(environment.harmonics));
        lengths.push_back(std::sqrt(squaredNorm(environment.harmonics)));
    }
    const RotationFinder finder;
    parallelFor(job, environments.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            for (std::size_t j = 0; j < i && !same[i]; ++j) {
                if (environments[i].texels == environments[j].texels) {
                    same[i] = SameEnvironment{j, 0.0f, true, 0.0};
                    continue;
                }
                // Norms of bands differ by no more than the light itself does.
                if (!mayBeSame(norms[i], norms[j], kSameTolerance * lengths[i]))
                    continue;
                SameEnvironment found =
                    finder.nearest(environments[j].harmonics, environments[i].harmonics);
                found.of = j;
                if (found.difference < kSameTolerance)
                    same[i] = found;
            }
    });
    return same;
}

} // namespace patina
