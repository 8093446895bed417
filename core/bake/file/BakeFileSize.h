// How large the files of a bake will be, known before its first ray.
#pragma once

#include "core/bake/domain/BakeRequest.h"
#include "core/bake/domain/BakeStorage.h"
#include "core/base/Result.h"
#include "core/trace/BakeInputs.h"

#include <cstdint>

namespace patina {

// Of its numbers in an OpenEXR file, before compression, which takes some tenths off.
[[nodiscard]] std::uint64_t bakeFileBytes(const BakeRequest& request, const BakeInputs& inputs,
                                          const BakeFileOptions& storage = {});
// The same of all grey pictures of an AoTexel bake, one byte a texel.
[[nodiscard]] std::uint64_t bakePictureBytes(const BakeRequest& request, const BakeInputs& inputs);

// Errors (Usage): more than an OpenEXR file of ours may hold; the message says what would fit.
Result<void> checkBakeFile(const BakeRequest& request, const BakeInputs& inputs);

} // namespace patina
