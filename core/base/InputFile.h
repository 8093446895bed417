// The one way to open a file for reading: it may be anything, a pipe that nobody writes to or a
// device included, and opening it never waits.
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

struct RegularFile {
    FileDescriptor fd;
    std::size_t size = 0; // may be 0
};

// Errors: InputMissing (not there, a folder, a pipe or device, no permission), InputBroken (Git LFS
// has not downloaded it yet).
Result<RegularFile> openRegularFile(const std::filesystem::path& path);

struct InputFile {
    FileDescriptor fd;
    std::size_t size = 0;
    std::string head; // the first bytes, at most 64
};

// Errors: as above; InputBroken (empty, larger than `maxSize`).
Result<InputFile> openInputFile(const std::filesystem::path& path, std::size_t maxSize);

} // namespace patina
