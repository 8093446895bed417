// Names of files that are being written, beside the file that each of them becomes.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace patina {

// ".NAME.PROCESS-HOST-RANDOM.part" beside `path`: given once, whoever else writes the same file, in
// this process, in another or on another machine.
[[nodiscard]] std::filesystem::path temporaryPath(const std::filesystem::path& path);

// Whether `name` is that of a temporary file whose process, of this machine, has ended.
// `finalName`: only of that file; empty: of any.
[[nodiscard]] bool isAbandoned(std::string_view name, std::string_view finalName = {});

} // namespace patina
