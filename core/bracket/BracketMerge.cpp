#include "core/bracket/BracketMerge.h"

#include "core/base/Check.h"
#include "core/image/Srgb.h"
#include "core/job/Parallel.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>

namespace patina {
namespace {

// Codes whose radiance is sure enough to be held against another photo's.
constexpr float kSureFrom = 16.0f, kSureTo = 240.0f;
// Radiances that differ by less agree: shutters and apertures are only so exact.
constexpr float kExposureTolerance = 0.1f; // natural logarithm
constexpr float kSigmas = 4.0f;            // of noise, beyond that

// The response of a channel as tables by code.
struct Tables {
    std::array<float, kCodes> exposure{}; // exp(g)
    std::array<float, kCodes> allowed{};  // difference of ln E that noise explains

    Tables() = default;
    explicit Tables(const RecoveredResponse& response) {
        const LogResponse& g = response.curve;
        for (std::size_t z = 0; z < kCodes; ++z) {
            exposure[z] = static_cast<float>(std::exp(g[z]));
            const std::size_t before = z > 0 ? z - 1 : 0, after = std::min(z + 1, kCodes - 1);
            const double slope = (g[after] - g[before]) / static_cast<double>(after - before);
            allowed[z] =
                kExposureTolerance + kSigmas * static_cast<float>(response.noiseCodes * slope);
        }
    }
};

float lookUp(const std::array<float, kCodes>& table, float code) {
    const auto at = std::min(static_cast<std::size_t>(code), kCodes - 2);
    const float part = code - static_cast<float>(at);
    return table[at] + part * (table[at + 1] - table[at]);
}

// What the rows of a picture are made with.
class RowMerger {
  public:
    RowMerger(std::span<const Photo> photos, std::span<const RecoveredResponse> responses)
        : m_photos(photos)
        , m_channels(static_cast<std::size_t>(photos.front().image.channels()))
        , m_width(photos.front().image.width())
        , m_samples(static_cast<std::size_t>(m_width) * m_channels) {
        for (std::size_t c = 0; c < m_channels; ++c)
            m_tables[c] = Tables(responses[c]);
        const float midGrey = srgbTable8()[kMidCode];
        for (const Photo& photo : photos)
            m_scales.push_back(static_cast<float>((photo.isLinear() ? photo.white : midGrey) /
                                                  std::exp(photo.logExposure())));
    }

    // `rgb`: 3 · width; `marks`: width.
    void merge(int y, std::span<float> rgb, std::span<std::uint8_t> marks) {
        m_codes.assign(m_photos.size() * m_samples, kOutside);
        m_row.resize(m_samples);
        for (std::size_t j = 0; j < m_photos.size(); ++j)
            takeRow(j, y);
        for (std::size_t i = 0; i < m_samples; ++i) {
            const std::size_t channel = i % m_channels, pixel = i / m_channels;
            std::uint8_t mark = 0;
            const float value = sample(i, m_tables[channel], mark);
            marks[pixel] |= mark;
            if (m_channels == 1)
                std::fill_n(rgb.begin() + static_cast<std::ptrdiff_t>(3 * pixel), 3, value);
            else
                rgb[3 * pixel + channel] = value;
        }
    }

  private:
    static constexpr float kOutside = -1.0f; // of the photo

    // The photo's codes where the result's row shows them.
    void takeRow(std::size_t j, int y) {
        const Photo& photo = m_photos[j];
        const int from = y + photo.shift.dy;
        if (from < 0 || from >= photo.image.height())
            return;
        codesOfRow(photo, from, m_row);
        const int left = std::max(0, -photo.shift.dx);
        const int right = std::min(m_width, m_width - photo.shift.dx);
        if (left >= right)
            return;
        const auto channels = static_cast<std::ptrdiff_t>(m_channels);
        std::copy(m_row.begin() + (left + photo.shift.dx) * channels,
                  m_row.begin() + (right + photo.shift.dx) * channels,
                  m_codes.begin() + static_cast<std::ptrdiff_t>(j * m_samples) + left * channels);
    }

    [[nodiscard]] float code(std::size_t j, std::size_t i) const {
        return m_codes[j * m_samples + i];
    }

