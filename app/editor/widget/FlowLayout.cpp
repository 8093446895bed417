#include "app/editor/widget/FlowLayout.h"

#include <algorithm>

namespace patina::editor {

FlowLayout::FlowLayout(int horizontalGap, int verticalGap, QWidget* parent)
    : QLayout(parent)
    , m_horizontalGap(horizontalGap)
    , m_verticalGap(verticalGap) {}

FlowLayout::~FlowLayout() {
    qDeleteAll(m_items);
}

void FlowLayout::addItem(QLayoutItem* item) {
    m_items << item;
}

QLayoutItem* FlowLayout::itemAt(int index) const {
    return m_items.value(index);
}

QLayoutItem* FlowLayout::takeAt(int index) {
    return index >= 0 && index < m_items.size() ? m_items.takeAt(index) : nullptr;
}

int FlowLayout::heightForWidth(int width) const {
    return arrange(QRect(0, 0, width, 0), false);
}

QSize FlowLayout::minimumSize() const {
    QSize size;
    for (const QLayoutItem* item : m_items)
        if (!item->isEmpty())
            size = size.expandedTo(item->minimumSize());
    const QMargins margins = contentsMargins();
    return size + QSize(margins.left() + margins.right(), margins.top() + margins.bottom());
}

void FlowLayout::setGeometry(const QRect& rect) {
    QLayout::setGeometry(rect);
    arrange(rect, true);
}

int FlowLayout::arrange(const QRect& rect, bool apply) const {
    const QRect inner = rect.marginsRemoved(contentsMargins());
    int x = inner.x(), y = inner.y(), height = 0;
    QList<std::pair<QLayoutItem*, QRect>> row;
    const auto endRow = [&] {
        if (apply)
            for (auto& [item, place] : row) // centred on the row's middle
                item->setGeometry(place.translated(0, (height - place.height()) / 2));
        row.clear();
    };
    for (QLayoutItem* item : m_items) {
        if (item->isEmpty())
            continue;
        const QSize size = item->sizeHint()
                               .expandedTo(item->minimumSize())
                               .boundedTo({std::max(inner.width(), item->minimumSize().width()),
                                           item->maximumSize().height()});
        if (x > inner.x() && x + size.width() > inner.right() + 1) {
            endRow();
            x = inner.x();
            y += height + m_verticalGap;
            height = 0;
        }
        row << std::pair(item, QRect(QPoint(x, y), size));
        x += size.width() + m_horizontalGap;
        height = std::max(height, size.height());
    }
    endRow();
    return y + height - rect.y() + contentsMargins().bottom();
}

} // namespace patina::editor
