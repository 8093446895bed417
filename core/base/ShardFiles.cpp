#include "core/base/ShardFiles.h"

#include "core/base/Check.h"

#include <algorithm>
#include <cstddef>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace patina {
namespace {

constexpr std::size_t kMostNamed = 20; // of those that are missing

} // namespace

Result<void> checkShardFiles(std::span<const ShardFile> files) {
    CHECK(!files.empty());
    const ShardFile& first = files.front();
    std::map<int, const ShardFile*> known;
    for (const ShardFile& file : files) {
        const auto broken = [&](std::string message) {
            return Error{ErrorKind::InputBroken, std::move(message), file.file, {}};
        };
        if (file.count != first.count)
            return broken(fmt::format("it is one of {} parts, {} is one of {}", file.count,
                                      first.file.string(), first.count));
        if (const auto [there, isNew] = known.try_emplace(file.index, &file); !isNew)
            return broken(fmt::format("it is part {} of {}, and so is {}", file.index + 1,
                                      file.count, there->second->file.string()));
    }
    const std::size_t missing = static_cast<std::size_t>(first.count) - known.size();
    if (missing == 0)
        return {};
    std::vector<int> named;
    for (int index = 0; named.size() < std::min(missing, kMostNamed); ++index)
        if (!known.contains(index))
            named.push_back(index + 1);
    const std::string more =
        missing > named.size() ? fmt::format(" and {} more", missing - named.size()) : "";
    return Error{ErrorKind::InputMissing,
                 fmt::format("of {} parts, {}{} {} missing; name {} too", first.count,
                             fmt::join(named, ", "), more, missing == 1 ? "is" : "are",
                             missing == 1 ? "it" : "them"),
                 {},
                 {}};
}

} // namespace patina
