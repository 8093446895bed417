#include "core/light/Cubemap.h"

#include "core/base/Check.h"
#include "core/job/Parallel.h"
#include "core/math/Shading.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

namespace patina {

namespace {

// Four floats in one register.
typedef float Quad __attribute__((vector_size(16))); // NOLINT(modernize-use-using): as GCC has it

Quad load(const glm::vec4& texel) {
    Quad quad;
    __builtin_memcpy(&quad, &texel, sizeof(quad));
    return quad;
}

// A lat-long image, small enough that a few samples per cube texel see each pixel. Four floats a
// texel: one register.
struct LatLong {
    int width, height;
    std::unique_ptr<glm::vec4[]> texels; // NOLINT: a vector would clear 32 MB first
    std::vector<double> rowSum;          // of the brightness
    std::vector<float> rowMaximum;

    LatLong(int columns, int rowCount)
        : width(columns)
        , height(rowCount)
        , texels(std::make_unique_for_overwrite<glm::vec4[]>(static_cast<std::size_t>(columns) *
                                                             rowCount))
        , rowSum(rowCount)
        , rowMaximum(rowCount) {}

    // Where a latitude lies: two rows and the share of the second. v ends at the poles.
    struct Rows {
        const glm::vec4 *top, *bottom;
        float share;
    };
    [[nodiscard]] Rows rows(float v) const {
        const float y =
            std::clamp(v * static_cast<float>(height) - 0.5f, 0.0f, static_cast<float>(height - 1));
        const int row0 = static_cast<int>(y);
        const int row1 = std::min(row0 + 1, height - 1);
        return {texels.get() + static_cast<std::size_t>(row0) * width,
                texels.get() + static_cast<std::size_t>(row1) * width,
                y - static_cast<float>(row0)};
    }

    // Bilinear between texel centres; u in 0…2 repeats after 1. (A cast instead of floor and a
    // comparison instead of a remainder: this is called millions of times.)
    [[nodiscard]] Quad sample(float u, const Rows& rows) const {
        const float x = u * static_cast<float>(width) + static_cast<float>(width) - 0.5f;
        int column0 = static_cast<int>(x);
        const float fx = x - static_cast<float>(column0);
        while (column0 >= width)
            column0 -= width;
        const int column1 = column0 + 1 == width ? 0 : column0 + 1;
        const Quad top0 = load(rows.top[column0]), bottom0 = load(rows.bottom[column0]);
        const Quad top = top0 + (load(rows.top[column1]) - top0) * fx;
        const Quad bottom = bottom0 + (load(rows.bottom[column1]) - bottom0) * fx;
        return top + (bottom - top) * rows.share;
    }
};

float brightest(const glm::vec4& c) {
    return std::max({c.x, c.y, c.z});
}

// Sum and maximum of the brightness of a row.
void measureRow(LatLong& image, std::size_t y) {
    // Four partial sums: an addition need not wait for the one before.
    float sum[4] = {}, maximum[4] = {};
    const glm::vec4* row = image.texels.get() + y * image.width;
    for (int x = 0; x < image.width; ++x) {
        const float value = brightest(row[x]);
        sum[x % 4] += value;
        maximum[x % 4] = std::max(maximum[x % 4], value);
    }
    image.rowSum[y] = static_cast<double>(sum[0]) + sum[1] + sum[2] + sum[3];
    image.rowMaximum[y] = std::max({maximum[0], maximum[1], maximum[2], maximum[3]});
}

LatLong unpack(const Image& environment, const JobContext& job) {
    LatLong result(environment.width(), environment.height());
    const std::size_t channels = environment.channels();
    parallelFor(job, result.height, 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y) {
            const float* source = environment.f32().data() + y * result.width * channels;
            glm::vec4* row = result.texels.get() + y * result.width;
            for (int x = 0; x < result.width; ++x, source += channels)
                row[x] = {source[0], source[1], source[2], 0.0f};
            measureRow(result, y); // while it is in the cache
        }
    });
    return result;
}