    [[nodiscard]] float sample(std::size_t i, const Tables& tables, std::uint8_t& mark) const {
        float sum = 0.0f, weights = 0.0f;
        int sure = 0;
        for (std::size_t j = 0; j < m_photos.size(); ++j) {
            const float z = code(j, i), weight = hatWeight(z); // 0 outside the photo
            if (weight <= 0.0f)
                continue;
            weights += weight;
            sum += weight * lookUp(tables.exposure, z) * m_scales[j];
            sure += z >= kSureFrom && z <= kSureTo ? 1 : 0;
        }
        if (weights <= 0.0f)
            return clipped(i, tables, mark);
        const float mean = sum / weights;
        if (sure > 1 && mean > 0.0f && disagree(i, tables, mean))
            mark |= kDisagrees;
        return mean;
    }

    [[nodiscard]] bool disagree(std::size_t i, const Tables& tables, float mean) const {
        for (std::size_t j = 0; j < m_photos.size(); ++j) {
            const float z = code(j, i);
            if (z < kSureFrom || z > kSureTo)
                continue;
            const float radiance = lookUp(tables.exposure, z) * m_scales[j];
            if (std::abs(std::log(radiance / mean)) > lookUp(tables.allowed, z))
                return true;
        }
        return false;
    }

    // Every photo is black or white here. The least exposed white one says how bright it is at
    // least; without one the most exposed black one how bright at most.
    [[nodiscard]] float clipped(std::size_t i, const Tables& tables, std::uint8_t& mark) const {
        for (std::size_t j = 0; j < m_photos.size(); ++j)
            if (code(j, i) >= kTopCode) {
                mark |= kClippedAbove;
                return tables.exposure.back() * m_scales[j];
            }
        mark |= kClippedBelow;
        for (std::size_t j = m_photos.size(); j-- > 0;)
            if (code(j, i) >= 0.0f)
                return tables.exposure.front() * m_scales[j];
        return 0.0f; // the photo that the others are shifted to shows every pixel
    }

    std::span<const Photo> m_photos;
    std::size_t m_channels;
    int m_width;
    std::size_t m_samples; // of a row
    std::array<Tables, 3> m_tables;
    std::vector<float> m_scales; // of each photo: radiance of an exposure of 1
    std::vector<float> m_codes, m_row;
};

} // namespace

LogResponse linearResponse() {
    LogResponse response{};
    for (std::size_t z = 0; z < kCodes; ++z) {
        // Black stays black: so far below the first code that it is none.
        constexpr double kBlack = 1e-12;
        response[z] = std::log(std::max(static_cast<double>(z), kBlack) / kTopCode);
    }
    return response;
}

MergedPhotos mergePhotos(std::span<const Photo> photos,
                         std::span<const RecoveredResponse> responses, const JobContext& job) {
    CHECK(!photos.empty());
    const int width = photos.front().image.width(), height = photos.front().image.height();
    MergedPhotos merged{Image(width, height, 3, PixelType::F32, ColorEncoding::Linear), {}};
    const auto columns = static_cast<std::size_t>(width), rows = static_cast<std::size_t>(height);
    merged.marks.resize(columns * rows);
    const RowMerger prepared(photos, responses);
    std::atomic<std::size_t> done = 0;
    parallelFor(job, rows, 16, [&](std::size_t begin, std::size_t end) {
        RowMerger merger = prepared;
        for (std::size_t y = begin; y < end && !job.cancelled(); ++y)
            merger.merge(static_cast<int>(y),
                         merged.image.f32().subspan(3 * y * columns, 3 * columns),
                         std::span(merged.marks).subspan(y * columns, columns));
        done += end - begin;
        job.setProgress(static_cast<double>(done) / static_cast<double>(rows));
    });
    return merged;
}

double shareOf(std::span<const std::uint8_t> marks, std::uint8_t mark) {
    if (marks.empty())
        return 0.0;
    const auto count =
        std::count_if(marks.begin(), marks.end(), [=](auto own) { return (own & mark) != 0; });
    return static_cast<double>(count) / static_cast<double>(marks.size());
}

} // namespace patina
