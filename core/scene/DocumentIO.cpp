#include "core/scene/DocumentIO.h"

#include "core/bake/file/BakeIO.h"
#include "core/base/AtomicFile.h"
#include "core/base/FileLock.h"
#include "core/base/Leftovers.h"
#include "core/base/Limits.h"
#include "core/base/Log.h"
#include "core/base/PrintableText.h"
#include "core/base/Utf8.h"
#include "core/document/AbsentBake.h"
#include "core/document/SceneSource.h"
#include "core/material/Material.h"
#include "core/scene/OutsideGrants.h"
#include "core/scene/OutsidePictures.h"
#include "core/scene/ProjectBakes.h"
#include "core/scene/ProjectJson.h"
#include "core/scene/ProjectSnapshots.h"
#include "core/scene/SceneLoader.h"
#include "core/worker/WorkerClient.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <set>
#include <span>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace patina {
namespace {

namespace fs = std::filesystem;

// Stands for a mesh whose file is missing or has changed: the instance keeps its id, its source and
// its material, so that nothing is lost when the project is saved again.
MeshPtr placeholderMesh(const std::string& name) {
    Mesh mesh;
    mesh.name = name;
    return std::make_shared<const Mesh>(std::move(mesh));
}

std::string aboutUnknown(const std::vector<std::string>& places) {
    constexpr std::size_t kNamed = 3;
    std::string names;
    for (std::size_t i = 0; i < std::min(places.size(), kNamed); ++i)
        names += (i > 0 ? ", " : "") + printableLine(places[i]);
    return fmt::format("this version of Patina does not know {} of the project's settings ({}{}): "
                       "they are kept when you save, and not shown; a newer version may know them",
                       places.size(), names, places.size() > kNamed ? ", …" : "");
}

void resolveMeshes(SceneLoader& loader, Document& document) {
    std::set<std::string> reported;
    for (MeshInstance& instance : document.meshes) {
        if (loader.cancelled())
            return;
        const Result<SceneLoader::Model>& model = loader.model(instance.source);
        const std::size_t index = static_cast<std::size_t>(instance.sourceIndex);
        if (model.ok() && index < model->parts.size()) {
            instance.mesh = model->parts[index].mesh;
            continue;
        }
        instance.mesh = placeholderMesh(instance.name);
        if (!reported.insert(instance.source).second)
            continue;
        const fs::path file = parseSceneSource(instance.source).file;
        if (model.ok())
            loader.addNotice("the model has fewer parts than when the project was saved; what is "
                             "gone stays in the scene as empty meshes",
                             file);
        else if (model.error().kind == ErrorKind::InputMissing)
            loader.addMissing(file.string());
        else
            loader.addNotice(model.error().message + "; its meshes stay in the scene, empty", file);
    }
}

void loadBakes(SceneLoader& loader, WorkerClient& worker, Document& document,
               const std::vector<project::BakeReference>& references) {
    for (const project::BakeReference& reference : references) {
        if (loader.cancelled())
            return;
        loader.job().setActivity("reading " +
                                 makeValidUtf8(fs::path(reference.file).filename().string()));
        Result<BakeArtifact> bake = loadBake(worker, reference.file, document);
        if (bake.ok() && bake->kind == reference.kind) {
            document.bakes.push_back(std::make_shared<const BakeArtifact>(*std::move(bake)));
            continue;
        }
        document.bakes.push_back(absentBake(reference.kind, reference.file));
        if (!bake.ok() && bake.error().kind == ErrorKind::InputMissing)
            loader.addNotice("a bake of this project is missing; put the file back or bake it anew",
                             reference.file);
        else
            loader.addNotice("a bake of this project cannot be used: " +
                                 (bake.ok() ? "the file holds a bake of another kind; bake it anew"
                                            : bake.error().message),
                             reference.file);
    }
}

// How long a save waits for another one of the same project, in this process or another.
constexpr std::chrono::seconds kPatience(30);

// What stands in the way of writing `file`, which is locked.
SaveOutcome checkSave(const fs::path& file, const SaveTerms& terms) {
    const auto stopped = [&](SaveObstacle obstacle, std::string message) {
        return SaveOutcome{
            Error{ErrorKind::CannotCreate, std::move(message), file, {}}, obstacle, {}};
    };
    struct stat there {};
    if (::stat(file.c_str(), &there) != 0)
        return {};
    if (terms.expected && projectVersion(file) != terms.expected)
        return stopped(SaveObstacle::Changed,
                       "the file was changed by something else since it was opened or saved here; "
                       "save under another name, or open it again");
    const bool writable = (there.st_mode & 0222) != 0 && ::access(file.c_str(), W_OK) == 0;
    if (!terms.mayReplaceReadOnly && S_ISREG(there.st_mode) && !writable)
        return stopped(SaveObstacle::ReadOnly,
                       "the file is write-protected; save under another name");
    return {};
}

} // namespace

