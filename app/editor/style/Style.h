// The look of the editor: Fusion, a dark palette and a small style sheet, all from Tokens.h.
#pragma once

class QApplication;

namespace patina::editor {

void applyStyle(QApplication& application);

} // namespace patina::editor
