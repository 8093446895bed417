// Opening a file that may be anything: the checks that need no decoder.
#pragma once

#include "core/base/FileDescriptor.h"
#include "core/base/Result.h"

#include <cstddef>
#include <filesystem>
#include <string>

namespace patina {

struct InputFile {
    FileDescriptor fd;
    std::size_t size = 0;
    std::string head; // the first bytes, at most 64
};

// Errors: InputMissing (not there, a folder, a pipe or device, no permission), InputBroken (empty,
// larger than `maxSize`). Never blocks.
Result<InputFile> openInputFile(const std::filesystem::path& path, std::size_t maxSize);

} // namespace patina
