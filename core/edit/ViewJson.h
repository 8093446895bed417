// How a document was looked at, for files and reports.
#pragma once

#include "core/document/View.h"
#include "core/math/Camera.h"

#include <nlohmann/json_fwd.hpp>

namespace patina {

[[nodiscard]] nlohmann::ordered_json describeCamera(const Camera& camera);
// Into `settings`: exposure, tone curve, lighting mode.
void describeView(nlohmann::ordered_json& settings, const View& view);

} // namespace patina
