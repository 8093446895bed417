// What every measure asks of two images before it compares them. Seen by this module only.
#pragma once

#include "core/base/Result.h"
#include "core/image/Image.h"

namespace patina::compare {

// Errors: Usage for images that are empty, differ in size (both sizes are named), or have numbers
// of channels without a common meaning.
Result<void> checkComparable(const Image& image, const Image& reference);

// The same for measures of what is seen: also at most four channels, and no NaN or infinity
// (InputBroken, with their number).
Result<void> checkPictures(const Image& image, const Image& reference);

// "3 samples are NaN or infinite …"
Error notFiniteError(std::size_t count);

} // namespace patina::compare
