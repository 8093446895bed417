#include "app/editor/widget/ReflowGrid.h"

#include <QWidget>
#include <algorithm>

namespace patina::editor {

ReflowGrid::ReflowGrid(int minimumColumn, int spacing, QWidget* parent)
    : QLayout(parent)
    , m_minimumColumn(minimumColumn) {
    setContentsMargins(0, 0, 0, 0);
    setSpacing(spacing);
}

ReflowGrid::~ReflowGrid() {
    qDeleteAll(m_items);
}

void ReflowGrid::addItem(QLayoutItem* item) {
    m_items << item;
}

QLayoutItem* ReflowGrid::itemAt(int index) const {
    return m_items.value(index);
}

QLayoutItem* ReflowGrid::takeAt(int index) {
    return index >= 0 && index < m_items.size() ? m_items.takeAt(index) : nullptr;
}

int ReflowGrid::columns(int width) const {
    return std::max(1, (width + spacing()) / (m_minimumColumn + spacing()));
}

int ReflowGrid::arrange(const QRect& rect, bool apply) const {
    QList<QLayoutItem*> shown;
    for (QLayoutItem* item : m_items)
        if (!item->isEmpty())
            shown << item;
    if (shown.isEmpty())
        return 0;
    // Few things do not grow without limit: the columns are those of a full row.
    const int columnCount = columns(rect.width());
    const double column =
        static_cast<double>(rect.width() - spacing() * (columnCount - 1)) / columnCount;
    int y = rect.top();
    for (int first = 0; first < shown.size(); first += columnCount) {
        const int last = std::min(first + columnCount, static_cast<int>(shown.size()));
        int height = 0;
        for (int i = first; i < last; ++i) {
            QLayoutItem* item = shown[i];
            const int width = static_cast<int>(column);
            height = std::max(height, item->hasHeightForWidth() ? item->heightForWidth(width)
                                                                : item->sizeHint().height());
        }
        if (apply)
            for (int i = first; i < last; ++i) {
                const int place = i - first;
                const int left = static_cast<int>(place * (column + spacing()));
                const int right = static_cast<int>(place * (column + spacing()) + column);
                shown[i]->setGeometry({rect.left() + left, y, right - left, height});
            }
        y += height + spacing();
    }
    return y - spacing() - rect.top();
}

int ReflowGrid::heightForWidth(int width) const {
    return arrange({0, 0, width, 0}, false);
}

void ReflowGrid::setGeometry(const QRect& rect) {
    QLayout::setGeometry(rect);
    arrange(rect, true);
}

QSize ReflowGrid::sizeHint() const {
    const int width = 3 * m_minimumColumn + 2 * spacing();
    return {width, heightForWidth(width)};
}

QSize ReflowGrid::minimumSize() const {
    return {m_minimumColumn, 0};
}

} // namespace patina::editor
