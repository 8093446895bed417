// What names an element of a document.
#pragma once

#include <cstdint>

namespace patina {

using Id = std::uint32_t; // unique within a document, never reused; 0 is "none"

} // namespace patina
