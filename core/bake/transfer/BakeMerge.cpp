#include "core/bake/transfer/BakeMerge.h"

#include "core/base/Check.h"
#include "core/base/ShardFiles.h"

#include <algorithm>
#include <fmt/format.h>

namespace patina {
namespace {

Error broken(const BakePart& part, std::string message) {
    return {ErrorKind::InputBroken, std::move(message), part.file, {}};
}

} // namespace

Result<std::vector<BakePart>> readBakeParts(std::span<const std::filesystem::path> files) {
    CHECK(!files.empty());
    std::vector<BakePart> parts;
    for (const std::filesystem::path& file : files) {
        Result<BakeManifest> manifest = readBakeManifest(file);
        if (!manifest)
            return manifest.error();
        BakePart part{file, *std::move(manifest)};
        if (!part.manifest.complete)
            return broken(part,
                          "the bake of this part is not finished; run it again with --resume");
        if (!parts.empty()) {
            const BakePart& first = parts.front();
            if (const auto why = whyDifferent(first.manifest, part.manifest))
                return broken(part, fmt::format("it belongs to another bake than {}: they differ "
                                                "in {}",
                                                first.file.string(), *why));
        }
        parts.push_back(std::move(part));
    }

    std::vector<ShardFile> shards;
    for (const BakePart& part : parts)
        shards.push_back({part.file, part.manifest.shard.index, part.manifest.shard.count});
    if (Result<void> all = checkShardFiles(shards); !all)
        return all.error();
    std::ranges::sort(parts, {}, [](const BakePart& part) { return part.manifest.shard.index; });
    return parts;
}

Result<std::optional<PassState>> JoiningTracer::trace(const PassWork& work) {
    m_here.points = work.points;
    m_here.ranges = work.ranges.size();
    PassState state;
    int samplesDone = 0;
    for (const BakePart& part : m_parts) {
        if (const auto why = whyDifferent(part.manifest, m_here))
            return broken(part, fmt::format("it does not fit the scene as it is now; they differ "
                                            "in {}",
                                            *why));
        if (Result<void> read = readBakeState(part.file, work.ranges, work.stride, state); !read)
            return read.error();
        // All are complete; they differ only where a shard holds no points.
        samplesDone = std::max(samplesDone, state.samplesDone);
    }
    state.samplesDone = samplesDone;
    return std::optional(std::move(state));
}

} // namespace patina
