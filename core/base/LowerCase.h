// Names compared without regard to case: extensions, endings of file names. ASCII only; other
// characters stay as they are.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace patina {

[[nodiscard]] std::string lowerCase(std::string_view text);
// In lower case, with the dot: ".glb"; empty for a name without one.
[[nodiscard]] std::string extensionOf(const std::filesystem::path& path);

} // namespace patina
