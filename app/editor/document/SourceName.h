// How what a document shows is called, wherever it comes from.
#pragma once

#include <QString>

namespace patina::editor {

// "teapot.obj", "Shader Ball". `source`: a path or "builtin:NAME".
[[nodiscard]] QString sourceName(const QString& source);

} // namespace patina::editor
