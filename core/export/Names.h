// Names that other programs can live with: valid UTF-8, unique, and safe as file names.
#pragma once

#include <set>
#include <string>
#include <string_view>

namespace patina {

// Invalid UTF-8 becomes U+FFFD, control characters become spaces; an empty name becomes `fallback`.
[[nodiscard]] std::string cleanName(std::string_view name, std::string_view fallback);

// ASCII letters, digits, '-', '_' and '.'; everything else becomes '_'. Such names need no
// escaping in a URI, which several readers do not undo.
[[nodiscard]] std::string fileSafeName(std::string_view name, std::string_view fallback);

// Hands out names that differ from each other, also for file systems that ignore case: the second
// "Body" is "Body_2".
class UniqueNames {
  public:
    [[nodiscard]] std::string take(const std::string& wanted);

  private:
    std::set<std::string> m_taken;
};

} // namespace patina
