// Files whose names the user did not choose: bakes beside a project, checkpoints, caches, textures
// of an export. A link in the place of one was put there by somebody else, with an archive or a
// shared folder, and would lead the data to a file that nobody meant: it is never followed.
#pragma once

#include "core/base/AtomicFile.h"

namespace patina {

// As writeFileAtomically(), but what is at `path` is replaced whatever it is: a link itself and not
// what it leads to, a pipe or a device too. A folder is CannotCreate.
Result<void> writeOwnFile(const std::filesystem::path& path, std::span<const std::byte> data);
Result<void> writeOwnPieces(const std::filesystem::path& path,
                            std::span<const std::span<const std::byte>> pieces);

// Creates the folder of such files inside of one that exists; fine when it is there. CannotCreate
// when the folder around it is missing, or when a link or a file is in its place.
Result<void> makeOwnFolder(const std::filesystem::path& folder);

} // namespace patina
