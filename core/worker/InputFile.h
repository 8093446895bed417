// Opening a file that may be anything: the checks that need no decoder.
#pragma once

#include "core/base/FileDescriptor.h"
#include "core/base/Result.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace patina {

// The message of the error where there is no file of that name.
inline constexpr std::string_view kNoSuchFile =
    "the file does not exist; check its name and folder";

struct InputFile {
    FileDescriptor fd;
    std::size_t size = 0;
    std::string head; // the first bytes, at most 64
};

// Errors: InputMissing (not there, a folder, a pipe or device, no permission), InputBroken (empty,
// larger than `maxSize`). Never blocks.
Result<InputFile> openInputFile(const std::filesystem::path& path, std::size_t maxSize);

} // namespace patina
