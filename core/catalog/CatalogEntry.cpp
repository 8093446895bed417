#include "core/catalog/CatalogEntry.h"

#include "core/base/InputFile.h"
#include "core/catalog/EnvironmentThumbnail.h"
#include "core/document/EnvironmentTitle.h"
#include "core/document/Source.h"
#include "core/io/ImageIO.h"
#include "core/library/Library.h"
#include "core/light/Environment.h"
#include "core/rank/SweepEnvironment.h"
#include "core/scene/EnvironmentFile.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

namespace patina {
namespace {

namespace fs = std::filesystem;

// Changes whenever makeCatalogEntry() would make something else.
constexpr std::uint32_t kCatalogVersion = 1;

// The file, or those of its six faces that are there.
std::vector<fs::path> filesOfSource(const std::string& source) {
    std::vector<fs::path> files = sixFaceFiles(source);
    std::error_code unknown;
    std::erase_if(files, [&](const fs::path& file) { return !fs::exists(file, unknown); });
    if (files.empty())
        files.emplace_back(source);
    return files;
}

std::string titleOf(const std::string& source) {
    Environment environment;
    environment.source = source;
    return environmentTitle(environment);
}

Error cancelledError(const std::string& source) {
    return {ErrorKind::Cancelled, "measuring was cancelled", source, {}};
}

// Size and layout of the file, and the picture that is measured.
Result<Image> readPicture(WorkerClient& worker, const std::string& source, CatalogEntry& entry,
                          const JobContext& job) {
    if (isBuiltin(source)) {
        const Result<ImagePtr> image = library::environment(builtinName(source), job);
        if (!image)
            return image.error();
        entry.width = (*image)->width();
        entry.height = (*image)->height();
        entry.texels = hashImage(**image);
        entry.layout = layoutLabel(EnvironmentLayout::LatLong);
        return **image;
    }
    for (const fs::path& file : filesOfSource(source)) {
        std::error_code error;
        const std::uintmax_t bytes = fs::file_size(file, error);
        entry.fileBytes += error ? 0 : bytes;
    }
    std::vector<Notice> notices;
    const Result<EnvironmentPicture> picture =
        readEnvironmentPicture(worker, source, EnvironmentLayout::Automatic, notices, job);
    if (!picture)
        return picture.error();
    for (const Notice& notice : notices)
        entry.notices.push_back(notice.message);
    entry.width = picture->image.width();
    entry.height =
        picture->layout == EnvironmentLayout::SixFaces ? entry.width : picture->image.height();
    entry.layout = layoutLabel(picture->layout);
    entry.texels = hashImage(picture->image);
    if (std::max(entry.width, entry.height) == kMaxEnvironmentSide)
        if (const Result<ImageInfo> info = inspectImage(worker, source)) { // perhaps it was reduced
            entry.width = info->width;
            entry.height = info->height;
        }
    return latLongOf(*picture, kMeasuredWidth, job);
}

} // namespace

Result<Hash> catalogKey(const std::string& source) {
    Hasher hasher;
    hasher.value(kCatalogVersion).text(source);
    if (isBuiltin(source))
        return hasher.finish();
    for (const fs::path& file : filesOfSource(source)) {
        std::error_code error;
        const std::uintmax_t bytes = fs::file_size(file, error);
        const fs::file_time_type written =
            error ? fs::file_time_type() : fs::last_write_time(file, error);
        if (error)
            return Error{ErrorKind::InputMissing, std::string(kNoSuchFile), file, error.message()};
        hasher.text(file.string())
            .value(static_cast<std::uint64_t>(bytes))
            .value(static_cast<std::int64_t>(written.time_since_epoch().count()));
    }
    return hasher.finish();
}

Result<CatalogEntry> makeCatalogEntry(WorkerClient& worker, const std::string& source,
                                      const JobContext& job) {
    CatalogEntry entry;
    entry.source = source;
    entry.title = titleOf(source);
    const Result<Image> picture = readPicture(worker, source, entry, job);
    if (!picture)
        return picture.error();
    if (job.cancelled())
        return cancelledError(source);
    MeasuredEnvironment measured = measureLight(*picture, job);
    if (job.cancelled())
        return cancelledError(source);
    entry.measures = measured.measures;
    entry.harmonics = std::move(measured.harmonics);
    entry.thumbnail = environmentThumbnail(*picture, measured.withoutSource);
    return entry;
}

std::vector<std::optional<SameEntry>> findSameEntries(std::span<const CatalogEntryPtr> entries,
                                                      const JobContext& job) {
    std::vector<SweepEnvironment> lights;
    for (const CatalogEntryPtr& entry : entries) {
        SweepEnvironment light;
        light.harmonics = entry->harmonics;
        light.texels = entry->texels;
        lights.push_back(std::move(light));
    }
    std::vector<std::optional<SameEntry>> result(entries.size());
    const auto found = findSameEnvironments(lights, job);
    for (std::size_t i = 0; i < entries.size(); ++i)
        if (found[i] && entries[i]->measures.meanLuminance > 0.0)
            result[i] = SameEntry{found[i]->of, found[i]->rotationDeg, found[i]->exactly};
    return result;
}

} // namespace patina