std::optional<Hash> projectVersion(const fs::path& projectFile) {
    const Result<Bytes> bytes = readFile(projectFile, limits::kMaxProjectFileBytes);
    return bytes ? std::optional(hashBytes(*bytes)) : std::nullopt;
}

Result<void> saveProject(WorkerClient& worker, const Document& document,
                         const fs::path& projectFile) {
    SaveOutcome outcome = saveProject(worker, document, projectFile, SaveTerms{});
    if (outcome.error)
        return *std::move(outcome.error);
    return {};
}

SaveOutcome saveProject(WorkerClient& worker, const Document& document, const fs::path& projectFile,
                        const SaveTerms& terms) {
    const fs::path folder = projectFile.has_parent_path() ? projectFile.parent_path() : ".";
    std::error_code ignored;
    if (!fs::is_directory(folder, ignored))
        return {Error{ErrorKind::CannotCreate,
                      "the folder of this project is not there; it was moved, renamed or removed. "
                      "Save the project in another place",
                      projectFile,
                      {}},
                SaveObstacle::FolderGone,
                {}};
    const Result<std::optional<FileLock>> lock = FileLock::takeWhenFree(projectFile, kPatience);
    if (!lock)
        return {lock.error(), SaveObstacle::None, {}};
    if (SaveOutcome stopped = checkSave(projectFile, terms); stopped.error)
        return stopped;
    removeLeftovers(projectFile);

    const Result<project::BakeNames> bakes = project::writeBakes(worker, document, projectFile);
    if (!bakes)
        return {bakes.error(), SaveObstacle::None, {}};
    const std::string text = project::projectText(document, projectFile, *bakes);
    if (Result<void> written = writeFileAtomically(projectFile, text); !written)
        return {written.error(), SaveObstacle::None, {}};
    project::removeOldBakes(projectFile, *bakes);
    // What the user sees and saves needs no question when it is opened again.
    if (Result<void> kept =
            grantOutside(projectFile, shownFromOutside(document, projectFile), outsideGrantsFile());
        !kept)
        logWarning("which pictures {} shows is not kept: {}", projectFile.string(),
                   kept.error().text());
    return {std::nullopt, SaveObstacle::None,
            hashBytes(std::as_bytes(std::span(text.data(), text.size())))};
}

Result<OpenedScene> loadProject(WorkerClient& worker, const fs::path& projectFile,
                                const JobContext& job) {
    Result<std::string> json = readTextFile(projectFile, limits::kMaxProjectFileBytes);
    if (!json)
        return json.error();
    return loadProjectText(worker, *json, projectFile, job);
}

Result<OpenedScene> loadProjectText(WorkerClient& worker, const std::string& json,
                                    const fs::path& projectFile, const JobContext& job,
                                    std::function<bool(const std::string& file)> mayShow) {
    Result<project::ParsedProject> parsed = project::parseProject(json, projectFile);
    if (!parsed)
        return parsed.error();

    OpenedScene opened;
    opened.isProject = true;
    opened.document = std::move(parsed->document);
    SceneLoader loader(&worker, job);
    if (!mayShow)
        mayShow = [granted = outsideGrants(projectFile, outsideGrantsFile())](
                      const std::string& file) { return granted.contains(file); };
    if (!worker.outsideAllowed(projectFile))
        loader.stayWithin(projectFile, std::move(mayShow));
    if (!parsed->unknown.empty())
        loader.addNotice(aboutUnknown(parsed->unknown), projectFile);
    for (const std::string& reason : parsed->leftOut)
        loader.addNotice("a snapshot of this project cannot be read and is left out (" +
                             printableLine(reason) +
                             "); the rest is as it was saved. Saving the project removes it",
                         projectFile);
    resolveMeshes(loader, opened.document);
    if (!loader.cancelled())
        loader.loadMaps(opened.document.materials);
    if (!loader.cancelled())
        loader.loadEnvironments(opened.document);
    if (!loader.cancelled())
        project::loadSnapshotImages(loader, opened.document);
    loadBakes(loader, worker, opened.document, parsed->bakes);
    if (loader.cancelled())
        return Error{ErrorKind::Cancelled, "opening was cancelled", projectFile, {}};
    opened.notices = loader.takeNotices(projectFile);
    opened.missingFiles = loader.missingFiles();
    opened.scenes = loader.chosenScenes();
    opened.cameras = loader.cameras();
    return opened;
}

} // namespace patina
