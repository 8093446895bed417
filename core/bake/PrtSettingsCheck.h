// Checking and describing the settings that all transfer bakes share.
#pragma once

#include "core/bake/domain/BakeRequest.h"
#include "core/bake/transfer/Passes.h"

#include <map>
#include <string>

namespace patina {

Result<PassSettings> prtPassSettings(const PrtSettings& settings); // Errors: Usage.
[[nodiscard]] std::map<std::string, std::string>
prtSettingsText(BakeKind kind, const PrtSettings& settings, int samples);

} // namespace patina
