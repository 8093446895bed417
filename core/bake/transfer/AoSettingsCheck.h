// Checking and describing the settings that both ambient occlusion bakes share.
#pragma once

#include "core/bake/domain/BakeRequest.h"
#include "core/bake/transfer/Passes.h"

#include <map>
#include <string>

namespace patina {

// maxDistance is still in metres. Errors: Usage.
Result<PassSettings> aoPassSettings(const AoSettings& settings);
[[nodiscard]] std::map<std::string, std::string>
aoSettingsText(BakeKind kind, const AoSettings& settings, int samples);

} // namespace patina
