// The environment files of a folder.
#pragma once

#include "core/base/Result.h"

#include <filesystem>
#include <vector>

namespace patina {

// .hdr and .exr of the folder by name, not of folders in it; of six faces the first one alone,
// which stands for all. Errors: InputMissing when the folder cannot be read, Usage when it holds
// none.
Result<std::vector<std::filesystem::path>> environmentFilesOf(const std::filesystem::path& folder);

} // namespace patina
