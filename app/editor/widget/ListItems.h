// Lists of a panel that show elements of the document, an item for each: an item stays with its
// element, and so does the name that is being typed into it.
#pragma once

#include "core/base/Id.h"

#include <Qt>
#include <functional>

class QListWidget;
class QListWidgetItem;

namespace patina::editor {

[[nodiscard]] Id idOf(const QListWidgetItem& item);

// The element's item, moved to `row`; a new one has `flags` besides the usual ones. Rows are placed
// from the first on.
QListWidgetItem* placeItem(QListWidget& list, Id element, int row, Qt::ItemFlags flags);
void removeItems(QListWidget& list, const std::function<bool(Id)>& isGone);
// As high as its rows, but at most four: more scroll.
void fitHeight(QListWidget& list);

} // namespace patina::editor
