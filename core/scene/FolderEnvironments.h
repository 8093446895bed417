// The environment files of a folder, found by their names: nothing is opened.
#pragma once

#include "core/base/Result.h"
#include "core/job/JobContext.h"

#include <cstddef>
#include <filesystem>
#include <vector>

namespace patina {

struct FolderSearch {
    int levels = 1;                    // 1: the folder alone; 2: the folders in it, too …
    std::size_t mostFiles = 10'000;    // environments
    std::size_t mostEntries = 200'000; // names looked at, of files and folders alike
};

struct FolderEnvironments {
    std::vector<std::filesystem::path> files; // by path
    bool complete = true;                     // false: there are more than the search looks for
    std::vector<std::filesystem::path> unreadable; // folders below the first
};

// .hdr and .exr of a folder; of six faces the first one alone, which stands for all. Links to
// folders are not followed below the first, so that no folder is met twice. Errors: InputMissing
// (no such folder, no permission), Cancelled.
Result<FolderEnvironments> environmentFilesOf(const std::filesystem::path& folder,
                                              const FolderSearch& search = {},
                                              const JobContext& job = {});

} // namespace patina
