// Checking the settings that all transfer bakes share.
#pragma once

#include "core/bake/domain/BakeRequest.h"
#include "core/bake/transfer/Passes.h"

namespace patina {

Result<PassSettings> prtPassSettings(const PrtSettings& settings); // Errors: Usage.

} // namespace patina
