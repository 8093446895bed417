// A sweep of lights without any cleverness: one light after the other, one pixel after the other,
// in double precision, all pictures kept.
#pragma once

#include "core/rank/LightSweep.h"

namespace patina::test {

[[nodiscard]] LightSweep referenceSweep(const SweepPixels& pixels,
                                        const std::vector<SweepEnvironment>& environments,
                                        const SweepSettings& settings);

} // namespace patina::test
