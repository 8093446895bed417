#include "core/codec/model/AssimpText.h"

#include "core/base/Utf8.h"
#include "core/codec/model/TextRewriting.h"

namespace patina::codec {

namespace {

constexpr std::string_view kDigits = "0123456789", kBeginsNumbers = "0123456789.-+";

bool isOneOf(std::string_view characters, char c) {
    return characters.find(c) != std::string_view::npos;
}

// `rewrite` of a text in UTF-16 is that of the same in UTF-8.
template <class Rewrite>
std::optional<std::string> inUtf8(std::string_view text, const Rewrite& rewrite) {
    std::optional<std::string> utf8 = utf8FromUtf16(text);
    if (!utf8)
        return rewrite(text);
    std::optional<std::string> rewritten = rewrite(*utf8);
    return rewritten ? rewritten : utf8;
}

std::optional<std::string> objOfUtf8(std::string_view text) {
    TextRewriting rewriting(text);
    forLines(text, [&](std::size_t begin, std::size_t first, std::size_t end) {
        if (first > begin)
            rewriting.replace(begin, "", first);
        if (text[first] != 'v')
            return;
        // Nothing is sought beyond the line: that would be quadratic in a file of whole numbers.
        const std::string_view line = text.substr(first, end - first);
        for (std::size_t at = line.find('.'); at != std::string_view::npos;
             at = line.find('.', at + 1)) {
            const std::size_t token = at - (isOneOf("-+", line[at - 1]) ? 1 : 0);
            if (isOneOf(kBlanks, line[token - 1]) && at + 1 < line.size() &&
                isOneOf(kDigits, line[at + 1]))
                rewriting.replace(first + at, "0", first + at);
        }
    });
    return rewriting.result();
}

std::optional<std::string> colladaOfUtf8(std::string_view text) {
    TextRewriting rewriting(text);
    for (std::size_t at = text.find('>'); at < text.size(); at = text.find('>', at + 1)) {
        const std::size_t next = text.find_first_not_of(" \t\r\n", at + 1);
        if (next > at + 1 && next < text.size() && isOneOf(kBeginsNumbers, text[next]))
            rewriting.replace(at + 1, "", next);
    }
    return rewriting.result();
}

} // namespace

std::optional<std::string> objForAssimp(std::string_view text) {
    return inUtf8(text, objOfUtf8);
}

std::optional<std::string> colladaForAssimp(std::string_view text) {
    return inUtf8(text, colladaOfUtf8);
}

} // namespace patina::codec
