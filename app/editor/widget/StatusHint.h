// A passing hint in the status bar of the window a widget belongs to.
#pragma once

class QString;
class QWidget;

namespace patina::editor {

// Stays until the next one; an empty text takes it away.
void showHint(QWidget& from, const QString& text);

} // namespace patina::editor
