// The errors of estimators as JSON.
#pragma once

#include "core/trace/error/PictureError.h"

#include <nlohmann/json_fwd.hpp>

namespace patina {

struct Document;

// {"flip", "flipNoise", "biasEv", "biasEvNoise", "relative"}; materials by name.
[[nodiscard]] nlohmann::ordered_json scoreJson(const ErrorScore& score);
[[nodiscard]] nlohmann::ordered_json errorJson(const PictureError& error, const Document& document);

} // namespace patina
