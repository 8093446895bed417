// `patina ladder --blame`: which shortcut of image-based light makes how much of its error.
#pragma once

#include "app/cli/Session.h"
#include "core/io/ImageIO.h"
#include "core/trace/blame/Blame.h"

#include <string>
#include <utility>
#include <vector>

namespace patina::cli {

[[nodiscard]] bool wantsBlame(const LadderOptions& options);
// Usage errors: what blame cannot be said of. `options` wants it.
Result<void> checkBlame(const LadderOptions& options, const View& view);

// A row for each cause, by its share, and what reduces the largest.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> blameTable(const Blame& blame);

// The parts of one file: the traced picture, the drawn one and what each cause lacks in it.
[[nodiscard]] std::vector<ImagePart> blameParts(const Blame& blame, const Image& drawn,
                                                const Image& traced);

} // namespace patina::cli
