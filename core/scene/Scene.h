// Opening things: a project, a model or a built-in scene becomes a document with every payload
// resolved. The editor and the command line open through these functions.
#pragma once

#include "core/base/Result.h"
#include "core/document/Document.h"
#include "core/document/Source.h"
#include "core/job/JobContext.h"
#include "core/scene/SceneCameras.h"

#include <filesystem>
#include <string>
#include <vector>

namespace patina {

class WorkerClient;

// Something the user should know but that stopped nothing: a missing texture, dropped triangles.
struct Notice {
    std::string message;        // one sentence: what happened and what to do
    std::filesystem::path file; // concerned, may be empty
    friend bool operator==(const Notice&, const Notice&) = default;
};

// Which of several visual scenes of a COLLADA file was read.
struct ChosenScene {
    std::string file;                // path of the model
    std::vector<std::string> scenes; // their titles, at least two
    std::size_t scene = 0;           // of them
    bool asked = false;              // for this one, by name
};

struct OpenedScene {
    Document document;
    std::vector<Notice> notices;
    std::vector<std::string> missingFiles; // textures and models that could not be found
    bool isProject = false;                // opened from a .patina file
    std::vector<ChosenScene> scenes{};     // of models that hold several
    std::vector<SceneCamera> cameras{};    // of the model files
};

// SCENE of the command line: "builtin:NAME", a .patina project or a model file, or one visual scene
// of it (formatSceneSource()). A model alone gets the default environment and view, framed.
Result<OpenedScene> openScene(WorkerClient& worker, const std::string& scene,
                              const JobContext& job = {});

// The editor's and README's first scene: the shader ball under the studio sky.
[[nodiscard]] Document startDocument();

// Appends a model's meshes, materials and lights to the document; on failure or cancel it is
// untouched. `missingFiles` receives the textures that could not be found.
Result<std::vector<Notice>> addModel(WorkerClient& worker, Document& document,
                                     const std::string& source, const JobContext& job = {},
                                     std::vector<std::string>* missingFiles = nullptr);

// Reads an image for a map ("builtin:…" or a path). On failure returns the error; callers that
// must go on store it in MapSlot::problem.
// `notices` receives the count of repaired pixels.
Result<ImagePtr> loadMapImage(WorkerClient& worker, const std::string& source,
                              ColorEncoding integerEncoding,
                              std::vector<Notice>* notices = nullptr);

// Reads an environment of any layout as a lat-long, F32 RGB, w = 2h, at most 4096 × 2048; pictures
// of proportions that no layout has are stretched, integer files decoded from sRGB. `notices`
// receives such changes, doubts about the layout and the count of repaired pixels.
Result<ImagePtr> loadEnvironmentImage(WorkerClient& worker, const std::string& source,
                                      std::vector<Notice>& notices,
                                      EnvironmentLayout layout = EnvironmentLayout::Automatic,
                                      const JobContext& job = {});

} // namespace patina
