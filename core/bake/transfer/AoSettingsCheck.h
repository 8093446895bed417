// Checking the settings that both ambient occlusion bakes share.
#pragma once

#include "core/bake/domain/BakeRequest.h"
#include "core/bake/transfer/Passes.h"

namespace patina {

// maxDistance is still in metres. Errors: Usage.
Result<PassSettings> aoPassSettings(const AoSettings& settings);

} // namespace patina
