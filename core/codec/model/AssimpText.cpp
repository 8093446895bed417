#include "core/codec/model/AssimpText.h"

#include <algorithm>

namespace patina::codec {

namespace {

constexpr std::string_view kBlanks = " \t";
constexpr std::string_view kDigits = "0123456789", kBeginsNumbers = "0123456789.-+";

bool isOneOf(std::string_view characters, char c) {
    return characters.find(c) != std::string_view::npos;
}

// The text, copied from the first change on.
class Rewriting {
  public:
    explicit Rewriting(std::string_view text)
        : m_text(text) {}

    // What was not copied yet goes up to `at`, then `added`; it goes on from `next`.
    void replace(std::size_t at, std::string_view added, std::size_t next) {
        m_result.append(m_text.substr(m_copied, at - m_copied)).append(added);
        m_copied = next;
        m_changed = true;
    }
    std::optional<std::string> result() {
        if (!m_changed)
            return std::nullopt;
        m_result.append(m_text.substr(m_copied));
        return std::move(m_result);
    }

  private:
    std::string_view m_text;
    std::string m_result;
    std::size_t m_copied = 0;
    bool m_changed = false;
};

// Calls `use` with each line's begin, its first character that is no blank and its end.
template <class Use>
void forLines(std::string_view text, Use use) {
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        if (const std::size_t first = text.find_first_not_of(kBlanks, begin); first < end)
            use(begin, first, end);
        begin = end + 1;
    }
}

} // namespace

std::optional<std::string> objForAssimp(std::string_view text) {
    Rewriting rewriting(text);
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

std::optional<std::string> mtlForAssimp(std::string_view text) {
    Rewriting rewriting(text);
    forLines(text, [&](std::size_t begin, std::size_t first, std::size_t end) {
        if (text.substr(first).starts_with("aniso"))
            rewriting.replace(begin, "", end);
    });
    return rewriting.result();
}

std::optional<std::string> colladaForAssimp(std::string_view text) {
    Rewriting rewriting(text);
    for (std::size_t at = text.find('>'); at < text.size(); at = text.find('>', at + 1)) {
        const std::size_t next = text.find_first_not_of(" \t\r\n", at + 1);
        if (next > at + 1 && next < text.size() && isOneOf(kBeginsNumbers, text[next]))
            rewriting.replace(at + 1, "", next);
    }
    return rewriting.result();
}

} // namespace patina::codec
