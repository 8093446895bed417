// The pixels of a film that one shard of a picture traces.
#pragma once

#include "core/trace/path/Film.h"
#include "core/trace/path/TraceTiles.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace patina {

[[nodiscard]] std::size_t tileCount(int width, int height);
[[nodiscard]] std::size_t shardPixels(int width, int height, const TraceShard& shard);

// Calls f(index of the first pixel, number of pixels) for each row of each tile of the shard; the
// whole film is one such row.
template <class F>
void forShardRows(int width, int height, const TraceShard& shard, const F& f) {
    if (shard.count == 1) {
        f(std::size_t{0}, static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
        return;
    }
    std::size_t tile = 0;
    for (int top = 0; top < height; top += kTraceTile)
        for (int left = 0; left < width; left += kTraceTile, ++tile) {
            if (!shard.holds(tile))
                continue;
            const int columns = std::min(kTraceTile, width - left);
            for (int y = top; y < std::min(top + kTraceTile, height); ++y)
                f(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(left),
                  static_cast<std::size_t>(columns));
        }
}

// How many samples the pixels of a shard have: none has less than `least` or more than `most`; both
// are 0 for a shard without pixels. `mean` is over them.
struct FilmSamples {
    std::uint32_t least = 0, most = 0;
    double mean = 0.0;
};
[[nodiscard]] FilmSamples samplesOf(const Film& film, const TraceShard& shard);

} // namespace patina
