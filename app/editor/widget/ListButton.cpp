#include "app/editor/widget/ListButton.h"

#include "app/editor/style/Icons.h"

#include <QToolButton>

namespace patina::editor {

QToolButton* makeListButton(const QString& iconName, const QString& text, const QString& tip) {
    auto* button = new QToolButton;
    button->setIcon(icon(iconName));
    if (!text.isEmpty()) {
        button->setObjectName(QStringLiteral("raised"));
        button->setText(text);
        button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    }
    button->setToolTip(tip);
    button->setStatusTip(tip);
    button->setAccessibleName(tip);
    button->setFocusPolicy(Qt::TabFocus);
    return button;
}

} // namespace patina::editor