// Means of 2 × 2 texels, weighted by the solid angles of their rows.
LatLong halve(const LatLong& from) {
    LatLong to(from.width / 2, from.height / 2);
    for (int y = 0; y < to.height; ++y) {
        // extent of row j in cos(theta): 2 sin(centre) sin(half height)
        const double step = std::numbers::pi / from.height;
        const double upper = std::sin(step * (2 * y + 0.5)), lower = std::sin(step * (2 * y + 1.5));
        const auto weight = static_cast<float>(upper / (upper + lower));
        const glm::vec4* top = from.texels.get() + static_cast<std::size_t>(2 * y) * from.width;
        const glm::vec4* bottom = top + from.width;
        for (int x = 0; x < to.width; ++x)
            to.texels[static_cast<std::size_t>(y) * to.width + x] =
                (top[2 * x] + top[2 * x + 1]) * (0.5f * weight) +
                (bottom[2 * x] + bottom[2 * x + 1]) * (0.5f * (1.0f - weight));
        measureRow(to, y);
    }
    return to;
}

// What is this many times brighter than the mean of the image is moved by area.
constexpr float kBrightContrast = 16.0f;

// Over the sphere.
float meanBrightness(const LatLong& image) {
    double sum = 0.0, weights = 0.0;
    for (int y = 0; y < image.height; ++y) {
        const double weight = std::sin(std::numbers::pi * (y + 0.5) / image.height);
        sum += weight * image.rowSum[y];
        weights += weight * image.width;
    }
    return static_cast<float>(sum / weights);
}

// How much solid angle a sample on the plane at distance 1 stands for: dω = dA / |d|³.
float sampleWeight(float squaredDistance) {
    const float inverse = 1.0f / squaredDistance;
    return inverse * std::sqrt(inverse);
}

// Takes what exceeds that brightness out of the image and adds it to the cubemap patch by
// patch: each deposits its flux where it lies. Sampling would find a small sun or miss it; this way
// its energy is exact, however small it is and wherever it stands.
void moveBrightTexels(LatLong& image, CubeLevel& cube, const JobContext& job) {
    const int size = cube.size;
    const float limit = kBrightContrast * meanBrightness(image);
    const std::vector<float> omega = cubeSolidAngles(size);
    // Eight patches across a cube texel
    const int n = std::clamp((32 * size + image.width - 1) / image.width, 4, 64);
    const double stepTheta = std::numbers::pi / (static_cast<double>(image.height) * n);
    const double stepPhi = 2.0 * std::numbers::pi / (static_cast<double>(image.width) * n);
    for (int y = 0; y < image.height && !job.cancelled(); ++y) {
        if (image.rowMaximum[y] <= limit)
            continue;
        for (int x = 0; x < image.width; ++x) {
            glm::vec4& texel = image.texels[static_cast<std::size_t>(y) * image.width + x];
            if (brightest(texel) <= limit)
                continue;
            const glm::vec4 kept = texel * (limit / brightest(texel));
            const glm::vec3 excess(texel - kept);
            texel = kept;
            for (int j = 0; j < n; ++j) {
                const double theta = stepTheta * (static_cast<double>(y) * n + j + 0.5);
                // cos(theta0) - cos(theta1) = 2 sin(centre) sin(half the step): exact
                const auto patch =
                    static_cast<float>(2.0 * std::sin(theta) * std::sin(0.5 * stepTheta) * stepPhi);
                const auto sinTheta = static_cast<float>(std::sin(theta));
                const auto cosTheta = static_cast<float>(std::cos(theta));
                for (int i = 0; i < n; ++i) {
                    const auto phi = static_cast<float>(
                        stepPhi * (static_cast<double>(x) * n + i + 0.5) - std::numbers::pi);
                    const CubePosition at = cubePosition(
                        {sinTheta * std::sin(phi), cosTheta, -sinTheta * std::cos(phi)});
                    const auto scale = static_cast<float>(size);
                    const int column = std::clamp(static_cast<int>(at.s * scale), 0, size - 1);
                    const int row = std::clamp(static_cast<int>(at.t * scale), 0, size - 1);
                    const std::size_t inFace = static_cast<std::size_t>(row) * size + column;
                    cube.texels[at.face * omega.size() + inFace] +=
                        excess * (patch / omega[inFace]);
                }
            }
        }
    }
}

// Positions of samples across a face and their azimuths, shared by rows and columns.
struct FaceGrid {
    std::vector<float> position, azimuth; // -1…1 and atan(position) / 2pi

