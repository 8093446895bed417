#include "core/radiosity/file/RadiosityMerge.h"

#include "core/base/Check.h"
#include "core/base/ShardFiles.h"

#include <algorithm>
#include <fmt/format.h>

namespace patina::radiosity {
namespace {

Error unfit(const RadiosityPart& part, std::string message) {
    return {ErrorKind::InputBroken, std::move(message), part.file, {}};
}

int indexOf(const RadiosityPart& part) {
    return part.manifest.shard.index;
}

} // namespace

Result<std::vector<RadiosityPart>>
readRadiosityParts(std::span<const std::filesystem::path> files) {
    CHECK(!files.empty());
    std::vector<RadiosityPart> parts;
    for (const std::filesystem::path& file : files) {
        Result<RadiosityManifest> manifest = readRadiosityManifest(file);
        if (!manifest)
            return manifest.error();
        RadiosityPart part{file, *std::move(manifest)};
        if (!part.manifest.complete)
            return unfit(part, "this part is not finished; run it again with --resume");
        if (!parts.empty()) {
            const RadiosityPart& first = parts.front();
            auto why = whyDifferent(first.manifest, part.manifest);
            if (!why)
                why = differingSetting(first.manifest.options, part.manifest.options);
            if (why)
                return unfit(part, fmt::format("it belongs to another radiosity than {}: they "
                                               "differ in {}",
                                               first.file.string(), *why));
        }
        parts.push_back(std::move(part));
    }
    std::vector<ShardFile> shards;
    for (const RadiosityPart& part : parts)
        shards.push_back({part.file, indexOf(part), part.manifest.shard.count});
    if (Result<void> all = checkShardFiles(shards); !all)
        return all.error();
    std::ranges::sort(parts, {}, indexOf);
    return parts;
}

Result<void> divideAsIn(const std::filesystem::path& file, ElementMesh& elements) {
    const auto divisions = readDivisions(file);
    if (!divisions)
        return divisions.error();
    for (const std::vector<std::uint32_t>& round : *divisions) {
        if (!std::ranges::is_sorted(round) || (!round.empty() && round.back() >= elements.size()))
            return Error{ErrorKind::InputBroken,
                         "the elements that it divides are not those of the scene; remove it and "
                         "bake it anew",
                         file,
                         {}};
        elements.divide(round);
    }
    return {};
}

Result<void> JoinedRadiosity::divide(ElementMesh& elements) {
    return divideAsIn(m_parts.front().file, elements);
}

Result<void> JoinedRadiosity::begin(const TraceScene& scene, const ElementMesh& elements) {
    const bool first = m_state.light.size() == 0;
    forget(elements);
    if (!first) // divided further than the parts were
        return {};
    m_here.elements = hashElements(scene, elements);
    m_here.elementCount = elements.size();
    for (const RadiosityPart& part : m_parts) {
        if (const auto why = whyDifferent(part.manifest, m_here))
            return unfit(part, fmt::format("it does not fit the scene as it is now; they differ "
                                           "in {}",
                                           *why));
        if (Result<void> read = readRadiosity(part.file, m_maxRowBytes, m_state); !read)
            return read;
    }
    return {};
}

} // namespace patina::radiosity
