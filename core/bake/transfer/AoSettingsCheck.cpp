#include "core/bake/transfer/AoSettingsCheck.h"

#include <cmath>
#include <fmt/format.h>

namespace patina {

Result<PassSettings> aoPassSettings(const AoSettings& settings) {
    const Result<int> samples = roundSamples(settings.samples);
    if (!samples)
        return samples.error();
    if (!std::isfinite(settings.maxDistance) || settings.maxDistance < 0.0f)
        return Error{
            ErrorKind::Usage,
            fmt::format("The distance of ambient occlusion is 0 (unlimited) or a number of "
                        "metres, not {}.",
                        settings.maxDistance),
            {},
            {}};
    PassSettings passes;
    passes.samples = *samples;
    passes.maxDistance = settings.maxDistance;
    passes.seed = settings.seed;
    return passes;
}

} // namespace patina
