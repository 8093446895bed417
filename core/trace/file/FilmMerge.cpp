#include "core/trace/file/FilmMerge.h"

#include "core/base/Check.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

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
            if (part.manifest.shard.count != first.manifest.shard.count)
                return misfit(part, fmt::format("it is one of {} parts, {} is one of {}",
                                                part.manifest.shard.count, first.file.string(),
                                                first.manifest.shard.count));
        }
        parts.push_back(std::move(part));
    }
    const auto index = [](const Part& part) { return part.manifest.shard.index; };
    std::ranges::stable_sort(parts, {}, index);
    const int count = parts.front().manifest.shard.count;
    std::vector<int> missing;
    std::size_t next = 0;
    for (int shard = 0; shard < count; ++shard) {
        if (next == parts.size() || index(parts[next]) != shard) {
            missing.push_back(shard + 1);
            continue;
        }
        ++next;
        if (next < parts.size() && index(parts[next]) == shard)
            return misfit(parts[next], fmt::format("it is part {} of {}, and so is {}", shard + 1,
                                                   count, parts[next - 1].file.string()));
    }
    if (!missing.empty())
        return Error{ErrorKind::InputMissing,
                     fmt::format("of {} parts, {} {} missing; name {} too", count,
                                 fmt::join(missing, ", "), missing.size() == 1 ? "is" : "are",
                                 missing.size() == 1 ? "it" : "them"),
                     {},
                     {}};
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
