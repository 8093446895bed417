#include "core/radiosity/ErrorBound.h"

#include "core/radiosity/Gathering.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace patina::radiosity {
namespace {

// Šidák 1967: each of `count` statements at this level, so that all of them hold at kConfidence.
double deviateOfEach(std::size_t count) {
    return normalDeviate(-std::expm1(std::log(ErrorBound::kConfidence) /
                                     static_cast<double>(std::max<std::size_t>(count, 1))));
}

// Standard error of a mean over rays of the numbers that they have met. Counts one ray more, which
// has met the largest number there is: few rays may all have missed what is bright.
double standardError(double mean, double meanSquare, double largest, double rays) {
    const double m = (rays * mean + largest) / (rays + 1.0);
    const double square = (rays * meanSquare + largest * largest) / (rays + 1.0);
    return std::sqrt(std::max(0.0, square - m * m) / rays);
}

double largestOf(const glm::dvec3& v) {
    return std::max({v.x, v.y, v.z});
}

// Parts of (‖r‖ + ‖ρ δF B‖) / (1 - ‖ρ F‖) for each colour; the colour whose sum is largest.
std::optional<ErrorBound> boundOf(const glm::dvec3& residual,
                                  const std::optional<glm::dvec3>& sampling,
                                  const glm::dvec3& returned) {
    if (!(largestOf(returned) < 1.0))
        return std::nullopt;
    ErrorBound bound;
    if (sampling)
        bound.sampling = 0.0;
    for (int c = 0; c < 3; ++c) {
        const double solving = residual[c] / (1.0 - returned[c]);
        const double sampled = sampling ? (*sampling)[c] / (1.0 - returned[c]) : 0.0;
        if (solving + sampled > bound.solving + bound.sampling.value_or(0.0)) {
            bound.solving = solving;
            if (sampling)
                bound.sampling = sampled;
        }
    }
    return bound;
}

// Of the power, W, that arrives at each element when senders shoot so much of the mean of their
// elements, and what a ray brings at most. What was not by rays has none.
struct ShotNoise {
    std::vector<glm::dvec3> variance;
    glm::dvec3 ofOneRay{0.0};
    bool byRays = true; // all of it
};
ShotNoise shotNoiseOf(const Problem& problem, const FactorMatrix& rows,
                      std::span<const glm::dvec3> shotByElements) {
    ShotNoise noise{std::vector<glm::dvec3>(problem.size(), glm::dvec3(0.0))};
    const std::vector<double> areas = senderAreas(problem);
    const std::vector<glm::dvec3> shot = senderMeans(problem, shotByElements);
    for (std::uint32_t j = 0; j < problem.senders(); ++j) {
        if (shot[j] == glm::dvec3(0.0))
            continue;
        if (!rows.has(j) || rows.rays(j) == 0) {
            noise.byRays = false;
            continue;
        }
        const auto rays = static_cast<double>(rows.rays(j));
        const glm::dvec3 ray = areas[j] * shot[j] / rays;
        noise.ofOneRay = glm::max(noise.ofOneRay, glm::abs(ray));
        for (const FactorRow::Share& share : rows.row(j))
            noise.variance[share.element] +=
                ray * ray * rays * double{share.factor} * (1.0 - double{share.factor});
    }
    return noise;
}

} // namespace

std::vector<double> gatheredNoise(const Problem& problem, const FactorMatrix& factors,
                                  std::span<const glm::dvec3> radiosity) {
    std::vector<double> result(problem.size(), 0.0);
    for (std::uint32_t i = 0; i < problem.size(); ++i) {
        const double rays = factors.has(i) ? factors.rays(i) : 0.0;
        if (!(rays > 0.0))
            continue;
        glm::dvec3 mean(0.0), meanSquare(0.0);
        for (const FactorRow::Share& share : factors.row(i)) {
            const glm::dvec3& B = radiosity[share.element];
            mean += double{share.factor} * B;
            meanSquare += double{share.factor} * B * B;
        }
        for (int c = 0; c < 3; ++c)
            result[i] += standardError(mean[c], meanSquare[c], 0.0, rays);
    }
    return result;
}

