// Which environments of a catalog are shown, and in which order.
#pragma once

#include "core/catalog/CatalogEntry.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace patina {

enum class CatalogSort {
    Name,
    SunElevation, // of the brightest source
    SunShare,     // the light that the brightest source has
    Range,
    KeyToFill,
    Temperature,
    Brightness
};
inline constexpr int kCatalogSorts = 7;

[[nodiscard]] std::string_view sortLabel(CatalogSort sort); // "Key to fill"
[[nodiscard]] std::string_view sortHelp(CatalogSort sort);

// The number that is sorted by; nothing for names, and where the environment has none: no source
// that stands out, no temperature.
[[nodiscard]] std::optional<double> sortNumber(const EnvironmentMeasures& measures,
                                               CatalogSort sort);

// Each word of `search` is part of the title, begins a word of a tag's label or is "duplicate" for
// one. Without regard to case.
[[nodiscard]] bool matchesSearch(const CatalogEntry& entry, bool isDuplicate,
                                 const std::string& search);

// Places in `entries` in the order of `sort`, ascending or descending; those without its number
// last, and ties by name. Names as people number them: "sky 2" before "sky 10".
[[nodiscard]] std::vector<std::size_t> sortedEntries(std::span<const CatalogEntryPtr> entries,
                                                     CatalogSort sort, bool descending);

} // namespace patina
