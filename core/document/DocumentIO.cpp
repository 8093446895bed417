#include "core/document/DocumentIO.h"

#include "core/bake/BakeIO.h"
#include "core/base/AtomicFile.h"
#include "core/base/Limits.h"
#include "core/base/Utf8.h"
#include "core/document/ProjectJson.h"
#include "core/document/SceneLoader.h"

#include <set>
#include <system_error>

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
        const fs::path file = instance.source;
        if (model.ok())
            loader.addNotice("the model has fewer parts than when the project was saved; what is "
                             "gone stays in the scene as empty meshes",
                             file);
        else if (model.error().kind == ErrorKind::InputMissing)
            loader.addMissing(instance.source);
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
        if (bake.ok() && bake->kind == reference.kind)
            document.bakes.push_back(std::make_shared<const BakeArtifact>(*std::move(bake)));
        else if (!bake.ok() && bake.error().kind == ErrorKind::InputMissing)
            loader.addNotice("a bake of this project is missing; put the file back or bake it anew",
                             reference.file);
        else
            loader.addNotice("a bake of this project is left out: " +
                                 (bake.ok() ? "the file holds a bake of another kind; bake it anew"
                                            : bake.error().message),
                             reference.file);
    }
}

Result<void> makeFolder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
        return Error{
            ErrorKind::CannotCreate,
            "the folder for the project's bakes cannot be created; check that the project's "
            "folder exists and is writable",
            folder, error.message()};
    return {};
}

} // namespace

Result<void> saveProject(WorkerClient& worker, const Document& document,
                         const fs::path& projectFile) {
    for (const BakeArtifactPtr& bake : document.bakes) {
        if (!bake)
            continue;
        Result<Bytes> bytes = encodeBake(worker, *bake, document);
        if (!bytes)
            return bytes.error();
        const fs::path file = project::bakeFile(projectFile, bake->kind);
        if (Result<void> made = makeFolder(file.parent_path()); !made)
            return made;
        if (Result<void> written = writeFileAtomically(file, *bytes); !written)
            return written;
    }
    return writeFileAtomically(projectFile, documentToJson(document, projectFile));
}

Result<OpenedScene> loadProject(WorkerClient& worker, const fs::path& projectFile,
                                const JobContext& job) {
    Result<std::string> json = readTextFile(projectFile, limits::kMaxProjectFileBytes);
    if (!json)
        return json.error();
    Result<project::ParsedProject> parsed = project::parseProject(*json, projectFile);
    if (!parsed)
        return parsed.error();

    OpenedScene opened;
    opened.isProject = true;
    opened.document = std::move(parsed->document);
    SceneLoader loader(&worker, job);
    resolveMeshes(loader, opened.document);
    if (!loader.cancelled())
        loader.loadMaps(opened.document.materials);
    if (!loader.cancelled())
        loader.loadEnvironments(opened.document);
    loadBakes(loader, worker, opened.document, parsed->bakes);
    if (loader.cancelled())
        return Error{ErrorKind::Cancelled, "opening was cancelled", projectFile, {}};
    opened.notices = loader.takeNotices(projectFile);
    opened.missingFiles = loader.missingFiles();
    return opened;
}

} // namespace patina
