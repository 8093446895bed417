// OpenColorIO's displays and views, as far as Patina needs them.
#pragma once

#include <string>

namespace patina {

// The OpenColorIO configuration in force: `chosen` where it is not empty, else what the environment
// variable OCIO names; an absolute path. Empty: there is none.
[[nodiscard]] std::string openColorIoConfig(const std::string& chosen);

} // namespace patina
