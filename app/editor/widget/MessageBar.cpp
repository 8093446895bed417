#include "app/editor/widget/MessageBar.h"

#include <QStyleOption>
#include <QStylePainter>
#include <algorithm>

namespace patina::editor {
namespace {

constexpr int kBarMargin = 6; // logical pixels

} // namespace

QRect MessageBar::messageRect() const {
    int right = width();
    for (const QWidget* widget : findChildren<QWidget*>(Qt::FindDirectChildrenOnly))
        if (widget->isVisible())
            right = std::min(right, widget->x());
    return {kBarMargin, 0, std::max(right - 2 * kBarMargin, 0), height()};
}

QString MessageBar::shownMessage() const {
    return fontMetrics().elidedText(currentMessage(), Qt::ElideRight, messageRect().width());
}

void MessageBar::paintEvent(QPaintEvent*) {
    QStylePainter painter(this);
    QStyleOption option;
    option.initFrom(this);
    painter.drawPrimitive(QStyle::PE_PanelStatusBar, option);
    painter.setPen(palette().windowText().color());
    painter.drawText(messageRect(), Qt::AlignLeft | Qt::AlignVCenter | Qt::TextSingleLine,
                     shownMessage());
}

} // namespace patina::editor
