#include "core/light/Cubemap.h"

#include "core/base/Check.h"
#include "core/job/Parallel.h"
#include "core/math/Shading.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace patina {

namespace {

// A lat-long image as packed RGB, small enough that a few samples per cube texel see each pixel.
struct LatLong {
    int width, height;
    std::vector<glm::vec3> texels;

    // Bilinear between texel centres; u repeats, v ends at the poles.
    [[nodiscard]] glm::vec3 sample(glm::vec2 uv) const {
        const float x = uv.x * static_cast<float>(width) - 0.5f;
        const float y = std::clamp(uv.y * static_cast<float>(height) - 0.5f, 0.0f,
                                   static_cast<float>(height - 1));
        const float x0 = std::floor(x);
        const int column0 = (static_cast<int>(x0) + width) % width;
        const int column1 = (column0 + 1) % width;
        const int row0 = static_cast<int>(y);
        const int row1 = std::min(row0 + 1, height - 1);
        const float fx = x - x0, fy = y - static_cast<float>(row0);
        const glm::vec3* top = texels.data() + static_cast<std::size_t>(row0) * width;
        const glm::vec3* bottom = texels.data() + static_cast<std::size_t>(row1) * width;
        return (top[column0] * (1.0f - fx) + top[column1] * fx) * (1.0f - fy) +
               (bottom[column0] * (1.0f - fx) + bottom[column1] * fx) * fy;
    }
};

LatLong unpack(const Image& environment) {
    LatLong result{environment.width(), environment.height(), {}};
    result.texels.resize(static_cast<std::size_t>(result.width) * result.height);
    const std::span<const float> source = environment.f32();
    const std::size_t channels = environment.channels();
    for (std::size_t i = 0; i < result.texels.size(); ++i)
        result.texels[i] = {source[i * channels], source[i * channels + 1],
                            source[i * channels + 2]};
    return result;
}

// Means of 2 × 2 texels, weighted by the solid angles of their rows.
LatLong halve(const LatLong& from) {
    LatLong to{from.width / 2, from.height / 2, {}};
    to.texels.resize(static_cast<std::size_t>(to.width) * to.height);
    for (int y = 0; y < to.height; ++y) {
        // extent of row j in cos(theta): 2 sin(centre) sin(half height)
        const double step = std::numbers::pi / from.height;
        const double upper = std::sin(step * (2 * y + 0.5)), lower = std::sin(step * (2 * y + 1.5));
        const auto weight = static_cast<float>(upper / (upper + lower));
        const glm::vec3* top = from.texels.data() + static_cast<std::size_t>(2 * y) * from.width;
        const glm::vec3* bottom = top + from.width;
        for (int x = 0; x < to.width; ++x)
            to.texels[static_cast<std::size_t>(y) * to.width + x] =
                (top[2 * x] + top[2 * x + 1]) * (0.5f * weight) +
                (bottom[2 * x] + bottom[2 * x + 1]) * (0.5f * (1.0f - weight));
    }
    return to;
}

float brightest(const glm::vec3& c) {
    return std::max({c.x, c.y, c.z});
}

// What is this many times brighter than the mean of the image counts as a lamp.
constexpr float kLamp = 16.0f;

float meanBrightness(const LatLong& image) {
    double sum = 0.0, weights = 0.0;
    for (int y = 0; y < image.height; ++y) {
        double row = 0.0;
        for (int x = 0; x < image.width; ++x)
            row += brightest(image.texels[static_cast<std::size_t>(y) * image.width + x]);
        const double weight = std::sin(std::numbers::pi * (y + 0.5) / image.height);
        sum += weight * row;
        weights += weight * image.width;
    }
    return static_cast<float>(sum / weights);
}

// How much solid angle a sample on the plane at distance 1 stands for: dω = dA / |d|³.
float sampleWeight(float squaredDistance) {
    const float inverse = 1.0f / squaredDistance;
    return inverse * std::sqrt(inverse);
}

// Takes what exceeds the lamp's brightness out of the image and adds it to the cubemap patch by
// patch: each deposits its flux where it lies. Sampling would find a small sun or miss it; this way
// its energy is exact, however small it is and wherever it stands.
void moveLamps(LatLong& image, CubeLevel& cube, const JobContext& job) {
    const int size = cube.size;
    const float limit = kLamp * meanBrightness(image);
    const std::vector<float> omega = cubeSolidAngles(size);
    // Eight patches across a cube texel
    const int n = std::clamp((32 * size + image.width - 1) / image.width, 4, 64);
    const double stepTheta = std::numbers::pi / (static_cast<double>(image.height) * n);
    const double stepPhi = 2.0 * std::numbers::pi / (static_cast<double>(image.width) * n);
    for (int y = 0; y < image.height && !job.cancelled(); ++y)
        for (int x = 0; x < image.width; ++x) {
            glm::vec3& texel = image.texels[static_cast<std::size_t>(y) * image.width + x];
            if (brightest(texel) <= limit)
                continue;
            const glm::vec3 kept = texel * (limit / brightest(texel));
            const glm::vec3 excess = texel - kept;
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

// n × n samples in the texels at (x, y) of all six faces (-Y: at (x, size - 1 - y)) at once: the
// four sides see the same latitudes, and a quarter further on the same longitudes; the floor
// mirrors the ceiling. That saves five of six arc tangents.
std::array<glm::vec3, 6> averageSixTexels(const LatLong& image, const FaceGrid& grid, int x, int y,
                                          int n) {
    std::array<glm::vec3, 6> sums{};
    float weights = 0.0f;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const float u = grid.position[static_cast<std::size_t>(x) * n + i];
            const float v = grid.position[static_cast<std::size_t>(y) * n + j];
            const float weight = sampleWeight(1.0f + u * u + v * v);
            weights += weight;

            const float side = std::atan2(std::sqrt(1.0f + u * u), -v) * shading::kInvPi;
            const float turn = grid.azimuth[static_cast<std::size_t>(x) * n + i];
            sums[0] += image.sample({0.75f - turn, side}) * weight;
            sums[1] += image.sample({0.25f - turn, side}) * weight;
            sums[4] += image.sample({1.0f - turn, side}) * weight;
            sums[5] += image.sample({0.5f - turn, side}) * weight;

            const float around = 0.5f + std::atan2(u, -v) / shading::kTwoPi;
            const float down = std::atan(std::sqrt(u * u + v * v)) * shading::kInvPi;
            sums[2] += image.sample({around, down}) * weight;
            sums[3] += image.sample({around, 1.0f - down}) * weight;
        }
    for (glm::vec3& sum : sums)
        sum /= weights;
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
    std::vector<double> corners(static_cast<std::size_t>(size + 1) * (size + 1));
    for (int j = 0; j <= size; ++j)
        for (int i = 0; i <= size; ++i) {
            const double x = 2.0 * i / size - 1.0, y = 2.0 * j / size - 1.0;
            corners[static_cast<std::size_t>(j) * (size + 1) + i] =
                std::atan2(x * y, std::sqrt(x * x + y * y + 1.0));
        }
    std::vector<float> result(static_cast<std::size_t>(size) * size);
    for (int j = 0; j < size; ++j)
        for (int i = 0; i < size; ++i) {
            const double* a = corners.data() + static_cast<std::size_t>(j) * (size + 1) + i;
            const double* b = a + size + 1;
            result[static_cast<std::size_t>(j) * size + i] =
                static_cast<float>(a[0] - a[1] - b[0] + b[1]);
        }
    return result;
}

CubeLevel cubeFromLatLong(const Image& environment, int size, const JobContext& job) {
    LatLong image = unpack(environment);
    while (image.width > 8 * size && image.width % 2 == 0 && image.height % 2 == 0)
        image = halve(image);

    CubeLevel level;
    level.size = size;
    level.texels.resize(6 * static_cast<std::size_t>(size) * size, glm::vec3(0.0f));
    moveLamps(image, level, job);

    // Two samples per image texel; at the equator 4 · size texels go around.
    const int n = std::clamp((image.width + 2 * size - 1) / (2 * size), 2, 16);
    const FaceGrid grid(size * n);
    parallelFor(job, size, 2, [&](std::size_t begin, std::size_t end) {
        for (std::size_t row = begin; row < end; ++row)
            for (int x = 0; x < size; ++x) {
                const int y = static_cast<int>(row);
                const std::array<glm::vec3, 6> means = averageSixTexels(image, grid, x, y, n);
                for (int face = 0; face < 6; ++face) {
                    const int faceRow = face == 3 ? size - 1 - y : y;
                    level.texels[(static_cast<std::size_t>(face) * size + faceRow) * size + x] +=
                        means[face];
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
