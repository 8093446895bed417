// How --help looks: options and what they mean in two columns, counted in letters instead of bytes,
// the second one wrapped.
#pragma once

#include <CLI/App.hpp>
#include <CLI/FormatterFwd.hpp>
#include <string>

namespace patina::cli {

class HelpFormatter : public CLI::Formatter {
  public:
    std::string make_option(const CLI::Option* option, bool isPositional) const override;
};

// `name` and `help` as a row of the two columns; the second begins at `column`, and with a line of
// its own where the name is too long. No line is longer than 100 letters where words allow it.
[[nodiscard]] std::string helpRow(const std::string& name, const std::string& help,
                                  std::size_t column);

} // namespace patina::cli
