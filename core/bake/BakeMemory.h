// How much memory a bake will take, and what to do when there is less.
#pragma once

#include "core/bake/domain/BakeRequest.h"
#include "core/base/Result.h"
#include "core/trace/BakeInputs.h"

#include <cstdint>
#include <string>

namespace patina {

struct BakeEstimate {
    std::uint64_t elements = 0; // vertices, or texels at most
    std::uint64_t rays = 0;     // at most
    std::uint64_t bytes = 0;    // at the most expensive moment, on top of the scene
};

[[nodiscard]] BakeEstimate estimateBake(const BakeRequest& request, const BakeInputs& inputs);

// Errors (Usage): the bake does not fit into `available` bytes; the message says which settings
// would. 0: whatever it takes is there.
Result<void> checkBakeMemory(const BakeRequest& request, const BakeInputs& inputs,
                             std::uint64_t available);

// How many textures of an AoTexel bake fit at a time (core/bake/OcclusionTextures.h); 0:
// none does.
[[nodiscard]] std::size_t texturesAtOnce(const BakeRequest& request, const BakeInputs& inputs,
                                         std::uint64_t available);

[[nodiscard]] std::string memoryText(std::uint64_t bytes); // "640 MiB", "1.4 GiB"

} // namespace patina
