// Changing text that a library reads, here and there, in linear time.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>

namespace patina::codec {

inline constexpr std::string_view kBlanks = " \t";

// The text, copied from the first change on.
class TextRewriting {
  public:
    explicit TextRewriting(std::string_view text)
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

} // namespace patina::codec
