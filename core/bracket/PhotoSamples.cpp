#include "core/bracket/PhotoSamples.h"

#include "core/job/Parallel.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

namespace patina {
namespace {

// Cells of the picture, each of which gives one place at most: some two thousand equations for
// each photo, where the paper's smallest picture has fifty.
constexpr int kColumns = 64, kRows = 48;
constexpr int kTries = 24; // places looked at in a cell
constexpr int kBlock = 3;  // pixels of a side that are averaged

struct Block {
    float mean = 0.0f, range = 0.0f;
};

// The mean of the pixels around (x, y); nothing outside the photo or where one of them is clipped.
std::optional<Block> blockAt(const Photo& photo, int x, int y, int channel) {
    constexpr int kReach = kBlock / 2;
    if (x < kReach || y < kReach || x + kReach >= photo.image.width() ||
        y + kReach >= photo.image.height())
        return std::nullopt;
    float sum = 0.0f, least = std::numeric_limits<float>::max(), most = 0.0f;
    for (int dy = -kReach; dy <= kReach; ++dy)
        for (int dx = -kReach; dx <= kReach; ++dx) {
            const float code = codeAt(photo, x + dx, y + dy, channel);
            if (hatWeight(code) <= 0.0f)
                return std::nullopt;
            sum += code;
            least = std::min(least, code);
            most = std::max(most, code);
        }
    return Block{sum / (kBlock * kBlock), most - least};
}

struct Place {
    ResponseSample sample;
    float range = 0.0f; // of the photo in which it is largest, against what it may be
};

std::optional<Place> placeAt(std::span<const Photo> photos, int x, int y, int channel) {
    Place place;
    for (const Photo& photo : photos)
        if (const auto block = blockAt(photo, x + photo.shift.dx, y + photo.shift.dy, channel)) {
            place.sample.seen.push_back({block->mean, static_cast<float>(photo.logExposure())});
            place.range = std::max(place.range, block->range);
        }
    if (place.sample.seen.size() < 2)
        return std::nullopt;
    return place;
}

// A fixed, well mixed sequence (a linear congruential generator's high bits).
class Sequence {
  public:
    explicit Sequence(std::uint64_t seed)
        : m_state(seed * 2862933555777941757u + 3037000493u) {}
    int below(int count) {
        m_state = m_state * 6364136223846793005u + 1442695040888963407u;
        return static_cast<int>((m_state >> 33u) % static_cast<std::uint64_t>(count));
    }

  private:
    std::uint64_t m_state;
};

} // namespace

std::vector<std::vector<ResponseSample>> chooseSamples(std::span<const Photo> photos,
                                                       const JobContext& job) {
    const int width = photos.front().image.width(), height = photos.front().image.height();
    const int channels = photos.front().image.channels();
    const int columns = std::min(kColumns, width), rows = std::min(kRows, height);
    const auto cells = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
    std::vector<std::vector<std::optional<Place>>> found(static_cast<std::size_t>(channels),
                                                         std::vector<std::optional<Place>>(cells));
    parallelFor(job, cells, 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t cell = begin; cell < end; ++cell) {
            const int column = static_cast<int>(cell) % columns;
            const int row = static_cast<int>(cell) / columns;
            const int left = width * column / columns, right = width * (column + 1) / columns;
            const int top = height * row / rows, bottom = height * (row + 1) / rows;
            Sequence sequence(cell);
            for (int i = 0; i < kTries; ++i) {
                const int x = left + sequence.below(right - left);
                const int y = top + sequence.below(bottom - top);
                for (int channel = 0; channel < channels; ++channel) {
                    std::optional<Place>& best = found[static_cast<std::size_t>(channel)][cell];
                    std::optional<Place> place = placeAt(photos, x, y, channel);
                    if (place && (!best || place->range < best->range))
                        best = std::move(place);
                }
            }
        }
    });

    // Of each channel the flatter ones, but not fewer than the response needs.
    constexpr float kFlat = 12.0f; // codes across a block
    std::vector<std::vector<ResponseSample>> result;
    for (std::vector<std::optional<Place>>& cellsPlaces : found) {
        std::vector<Place> places;
        for (std::optional<Place>& place : cellsPlaces)
            if (place)
                places.push_back(std::move(*place));
        std::stable_sort(places.begin(), places.end(),
                         [](const Place& a, const Place& b) { return a.range < b.range; });
        std::vector<ResponseSample>& samples = result.emplace_back();
        for (Place& place : places)
            if (place.range <= kFlat || samples.size() < 4 * kLeastSamples)
                samples.push_back(std::move(place.sample));
    }
    return result;
}

} // namespace patina
