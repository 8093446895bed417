#include "core/light/ShBands.h"

#include "core/base/Check.h"
#include "core/job/Parallel.h"
#include "core/math/ShRotation.h"
#include "core/math/Shading.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

namespace patina {
namespace {

constexpr int kLanes = 4; // rows are padded to whole groups
typedef float Lanes __attribute__((vector_size(kLanes * sizeof(float)))); // NOLINT: GCC's

// What one row of pixels adds to the sums over the sphere.
struct RowResult {
    std::array<double, kMaxShOrder> squares{}; // Σ over x and channels of (L - sum)²
    std::array<float, kMaxShOrder> lowest{};
    std::array<int, kMaxShOrder> lowestX{};
    double squaresOfAll = 0.0; // of L
};

// Coefficients in the image's own frame: zonal axis +Y of the world, azimuth 0 at the left edge
// (+Z), growing with u. There a row of the picture is a short Fourier series.
std::vector<glm::dvec3> inImageFrame(std::span<const glm::vec3> coefficients) {
    // Columns: where the world's axes lie in the frame whose x, y, z are +Z, -X, +Y of the world.
    const glm::dmat3 toFrame(glm::dvec3(0, -1, 0), glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0));
    const ShRotation rotation(toFrame, kMaxShOrder);
    std::vector<glm::dvec3> local(coefficients.size(), glm::dvec3(0.0));
    for (int l = 0; l < kMaxShOrder; ++l)
        for (int row = -l; row <= l; ++row)
            for (int column = -l; column <= l; ++column)
                local[shIndex(l, row)] +=
                    rotation.element(l, row, column) * glm::dvec3(coefficients[shIndex(l, column)]);
    return local;
}

// cos and sin of m phi at the pixels' centres, m = 0 … order - 1, one row after another.
struct AzimuthTable {
    AzimuthTable(int columns, int bands)
        : width(columns)
        , padded((columns + kLanes - 1) / kLanes * kLanes)
        , cosines(static_cast<std::size_t>(bands) * padded)
        , sines(cosines.size()) {
        for (int m = 0; m < bands; ++m)
            for (int x = 0; x < width; ++x) {
                const double phi = 2.0 * std::numbers::pi * (x + 0.5) / width;
                cosines[static_cast<std::size_t>(m) * padded + x] =
                    static_cast<float>(std::cos(m * phi));
                sines[static_cast<std::size_t>(m) * padded + x] =
                    static_cast<float>(std::sin(m * phi));
            }
    }
    int width, padded;
    std::vector<float> cosines, sines;
};

Lanes loadLanes(const float* from) {
    Lanes lanes;
    __builtin_memcpy(&lanes, from, sizeof(lanes));
    return lanes;
}
void store(float* to, const Lanes& lanes) {
    __builtin_memcpy(to, &lanes, sizeof(lanes));
}

// Adds band l at polar angle theta to the three planes of `sums`.
void addBand(int l, double theta, std::span<const glm::dvec3> local, const AzimuthTable& table,
             float* sums) {
    std::array<double, kMaxShOrder * kMaxShOrder> basis{};
    evaluateSh(l + 1, glm::dvec3(std::sin(theta), 0.0, std::cos(theta)), basis); // at phi = 0
    for (int channel = 0; channel < 3; ++channel) {
        float* sum = sums + static_cast<std::ptrdiff_t>(channel) * table.padded;
        for (int m = 0; m <= l; ++m) {
            // Y_l,±m = P {cos, sin}(m phi), and P is Y_lm at phi = 0.
            const double p = basis[shIndex(l, m)];
            const auto a = static_cast<float>(p * local[shIndex(l, m)][channel]);
            const auto b = static_cast<float>(m == 0 ? 0.0 : p * local[shIndex(l, -m)][channel]);
            const float* cosine =
                table.cosines.data() + static_cast<std::ptrdiff_t>(m) * table.padded;
            const float* sine = table.sines.data() + static_cast<std::ptrdiff_t>(m) * table.padded;
            for (int x = 0; x < table.padded; x += kLanes)
                store(sum + x,
                      loadLanes(sum + x) + a * loadLanes(cosine + x) + b * loadLanes(sine + x));
        }
    }
}

// Σ (L - sum)² over a plane; what is beyond the width is 0 in both.
double squaredDifference(const float* radiance, const float* sum, int padded) {
    Lanes total = {};
    for (int x = 0; x < padded; x += kLanes) {
        const Lanes difference = loadLanes(radiance + x) - loadLanes(sum + x);
        total += difference * difference;
    }
    double result = 0.0;
    for (int i = 0; i < kLanes; ++i)
        result += total[i];
    return result;
}

// `planes`: red, green and blue of the row.
RowResult compareRow(const std::vector<float>& planes, double theta,
                     std::span<const glm::dvec3> local, const AzimuthTable& table) {
    RowResult result;
    std::vector<float> sums(planes.size(), 0.0f);
    const int padded = table.padded;
    for (int channel = 0; channel < 3; ++channel) {
        const std::ptrdiff_t plane = static_cast<std::ptrdiff_t>(channel) * padded;
        result.squaresOfAll +=
            squaredDifference(planes.data() + plane, sums.data() + plane, padded);
    }
    for (int l = 0; l < kMaxShOrder; ++l) {
        addBand(l, theta, local, table, sums.data());
        result.lowest[l] = std::numeric_limits<float>::max();
        for (int channel = 0; channel < 3; ++channel) {
            const std::ptrdiff_t plane = static_cast<std::ptrdiff_t>(channel) * padded;
            const float* sum = sums.data() + plane;
            result.squares[l] += squaredDifference(planes.data() + plane, sum, padded);
            const float* lowest = std::min_element(sum, sum + table.width);
            if (*lowest < result.lowest[l]) {
                result.lowest[l] = *lowest;
                result.lowestX[l] = static_cast<int>(lowest - sum);
            }
        }
    }
    return result;
}

} // namespace

