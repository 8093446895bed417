#include "core/radiosity/FormFactors.h"

#include "core/job/Parallel.h"
#include "core/radiosity/AnalyticFactors.h"
#include "core/radiosity/HemicubeFactors.h"
#include "core/radiosity/ParaboloidFactors.h"
#include "core/radiosity/RayFactors.h"

#include <algorithm>
#include <chrono>

namespace patina::radiosity {

double FactorRow::sum() const {
    double total = 0.0;
    for (const Share& share : shares)
        total += share.factor;
    return total;
}

double expectedSeconds(const FormFactors& factors, std::size_t senders, const JobContext& job) {
    if (senders == 0)
        return 0.0;
    // All over the scene, as many as keep every thread busy.
    const std::size_t count =
        std::min(senders, 2 * static_cast<std::size_t>(std::max(threadCount(), 1)));
    const auto begin = std::chrono::steady_clock::now();
    parallelFor(job, count, 1, [&](std::size_t from, std::size_t to) {
        FactorRow row;
        for (std::size_t i = from; i < to; ++i)
            factors.row(static_cast<std::uint32_t>(i * senders / count), row);
    });
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    return took.count() * static_cast<double>(senders) / static_cast<double>(count);
}

std::string_view name(FactorMethod method) {
    switch (method) {
    case FactorMethod::Rays:
        return "raycast";
    case FactorMethod::Hemicube:
        return "hemicube";
    case FactorMethod::Analytic:
        return "analytic";
    case FactorMethod::Paraboloid:
        break;
    }
    return "paraboloid";
}

ResolutionRange resolutionRange(FactorMethod method) {
    switch (method) {
    case FactorMethod::Rays:
        return {256, 1, 1 << 20};
    case FactorMethod::Hemicube:
        return {256, 2, 4096};
    case FactorMethod::Analytic:
        return {64, 1, 65536};
    case FactorMethod::Paraboloid:
        break;
    }
    return {512, 2, 4096}; // in the middle a texel is as large as a cell of a hemicube of 256
}

Result<std::unique_ptr<FormFactors>>
makeFormFactors(const ElementMesh& elements, const RayScene& rays, const FactorSettings& settings) {
    using Made = std::unique_ptr<FormFactors>;
    switch (settings.method) {
    case FactorMethod::Rays:
        return Made(std::make_unique<RayFactors>(elements, rays, settings));
    case FactorMethod::Hemicube:
        return HemicubeFactors::make(elements, rays, settings);
    case FactorMethod::Analytic:
        return Made(std::make_unique<AnalyticFactors>(elements, rays, settings));
    case FactorMethod::Paraboloid:
        break;
    }
    return Made(std::make_unique<ParaboloidFactors>(elements, rays, settings));
}

} // namespace patina::radiosity
