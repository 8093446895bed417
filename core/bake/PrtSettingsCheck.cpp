#include "core/bake/PrtSettingsCheck.h"

#include "core/bake/Interreflection.h"
#include "core/math/SphericalHarmonics.h"

#include <fmt/format.h>

namespace patina {

Result<PassSettings> prtPassSettings(const PrtSettings& settings) {
    const Result<int> samples = roundSamples(settings.samples, settings.method);
    if (!samples)
        return samples.error();
    if (settings.order < 1 || settings.order > kMaxShOrder)
        return Error{ErrorKind::Usage,
                     fmt::format("The order of a radiance transfer bake is 1 to {}, not {}.",
                                 kMaxShOrder, settings.order),
                     {},
                     {}};
    if (settings.transfer == TransferKind::Interreflected)
        if (std::optional<Error> error = checkBounceSettings(settings))
            return *std::move(error);
    PassSettings passes;
    passes.samples = *samples;
    passes.shOrder = settings.order;
    passes.seed = settings.seed;
    passes.method = settings.method;
    return passes;
}

std::map<std::string, std::string> prtSettingsText(const PrtSettings& settings, int samples) {
    return {{"samples", std::to_string(samples)},
            {"order", std::to_string(settings.order)},
            {"seed", std::to_string(settings.seed)}};
}

} // namespace patina
