#pragma once

#include <string>

namespace patina::codec {

// Thrown where a file is not read here exactly as OpenImageIO reads it: the worker with OpenImageIO
// gets it then, and has the last word on what is damaged.
struct HandOn {
    std::string reason; // for debugging
};

} // namespace patina::codec