std::vector<double> shotNoise(const Problem& problem, const FactorMatrix& rows,
                              std::span<const glm::dvec3> shot) {
    const ShotNoise noise = shotNoiseOf(problem, rows, shot);
    std::vector<double> result;
    for (std::size_t i = 0; i < problem.size(); ++i)
        result.push_back(magnitude(glm::sqrt(noise.variance[i])) / problem.areas[i]);
    return result;
}

std::optional<ErrorBound> unsolvedBound(const Problem& problem, const glm::dvec3& change) {
    glm::dvec3 returned(0.0);
    for (const glm::dvec3& rho : problem.reflectance)
        returned = glm::max(returned, rho);
    return boundOf(change, std::nullopt, returned);
}

double normalDeviate(double outside) {
    double low = 0.0, high = 40.0; // erfc() is 0 in double precision from 38.6 on
    for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high);
        (std::erfc(middle / std::sqrt(2.0)) > outside ? low : high) = middle;
    }
    return high;
}

std::optional<ErrorBound> gatheringBound(const Problem& problem, const FactorMatrix& factors,
                                         std::span<const glm::dvec3> radiosity) {
    const std::size_t n = problem.size();
    const double z = deviateOfEach(4 * n); // three colours and the sum of a row
    glm::dvec3 brightest(0.0), residual(0.0), sampling(0.0), returned(0.0);
    for (const glm::dvec3& B : radiosity)
        brightest = glm::max(brightest, B);
    bool byRays = true;
    for (std::uint32_t i = 0; i < n; ++i) {
        glm::dvec3 mean(0.0), meanSquare(0.0);
        double sum = 0.0;
        for (const FactorRow::Share& share : factors.row(i)) {
            const glm::dvec3& B = radiosity[share.element];
            mean += double{share.factor} * B;
            meanSquare += double{share.factor} * B * B;
            sum += double{share.factor};
        }
        const glm::dvec3& rho = problem.reflectance[i];
        residual = glm::max(residual, glm::abs(problem.emission[i] + rho * mean - radiosity[i]));
        const double rays = factors.rays(i);
        byRays = byRays && rays > 0.0;
        if (rays > 0.0) {
            for (int c = 0; c < 3; ++c)
                sampling[c] = std::max(
                    sampling[c],
                    rho[c] * z * standardError(mean[c], meanSquare[c], brightest[c], rays));
            sum = std::min(1.0, sum + z * standardError(sum, sum, 1.0, rays));
        }
        returned = glm::max(returned, rho * sum);
    }
    return boundOf(residual, byRays ? std::optional(sampling) : std::nullopt, returned);
}

std::optional<ErrorBound> shootingBound(const Problem& problem, const FactorMatrix& rows,
                                        std::span<const glm::dvec3> shotByElements,
                                        std::span<const glm::dvec3> unshotByElements) {
    const std::size_t n = problem.size();
    const double z = deviateOfEach(3 * n);
    const ShotNoise noise = shotNoiseOf(problem, rows, shotByElements);
    glm::dvec3 residual(0.0), returned(0.0);
    for (const glm::dvec3& rho : problem.reflectance)
        returned = glm::max(returned, rho); // rows of true factors: 1 at most
    for (const glm::dvec3& unshot : senderMeans(problem, unshotByElements))
        residual = glm::max(residual, glm::abs(unshot));
    glm::dvec3 sampling(0.0);
    for (std::uint32_t i = 0; i < n; ++i)
        sampling =
            glm::max(sampling, problem.reflectance[i] * z *
                                   glm::sqrt(noise.variance[i] + noise.ofOneRay * noise.ofOneRay) /
                                   problem.areas[i]);
    return boundOf(residual, noise.byRays ? std::optional(sampling) : std::nullopt, returned);
}

} // namespace patina::radiosity
