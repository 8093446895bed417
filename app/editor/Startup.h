// What must be said to Qt before there is a QApplication.
#pragma once

namespace patina::editor {

// Shared OpenGL contexts, the surface format of the viewport, names for settings.
void prepareApplication();

} // namespace patina::editor
