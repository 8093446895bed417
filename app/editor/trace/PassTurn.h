// Whose pass is next where several traced pictures share the processor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace patina::editor {

struct PassTurn {
    bool wants = false;     // another pass
    int coarseness = 0;     // of the next pass: 0 adds samples to a picture of full size
    std::uint64_t last = 0; // when it had its last pass, counted in passes of all; 0: never
};

// The coarsest, so that each has a first picture soon; of equals the one that has waited longest.
// Where another one waits, none has two passes in a row: one that begins anew all the time leaves
// the others every second pass. Nothing: none wants one.
[[nodiscard]] std::optional<std::size_t> nextTurn(std::span<const PassTurn> pictures);

} // namespace patina::editor
