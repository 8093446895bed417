#include "core/trace/file/FilmTiles.h"

#include <limits>

namespace patina {

std::size_t tileCount(int width, int height) {
    const auto along = [](int side) {
        return static_cast<std::size_t>((side + kTraceTile - 1) / kTraceTile);
    };
    return along(width) * along(height);
}

std::size_t shardPixels(int width, int height, const TraceShard& shard) {
    std::size_t sum = 0;
    forShardRows(width, height, shard, [&](std::size_t, std::size_t count) { sum += count; });
    return sum;
}

FilmSamples samplesOf(const Film& film, const TraceShard& shard) {
    FilmSamples samples{std::numeric_limits<std::uint32_t>::max(), 0, 0.0};
    std::size_t pixels = 0;
    forShardRows(film.width(), film.height(), shard, [&](std::size_t first, std::size_t count) {
        for (const Film::Pixel& pixel : film.pixels().subspan(first, count)) {
            samples.least = std::min(samples.least, pixel.samples);
            samples.most = std::max(samples.most, pixel.samples);
            samples.mean += pixel.samples;
        }
        pixels += count;
    });
    if (pixels == 0)
        return {};
    samples.mean /= static_cast<double>(pixels);
    return samples;
}

} // namespace patina
