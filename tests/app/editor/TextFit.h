// What of the texts in a window is cut where it should not be.
#pragma once

#include <QStringList>

class QWidget;

namespace patina::editor {

// Every label, button, tab, field and table below `root` that is seen and has less room than its
// text needs, in words. Texts that end in an ellipsis where they are cut are no fault, unless they
// are numbers.
[[nodiscard]] QStringList cutTexts(const QWidget& root);

} // namespace patina::editor
