// From argc and argv to an Invocation. CLI11 is seen behind it only (CommandParser.h).
#pragma once

#include "app/cli/Options.h"
#include "core/base/Result.h"

#include <string>
#include <variant>

namespace patina::cli {

struct HelpText {
    std::string text;
};

// An Invocation, a text to print (--help, --version), or a Usage error.
Result<std::variant<Invocation, HelpText>> parseCommandLine(int argc, const char* const* argv);

// True when the arguments are for the editor: none at all, "edit", files or the editor's options.
// A misspelt command is not taken for a file.
[[nodiscard]] bool isForEditor(int argc, const char* const* argv);

} // namespace patina::cli
