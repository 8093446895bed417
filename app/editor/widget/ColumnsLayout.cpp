#include "app/editor/widget/ColumnsLayout.h"

#include <QWidget>
#include <algorithm>

namespace patina::editor {
namespace {

int stretchOf(QLayoutItem* item) {
    return std::max(item->widget() ? item->widget()->sizePolicy().horizontalStretch() : 1, 1);
}

} // namespace

ColumnsLayout::ColumnsLayout(int gap, QWidget* parent)
    : QLayout(parent)
    , m_gap(gap) {
    setContentsMargins(0, 0, 0, 0);
}

ColumnsLayout::~ColumnsLayout() {
    for (QLayoutItem* item : m_items)
        delete item;
}

void ColumnsLayout::addItem(QLayoutItem* item) {
    m_items.push_back(item);
}

int ColumnsLayout::count() const {
    return static_cast<int>(m_items.size());
}

QLayoutItem* ColumnsLayout::itemAt(int index) const {
    return index >= 0 && index < count() ? m_items[static_cast<std::size_t>(index)] : nullptr;
}

QLayoutItem* ColumnsLayout::takeAt(int index) {
    QLayoutItem* item = itemAt(index);
    if (item)
        m_items.erase(m_items.begin() + index);
    return item;
}

std::vector<ColumnsLayout::Row> ColumnsLayout::rows(int width) const {
    std::vector<Row> rows;
    int used = 0;
    for (QLayoutItem* item : m_items) {
        if (item->isEmpty())
            continue; // hidden
        const int least = std::min(item->minimumSize().width(), width);
        if (rows.empty() || used + m_gap + least > width) {
            rows.emplace_back();
            used = least;
        } else {
            used += m_gap + least;
        }
        rows.back().items.push_back(item);
        rows.back().widths.push_back(least);
    }
    for (Row& row : rows) {
        int left = width - m_gap * (static_cast<int>(row.items.size()) - 1), stretch = 0;
        for (std::size_t i = 0; i < row.items.size(); ++i) {
            left -= row.widths[i];
            stretch += stretchOf(row.items[i]);
        }
        for (std::size_t i = 0; i < row.items.size(); ++i) {
            QLayoutItem* item = row.items[i];
            const int own = stretchOf(item), more = left * own / stretch;
            row.widths[i] += more;
            left -= more;
            stretch -= own;
            row.height =
                std::max(row.height, item->hasHeightForWidth() ? item->heightForWidth(row.widths[i])
                                                               : item->sizeHint().height());
            row.expands |= item->expandingDirections().testFlag(Qt::Vertical);
        }
    }
    return rows;
}

int ColumnsLayout::heightForWidth(int width) const {
    const std::vector<Row> all = rows(width);
    int height = m_gap * std::max(static_cast<int>(all.size()) - 1, 0);
    for (const Row& row : all)
        height += row.height;
    return height;
}

Qt::Orientations ColumnsLayout::expandingDirections() const {
    Qt::Orientations directions = Qt::Horizontal;
    for (QLayoutItem* item : m_items)
        if (item->expandingDirections().testFlag(Qt::Vertical))
            directions |= Qt::Vertical;
    return directions;
}

QSize ColumnsLayout::sizeHint() const {
    return {320, heightForWidth(320)};
}

QSize ColumnsLayout::minimumSize() const {
    int width = 0;
    for (QLayoutItem* item : m_items)
        width = std::max(width, item->minimumSize().width());
    return {width, 0};
}

void ColumnsLayout::setGeometry(const QRect& rect) {
    QLayout::setGeometry(rect);
    std::vector<Row> all = rows(rect.width());
    int left = rect.height() - m_gap * std::max(static_cast<int>(all.size()) - 1, 0), expanding = 0;
    for (const Row& row : all) {
        left -= row.height;
        expanding += row.expands ? 1 : 0;
    }
    int y = rect.top();
    for (Row& row : all) {
        if (row.expands && left > 0) {
            const int more = left / expanding;
            row.height += more;
            left -= more;
            --expanding;
        }
        int x = rect.left();
        for (std::size_t i = 0; i < row.items.size(); ++i) {
            row.items[i]->setGeometry(
                {x, y, row.widths[i], std::min(row.height, row.items[i]->maximumSize().height())});
            x += row.widths[i] + m_gap;
        }
        y += row.height + m_gap;
    }
}

} // namespace patina::editor
