#include "core/compare/Ssim.h"

#include "core/compare/Comparable.h"
#include "core/image/Srgb.h"
#include "core/job/Parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace patina {
namespace {

constexpr int kRadius = 5;
constexpr int kWindow = 2 * kRadius + 1;
constexpr double kSigma = 1.5;
constexpr double kC1 = 0.01 * 0.01, kC2 = 0.03 * 0.03;
constexpr int kSsimRows = 64; // the rows above and below are filtered again for each such band

std::array<double, kWindow> window() {
    std::array<double, kWindow> weights{};
    double sum = 0;
    for (int i = 0; i < kWindow; ++i)
        sum += weights[static_cast<std::size_t>(i)] =
            std::exp(-(i - kRadius) * (i - kRadius) / (2 * kSigma * kSigma));
    for (double& weight : weights)
        weight /= sum;
    return weights;
}

// What part of the window lies in `size` pixels, around each of them.
std::vector<double> coverage(const std::array<double, kWindow>& weights, int size) {
    std::vector<double> result(static_cast<std::size_t>(size), 0.0);
    for (int x = 0; x < size; ++x)
        for (int i = -kRadius; i <= kRadius; ++i)
            if (x + i >= 0 && x + i < size)
                result[static_cast<std::size_t>(x)] +=
                    weights[static_cast<std::size_t>(i + kRadius)];
    return result;
}

double luma(const Image& image, int x, int y) {
    const auto sample = [&](int channel) {
        const float value = image.sample(x, y, image.channels() <= 2 ? 0 : channel);
        return static_cast<double>(image.encoding() == ColorEncoding::Linear
                                       ? linearToSrgb(std::clamp(value, 0.0f, 1.0f))
                                       : value);
    };
    if (image.channels() <= 2)
        return sample(0);
    return 0.2126 * sample(0) + 0.7152 * sample(1) + 0.0722 * sample(2);
}

// The moments of a band of rows: a, b, a², b², ab.
constexpr std::size_t kMoments = 5;

class Band {
  public:
    Band(const Image& image, const Image& reference)
        : m_image(image)
        , m_reference(reference)
        , m_columns(coverage(m_weights, image.width()))
        , m_rows(coverage(m_weights, image.height())) {}

    void evaluate(int begin, int end, std::span<float> out) const {
        const int first = std::max(0, begin - kRadius);
        const int last = std::min(m_image.height(), end + kRadius);
        const auto width = static_cast<std::size_t>(m_image.width());
        std::array<std::vector<double>, kMoments> filtered;
        for (std::vector<double>& plane : filtered)
            plane.resize(width * static_cast<std::size_t>(last - first));
        for (int y = first; y < last; ++y)
            filterAlongX(y, static_cast<std::size_t>(y - first) * width, filtered);

        std::array<std::vector<double>, kMoments> row;
        for (int y = begin; y < end; ++y) {
            for (std::size_t m = 0; m < kMoments; ++m) {
                row[m].assign(width, 0.0);
                for (int i = std::max(-kRadius, -y);
                     i <= std::min(kRadius, m_image.height() - 1 - y); ++i) {
                    const double weight = m_weights[static_cast<std::size_t>(i + kRadius)];
                    const double* source =
                        filtered[m].data() + static_cast<std::size_t>(y + i - first) * width;
                    for (std::size_t x = 0; x < width; ++x)
                        row[m][x] += weight * source[x];
                }
            }
            float* target = out.data() + static_cast<std::size_t>(y) * width;
            for (std::size_t x = 0; x < width; ++x)
                target[x] = static_cast<float>(
                    similarity(row, x, m_columns[x] * m_rows[static_cast<std::size_t>(y)]));
        }
    }

  private:
    void filterAlongX(int y, std::size_t to,
                      std::array<std::vector<double>, kMoments>& filtered) const {
        // Zeros beyond the border; what they take from the sums is divided out at last.
        const auto width = static_cast<std::size_t>(m_image.width());
        std::array<std::vector<double>, kMoments> row;
        for (std::vector<double>& moment : row)
            moment.assign(width + 2 * kRadius, 0.0);
        for (std::size_t x = 0; x < width; ++x) {
            const double a = luma(m_image, static_cast<int>(x), y);
            const double b = luma(m_reference, static_cast<int>(x), y);
            const std::array<double, kMoments> moments{a, b, a * a, b * b, a * b};
            for (std::size_t m = 0; m < kMoments; ++m)
                row[m][x + kRadius] = moments[m];
        }
        for (std::size_t m = 0; m < kMoments; ++m)
            for (std::size_t i = 0; i < kWindow; ++i)
                for (std::size_t x = 0; x < width; ++x)
                    filtered[m][to + x] += m_weights[i] * row[m][x + i];
    }

    static double similarity(const std::array<std::vector<double>, kMoments>& moments,
                             std::size_t x, double covered) {
        const double a = moments[0][x] / covered, b = moments[1][x] / covered;
        const double varianceA = moments[2][x] / covered - a * a;
        const double varianceB = moments[3][x] / covered - b * b;
        const double covariance = moments[4][x] / covered - a * b;
        return (2 * a * b + kC1) * (2 * covariance + kC2) /
               ((a * a + b * b + kC1) * (varianceA + varianceB + kC2));
    }

    const Image& m_image;
    const Image& m_reference;
    std::array<double, kWindow> m_weights = window();
    std::vector<double> m_columns, m_rows; // coverage
};

double meanOf(const Image& map) {
    const bool whole = map.width() >= kWindow && map.height() >= kWindow;
    const int border = whole ? kRadius : 0;
    double sum = 0;
    for (int y = border; y < map.height() - border; ++y) {
        double row = 0; // a sum per row keeps the rounding error small
        for (int x = border; x < map.width() - border; ++x)
            row += static_cast<double>(map.sample(x, y, 0));
        sum += row;
    }
    return sum / (static_cast<double>(map.width() - 2 * border) *
                  static_cast<double>(map.height() - 2 * border));
}

} // namespace

Result<Ssim> computeSsim(const Image& image, const Image& reference, const JobContext& job) {
    if (Result<void> comparable = compare::checkPictures(image, reference); !comparable)
        return comparable.error();
    Ssim ssim;
    ssim.map = Image(image.width(), image.height(), 1, PixelType::F32, ColorEncoding::Data);
    const Band band(image, reference);
    const std::span<float> out = ssim.map.f32();
    parallelFor(job, static_cast<std::size_t>(image.height()), kSsimRows,
                [&](std::size_t begin, std::size_t end) {
                    band.evaluate(static_cast<int>(begin), static_cast<int>(end), out);
                });
    if (job.cancelled())
        return Error{ErrorKind::Cancelled, "cancelled", {}, {}};
    ssim.mean = meanOf(ssim.map);
    return ssim;
}

} // namespace patina
