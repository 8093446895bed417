// One of several visual scenes of a COLLADA file as a source: "PATH.dae#scene:TITLE". Meshes keep
// it (MeshInstance::source), so that a project opens the same scene again.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace patina {

struct SceneSource {
    std::string file;  // path of the model
    std::string title; // as visualSceneTitles() has it; empty: that which the file names
};

[[nodiscard]] std::string formatSceneSource(const SceneSource& source);
// Of any source: without a scene its title is empty.
[[nodiscard]] SceneSource parseSceneSource(const std::string& source);

// Whether files of this name may hold several scenes.
[[nodiscard]] bool holdsVisualScenes(const std::string& file);

} // namespace patina
