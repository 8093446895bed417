#include "app/editor/widget/PanelScroll.h"

#include "app/editor/style/Tokens.h"

#include <QScrollBar>
#include <QVBoxLayout>

namespace patina::editor {

PanelScroll::PanelScroll(QWidget* parent)
    : QScrollArea(parent) {
    auto* body = new QWidget;
    body->setObjectName(QStringLiteral("panelContents"));
    m_layout = new QVBoxLayout(body);
    m_layout->setContentsMargins(tokens::kMargin, tokens::kGap, tokens::kMargin, tokens::kMargin);
    m_layout->setSpacing(tokens::kGap);
    setWidget(body);
    setWidgetResizable(true);
    setFrameShape(QFrame::NoFrame);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    setFocusPolicy(Qt::NoFocus);
}

QSize PanelScroll::sizeHint() const {
    return {312, 320};
}

QSize PanelScroll::minimumSizeHint() const {
    return {widget()->minimumSizeHint().width() + verticalScrollBar()->sizeHint().width(), 80};
}

} // namespace patina::editor
