// The errors of estimators as JSON.
#pragma once

#include "core/trace/blame/Blame.h"
#include "core/trace/error/PictureError.h"

#include <nlohmann/json_fwd.hpp>

namespace patina {

struct Document;

// {"flip", "flipNoise", "biasEv", "biasEvNoise", "relative"}; materials by name.
[[nodiscard]] nlohmann::ordered_json scoreJson(const ErrorScore& score);
[[nodiscard]] nlohmann::ordered_json errorJson(const PictureError& error, const Document& document);
// {"relative", "causes": [{"cause", "share", "shareNoise", "relative", "bias"}], "largest",
// "remedy"}; materials by name. Shares are null while the error is within its noise.
[[nodiscard]] nlohmann::ordered_json blameJson(const Blame& blame, const Document& document);

} // namespace patina
