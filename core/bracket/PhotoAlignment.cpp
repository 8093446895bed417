#include "core/bracket/PhotoAlignment.h"

#include "core/job/Parallel.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace patina {
namespace {

// Codes so near to the threshold are noise, and are left out of the comparison (Ward's exclusion
// bitmap).
constexpr int kExcluded = 4;
// The smallest picture of a pyramid: below it little is left to compare.
constexpr int kSmallestSide = 32;

// A picture in greys of 8 bits.
struct Grey {
    int width = 0, height = 0;
    std::vector<std::uint8_t> codes;
};

Grey greyOf(const Photo& photo, const JobContext& job) {
    Grey grey{photo.image.width(), photo.image.height(), {}};
    const auto width = static_cast<std::size_t>(grey.width);
    const auto channels = static_cast<std::size_t>(photo.image.channels());
    grey.codes.resize(width * static_cast<std::size_t>(grey.height));
    parallelFor(
        job, static_cast<std::size_t>(grey.height), 32, [&](std::size_t begin, std::size_t end) {
            std::vector<float> row(width * channels);
            for (std::size_t y = begin; y < end; ++y) {
                codesOfRow(photo, static_cast<int>(y), row);
                for (std::size_t x = 0; x < width; ++x) {
                    const float* p = row.data() + x * channels;
                    // Ward's weights.
                    const float code = channels < 3
                                           ? p[0]
                                           : (54.0f * p[0] + 183.0f * p[1] + 19.0f * p[2]) / 256.0f;
                    grey.codes[y * width + x] = static_cast<std::uint8_t>(code);
                }
            }
        });
    return grey;
}

Grey halved(const Grey& grey) {
    Grey half{grey.width / 2, grey.height / 2, {}};
    half.codes.reserve(static_cast<std::size_t>(half.width) *
                       static_cast<std::size_t>(half.height));
    for (int y = 0; y < half.height; ++y)
        for (int x = 0; x < half.width; ++x) {
            const auto at = static_cast<std::size_t>(2 * y) * static_cast<std::size_t>(grey.width) +
                            static_cast<std::size_t>(2 * x);
            const auto below = at + static_cast<std::size_t>(grey.width);
            half.codes.push_back(
                static_cast<std::uint8_t>((grey.codes[at] + grey.codes[at + 1] + grey.codes[below] +
                                           grey.codes[below + 1] + 2) /
                                          4));
        }
    return half;
}

using Histogram = std::array<std::size_t, 256>;

// What (x, y) of one picture and (x + dx, y + dy) of another have in common, in the first one's
// pixels.
struct Overlap {
    int left = 0, right = 0, top = 0, bottom = 0;
    [[nodiscard]] std::size_t pixels() const {
        return left < right && top < bottom
                   ? static_cast<std::size_t>(right - left) * static_cast<std::size_t>(bottom - top)
                   : 0;
    }
};

Overlap overlapOf(int width, int height, PhotoShift shift) {
    return {std::max(0, -shift.dx), std::min(width, width - shift.dx), std::max(0, -shift.dy),
            std::min(height, height - shift.dy)};
}

Histogram histogramOf(const Grey& grey, const Overlap& part, PhotoShift shift) {
    Histogram histogram{};
    for (int y = part.top; y < part.bottom; ++y) {
        const std::uint8_t* row =
            grey.codes.data() +
            static_cast<std::size_t>(y + shift.dy) * static_cast<std::size_t>(grey.width) +
            static_cast<std::size_t>(part.left + shift.dx);
        for (int x = 0; x < part.right - part.left; ++x)
            ++histogram[row[x]];
    }
    return histogram;
}

int percentile(const Histogram& histogram, std::size_t total, double share) {
    const auto wanted = static_cast<std::size_t>(share * static_cast<double>(total));
    std::size_t sum = 0;
    for (std::size_t code = 0; code < histogram.size(); ++code)
        if ((sum += histogram[code]) > wanted)
            return static_cast<int>(code);
    return 255;
}

// Codes at which both pictures are split alike: the median or, where that is clipped in one of
// them, another percentile. Of what they have in common: of the whole pictures it would split each
// in its own middle, wherever that is in the scene. Nothing when there is none.
std::optional<std::array<int, 2>> thresholdsOf(const Grey& a, const Grey& b, PhotoShift shift) {
    const Overlap part = overlapOf(a.width, a.height, shift);
    if (part.pixels() == 0)
        return std::nullopt;
    const Histogram one = histogramOf(a, part, {}), other = histogramOf(b, part, shift);
    constexpr std::array kShares{0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8, 0.1, 0.9, 0.05, 0.95};
    for (const double share : kShares) {
        const std::array<int, 2> found{percentile(one, part.pixels(), share),
                                       percentile(other, part.pixels(), share)};
        if (std::all_of(found.begin(), found.end(), [](int code) {
                return code > 2 * kExcluded && code < 255 - 2 * kExcluded;
            }))
            return found;
    }
    return std::nullopt;
}

// Ward's two bitmaps in one: bit 0 says above the threshold, bit 1 that the pixel counts.
std::vector<std::uint8_t> bitmapOf(const Grey& grey, int threshold) {
    std::vector<std::uint8_t> bits(grey.codes.size());
    for (std::size_t i = 0; i < bits.size(); ++i) {
        const int code = grey.codes[i];
        const int above = code > threshold ? 1 : 0;
        const int counts = code < threshold - kExcluded || code > threshold + kExcluded ? 2 : 0;
        bits[i] = static_cast<std::uint8_t>(above | counts);
    }
    return bits;
}

struct Level {
    int width = 0, height = 0;
    std::vector<std::uint8_t> a, b;
};

// Share of the pixels that differ when (x, y) of `a` is (x + dx, y + dy) of `b`; 1 where too few
// can be compared.
double differing(const Level& level, PhotoShift shift, const JobContext& job) {
    const Overlap part = overlapOf(level.width, level.height, shift);
    if (part.pixels() == 0)
        return 1.0;
    const int left = part.left, right = part.right, top = part.top, bottom = part.bottom;
    std::atomic<std::size_t> differ = 0, compared = 0;
    parallelFor(
        job, static_cast<std::size_t>(bottom - top), 64, [&](std::size_t begin, std::size_t end) {
            std::size_t myDiffer = 0, myCompared = 0;
            for (std::size_t i = begin; i < end; ++i) {
                const int y = top + static_cast<int>(i);
                const auto width = static_cast<std::size_t>(level.width);
                const std::uint8_t* a = level.a.data() + static_cast<std::size_t>(y) * width +
                                        static_cast<std::size_t>(left);
                const std::uint8_t* b = level.b.data() +
                                        static_cast<std::size_t>(y + shift.dy) * width +
                                        static_cast<std::size_t>(left + shift.dx);
                std::uint32_t rowDiffer = 0, rowCompared = 0;
                for (int x = 0; x < right - left; ++x) {
                    const std::uint32_t counts = static_cast<std::uint32_t>(a[x] & b[x]) >> 1u;
                    rowCompared += counts;
                    rowDiffer += counts & static_cast<std::uint32_t>(a[x] ^ b[x]);
                }
                myDiffer += rowDiffer;
                myCompared += rowCompared;
            }
            differ += myDiffer;
            compared += myCompared;
        });
    // A few pixels agree by chance.
    constexpr std::size_t kLeastCompared = 20; // one of so many
    if (compared * kLeastCompared < part.pixels())
        return 1.0;
    return static_cast<double>(differ) / static_cast<double>(compared);
}

struct Candidate {
    PhotoShift shift;
    double error = 2.0; // share of the pixels that differ
};

// The better one; of equals the nearer to none.
bool isBetter(const Candidate& a, const Candidate& b) {
    const auto length = [](PhotoShift shift) { return shift.dx * shift.dx + shift.dy * shift.dy; };
    return a.error != b.error ? a.error < b.error : length(a.shift) < length(b.shift);
}

// Adds the shifts within `reach` of `start` that are not there yet.
void addNear(std::vector<Candidate>& candidates, const Level& level, PhotoShift start, int reach,
             int limit, const JobContext& job) {
    for (int dy = std::max(start.dy - reach, -limit); dy <= std::min(start.dy + reach, limit); ++dy)
        for (int dx = std::max(start.dx - reach, -limit); dx <= std::min(start.dx + reach, limit);
             ++dx) {
            const PhotoShift shift{dx, dy};
            if (std::none_of(candidates.begin(), candidates.end(),
                             [&](const Candidate& other) { return other.shift == shift; }))
                candidates.push_back({shift, differing(level, shift, job)});
        }
}

// Both pictures' bitmaps where they are about so far apart.
std::optional<Level> levelAt(const Grey& a, const Grey& b, PhotoShift shift) {
    const auto thresholds = thresholdsOf(a, b, shift);
    if (!thresholds)
        return std::nullopt;
    return Level{a.width, a.height, bitmapOf(a, (*thresholds)[0]), bitmapOf(b, (*thresholds)[1])};
}

// How far (x, y) of `a` is away in `b`: all shifts of a small picture, then by a pixel either way
// in pictures twice as large each. Ward follows the best shift alone; in a small picture another
// one may look as good, so the best few are followed, half as many in each next picture.
PhotoShift shiftBetween(const std::vector<Grey>& a, const std::vector<Grey>& b,
                        const JobContext& job) {
    constexpr std::size_t kFollowed = 24; // of the smallest picture
    const int limit = std::min({kMaxPhotoShift, a.front().width / 4, a.front().height / 4});
    std::vector<PhotoShift> starts;
    const int smallestLimit = a.size() > 1 ? (limit >> (a.size() - 1)) + 1 : limit;
    for (int dy = -smallestLimit; dy <= smallestLimit; ++dy)
        for (int dx = -smallestLimit; dx <= smallestLimit; ++dx)
            starts.push_back({dx, dy});
    std::size_t kept = kFollowed;
    for (std::size_t k = a.size(); k-- > 0;) {
        const bool smallest = k + 1 == a.size();
        const int levelLimit = smallest ? smallestLimit : (limit >> k) + (k > 0 ? 1 : 0);
        std::vector<Candidate> tried;
        for (const PhotoShift start : starts) {
            if (job.cancelled())
                return {};
            if (const std::optional<Level> level = levelAt(a[k], b[k], start))
                addNear(tried, *level, start, smallest ? 0 : 1, levelLimit, job);
        }
        if (tried.empty())
            return {};
        std::sort(tried.begin(), tried.end(), isBetter);
        tried.resize(std::min(tried.size(), std::max<std::size_t>(kept, 1)));
        kept /= 2;
        if (k == 0)
            return tried.front().shift;
        starts.clear();
        for (const Candidate& one : tried)
            starts.push_back({2 * one.shift.dx, 2 * one.shift.dy});
    }
    return {};
}

std::vector<Grey> pyramidOf(const Photo& photo, const JobContext& job) {
    std::vector<Grey> levels{greyOf(photo, job)};
    // Down to shifts of a few pixels, so that all of them can be tried.
    while (levels.size() < 6 &&
           std::min(levels.back().width, levels.back().height) / 2 >= kSmallestSide)
        levels.push_back(halved(levels.back()));
    return levels;
}

} // namespace

std::vector<PhotoShift> findShifts(std::span<const Photo> photos, const JobContext& job) {
    std::vector<PhotoShift> shifts(photos.size());
    if (photos.size() < 2)
        return shifts;
    // Along the chain of neighbours, then against the one in the middle.
    std::vector<Grey> previous = pyramidOf(photos[0], job);
    for (std::size_t i = 1; i < photos.size() && !job.cancelled(); ++i) {
        job.setProgress(static_cast<double>(i) / static_cast<double>(photos.size()));
        std::vector<Grey> next = pyramidOf(photos[i], job);
        const PhotoShift step = shiftBetween(previous, next, job);
        shifts[i] = {shifts[i - 1].dx + step.dx, shifts[i - 1].dy + step.dy};
        previous = std::move(next);
    }
    const PhotoShift reference = shifts[referencePhoto(photos.size())];
    for (PhotoShift& shift : shifts)
        shift = {shift.dx - reference.dx, shift.dy - reference.dy};
    return shifts;
}

} // namespace patina
