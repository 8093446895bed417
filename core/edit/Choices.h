// The choices of a parameter: one row for each enumerator. What would make files, menus and the
// enum disagree does not compile: a row that is missing, superfluous or in another place, or a name
// that is not the enumerator's.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

namespace patina {

template <class E>
struct Choice {
    E value;
    std::string_view name;  // as in files: the enumerator's, beginning with a small letter
    std::string_view label; // as shown
};

namespace detail {

// "PbrNeutral" of ToneMap::PbrNeutral; empty where no enumerator has this value.
template <auto V>
consteval std::string_view enumeratorName() {
    // GCC: "… [with auto V = patina::ToneMap::Clamp; …]", Clang: "… [V = patina::ToneMap::Clamp]";
    // of any other number: "V = (patina::ToneMap)8".
    constexpr std::string_view kSignature = __PRETTY_FUNCTION__;
    constexpr std::string_view kBefore = "V = ";
    std::string_view text = kSignature.substr(kSignature.find(kBefore) + kBefore.size());
    text = text.substr(0, text.find_first_of(";]"));
    if (text.starts_with('('))
        return {};
    return text.substr(text.rfind(':') + 1);
}

constexpr char lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

consteval bool sameLetters(std::string_view a, std::string_view b) {
    if (a.size() != b.size())
        return false;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (lower(a[i]) != lower(b[i]))
            return false;
    return true;
}

} // namespace detail

template <class E, std::size_t N>
class Choices {
  public:
    // NOLINTNEXTLINE(google-explicit-constructor): reads as a table
    consteval Choices(const Choice<E> (&rows)[N]) {
        check(rows, std::make_index_sequence<N>());
        for (std::size_t i = 0; i < N; ++i) {
            m_names[i] = rows[i].name;
            m_labels[i] = rows[i].label;
        }
    }
    [[nodiscard]] constexpr const std::array<std::string_view, N>& names() const { return m_names; }
    [[nodiscard]] constexpr const std::array<std::string_view, N>& labels() const {
        return m_labels;
    }

  private:
    template <std::size_t I>
    static consteval void checkRow(const Choice<E>& row) {
        if (row.value != static_cast<E>(I))
            throw "the rows are in the order of the enum, one for each enumerator";
        if (!detail::sameLetters(row.name, detail::enumeratorName<static_cast<E>(I)>()))
            throw "the name of a choice is that of its enumerator";
        if (row.name.front() != detail::lower(row.name.front()) || row.label.empty())
            throw "a name begins with a small letter, and every choice has a label";
    }
    template <std::size_t... I>
    static consteval void check(const Choice<E> (&rows)[N], std::index_sequence<I...>) {
        (checkRow<I>(rows[I]), ...);
        if (!detail::enumeratorName<static_cast<E>(N)>().empty())
            throw "an enumerator has no row";
    }

    std::array<std::string_view, N> m_names{}, m_labels{};
};

} // namespace patina
