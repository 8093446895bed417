#include "core/bake/PrtSettingsCheck.h"

#include "core/bake/BakeOptions.h"
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

std::map<std::string, std::string> prtSettingsText(BakeKind kind, const PrtSettings& settings,
                                                   int samples) {
    BakeRequest request{kind, {}, settings};
    request.prt.samples = samples;
    return settingsText(request);
}

} // namespace patina
