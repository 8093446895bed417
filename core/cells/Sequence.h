// Pictures that follow each other: the camera goes round its target, or the environment turns round
// the scene, by equal steps and once.
#pragma once

#include "core/cells/Cell.h"

#include <filesystem>

namespace patina {

enum class Turning { Camera, Environment };

inline constexpr int kMostSequenceFrames = 9999;

// `frame` 0 … count - 1 of `count` > 0; the first is the document as it is, and so would be the one
// after the last, so that a video loops. The environment is the one that lights the scene, where
// two are mixed the first of them.
[[nodiscard]] Cell sequenceCell(const Document& document, Turning turning, int frame, int count);

// "turn.png" → "turn-0001.png"; counted from 1.
[[nodiscard]] std::filesystem::path sequenceFile(const std::filesystem::path& file, int frame);

} // namespace patina
