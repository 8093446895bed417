#include "app/editor/widget/RowLabel.h"

#include "app/editor/style/Tokens.h"

#include <QMouseEvent>
#include <QPalette>

namespace patina::editor {

RowLabel::RowLabel(const QString& text, QWidget* parent)
    : QLabel(text, parent) {
    setFixedHeight(tokens::kRowHeight - 2);
    setAtDefault(true);
}

void RowLabel::setAtDefault(bool atDefault) {
    if (atDefault == m_atDefault)
        return; // a new palette costs more than all the rest of a row
    m_atDefault = atDefault;
    QPalette colors = palette();
    colors.setColor(QPalette::WindowText, QColor(atDefault ? tokens::kTextDim : tokens::kText));
    setPalette(colors);
}

void RowLabel::mouseDoubleClickEvent(QMouseEvent* event) {
    if (event->button() == Qt::LeftButton)
        Q_EMIT resetRequested();
}

} // namespace patina::editor
