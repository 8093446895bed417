// The buttons above a list: add, duplicate, remove.
#pragma once

#include <QString>

class QToolButton;

namespace patina::editor {

// With an icon of the icon set, and a text beside it unless that is empty. `tip` says what it does.
[[nodiscard]] QToolButton* makeListButton(const QString& iconName, const QString& text,
                                          const QString& tip);

} // namespace patina::editor
