#include "app/editor/widget/PanelScroll.h"

#include "app/editor/style/Tokens.h"

#include <QEvent>
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
    body->installEventFilter(this);
}

bool PanelScroll::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::LayoutRequest)
        updateGeometry();
    return QScrollArea::eventFilter(watched, event);
}

QSize PanelScroll::sizeHint() const {
    return {312, 320};
}

QSize PanelScroll::minimumSizeHint() const {
    return {widget()->minimumSizeHint().width() + verticalScrollBar()->sizeHint().width(), 80};
}

} // namespace patina::editor