    explicit FaceGrid(int samples)
        : position(samples)
        , azimuth(samples) {
        for (int i = 0; i < samples; ++i) {
            position[i] =
                (2.0f * static_cast<float>(i) + 1.0f) / static_cast<float>(samples) - 1.0f;
            azimuth[i] = std::atan(position[i]) / shading::kTwoPi;
        }
    }
};

// Means over the texels at (x, y) of all six faces and over their mirror images, behind x, y and
// both: of[mirror][face]. The four sides see the same latitudes, and a quarter further on the
// same longitudes; the floor mirrors the ceiling. That saves 23 of 24 arc tangents.
struct MirroredSums {
    Quad of[4][6] = {};
};

// n × n samples per texel; face -Y: at (x, size - 1 - y).
MirroredSums averageTexels(const LatLong& image, const FaceGrid& grid, int x, int y, int n) {
    MirroredSums sums;
    float weights = 0.0f;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const float u = grid.position[static_cast<std::size_t>(x) * n + i];
            const float v = grid.position[static_cast<std::size_t>(y) * n + j];
            const float weight = sampleWeight(1.0f + u * u + v * v);
            weights += weight;

            // The sides: azimuths ± turn from their middles, latitudes `side` and 1 - side
            const float side = std::atan2(std::sqrt(1.0f + u * u), -v) * shading::kInvPi;
            const float turn = grid.azimuth[static_cast<std::size_t>(x) * n + i];
            const LatLong::Rows sideRows[2] = {image.rows(side), image.rows(1.0f - side)};
            // Ceiling and floor: azimuth from the middle of the image
            const float around = std::atan2(u, -v) / shading::kTwoPi;
            const float down = std::atan(std::sqrt(u * u + v * v)) * shading::kInvPi;
            const LatLong::Rows up = image.rows(down), under = image.rows(1.0f - down);
            for (int mirror = 0; mirror < 4; ++mirror) {
                Quad* sum = sums.of[mirror];
                const float signedTurn = mirror % 2 == 0 ? turn : -turn;
                const LatLong::Rows& rows = sideRows[mirror / 2];
                sum[0] += image.sample(0.75f - signedTurn, rows) * weight;
                sum[1] += image.sample(0.25f - signedTurn, rows) * weight;
                sum[4] += image.sample(1.0f - signedTurn, rows) * weight;
                sum[5] += image.sample(0.5f - signedTurn, rows) * weight;
                // atan2(u, v) = pi - atan2(u, -v), and odd in u
                const float here = mirror / 2 == 0 ? around : 0.5f - around;
                const float azimuth = 0.5f + (mirror % 2 == 0 ? here : -here);
                sum[2] += image.sample(azimuth, up) * weight;
                sum[3] += image.sample(azimuth, under) * weight;
            }
        }
    for (Quad(&mirror)[6] : sums.of)
        for (Quad& value : mirror)
            value /= weights;
    return sums;
}

} // namespace

glm::vec3 cubeDirection(int face, float s, float t) {
    const float u = 2.0f * s - 1.0f, v = 2.0f * t - 1.0f;
    switch (face) {
    case 0:
        return {1.0f, -v, -u};
    case 1:
        return {-1.0f, -v, u};
    case 2:
        return {u, 1.0f, v};
    case 3:
        return {u, -1.0f, -v};
    case 4:
        return {u, -v, 1.0f};
    default:
        CHECK_EQ(face, 5);
        return {-u, -v, -1.0f};
    }
}

CubePosition cubePosition(const glm::vec3& d) {
    const glm::vec3 a = glm::abs(d);
    int face;
    float u, v, major;
    if (a.x >= a.y && a.x >= a.z) {
        face = d.x >= 0.0f ? 0 : 1;
        u = d.x >= 0.0f ? -d.z : d.z;
        v = -d.y;
        major = a.x;
    } else if (a.y >= a.z) {
        face = d.y >= 0.0f ? 2 : 3;
        u = d.x;
        v = d.y >= 0.0f ? d.z : -d.z;
        major = a.y;
    } else {
        face = d.z >= 0.0f ? 4 : 5;
        u = d.z >= 0.0f ? d.x : -d.x;
        v = -d.y;
        major = a.z;
    }
    return {face, 0.5f * (u / major + 1.0f), 0.5f * (v / major + 1.0f)};
}

