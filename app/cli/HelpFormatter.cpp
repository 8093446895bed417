#include "app/cli/HelpFormatter.h"

#include <algorithm>
#include <sstream>

namespace patina::cli {
namespace {

constexpr std::size_t kWidth = 100;

// Of UTF-8 text: all bytes but those that go on with a letter.
std::size_t letters(const std::string& text) {
    return static_cast<std::size_t>(std::ranges::count_if(
        text, [](char c) { return (static_cast<unsigned char>(c) & 0xc0u) != 0x80u; }));
}

} // namespace

std::string helpRow(const std::string& name, const std::string& help, std::size_t column) {
    std::string row = "  " + name;
    std::size_t at = letters(row);
    const auto breakLine = [&] {
        row += '\n';
        at = 0;
    };
    if (at + 1 > column)
        breakLine();
    bool first = true; // word of its line
    std::istringstream words(help);
    for (std::string word; words >> word;) {
        if (!first && at + 1 + letters(word) > kWidth) {
            breakLine();
            first = true;
        }
        const std::size_t space = first ? column - at : 1;
        row += std::string(space, ' ') + word;
        at += space + letters(word);
        first = false;
    }
    return row + '\n';
}

std::string HelpFormatter::make_option(const CLI::Option* option, bool isPositional) const {
    return helpRow(make_option_name(option, isPositional) + make_option_opts(option),
                   make_option_desc(option), get_column_width());
}

} // namespace patina::cli
