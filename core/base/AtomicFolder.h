// Writing a folder of files so that it appears under its name complete or not at all. The files are
// written without names and synchronised first; a crash before the last moment leaves nothing.
#pragma once

#include "core/base/AtomicFile.h"

#include <functional>

namespace patina {

struct FolderFile {
    std::string name; // without folders
    Bytes data;
};

// Whether an existing folder may be replaced by a new one, which removes all it holds.
using MayReplaceFolder = std::function<bool(const std::filesystem::path& folder)>;

// CannotCreate when `folder` could not be written: it is a file, its own folder is missing or not
// writable, or it holds something that `mayReplace` does not allow to go. An empty one may always.
Result<void> checkFolderOutput(const std::filesystem::path& folder,
                               const MayReplaceFolder& mayReplace);

// Creates or replaces `folder`, which then holds exactly `files`. Polls `cancelled`; after a cancel
// (ErrorKind::Cancelled) or an error (CannotCreate, Io) everything is as it was before.
Result<void> writeFolderAtomically(const std::filesystem::path& folder,
                                   std::span<const FolderFile> files,
                                   const MayReplaceFolder& mayReplace,
                                   const std::function<bool()>& cancelled);

} // namespace patina
