// Which folder a file dialog begins in: that of the project or model, where its files lie, until
// the user goes elsewhere for this scene.
#pragma once

#include <QString>

namespace patina::editor {

class DocumentController;

// Of the project file, or of the first model that was read from a file; empty: neither.
[[nodiscard]] QString sceneFolder(const DocumentController& controller);

// `key`: of the dialog's kind, in the settings ("folders/images"). Without a scene on disk what was
// chosen last; then the user's documents or home, whichever exists.
[[nodiscard]] QString proposedFolder(const DocumentController& controller, const QString& key);
// A file in that folder, named after the scene: "helmet.glb" for the ending ".glb".
[[nodiscard]] QString proposedFile(const DocumentController& controller, const QString& key,
                                   const QString& ending);
void rememberFolder(const DocumentController& controller, const QString& key, const QString& file);

} // namespace patina::editor
