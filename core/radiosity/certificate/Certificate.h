// The Cornell box by every way of computing its light, against the irradiance that is known of it:
// what Patina's path tracer and radiosity are worth, as numbers.
#pragma once

#include "core/base/Result.h"
#include "core/job/JobContext.h"
#include "core/library/CornellPoints.h"
#include "core/radiosity/FormFactors.h"
#include "core/radiosity/Solve.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace patina::radiosity {

struct CertificateSettings {
    std::uint32_t paths = 32768; // per point; a multiple of kPathBatches is traced
    double edge = 0.06;          // metres: no element's is longer; half that close to a point
    // FactorSettings::resolution of each method.
    int rays = 8192, hemicube = 32, paraboloid = 64, analytic = 16;
    int lightSamples = 256;           // SceneProblemSettings
    std::uint32_t gatherRays = 65536; // by which a point gathers the light of the elements
    double residual = 1e-4;           // SolveSettings
    std::uint32_t seed = 1;

    // Their spread is the path tracer's standard error.
    static constexpr std::uint32_t kPathBatches = 64;
};

// One way of computing light, and what it says.
struct Estimator {
    struct Radiosity {
        FactorMethod factors;
        Solver solver;
    };
    std::optional<Radiosity> radiosity; // nothing: the path tracer
    // Of each of library::cornellPoints(), W/m².
    std::vector<library::CornellValues> irradiance;
    std::vector<library::CornellValues> standardErrors; // of the path tracer; else empty

    [[nodiscard]] std::string name() const; // "raycast, progressive"

    // Radiosity has the error of its division: this share of the reference is allowed.
    static constexpr double kRadiosityTolerance = 0.02;
    // Standard errors of the estimate and of the reference together.
    static constexpr double kPathTolerance = 4.0;
    // From the reference, as a share of it.
    [[nodiscard]] double deviation(std::size_t point, std::size_t channel) const;
    // The same in what is allowed: above 1 it is too much.
    [[nodiscard]] double shareOfTolerance(std::size_t point, std::size_t channel) const;
};

// Of all points and channels.
struct EstimatorSummary {
    double largest = 0.0, mean = 0.0;        // deviations without their sign
    std::size_t point = 0, channel = 0;      // of the largest
    double largestOfTolerance = 0.0;         // shareOfTolerance()
    std::optional<double> meanStandardError; // as a share of the reference
    [[nodiscard]] bool holds() const { return largestOfTolerance <= 1.0; }
};
[[nodiscard]] EstimatorSummary summarize(const Estimator& estimator);

struct Certificate {
    std::vector<Estimator> estimators; // the path tracer first
    std::size_t elementsEmpty = 0, elementsWithBlocks = 0;
};

// Any of the form factors, each with progressive shooting, gathering and, where the box has no more
// than kMaxDirect elements, the exact solution. Errors: Usage for divisions of more than
// ElementLimits::maxElements; Cancelled; those of solve().
Result<Certificate> makeCertificate(const CertificateSettings& settings, const JobContext& job);

} // namespace patina::radiosity
