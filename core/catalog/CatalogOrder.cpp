#include "core/catalog/CatalogOrder.h"

#include "core/base/LowerCase.h"
#include "core/catalog/EnvironmentTags.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <sstream>
#include <string_view>

namespace patina {
namespace {

struct SortRow {
    std::string_view label, help;
};

// In the order of CatalogSort.
constexpr std::array<SortRow, kCatalogSorts> kSortRows{{
    {"Name", "by name"},
    {"Sun elevation", "by the height of the brightest source over the horizon"},
    {"Share of the sun", "by the share of the light that the brightest source has"},
    {"Dynamic range", "by the stops between the dark and the bright of it"},
    {"Key to fill", "by the light of the brightest side over that of the sides away from it"},
    {"Temperature", "by the colour temperature of the mean colour"},
    {"Brightness", "by the mean luminance"},
}};

bool isDigit(char c) {
    return c >= '0' && c <= '9';
}

// Without case, runs of digits as numbers: negative, 0, positive.
int compareNames(std::string_view a, std::string_view b) {
    std::size_t i = 0, j = 0;
    while (i < a.size() && j < b.size()) {
        if (isDigit(a[i]) && isDigit(b[j])) {
            const auto run = [](std::string_view text, std::size_t& at) {
                while (at < text.size() && text[at] == '0')
                    ++at;
                const std::size_t begin = at;
                while (at < text.size() && isDigit(text[at]))
                    ++at;
                return text.substr(begin, at - begin);
            };
            const std::string_view x = run(a, i), y = run(b, j);
            if (x.size() != y.size())
                return x.size() < y.size() ? -1 : 1;
            if (const int order = x.compare(y); order != 0)
                return order;
            continue;
        }
        if (a[i] != b[j])
            return static_cast<unsigned char>(a[i]) < static_cast<unsigned char>(b[j]) ? -1 : 1;
        ++i;
        ++j;
    }
    return static_cast<int>(a.size() - i > 0) - static_cast<int>(b.size() - j > 0);
}

// A word of the label begins with it.
bool beginsWord(std::string_view label, std::string_view word) {
    for (std::size_t at = label.find(word); at != std::string_view::npos;
         at = label.find(word, at + 1))
        if (at == 0 || label[at - 1] == ' ')
            return true;
    return false;
}

} // namespace

std::string_view sortLabel(CatalogSort sort) {
    return kSortRows[static_cast<std::size_t>(sort)].label;
}

std::string_view sortHelp(CatalogSort sort) {
    return kSortRows[static_cast<std::size_t>(sort)].help;
}

std::optional<double> sortNumber(const EnvironmentMeasures& m, CatalogSort sort) {
    const bool clear = m.source && m.source->isClear;
    switch (sort) {
    case CatalogSort::Name:
        return std::nullopt;
    case CatalogSort::SunElevation:
        return clear ? std::optional(m.source->elevationDeg) : std::nullopt;
    case CatalogSort::SunShare:
        return m.source ? std::optional(m.source->share) : std::nullopt;
    case CatalogSort::Range:
        return m.rangeStops;
    case CatalogSort::KeyToFill:
        return m.keyToFill;
    case CatalogSort::Temperature:
        return m.temperature ? std::optional(m.temperature->kelvin) : std::nullopt;
    case CatalogSort::Brightness:
        return m.meanLuminance;
    }
    return std::nullopt;
}

bool matchesSearch(const CatalogEntry& entry, bool isDuplicate, const std::string& search) {
    const std::string title = lowerCase(entry.title);
    const std::vector<EnvironmentTag> tags = tagsOf(entry.measures);
    std::istringstream words(lowerCase(search));
    for (std::string word; words >> word;) {
        const bool found = title.find(word) != std::string::npos ||
                           (isDuplicate && beginsWord("duplicate", word)) ||
                           std::ranges::any_of(tags, [&](EnvironmentTag tag) {
                               return beginsWord(lowerCase(tagLabel(tag)), word);
                           });
        if (!found)
            return false;
    }
    return true;
}

std::vector<std::size_t> sortedEntries(std::span<const CatalogEntryPtr> entries, CatalogSort sort,
                                       bool descending) {
    struct Key {
        std::optional<double> number;
        std::string name;
    };
    std::vector<Key> keys;
    for (const CatalogEntryPtr& entry : entries)
        keys.push_back({sortNumber(entry->measures, sort), lowerCase(entry->title)});
    std::vector<std::size_t> order(entries.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const bool byName = sort == CatalogSort::Name;
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
        const Key &x = keys[a], &y = keys[b];
        if (x.number.has_value() != y.number.has_value())
            return x.number.has_value();
        if (x.number && *x.number != *y.number)
            return descending ? *x.number > *y.number : *x.number < *y.number;
        const int names = compareNames(x.name, y.name);
        if (names != 0)
            return byName && descending ? names > 0 : names < 0;
        return entries[a]->source < entries[b]->source;
    });
    return order;
}

} // namespace patina
