#include "core/base/PrintableText.h"

#include "core/base/Utf8.h"

#include <cstdint>
#include <fmt/format.h>

namespace patina {

namespace {

constexpr std::string_view kReplacement = "\xef\xbf\xbd"; // U+FFFD

char32_t decode(std::string_view sequence) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(sequence[i]); };
    switch (sequence.size()) {
    case 1:
        return byte(0);
    case 2:
        return (byte(0) & 0x1fu) << 6 | (byte(1) & 0x3fu);
    case 3:
        return (byte(0) & 0x0fu) << 12 | (byte(1) & 0x3fu) << 6 | (byte(2) & 0x3fu);
    default:
        return (byte(0) & 0x07u) << 18 | (byte(1) & 0x3fu) << 12 | (byte(2) & 0x3fu) << 6 |
               (byte(3) & 0x3fu);
    }
}

constexpr char32_t kDelete = 0x7f;

// C1: eight-bit forms of escape sequences, which terminals know in UTF-8, too.
bool isUpperControl(char32_t c) {
    return c >= 0x80 && c <= 0x9f;
}

// Unicode's line and paragraph separators, embeddings, overrides and isolates (UAX #9).
bool reorders(char32_t c) {
    return (c >= 0x2028 && c <= 0x202e) || (c >= 0x2066 && c <= 0x2069);
}

// Calls visit(bytes, code point) for each character; a byte that is no UTF-8 comes as `otherwise`.
template <class Visit>
void forEachCharacter(std::string_view text, char32_t otherwise, const Visit& visit) {
    while (!text.empty()) {
        const std::size_t length = utf8SequenceLength(text);
        const std::string_view sequence = text.substr(0, length == 0 ? 1 : length);
        text.remove_prefix(sequence.size());
        visit(sequence, length == 0 ? otherwise : decode(sequence));
    }
}

std::string printable(std::string_view text, bool keepsLines) {
    std::string result;
    result.reserve(text.size());
    // Replaced like any control character above ASCII.
    forEachCharacter(text, 0x80, [&](std::string_view sequence, char32_t c) {
        const bool layout = c == '\n' || c == '\t';
        if (layout && keepsLines)
            result += sequence;
        else if (c < 0x20) // control pictures start at U+2400
            result += {'\xe2', '\x90', static_cast<char>(0x80 + c)};
        else if (c == kDelete)
            result += "\xe2\x90\xa1";
        else if (isUpperControl(c) || reorders(c))
            result += kReplacement;
        else
            result += sequence;
    });
    return result;
}

} // namespace

std::string printableLine(std::string_view text) {
    return printable(text, false);
}

std::string printableText(std::string_view text) {
    return printable(text, true);
}

std::string printableJson(std::string_view json) {
    std::string result;
    result.reserve(json.size());
    constexpr char32_t kReplacementCharacter = 0xfffd;
    forEachCharacter(json, kReplacementCharacter, [&](std::string_view sequence, char32_t c) {
        if (c == kReplacementCharacter || c == kDelete || isUpperControl(c) || reorders(c))
            result += fmt::format("\\u{:04x}", static_cast<std::uint32_t>(c));
        else
            result += sequence;
    });
    return result;
}

} // namespace patina
