// The files that the shards of one piece of work wrote: whether all of them are there.
#pragma once

#include "core/base/Result.h"

#include <filesystem>
#include <span>

namespace patina {

struct ShardFile {
    std::filesystem::path file;
    int index = 0, count = 1; // part `index` of `count`, 0…count - 1
};

// Whether every part is there once; `files`, which is not empty, may be in any order. Errors:
// InputBroken, naming the file, for a part of another number of parts and for one that is there
// twice; InputMissing where some are missing, with their numbers.
Result<void> checkShardFiles(std::span<const ShardFile> files);

} // namespace patina
