// Words and numbers of a text file, one after another.
#pragma once

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>

namespace patina::codec {

class TokenReader {
  public:
    explicit TokenReader(std::string_view text)
        : m_rest(text) {}

    // The next word; empty at the end.
    std::string_view word() {
        std::size_t begin = 0;
        while (begin < m_rest.size() && isSpace(m_rest[begin]))
            ++begin;
        std::size_t end = begin;
        while (end < m_rest.size() && !isSpace(m_rest[end]))
            ++end;
        const std::string_view result = m_rest.substr(begin, end - begin);
        m_rest.remove_prefix(end);
        return result;
    }
    // The rest of the line, without its end.
    std::string_view line() {
        const std::size_t end = std::min(m_rest.find('\n'), m_rest.size());
        std::string_view result = m_rest.substr(0, end);
        m_rest.remove_prefix(std::min(end + 1, m_rest.size()));
        while (!result.empty() && isSpace(result.back()))
            result.remove_suffix(1);
        return result;
    }
    // Nothing when the next word is no number. "nan" and "inf" are numbers here.
    std::optional<double> number() {
        std::string_view text = word();
        if (text.starts_with('+'))
            text.remove_prefix(1);
        double value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        // Too large or too small for a double is still a number.
        if ((error != std::errc() && error != std::errc::result_out_of_range) ||
            end != text.data() + text.size() || text.empty())
            return std::nullopt;
        return value;
    }
    [[nodiscard]] std::string_view rest() const { return m_rest; }

  private:
    static bool isSpace(char c) {
        return c == ' ' || c == '\n' || c == '\r' || c == '\t' || c == '\v' || c == '\f' ||
               c == '\0';
    }
    std::string_view m_rest;
};

} // namespace patina::codec
