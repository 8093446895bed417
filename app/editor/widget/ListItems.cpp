#include "app/editor/widget/ListItems.h"

#include <QListWidget>
#include <algorithm>

namespace patina::editor {

Id idOf(const QListWidgetItem& item) {
    return item.data(Qt::UserRole).toUInt();
}

QListWidgetItem* placeItem(QListWidget& list, Id element, int row, Qt::ItemFlags flags) {
    int from = row;
    while (from < list.count() && idOf(*list.item(from)) != element)
        ++from;
    if (from == row && from < list.count())
        return list.item(row);
    QListWidgetItem* item = list.takeItem(from); // null: none yet
    if (!item) {
        item = new QListWidgetItem;
        item->setData(Qt::UserRole, element);
        // Once: setting flags brings the old name back into an open editor.
        item->setFlags(item->flags() | flags);
    }
    list.insertItem(row, item);
    return item;
}

void removeItems(QListWidget& list, const std::function<bool(Id)>& isGone) {
    for (int row = list.count() - 1; row >= 0; --row)
        if (isGone(idOf(*list.item(row))))
            delete list.takeItem(row);
}

void fitHeight(QListWidget& list) {
    constexpr int kShownRows = 4;
    if (list.count() > 0)
        list.setFixedHeight(std::min(list.count(), kShownRows) * list.sizeHintForRow(0) +
                            2 * list.frameWidth() + 6);
}

} // namespace patina::editor
