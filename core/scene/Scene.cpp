#include "core/scene/Scene.h"

#include "core/base/Check.h"
#include "core/base/LowerCase.h"
#include "core/document/SceneSource.h"
#include "core/document/Source.h"
#include "core/document/ViewChoices.h"
#include "core/library/Library.h"
#include "core/scene/DocumentIO.h"
#include "core/scene/SceneLoader.h"

namespace patina {
namespace {

namespace fs = std::filesystem;

constexpr float kFramingAspect = 16.0f / 9.0f; // whatever the window or picture: the same camera

bool isProjectFile(const fs::path& file) {
    return extensionOf(file) == ".patina";
}

void frame(Document& document) {
    const Bounds bounds = document.bounds();
    if (!bounds.empty())
        document.view.camera = frameBounds(document.view.camera, bounds, kFramingAspect);
}

// A scene that brings its own light is lit by that, not by the environment of a bare model:
// built-in rooms and COLLADA files with lights. Rooms show it as it spreads, from the front where
// they are open.
void light(Document& document, const std::string& source) {
    const library::Room room =
        isBuiltin(source) ? library::roomOf(builtinName(source)) : library::Room::None;
    const bool collada = !isBuiltin(source) && extensionOf(parseSceneSource(source).file) == ".dae";
    if (room != library::Room::None || (collada && !document.lights.empty()))
        document.environment().enabled = false;
    if (room == library::Room::None)
        return;
    document.view.lighting = LightingMode::Radiosity;
    document.view.exposureMode = ExposureMode::Automatic;
    if (room == library::Room::Box) {
        document.view.camera.yawDeg = 0.0f;
        document.view.camera.pitchDeg = 0.0f;
    }
}

// For notices; empty: none.
fs::path fileOf(const std::string& source) {
    return isBuiltin(source) ? fs::path() : fs::path(parseSceneSource(source).file);
}

Error cancelledError(const std::string& scene) {
    return {ErrorKind::Cancelled, "opening was cancelled", scene, {}};
}

} // namespace

Result<OpenedScene> openScene(WorkerClient& worker, const std::string& scene,
                              const JobContext& job) {
    const std::string source = normalizeSource(scene);
    if (!isBuiltin(source) && isProjectFile(source))
        return loadProject(worker, source, job);

    SceneLoader loader(&worker, job);
    OpenedScene opened;
    if (!appendModel(loader, opened.document, source))
        return loader.model(source).error();
    loader.loadEnvironments(opened.document);
    if (loader.cancelled())
        return cancelledError(source);
    light(opened.document, source);
    frame(opened.document);
    opened.notices = loader.takeNotices(fileOf(source));
    opened.scenes = loader.chosenScenes();
    opened.cameras = loader.cameras();
    opened.missingFiles = loader.missingFiles();
    return opened;
}

Document startDocument() {
    SceneLoader loader(nullptr, {});
    Document document;
    const bool read = appendModel(loader, document, "builtin:shader-ball");
    CHECK(read);
    loader.loadEnvironments(document);
    frame(document);
    return document;
}

Result<std::vector<Notice>> addModel(WorkerClient& worker, Document& document,
                                     const std::string& source, const JobContext& job,
                                     std::vector<std::string>* missingFiles) {
    const std::string normalized = normalizeSource(source);
    SceneLoader loader(&worker, job);
    Document extended = document;
    if (!appendModel(loader, extended, normalized))
        return loader.model(normalized).error();
    if (loader.cancelled())
        return cancelledError(normalized);
    document = std::move(extended);
    if (missingFiles != nullptr)
        missingFiles->insert(missingFiles->end(), loader.missingFiles().begin(),
                             loader.missingFiles().end());
    return loader.takeNotices(fileOf(normalized));
}

} // namespace patina
