// Texts from files, names above all, as people may see them: no character of theirs steers a
// terminal or reorders what stands around it.
#pragma once

#include <string>
#include <string_view>

namespace patina {

// On one line: control characters become their pictures ("␛" for escape, "␊" for a line's end),
// those beyond ASCII, ends of lines and paragraphs, changes of writing direction and bytes that are
// no UTF-8 become U+FFFD.
[[nodiscard]] std::string printableLine(std::string_view text);
// The same, but ends of lines and tabs stay: for texts that have lines of their own.
[[nodiscard]] std::string printableText(std::string_view text);

// JSON text (core/document and the command line leave characters beyond ASCII as they are) with
// control characters beyond those that JSON escapes by itself escaped, too: a terminal obeys them.
[[nodiscard]] std::string printableJson(std::string_view json);

} // namespace patina
