// The parameter table as text: the reference page docs/parameters.md and `patina parameters`.
#pragma once

#include <string>

namespace patina {

[[nodiscard]] std::string parametersAsMarkdown();
// {"parameters": [{"id", "alias", "label", "group", "scope", "type", "default", "hardRange",
// "softRange", "unit", "choices", "help"} …]}; keys that do not apply are absent.
[[nodiscard]] std::string parametersAsJson();

} // namespace patina
