#include "core/radiosity/certificate/Certificate.h"

#include "core/job/Parallel.h"
#include "core/math/Sampling.h"
#include "core/radiosity/DirectSolution.h"
#include "core/radiosity/certificate/CertificateBox.h"
#include "core/trace/BakeInputs.h"
#include "core/trace/path/PathTracer.h"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <mutex>
#include <utility>

namespace patina::radiosity {
namespace {

using library::CornellPoint;
using library::CornellValues;
using library::kCornellWalls;

constexpr std::array kMethods{FactorMethod::Rays, FactorMethod::Hemicube, FactorMethod::Paraboloid,
                              FactorMethod::Analytic};
constexpr std::array kSolvers{Solver::Progressive, Solver::GaussSeidel, Solver::Direct};

// Rows that have been computed already.
class KeptFactors final : public FormFactors {
  public:
    explicit KeptFactors(const FactorMatrix& matrix)
        : m_matrix(matrix) {}
    void row(std::uint32_t element, FactorRow& row) const override {
        row = m_matrix.whole(element);
    }

  private:
    const FactorMatrix& m_matrix;
};

// The points of one of the boxes, whose numbers run on from `first`.
struct BoxPoints {
    std::span<const CornellPoint> points;
    std::size_t first = 0;
};

BoxPoints pointsOf(bool blocks) {
    const std::span<const CornellPoint> all = library::cornellPoints();
    std::size_t empty = 0;
    while (empty < all.size() && !all[empty].blocks)
        ++empty;
    return blocks ? BoxPoints{all.subspan(empty), empty} : BoxPoints{all.first(empty), 0};
}

Result<void> tracePoints(const CertificateSettings& settings, bool blocks, Estimator& estimator,
                         const JobContext& job) {
    constexpr std::uint32_t kBatches = CertificateSettings::kPathBatches;
    const std::uint32_t samples = (settings.paths + kBatches - 1) / kBatches;
    const BoxPoints box = pointsOf(blocks);
    for (std::size_t set = 0; set < kCornellWalls.size(); ++set) {
        const Result<TraceInputs> inputs = certificateInputs(kCornellWalls[set], blocks);
        if (!inputs)
            return inputs.error();
        const JobContext part =
            job.part(0.5 * static_cast<double>(set), 0.5 * static_cast<double>(set + 1));
        const Result<TraceScene> scene = TraceScene::build(*inputs, part);
        if (!scene)
            return scene.error();
        std::vector<Film::Pixel> found(box.points.size() * kBatches);
        parallelFor(part, found.size(), 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end && !part.cancelled(); ++i) {
                const CornellPoint& point = box.points[i / kBatches];
                PathSettings path;
                path.seed =
                    seedFor(settings.seed + static_cast<std::uint32_t>(set) * 2 + (blocks ? 1 : 0),
                            static_cast<std::uint32_t>(i));
                traceIrradiance(*scene, library::cornellPosition(point.position),
                                glm::vec3(library::cornellDirection(point.normal)), path, samples,
                                found[i]);
            }
        });
        if (part.cancelled())
            return bakeCancelled();
        for (std::size_t p = 0; p < box.points.size(); ++p)
            for (int c = 0; c < 3; ++c) {
                double sum = 0.0, squares = 0.0;
                for (std::uint32_t b = 0; b < kBatches; ++b) {
                    const double mean = found[p * kBatches + b].sum[c] / samples;
                    sum += mean;
                    squares += mean * mean;
                }
                const double mean = sum / kBatches;
                const auto channel = 3 * set + static_cast<std::size_t>(c);
                estimator.irradiance[box.first + p][channel] = mean;
                estimator.standardErrors[box.first + p][channel] =
                    std::sqrt(std::max(0.0, squares / kBatches - mean * mean) / (kBatches - 1));
            }
    }
    return {};
}

FactorSettings factorSettings(FactorMethod method, const CertificateSettings& settings) {
    const int resolution = method == FactorMethod::Rays         ? settings.rays
                           : method == FactorMethod::Hemicube   ? settings.hemicube
                           : method == FactorMethod::Paraboloid ? settings.paraboloid
                                                                : settings.analytic;
    return {method, resolution, settings.seed};
}

// Every solver on the form factors of one method, for both sets of walls. `points`: those of the
// box, of which the first has the number `first` among all.
Result<void> solveBox(const DividedBox& box, const std::vector<SceneProblem>& lit,
                      const FormFactors& factors, std::span<const Solver> solvers,
                      std::span<const GatheringPoint> points, std::size_t first,
                      const CertificateSettings& settings, std::span<Estimator> estimators,
                      const JobContext& job) {
    auto matrix = FactorMatrix::compute(factors, box.elements.size(), 0, job.part(0.0, 0.8));
    if (!matrix)
        return matrix.error();
    const KeptFactors kept(*matrix);
    std::mutex mutex;
    Result<void> result;
    const JobContext rest = job.part(0.8, 1.0);
    parallelFor(rest, solvers.size() * lit.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end && !rest.cancelled(); ++i) {
            const std::size_t set = i % lit.size();
            SolveSettings solving;
            solving.solver = solvers[i / lit.size()];
            solving.residual = settings.residual;
            solving.maxBytes = 0;
            const Result<Solved> solved = solve(lit[set].problem, kept, solving, rest);
            if (!solved) {
                const std::scoped_lock lock(mutex);
                result = solved.error();
                return;
            }
            Estimator& estimator = estimators[i / lit.size()];
            for (std::size_t p = 0; p < points.size(); ++p) {
                const glm::dvec3 light = points[p].irradiance(solved->solution);
                for (int c = 0; c < 3; ++c)
                    estimator.irradiance[first + p][3 * set + static_cast<std::size_t>(c)] =
                        light[c];
            }
        }
    });
    if (rest.cancelled())
        return bakeCancelled();
    return result;
}

} // namespace

