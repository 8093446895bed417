// A COLLADA file may hold several visual scenes: how each is called, and which one a name means.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace patina {

struct VisualScene {
    std::string id, name; // as the file has them; either may be empty
};

// For each a title of its own that visualScene() finds it by: its name; its id where there is no
// name or another scene has the same one; "scene 2" where neither tells it apart.
[[nodiscard]] std::vector<std::string> visualSceneTitles(const std::vector<VisualScene>& scenes);

// The scene with this title, or else with this id. Null: there is none.
[[nodiscard]] std::optional<std::size_t> visualScene(const std::vector<VisualScene>& scenes,
                                                     std::string_view title);

// "\"Attic\", \"Kitchen\" and \"Yard\"": the first ten, and how many more; all but `except`.
[[nodiscard]] std::string listVisualScenes(const std::vector<std::string>& titles,
                                           std::optional<std::size_t> except = std::nullopt);

// For the user, that a file has no scene `title` and which it has.
[[nodiscard]] std::string noSuchVisualScene(const std::vector<std::string>& titles,
                                            std::string_view title);

} // namespace patina
