// How much memory there is, and how much this process has.
#pragma once

#include <cstddef>
#include <cstdint>

namespace patina {

// Bytes in the machine's memory, not swapped out; 0 where the system does not say.
[[nodiscard]] std::size_t residentMemory();
// Bytes of the machine; 0 where the system does not say.
[[nodiscard]] std::size_t installedMemory();

// What this process may still take before the system swaps or ends it: the least of the free
// memory and what the control groups above it leave. 0: unknown.
[[nodiscard]] std::uint64_t availableMemory();

} // namespace patina
