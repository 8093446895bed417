// Numbers in the text of an option.
#pragma once

#include <charconv>
#include <cmath>
#include <concepts>
#include <string_view>
#include <system_error>
#include <vector>

namespace patina::cli {

// Numbers between separators; false when anything else is there. Infinity and NaN are no numbers
// here.
template <class Number>
bool parseNumbers(std::string_view text, char separator, std::vector<Number>& numbers) {
    while (true) {
        const std::string_view part = text.substr(0, text.find(separator));
        Number number{};
        const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), number);
        if (error != std::errc() || end != part.data() + part.size())
            return false;
        if constexpr (std::floating_point<Number>)
            if (!std::isfinite(number))
                return false;
        numbers.push_back(number);
        if (part.size() == text.size())
            return true;
        text.remove_prefix(part.size() + 1);
    }
}

} // namespace patina::cli
