// What the commands that work on a scene share: opening it with its --set and --bake options, and
// refusing an output that could not be written before any work is done.
#pragma once

#include "app/cli/Session.h"
#include "core/document/Document.h"
#include "core/mix/LightList.h"
#include "core/scene/SceneCameras.h"

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace patina::cli {

inline constexpr std::string_view kNoEnvironment = "none"; // of --environment

struct SceneRequest {
    std::string scene;
    std::string environment;        // empty: the scene's own; none: no light of it
    std::string environmentLayout;  // empty: guessed
    std::vector<std::string> bakes; // files to attach
    std::optional<std::vector<std::string>> sets = {}; // instead of those of --set
    // What an environment would add is not wanted unless it is named: a scene that is no project
    // and has lights or glowing surfaces is lit by those alone.
    bool ownLightAlone = false;
    // Set by openSceneFor():
    bool isProject = false;                // the scene has a camera of its own
    std::vector<SceneCamera> cameras = {}; // of its model files
};

// Opens `scene`, of a COLLADA file with the visual scene that --visual-scene names. Errors: Usage,
// where another kind of file or no such scene is named; those of openScene().
Result<OpenedScene> openNamedScene(Session& session, const std::string& scene);
// Opens the scene so, reports its notices, and applies environment, --set and bakes in this order.
Result<Document> openSceneFor(Session& session, SceneRequest& request);

// A document whose environment is that of the image or builtin:NAME, or whose environment and
// shading model are a .patina project's, with --set applied. Usage error when that sets anything
// else. `layoutName` of the image; empty: guessed.
Result<Document> openEnvironmentFor(Session& session, const std::string& source,
                                    const std::string& layoutName = {});

// Sets one parameter from its text, as --set does; maps and environments are loaded.
Result<void> setParameter(Session& session, Document& document, const std::string& name,
                          const std::string& value);

// The environment becomes that of an image or builtin:NAME; errors leave it as it is.
Result<void> setEnvironment(Session& session, Environment& environment, const std::string& source,
                            EnvironmentLayout layout);

// Warns where none of the elements that were set has a use for the parameter; `option`: "--set".
void warnIfIdle(Session& session, const Document& document, std::string_view option,
                const std::string& name);

// Usage error when the named choice is one that the document does not offer (whyUnavailable()).
Result<void> checkOffered(const Document& document, const std::string& name);

// What lights the scene, for reports: the image's source, or "sky", "softboxes".
[[nodiscard]] std::string environmentName(const Environment& environment);

// {"kind": "environment" | "light" | "glow", "name": …} of each.
[[nodiscard]] nlohmann::ordered_json lightsJson(const std::vector<LightName>& names);

// The layout of an environment by name; Automatic for an empty one. Usage error with the names.
Result<EnvironmentLayout> parseLayout(const std::string& name);

// CannotCreate when the folder is missing or not writable, or the path is a folder.
Result<void> checkOutput(const std::filesystem::path& output);

} // namespace patina::cli