std::vector<float> cubeSolidAngles(int size) {
    // A(x, y) = atan(xy / sqrt(x² + y² + 1)) is odd in x and in y: one quarter of the corners is
    // enough, x and y >= 0; half a texel off when the size is odd.
    const int half = size / 2 + 1;
    std::vector<double> corners(static_cast<std::size_t>(half) * half);
    const auto position = [&](int i) { return std::abs(2.0 * i / size - 1.0); };
    for (int j = 0; j < half; ++j)
        for (int i = 0; i < half; ++i) {
            const double x = position(i), y = position(j);
            corners[static_cast<std::size_t>(j) * half + i] =
                std::atan2(x * y, std::sqrt(x * x + y * y + 1.0));
        }
    const auto corner = [&](int i, int j) {
        const int column = std::min(i, size - i), row = std::min(j, size - j);
        const double a = corners[static_cast<std::size_t>(row) * half + column];
        return (column == i) == (row == j) ? a : -a;
    };
    std::vector<float> result(static_cast<std::size_t>(size) * size);
    for (int j = 0; j < size; ++j)
        for (int i = 0; i < size; ++i)
            result[static_cast<std::size_t>(j) * size + i] = static_cast<float>(
                corner(i, j) - corner(i + 1, j) - corner(i, j + 1) + corner(i + 1, j + 1));
    return result;
}

CubeLevel cubeFromLatLong(const Image& environment, int size, const JobContext& job) {
    CHECK_EQ(size % 2, 0);
    LatLong image = unpack(environment, job);
    while (image.width > 8 * size && image.width % 2 == 0 && image.height % 2 == 0)
        image = halve(image);

    CubeLevel level;
    level.size = size;
    level.texels.resize(6 * static_cast<std::size_t>(size) * size, glm::vec3(0.0f));
    moveBrightTexels(image, level, job);

    // A sample per image texel, on average: at the equator 4 · size texels go around. Small cubes
    // need more, to weigh what their curved texels cover.
    const int n = std::clamp((image.width + 4 * size - 1) / (4 * size), size < 64 ? 4 : 2, 16);
    const FaceGrid grid(size * n);
    parallelFor(job, size / 2, 2, [&](std::size_t begin, std::size_t end) {
        for (int row = static_cast<int>(begin); row < static_cast<int>(end); ++row)
            for (int column = 0; column < size / 2; ++column) {
                const MirroredSums means = averageTexels(image, grid, column, row, n);
                for (int mirror = 0; mirror < 4; ++mirror)
                    for (int face = 0; face < 6; ++face) {
                        const int x = mirror % 2 == 0 ? column : size - 1 - column;
                        int y = mirror / 2 == 0 ? row : size - 1 - row;
                        if (face == 3)
                            y = size - 1 - y;
                        const Quad& mean = means.of[mirror][face];
                        level.texels[(static_cast<std::size_t>(face) * size + y) * size + x] +=
                            glm::vec3(mean[0], mean[1], mean[2]);
                    }
            }
    });
    return level;
}

CubeLevel halveCube(const CubeLevel& from) {
    CHECK_EQ(from.size % 2, 0);
    const std::vector<float> omega = cubeSolidAngles(from.size);
    CubeLevel to;
    to.size = from.size / 2;
    to.texels.resize(6 * static_cast<std::size_t>(to.size) * to.size);
    for (int face = 0; face < 6; ++face)
        for (int y = 0; y < to.size; ++y)
            for (int x = 0; x < to.size; ++x) {
                glm::vec3 sum(0.0f);
                float weights = 0.0f;
                for (int k = 0; k < 4; ++k) {
                    const std::size_t child =
                        static_cast<std::size_t>(2 * y + k / 2) * from.size + 2 * x + k % 2;
                    sum += from.texels[face * omega.size() + child] * omega[child];
                    weights += omega[child];
                }
                to.texels[(static_cast<std::size_t>(face) * to.size + y) * to.size + x] =
                    sum / weights;
            }
    return to;
}

} // namespace patina
