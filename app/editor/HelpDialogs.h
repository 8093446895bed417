// The pages of the Help menu.
#pragma once

#include <QList>

class QAction;
class QDialog;
class QWidget;

namespace patina::editor {

// Every shortcut, from the actions themselves, and what the mouse does.
[[nodiscard]] QDialog* makeShortcutsDialog(const QList<QAction*>& commands,
                                           const QList<QAction*>& views, QWidget* parent);
[[nodiscard]] QDialog* makeAboutDialog(QWidget* parent);

} // namespace patina::editor
