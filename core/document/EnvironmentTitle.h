// What an environment is called in lists, exports and scripts.
#pragma once

#include "core/light/Environment.h"

#include <string>

namespace patina {

// The name that the user gave it; else what it shows: "Sky", "Softboxes", "Clear Sky" of
// builtin:clear-sky, or its file's name without folder and extension. Never empty; UTF-8 as far as
// the file's name is.
[[nodiscard]] std::string environmentTitle(const Environment& environment);

} // namespace patina
