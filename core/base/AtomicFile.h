// Writing a file so that, whatever happens, either the old or the new content is there in full:
// the data goes to an unnamed file in the same folder, is synchronised, and takes the name in one
// step. A crash leaves nothing behind.
#pragma once

#include "core/base/Result.h"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace patina {

using Bytes = std::vector<std::byte>;

// Replaces or creates `path` with `data`. Symbolic links are followed, the permissions of an
// existing file are kept. Errors: CannotCreate (folder missing or not writable, path is a folder),
// Io (disk full, I/O error); the old content is intact in every case.
Result<void> writeFileAtomically(const std::filesystem::path& path,
                                 std::span<const std::byte> data);
Result<void> writeFileAtomically(const std::filesystem::path& path, std::string_view text);
// The same for data that lies in several places: written one after another, without a copy.
Result<void> writePiecesAtomically(const std::filesystem::path& path,
                                   std::span<const std::span<const std::byte>> pieces);

// Reads a whole file. Errors: InputMissing (missing, unreadable, a folder), InputBroken (larger
// than `maxSize` bytes).
Result<Bytes> readFile(const std::filesystem::path& path, std::size_t maxSize);
Result<std::string> readTextFile(const std::filesystem::path& path, std::size_t maxSize);

} // namespace patina
