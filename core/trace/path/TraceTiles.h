// The squares of pixels that a picture is traced in: which of them one process traces, and who may
// look at the film while it does.
#pragma once

#include <cstddef>
#include <functional>
#include <mutex>

namespace patina {

class TraceOutputs;

inline constexpr int kTraceTile = 16; // pixels a side; at the right and lower border less

// Tiles count row by row from the top left. A shard traces those of number n with
// n % count == index. A picture is split by tiles and not by samples: a pixel's sums are rounded
// after every sample, so that sums of sums would end in other bits than those of the whole.
struct TraceShard {
    int index = 0, count = 1;
    [[nodiscard]] bool holds(std::size_t tile) const {
        return tile % static_cast<std::size_t>(count) == static_cast<std::size_t>(index);
    }
    friend bool operator==(const TraceShard&, const TraceShard&) = default;
};

struct TraceTiles {
    TraceShard shard;
    // Held while a pixel of the film changes, so that who locks it finds all samples of a pass in
    // each pixel, or none. Null: nobody looks.
    std::mutex* film = nullptr;
    // Called from the pool's threads after each tile, without the lock. May be empty.
    std::function<void()> tileDone;
    // Of the film's size, filled with it; changes under the same lock. Null: colour alone.
    TraceOutputs* outputs = nullptr;
};

} // namespace patina