std::string Estimator::name() const {
    return radiosity ? fmt::format("{}, {}", radiosity::name(radiosity->factors),
                                   radiosity::name(radiosity->solver))
                     : "path tracer";
}

double Estimator::deviation(std::size_t point, std::size_t channel) const {
    return irradiance[point][channel] / library::cornellPoints()[point].irradiance(channel) - 1.0;
}

double Estimator::shareOfTolerance(std::size_t point, std::size_t channel) const {
    const CornellPoint& truth = library::cornellPoints()[point];
    const double apart = std::abs(irradiance[point][channel] - truth.irradiance(channel));
    if (standardErrors.empty())
        return apart / (kRadiosityTolerance * truth.irradiance(channel));
    return apart / (kPathTolerance *
                    std::hypot(standardErrors[point][channel], truth.standardError(channel)));
}

EstimatorSummary summarize(const Estimator& estimator) {
    EstimatorSummary summary;
    const std::span<const CornellPoint> points = library::cornellPoints();
    double errors = 0.0;
    for (std::size_t p = 0; p < points.size(); ++p)
        for (std::size_t c = 0; c < library::kCornellChannels; ++c) {
            const double deviation = std::abs(estimator.deviation(p, c));
            summary.mean += deviation;
            if (deviation > summary.largest) {
                summary.largest = deviation;
                summary.point = p;
                summary.channel = c;
            }
            summary.largestOfTolerance =
                std::max(summary.largestOfTolerance, estimator.shareOfTolerance(p, c));
            if (!estimator.standardErrors.empty())
                errors += estimator.standardErrors[p][c] / points[p].irradiance(c);
        }
    const double count = static_cast<double>(points.size() * library::kCornellChannels);
    summary.mean /= count;
    if (!estimator.standardErrors.empty())
        summary.meanStandardError = errors / count;
    return summary;
}

Result<Certificate> makeCertificate(const CertificateSettings& settings, const JobContext& job) {
    Certificate result;
    const std::size_t points = library::cornellPoints().size();
    job.setActivity("tracing paths");
    Estimator& paths = result.estimators.emplace_back();
    paths.irradiance.resize(points);
    paths.standardErrors.resize(points);
    for (const bool blocks : {false, true}) {
        const double start = blocks ? 0.1 : 0.0;
        if (Result<void> traced =
                tracePoints(settings, blocks, paths, job.part(start, start + 0.1));
            !traced)
            return traced.error();
    }

    // Both boxes are divided first: which solvers there are depends on how finely.
    std::array<std::unique_ptr<DividedBox>, 2> boxes;
    std::array<std::vector<SceneProblem>, 2> lit; // for each set of walls
    std::array<std::vector<GatheringPoint>, 2> gathering;
    job.setActivity("collecting light");
    for (const bool blocks : {false, true}) {
        const JobContext part = job.part(blocks ? 0.25 : 0.2, blocks ? 0.3 : 0.25);
        for (const library::CornellWalls& walls : kCornellWalls) {
            const Result<TraceInputs> inputs = certificateInputs(walls, blocks);
            if (!inputs)
                return inputs.error();
            auto box = DividedBox::make(*inputs, settings.edge, pointsOf(blocks).points, part);
            if (!box)
                return box.error();
            auto problem = SceneProblem::make((*box)->scene, (*box)->elements,
                                              {settings.lightSamples, settings.seed, false}, part);
            if (!problem)
                return problem.error();
            lit[blocks].push_back(std::move(*problem));
            boxes[blocks] = std::move(*box); // the same for all walls
        }
        gathering[blocks].resize(pointsOf(blocks).points.size());
        parallelFor(part, gathering[blocks].size(), 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t p = begin; p < end && !part.cancelled(); ++p)
                gathering[blocks][p] =
                    gatherAt(*boxes[blocks], pointsOf(blocks).points[p], settings.gatherRays,
                             seedFor(settings.seed, static_cast<std::uint32_t>(2 * p + blocks)));
        });
        if (part.cancelled())
            return bakeCancelled();
    }
    result.elementsEmpty = boxes[0]->elements.size();
    result.elementsWithBlocks = boxes[1]->elements.size();

    std::vector<Solver> solvers;
    for (const Solver solver : kSolvers)
        if (solver != Solver::Direct ||
            std::max(result.elementsEmpty, result.elementsWithBlocks) <= kMaxDirect)
            solvers.push_back(solver);
    double done = 0.3;
    for (const FactorMethod method : kMethods) {
        const std::size_t first = result.estimators.size();
        for (const Solver solver : solvers)
            result.estimators.push_back(
                {Estimator::Radiosity{method, solver}, std::vector<CornellValues>(points), {}});
        job.setActivity(fmt::format("computing form factors ({})", name(method)));
        for (const bool blocks : {false, true}) {
            const double share = 0.7 / kMethods.size() * (blocks ? 0.6 : 0.4);
            const DividedBox& box = *boxes[blocks];
            const auto factors =
                makeFormFactors(box.elements, *box.scene.rays(), factorSettings(method, settings));
            if (!factors)
                return factors.error();
            if (Result<void> solved = solveBox(box, lit[blocks], **factors, solvers,
                                               gathering[blocks], pointsOf(blocks).first, settings,
                                               std::span(result.estimators).subspan(first),
                                               job.part(done, done + share));
                !solved)
                return solved.error();
            done += share;
        }
    }
    return result;
}

} // namespace patina::radiosity
