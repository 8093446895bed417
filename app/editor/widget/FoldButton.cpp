#include "app/editor/widget/FoldButton.h"

#include "app/editor/style/Icons.h"
#include "app/editor/style/Tokens.h"

#include <QScrollArea>
#include <QScrollBar>
#include <QSettings>
#include <QWheelEvent>
#include <utility>

namespace patina::editor {

FoldButton::FoldButton(const QString& text, QString key, QWidget* parent)
    : QToolButton(parent)
    , m_key(std::move(key)) {
    setText(text);
    setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    setIconSize({14, 14});
    setFocusPolicy(Qt::TabFocus);
}

void FoldButton::setFolded(bool folded) {
    m_folded = folded;
    setIcon(editor::icon(folded ? QStringLiteral("chevron-right") : QStringLiteral("chevron-down"),
                         tokens::kTextDim));
    QSettings().setValue(m_key, folded);
}

bool FoldButton::remembered(bool otherwise) const {
    return QSettings().value(m_key, otherwise).toBool();
}

void scrollSideways(QScrollArea& area, const QWheelEvent& event) {
    const QPoint angle = event.angleDelta();
    QScrollBar* bar = area.horizontalScrollBar();
    bar->setValue(bar->value() - (angle.x() != 0 ? angle.x() : angle.y()));
}

} // namespace patina::editor
