// UTF-8, for texts that come from files and file names.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace patina {

// The length in bytes (1…4) of the valid UTF-8 sequence that `text` begins with (Unicode 15,
// table 3-7: no overlong forms, no surrogates, at most U+10FFFF); 0 when it begins with none.
[[nodiscard]] std::size_t utf8SequenceLength(std::string_view text);

// Each byte that belongs to no valid sequence becomes U+FFFD.
[[nodiscard]] std::string makeValidUtf8(std::string_view text);

// A text in UTF-16 that begins with a byte order mark, in UTF-8 and without it; nothing where it
// begins with none. What is no character becomes U+FFFD.
[[nodiscard]] std::optional<std::string> utf8FromUtf16(std::string_view text);

} // namespace patina
