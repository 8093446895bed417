// Bytes as text, for files that hold text alone (RFC 4648, section 4, with padding).
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace patina {

[[nodiscard]] std::string toBase64(std::span<const std::byte> bytes);
// Nothing where the text is not what toBase64() writes of some bytes.
[[nodiscard]] std::optional<std::vector<std::byte>> fromBase64(std::string_view text);

} // namespace patina
