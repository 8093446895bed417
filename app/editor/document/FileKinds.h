// What a file is to Patina, judged by its name; the content is judged by whoever reads it.
#pragma once

#include <QString>
#include <QStringList>

namespace patina::editor {

enum class FileKind { Project, Model, Environment, Image, DisplayConfig, Unknown };

[[nodiscard]] FileKind fileKind(const QString& file);

// Filters for file dialogs: "Models (*.gltf *.glb …)".
[[nodiscard]] QString sceneFilter(); // projects and models, each, and all files
[[nodiscard]] QString modelFilter();
[[nodiscard]] QString imageFilter();
[[nodiscard]] QString environmentFilter();
[[nodiscard]] QString projectFilter();
[[nodiscard]] QString displayConfigFilter();

} // namespace patina::editor
