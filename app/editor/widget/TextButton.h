// A button with words on it, and what it does in its tooltip and in the status bar.
#pragma once

#include <QPushButton>

namespace patina::editor {

// Accessible as `text`. Belongs to the layout it is put into.
[[nodiscard]] inline QPushButton* makeTextButton(const QString& text, const QString& help) {
    auto* button = new QPushButton(text);
    button->setToolTip(help);
    button->setStatusTip(help);
    button->setAccessibleName(text);
    return button;
}

} // namespace patina::editor
