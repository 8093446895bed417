// Small pictures as QOI ("Quite OK Image", qoiformat.org, specification of 2022-01-05): lossless,
// and so plain that a file of anybody's can be decoded in this process.
#pragma once

#include "core/image/Image.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace patina {

// U8, three channels, sRGB.
[[nodiscard]] std::vector<std::byte> encodeQoi(const Image& image);
// U8, three channels (a file's alpha is left out), sRGB. Nothing where it is no such file, is cut
// off, or is larger than `maxSide` a side.
[[nodiscard]] std::optional<Image> decodeQoi(std::span<const std::byte> file, int maxSide);

} // namespace patina
