// What a control is called and does, for the pointer and for screen readers alike.
#pragma once

#include <QString>
#include <QWidget>

namespace patina::editor {

// Tool tip and accessible description are the same sentence.
template <class Widget>
Widget* withHelp(Widget* widget, const QString& help) {
    widget->setToolTip(help);
    widget->setAccessibleDescription(help);
    return widget;
}

// The same with a name for screen readers, where the control has no label of its own, and in the
// status bar.
template <class Widget>
Widget* describe(Widget* widget, const QString& name, const QString& help) {
    widget->setAccessibleName(name);
    widget->setStatusTip(help);
    return withHelp(widget, help);
}

} // namespace patina::editor
