#include "core/bake/transfer/BakeMerge.h"

#include "core/base/Check.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

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
        const PassShard& shard = part.manifest.shard;
        if (!part.manifest.complete)
            return broken(part,
                          "the bake of this part is not finished; run it again with --resume");
        if (!parts.empty()) {
            const BakePart& first = parts.front();
            if (const auto why = whyDifferent(first.manifest, part.manifest))
                return broken(part, fmt::format("it belongs to another bake than {}: they differ "
                                                "in {}",
                                                first.file.string(), *why));
            if (shard.count != first.manifest.shard.count)
                return broken(part,
                              fmt::format("it is one of {} parts, {} is one of {}", shard.count,
                                          first.file.string(), first.manifest.shard.count));
        }
        parts.push_back(std::move(part));
    }

    // Every shard once.
    std::stable_sort(parts.begin(), parts.end(), [](const BakePart& a, const BakePart& b) {
        return a.manifest.shard.index < b.manifest.shard.index;
    });
    for (std::size_t i = 1; i < parts.size(); ++i)
        if (parts[i].manifest.shard.index == parts[i - 1].manifest.shard.index)
            return broken(parts[i],
                          fmt::format("it is part {} of {}, and so is {}",
                                      parts[i].manifest.shard.index + 1,
                                      parts[i].manifest.shard.count, parts[i - 1].file.string()));
    const int count = parts.front().manifest.shard.count;
    if (static_cast<int>(parts.size()) == count)
        return parts;
    std::vector<int> missing;
    for (int index = 0; index < count; ++index)
        if (std::none_of(parts.begin(), parts.end(), [index](const BakePart& part) {
                return part.manifest.shard.index == index;
            }))
            missing.push_back(index + 1);
    return Error{ErrorKind::InputMissing,
                 fmt::format("of {} parts, {} {} missing; name {} too", count,
                             fmt::join(missing, ", "), missing.size() == 1 ? "is" : "are",
                             missing.size() == 1 ? "it" : "them"),
                 {},
                 {}};
}

Result<std::optional<PassState>> JoiningTracer::trace(const TraceRequest& request) {
    m_here.points = request.points.size();
    m_here.ranges = request.ranges.size();
    PassState state;
    int samplesDone = 0;
    for (const BakePart& part : m_parts) {
        if (const auto why = whyDifferent(part.manifest, m_here))
            return broken(part, fmt::format("it does not fit the scene as it is now; they differ "
                                            "in {}",
                                            *why));
        if (Result<void> read =
                readBakeState(part.file, request.ranges, request.settings.stride(), state);
            !read)
            return read.error();
        // All are complete; they differ only where a shard holds no points.
        samplesDone = std::max(samplesDone, state.samplesDone);
    }
    state.samplesDone = samplesDone;
    return std::optional(std::move(state));
}

} // namespace patina
