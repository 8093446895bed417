// Appending integers to a file's bytes, least significant byte first.
#pragma once

#include "core/base/AtomicFile.h"

#include <concepts>

namespace patina {

template <std::unsigned_integral T>
void appendLittleEndian(Bytes& out, T value) {
    for (std::size_t i = 0; i < sizeof(T); ++i)
        out.push_back(static_cast<std::byte>(value >> (8 * i)));
}

} // namespace patina