ShBands computeShBands(const Image& environment, const JobContext& job) {
    ShBands bands;
    bands.coefficients = projectLatLong(environment, kMaxShOrder, job);
    if (job.cancelled())
        return bands;

    const int width = environment.width(), height = environment.height();
    const int channels = environment.channels();
    const std::span<const float> texels = environment.f32();
    const std::vector<glm::dvec3> local = inImageFrame(bands.coefficients);
    const AzimuthTable table(width, kMaxShOrder);
    std::vector<RowResult> rows(static_cast<std::size_t>(height));
    parallelFor(job, static_cast<std::size_t>(height), 16, [&](std::size_t begin, std::size_t end) {
        std::vector<float> planes(3 * static_cast<std::size_t>(table.padded), 0.0f);
        for (std::size_t y = begin; y < end; ++y) {
            const float* source = texels.data() + y * width * channels;
            for (int channel = 0; channel < 3; ++channel)
                for (int x = 0; x < width; ++x)
                    planes[static_cast<std::size_t>(channel) * table.padded + x] =
                        source[static_cast<std::ptrdiff_t>(x) * channels + channel];
            rows[y] = compareRow(planes, std::numbers::pi * (static_cast<double>(y) + 0.5) / height,
                                 local, table);
        }
    });
    if (job.cancelled())
        return bands;

    // Each row's pixels have one exact solid angle; all of them add up to 4pi.
    std::array<double, kMaxShOrder> squares{};
    double squaresOfAll = 0.0;
    std::array<int, kMaxShOrder> lowestRow{};
    for (int y = 0; y < height; ++y) {
        const RowResult& row = rows[static_cast<std::size_t>(y)];
        const double share = (std::cos(std::numbers::pi * y / height) -
                              std::cos(std::numbers::pi * (y + 1) / height)) /
                             (2.0 * width) / 3.0;
        squaresOfAll += share * row.squaresOfAll;
        for (int l = 0; l < kMaxShOrder; ++l) {
            squares[l] += share * row.squares[l];
            if (row.lowest[l] < rows[static_cast<std::size_t>(lowestRow[l])].lowest[l])
                lowestRow[l] = y;
        }
    }
    bands.rms = std::sqrt(squaresOfAll);
    for (int l = 0; l < kMaxShOrder; ++l) {
        const RowResult& row = rows[static_cast<std::size_t>(lowestRow[l])];
        ShBandSum& sum = bands.sums[l];
        sum.rmse = std::sqrt(squares[l]);
        sum.lowest = row.lowest[l];
        sum.lowestDirection = shading::directionFromLatLong(
            {(static_cast<float>(row.lowestX[l]) + 0.5f) / static_cast<float>(width),
             (static_cast<float>(lowestRow[l]) + 0.5f) / static_cast<float>(height)});
    }
    return bands;
}

