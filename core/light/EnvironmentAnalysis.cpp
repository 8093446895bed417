#include "core/light/EnvironmentAnalysis.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace patina {

EnvironmentAnalysisPtr analyseEnvironment(const ImagePtr& environment, const JobContext& job) {
    auto analysis = std::make_shared<EnvironmentAnalysis>();
    analysis->environment = environment;
    const std::span<const float> samples = environment->f32();
    if (std::any_of(samples.begin(), samples.end(),
                    [](float v) { return !(v >= 0.0f) || !std::isfinite(v); })) {
        auto repaired = std::make_shared<Image>(*environment);
        analysis->invalidSamples = sanitizeHdr(*repaired);
        analysis->environment = std::move(repaired);
    }
    if (job.cancelled())
        return nullptr;
    analysis->bands = computeShBands(*analysis->environment, job);
    if (job.cancelled())
        return nullptr;
    return analysis;
}

} // namespace patina
