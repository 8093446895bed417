// Small scenes with everything that sends or stops light but glass, for tests of what paths find.
#pragma once

#include "core/trace/path/PathTracer.h"
#include "core/trace/path/TraceInputs.h"
#include "tests/reference/PictureReference.h"

#include <array>
#include <cstdint>
#include <vector>

namespace patina::test {

struct BiasScene {
    TraceInputs inputs;
    TraceView view;
    std::vector<reference::SkyPart> bright; // of the sky
    // Of a pixel and a seed, by both searches, lights alone and surfaces alone: so many that the
    // means are near normal.
    std::array<std::uint32_t, 3> samples{16, 16, 16};
    int referencePaths = 24;
};

// A room without ceiling, seen through the back of a wall, with a block; under a sky.
[[nodiscard]] BiasScene openRoom();
// A ball of few triangles, half metal, on a floor; two skies, one with a sun.
[[nodiscard]] BiasScene glossyBall();
// Sphere, rectangle, disc, point and a spot without shadow over rough metal and a block.
[[nodiscard]] BiasScene lightsOverMetal();
// Glowing surfaces, one of them blended and one cut out, and a blended sheet in the sun.
[[nodiscard]] BiasScene glowAndAlpha();

} // namespace patina::test