double bandEnergy(std::span<const glm::vec3> coefficients, int l) {
    CHECK(l >= 0 && static_cast<std::size_t>(shCount(l + 1)) <= coefficients.size());
    double sum = 0.0;
    for (int i = shCount(l); i < shCount(l + 1); ++i) {
        const glm::dvec3 c(coefficients[static_cast<std::size_t>(i)]);
        sum += glm::dot(c, c);
    }
    return sum / 3.0 / (4.0 * std::numbers::pi);
}

glm::vec3 shSum(std::span<const glm::vec3> coefficients, int order, const glm::vec3& direction) {
    CHECK_LE(static_cast<std::size_t>(shCount(order)), coefficients.size());
    std::array<double, kMaxShOrder * kMaxShOrder> basis{};
    evaluateSh(order, glm::dvec3(direction), basis);
    glm::dvec3 sum(0.0);
    for (int i = 0; i < shCount(order); ++i)
        sum += basis[i] * glm::dvec3(coefficients[i]);
    return glm::vec3(sum);
}

Image shLatLong(std::span<const glm::vec3> coefficients, int order, int height,
                const JobContext& job) {
    CHECK(order >= 1 && order <= kMaxShOrder);
    CHECK_LE(static_cast<std::size_t>(shCount(order)), coefficients.size());
    std::vector<glm::vec3> all(shCount(kMaxShOrder), glm::vec3(0.0f));
    std::copy_n(coefficients.begin(), shCount(order), all.begin());
    const std::vector<glm::dvec3> local = inImageFrame(all);
    const int width = 2 * height;
    const AzimuthTable table(width, order);
    Image image(width, height, 3, PixelType::F32, ColorEncoding::Linear);
    const std::span<float> out = image.f32();
    parallelFor(job, static_cast<std::size_t>(height), 16, [&](std::size_t begin, std::size_t end) {
        std::vector<float> sums(3 * static_cast<std::size_t>(table.padded));
        for (std::size_t y = begin; y < end; ++y) {
            std::fill(sums.begin(), sums.end(), 0.0f);
            for (int l = 0; l < order; ++l)
                addBand(l, std::numbers::pi * (static_cast<double>(y) + 0.5) / height, local, table,
                        sums.data());
            for (int channel = 0; channel < 3; ++channel)
                for (int x = 0; x < width; ++x)
                    out[(y * width + x) * 3 + channel] =
                        sums[static_cast<std::size_t>(channel) * table.padded + x];
        }
    });
    return image;
}

Image shBandLatLong(std::span<const glm::vec3> coefficients, int l, int height,
                    const JobContext& job) {
    CHECK(l >= 0 && l < kMaxShOrder);
    CHECK_LE(static_cast<std::size_t>(shCount(l + 1)), coefficients.size());
    std::vector<glm::vec3> band(shCount(l + 1), glm::vec3(0.0f));
    std::copy(coefficients.begin() + shCount(l), coefficients.begin() + shCount(l + 1),
              band.begin() + shCount(l));
    return shLatLong(band, l + 1, height, job);
}

} // namespace patina
