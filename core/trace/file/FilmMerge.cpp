#include "core/trace/file/FilmMerge.h"

#include "core/base/Check.h"
#include "core/base/ShardFiles.h"

#include <algorithm>
#include <fmt/format.h>

namespace patina {
namespace {

struct Part {
    std::filesystem::path file;
    FilmManifest manifest;
};

Error misfit(const Part& part, std::string message) {
    return {ErrorKind::InputBroken, std::move(message), part.file, {}};
}

// Every shard of one picture once, in order.
Result<std::vector<Part>> readParts(std::span<const std::filesystem::path> files) {
    std::vector<Part> parts;
    for (const std::filesystem::path& file : files) {
        Result<FilmManifest> manifest = readFilmManifest(file);
        if (!manifest)
            return manifest.error();
        Part part{file, *std::move(manifest)};
        if (!part.manifest.complete)
            return misfit(part, "this part is not finished; run it again with --resume");
        if (!parts.empty()) {
            const Part& first = parts.front();
            if (const auto why = whyDifferent(first.manifest, part.manifest))
                return misfit(part, fmt::format("it belongs to another picture than {}: they "
                                                "differ in {}",
                                                first.file.string(), *why));
        }
        parts.push_back(std::move(part));
    }
    std::vector<ShardFile> shards;
    for (const Part& part : parts)
        shards.push_back({part.file, part.manifest.shard.index, part.manifest.shard.count});
    if (Result<void> all = checkShardFiles(shards); !all)
        return all.error();
    std::ranges::sort(parts, {}, [](const Part& part) { return part.manifest.shard.index; });
    return parts;
}

} // namespace

Result<JoinedFilm> joinFilms(std::span<const std::filesystem::path> files) {
    CHECK(!files.empty());
    const Result<std::vector<Part>> parts = readParts(files);
    if (!parts)
        return parts.error();
    JoinedFilm joined;
    joined.manifest = parts->front().manifest;
    joined.manifest.shard = {};
    for (const Part& part : *parts)
        if (const Result<FilmManifest> read = readFilm(part.file, joined.film, joined.outputs);
            !read)
            return read.error();
    // A shard without pixels has no samples.
    joined.manifest.samples = joined.film.leastSamples();
    return joined;
}

} // namespace patina
