// How a project file names other files: relative to its own folder, with forward slashes, so that a
// project can move together with what it uses. On Linux a file name is bytes: "%" and bytes that
// are not UTF-8 are written as %XX, so that every name survives JSON.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace patina {

// `source`: as in MapSlot::source. builtin:NAME and the empty text stay as they are.
[[nodiscard]] std::string toProjectPath(const std::string& source,
                                        const std::filesystem::path& projectFile);
// The inverse; nothing when the text holds a NUL, which no file name can.
[[nodiscard]] std::optional<std::string> fromProjectPath(const std::string& text,
                                                         const std::filesystem::path& projectFile);

} // namespace patina
