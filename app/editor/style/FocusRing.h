// The colour of the ring around what the keys go to, and of nothing else.
#pragma once

#include <QRgb>

namespace patina::editor::tokens {

inline constexpr QRgb kFocus = 0xfff6f7f8;

} // namespace patina::editor::tokens
