#include "core/recovery/RecoveryLoader.h"

#include "core/bake/file/BakeIO.h"
#include "core/base/AtomicFile.h"
#include "core/base/Limits.h"
#include "core/recovery/RecoveryBakes.h"
#include "core/scene/DocumentIO.h"
#include "core/scene/OutsidePictures.h"
#include "core/scene/ProjectJson.h"

#include <algorithm>
#include <optional>

namespace patina {
namespace {

namespace fs = std::filesystem;

// The saved project's bake of that kind, if it is still the one that was attached.
std::optional<BakeArtifact> savedBake(WorkerClient& worker, const RecoveryRecord& record,
                                      const RecoveryBake& wanted, const Document& document) {
    const Result<std::string> json = readTextFile(record.file, limits::kMaxProjectFileBytes);
    if (!json)
        return std::nullopt;
    const Result<project::ParsedProject> saved = project::parseProject(*json, record.file);
    if (!saved)
        return std::nullopt;
    for (const project::BakeReference& reference : saved->bakes) {
        if (reference.kind != wanted.kind)
            continue;
        Result<BakeArtifact> bake = loadBake(worker, reference.file, document);
        if (bake.ok() && bake->kind == wanted.kind && bake->inputs == wanted.inputs &&
            bake->samplesDone == wanted.samplesDone)
            return *std::move(bake);
    }
    return std::nullopt;
}

} // namespace

Result<OpenedScene> loadRecovered(WorkerClient& worker, const RecoveryRecord& record,
                                  const fs::path& bakeFolder, const JobContext& job) {
    // The user saw the others.
    const auto mayShow = [&](const std::string& file) {
        return std::ranges::none_of(record.outside, [&](const std::string& source) {
            return fileOfPicture(source) == file;
        });
    };
    Result<OpenedScene> opened =
        loadProjectText(worker, record.project, record.projectFile(), job, mayShow);
    if (!opened)
        return opened.error();
    for (const RecoveryBake& wanted : record.bakes) {
        if (job.cancelled())
            return Error{ErrorKind::Cancelled, "recovering was cancelled", record.file, {}};
        const bool isSaved = wanted.content == Hash{};
        std::optional<BakeArtifact> bake =
            isSaved ? savedBake(worker, record, wanted, opened->document)
                    : keptBake(bakeFolder, wanted.content, opened->document);
        std::erase_if(opened->document.bakes, [&](const BakeArtifactPtr& other) {
            return bake && other->kind == bake->kind;
        });
        if (bake)
            opened->document.bakes.push_back(
                std::make_shared<const BakeArtifact>(*std::move(bake)));
        else
            opened->notices.push_back(
                {isSaved ? "a bake of the saved project is missing or has changed; bake it anew"
                         : "the copy of a bake is damaged or missing; bake it anew",
                 record.file});
    }
    for (const std::string& text : record.leftOut)
        opened->notices.push_back({"not recovered: " + text, record.file});
    return opened;
}

bool savedFileUnchanged(const RecoveryRecord& record) {
    return !record.file.empty() && record.savedContent != Hash{} &&
           hashFile(record.file) == record.savedContent;
}

} // namespace patina
