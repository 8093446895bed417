#include "core/bake/PrtSettingsCheck.h"

#include "core/bake/bounce/Interreflection.h"
#include "core/math/SphericalHarmonics.h"

#include <cmath>
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
    if (!std::isfinite(settings.tolerance) || settings.tolerance < 0.0f)
        return Error{
            ErrorKind::Usage,
            fmt::format("The tolerance of a bake is 0 (cast every ray) or a small positive "
                        "number, not {}.",
                        settings.tolerance),
            {},
            {}};
    if (settings.tolerance > 0.0f && settings.method == SampleMethod::Stratified)
        return Error{ErrorKind::Usage,
                     "Stratified samples come in one pass, which cannot tell its error: leave out "
                     "the tolerance, or sample by the method \"qmc\".",
                     {},
                     {}};
    if (settings.transfer == TransferKind::Interreflected)
        if (std::optional<Error> error = checkBounceSettings(settings))
            return *std::move(error);
    PassSettings passes;
    passes.samples = *samples;
    passes.shOrder = settings.order;
    passes.unshadowed = settings.transfer == TransferKind::Unshadowed;
    passes.seed = settings.seed;
    passes.method = settings.method;
    passes.tolerance = settings.tolerance;
    return passes;
}

} // namespace patina
