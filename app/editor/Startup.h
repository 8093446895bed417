// What must be said to Qt before there is a QApplication.
#pragma once

namespace patina::editor {

// Shared OpenGL contexts, the surface format of the viewport, names for settings, no shader cache
// on a disk that is full.
void prepareApplication();

} // namespace patina::editor
