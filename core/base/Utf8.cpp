#include "core/base/Utf8.h"

namespace patina {

std::size_t utf8SequenceLength(std::string_view text) {
    if (text.empty())
        return 0;
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char lead = byte(0);
    if (lead < 0x80)
        return 1;
    const std::size_t length = lead >= 0xc2 && lead <= 0xdf   ? 2
                               : (lead & 0xf0) == 0xe0        ? 3
                               : lead >= 0xf0 && lead <= 0xf4 ? 4
                                                              : 0;
    if (length == 0 || text.size() < length)
        return 0;
    for (std::size_t i = 1; i < length; ++i)
        if ((byte(i) & 0xc0) != 0x80)
            return 0;
    // The second byte also rules out overlong forms, surrogates and what lies beyond U+10FFFF.
    const bool valid = !(lead == 0xe0 && byte(1) < 0xa0) && !(lead == 0xed && byte(1) > 0x9f) &&
                       !(lead == 0xf0 && byte(1) < 0x90) && !(lead == 0xf4 && byte(1) > 0x8f);
    return valid ? length : 0;
}

std::optional<std::string> utf8FromUtf16(std::string_view text) {
    const bool bigEndian = text.starts_with("\xfe\xff");
    if (!bigEndian && !text.starts_with("\xff\xfe"))
        return std::nullopt;
    const auto unit = [&](std::size_t i) -> char32_t {
        const auto first = static_cast<unsigned char>(text[i]),
                   second = static_cast<unsigned char>(text[i + 1]);
        return bigEndian ? first << 8 | second : second << 8 | first;
    };
    std::string result;
    result.reserve(text.size() / 2);
    for (std::size_t i = 2; i + 1 < text.size(); i += 2) {
        char32_t c = unit(i);
        if (c >= 0xd800 && c <= 0xdfff) { // half of a character
            const char32_t low = c <= 0xdbff && i + 3 < text.size() ? unit(i + 2) : 0;
            const bool pair = low >= 0xdc00 && low <= 0xdfff;
            c = pair ? 0x10000 + ((c - 0xd800) << 10 | (low - 0xdc00)) : 0xfffd;
            i += pair ? 2 : 0;
        }
        const auto tail = [&](int shift) {
            result += static_cast<char>(0x80 | ((c >> shift) & 0x3f));
        };
        if (c < 0x80) {
            result += static_cast<char>(c);
        } else if (c < 0x800) {
            result += static_cast<char>(0xc0 | c >> 6);
            tail(0);
        } else if (c < 0x10000) {
            result += static_cast<char>(0xe0 | c >> 12);
            tail(6);
            tail(0);
        } else {
            result += static_cast<char>(0xf0 | c >> 18);
            tail(12);
            tail(6);
            tail(0);
        }
    }
    if (text.size() % 2 != 0)
        result += "\xef\xbf\xbd";
    return result;
}

std::string makeValidUtf8(std::string_view text) {
    std::string result;
    result.reserve(text.size());
    while (!text.empty()) {
        const std::size_t length = utf8SequenceLength(text);
        result += length > 0 ? text.substr(0, length) : std::string_view("\xef\xbf\xbd");
        text.remove_prefix(length > 0 ? length : 1);
    }
    return result;
}

} // namespace patina
