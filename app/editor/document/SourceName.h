// How what a document shows is called, wherever it comes from.
#pragma once

#include <QString>

namespace patina::editor {

// "teapot.obj", "room.dae (Attic)", "Shader Ball". `source`: a path, a scene of a COLLADA file
// (formatSceneSource()) or "builtin:NAME".
[[nodiscard]] QString sourceName(const QString& source);

} // namespace patina::editor
