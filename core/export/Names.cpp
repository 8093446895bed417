#include "core/export/Names.h"

#include "core/base/Utf8.h"

#include <algorithm>
#include <cstddef>
#include <fmt/format.h>

namespace patina {
namespace {

std::string lowerAscii(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return text;
}

} // namespace

std::string cleanName(std::string_view name, std::string_view fallback) {
    std::string result = makeValidUtf8(name);
    for (char& c : result)
        if ((c >= 0 && c < 0x20) || c == 0x7f)
            c = ' ';
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
