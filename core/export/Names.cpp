#include "core/export/Names.h"

#include <algorithm>
#include <cstddef>
#include <fmt/format.h>

namespace patina {
namespace {

// Length of the well-formed UTF-8 sequence at the start of `text`, 0 when there is none
// (Unicode 15, table 3-7: no overlong forms, no surrogates).
std::size_t sequenceLength(std::string_view text) {
    const auto byte = [&](std::size_t i) {
        return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
    };
    const auto continues = [&](std::size_t i, unsigned low = 0x80, unsigned high = 0xbf) {
        return byte(i) >= low && byte(i) <= high;
    };
    const unsigned first = byte(0);
    if (first < 0x80)
        return 1;
    if (first >= 0xc2 && first <= 0xdf)
        return continues(1) ? 2 : 0;
    if (first >= 0xe0 && first <= 0xef) {
        const unsigned low = first == 0xe0 ? 0xa0 : 0x80;
        const unsigned high = first == 0xed ? 0x9f : 0xbf;
        return continues(1, low, high) && continues(2) ? 3 : 0;
    }
    if (first >= 0xf0 && first <= 0xf4) {
        const unsigned low = first == 0xf0 ? 0x90 : 0x80;
        const unsigned high = first == 0xf4 ? 0x8f : 0xbf;
        return continues(1, low, high) && continues(2) && continues(3) ? 4 : 0;
    }
    return 0;
}

std::string lowerAscii(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return text;
}

} // namespace

std::string cleanName(std::string_view name, std::string_view fallback) {
    std::string result;
    while (!name.empty()) {
        const std::size_t length = sequenceLength(name);
        if (length == 0)
            result += "\xef\xbf\xbd";
        else if (length == 1 && (static_cast<unsigned char>(name[0]) < 0x20 || name[0] == 0x7f))
            result += ' ';
        else
            result += name.substr(0, length);
        name.remove_prefix(std::max<std::size_t>(length, 1));
    }
    const bool blank = result.find_first_not_of(' ') == std::string::npos;
    return blank ? std::string(fallback) : result;
}

std::string fileSafeName(std::string_view name, std::string_view fallback) {
    std::string result;
    for (const char c : name) {
        const bool safe = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                          (c >= '0' && c <= '9') || c == '-' || c == '_' || c == '.';
        result += safe ? c : '_';
    }
    // File systems end at 255 bytes; suffixes and extensions still have to fit.
    result.resize(std::min<std::size_t>(result.size(), 100));
    const bool meaningless = result.find_first_not_of("_.") == std::string::npos;
    return meaningless ? std::string(fallback) : result;
}

std::string UniqueNames::take(const std::string& wanted) {
    std::string name = wanted;
    for (int n = 2; !m_taken.insert(lowerAscii(name)).second; ++n)
        name = fmt::format("{}_{}", wanted, n);
    return name;
}

} // namespace patina
