// What the Library dock says of an environment.
#pragma once

#include "core/catalog/CatalogOrder.h"

#include <QString>

namespace patina::editor {

struct LibraryItem;

// "Sun, High contrast, Neutral", and "Duplicate" for one.
[[nodiscard]] QString tagsText(const LibraryItem& item);
// The number that is sorted by ("12.6 : 1"); its size in pixels where that is the name; "not
// measured yet".
[[nodiscard]] QString sortedText(const LibraryItem& item, CatalogSort sort);
// Two short lines: what it is called and how it is tagged; what was measured.
struct LibrarySummary {
    QString name, measures;
};
[[nodiscard]] LibrarySummary summaryOf(const LibraryItem& item);
// All that is known of it, in words.
[[nodiscard]] QString describedText(const LibraryItem& item);
// The same as a table for a tooltip, with what the tags mean.
[[nodiscard]] QString toolTipText(const LibraryItem& item);

} // namespace patina::editor
