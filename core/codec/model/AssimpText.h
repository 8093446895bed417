// Text that Assimp 5.2.5 takes for damaged although it is right, in a spelling that it reads.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace patina::codec {

// Each returns nothing where the text needs no change, and takes linear time.

// OBJ: UTF-8, lines begin without blanks, and numbers of vertices with a digit. Big-endian UTF-16
// had no faces; an indented line was left out; "v .5 0 0" had two numbers.
[[nodiscard]] std::optional<std::string> objForAssimp(std::string_view text);
// COLLADA: no white space between a tag and the number that its text begins with.
[[nodiscard]] std::optional<std::string> colladaForAssimp(std::string_view text);

} // namespace patina::codec
