// Where payloads come from, as text: an absolute path, "builtin:NAME" or
// "PATH-OF-MODEL#embedded:INDEX" (an image inside a model file).
#pragma once

#include <optional>
#include <string>

namespace patina {

[[nodiscard]] bool isBuiltin(const std::string& source);
[[nodiscard]] std::string builtinName(const std::string& source); // "studio" of "builtin:studio"

// Absolute path for paths, unchanged for builtin:NAME. On Linux a path is bytes, most often UTF-8.
[[nodiscard]] std::string normalizeSource(const std::string& source);

struct EmbeddedSource {
    std::string model; // path of the model file
    int index = 0;
};
[[nodiscard]] std::optional<EmbeddedSource> parseEmbeddedSource(const std::string& source);
[[nodiscard]] std::string formatEmbeddedSource(const EmbeddedSource& source);

} // namespace patina
