// What every reader of models says of the limits of core/base/Limits.h.
#pragma once

#include "core/base/Limits.h"

#include <fmt/format.h>
#include <string>

namespace patina::codec {

inline std::string tooManyObjects() {
    return fmt::format("the model has more than the supported {} objects; join some of them and "
                       "export it again",
                       limits::kMaxInstances);
}

} // namespace patina::codec
