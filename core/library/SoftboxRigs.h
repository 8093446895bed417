// Arrangements of softboxes that photographers use, around a camera at azimuth 30° as the start
// view has it.
#pragma once

#include "core/light/Environment.h"

#include <span>
#include <string>
#include <vector>

namespace patina::library {

struct SoftboxRig {
    std::string title; // "Three-Point"
    std::string help;
    std::vector<Softbox> softboxes; // ids 0
};

// At least one; the first is a good start.
[[nodiscard]] const std::vector<SoftboxRig>& softboxRigs();

} // namespace patina::library
