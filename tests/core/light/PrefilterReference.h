// Exact values of the GGX prefilter with N = V = R and weight N·L (Karis 2013), and the cubemaps
// they are tested with: closed forms of the density of half vectors, alpha² / (1 - (1 - alpha²) x)²
// of x = cos², on 1/2 … 1.
#pragma once

#include "core/light/Cubemap.h"

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace patina::reference {

// P_l becomes lambda_l P_l, l = 1 … 4.
struct BandFactors {
    float perceptualRoughness;
    double lambda[4];
};
inline constexpr BandFactors kBandFactors[] = {
    {0.05f, {0.999883857004, 0.999660942803, 0.999344792271, 0.998947243679}},
    {0.1f, {0.998693503699, 0.996229938117, 0.992824773157, 0.988665743355}},
    {0.25f, {0.976092604298, 0.933738270618, 0.880606983182, 0.822958863625}},
    {0.5f, {0.867395662812, 0.662405687279, 0.460387585347, 0.305538297757}},
    {0.75f, {0.745131342455, 0.398824737791, 0.140121157544, 0.0289846076205}},
    {1.0f, {0.666666666667, 0.25, 0.0, -0.0416666666667}},
};

// K(t) = D(t / 2) cos t / (4 W): response at angle t from R to unit integrated radiance; and the
// fraction of it inside a disc around R.
inline constexpr float kFilterRoughness[5] = {0.1f, 0.25f, 0.5f, 0.75f, 1.0f};
inline constexpr double kKernelAngleDeg[8] = {0, 5, 10, 20, 30, 45, 60, 80};
inline constexpr double kKernel[5][8] = {
    {797.053020629, 1.98017439223, 0.13255018851, 0.00818470273818, 0.00153399510852,
     0.0002624868001, 6.37260003148e-05, 8.10520679947e-06},
    {21.0957001062, 9.52757393885, 2.40843045642, 0.262555479877, 0.0558782922431, 0.010145809629,
     0.00251584801732, 0.000323823737212},
    {1.67025672741, 1.57284266925, 1.32559130272, 0.744137473127, 0.359888235795, 0.115575213166,
     0.0370139994995, 0.005598521862},
    {0.534055233168, 0.527675877133, 0.509094726092, 0.442336735447, 0.352950647382, 0.217920161614,
     0.11257581728, 0.0258886473299},
    {0.318309886184, 0.317098620966, 0.313474043774, 0.29911345117, 0.275664447711, 0.225079079039,
     0.159154943092, 0.0552739316692}};

struct Disc {
    double halfAngleDeg;
    double fraction[5]; // by roughness
};
inline constexpr Disc kDiscs[] = {
    {0.2666, // the Sun
     {0.0514302096453, 0.00143290266601, 0.000113597751254, 3.63247689137e-05, 2.16506974444e-05}},
    {2.5, {0.827566121667, 0.112452461214, 0.0099129653364, 0.00318895909711, 0.00190265095413}},
    {10.0, {0.988017070715, 0.68222336265, 0.142079213488, 0.0497765768298, 0.030153689607}}};

// D(h) N·L but for a constant, textbook form; c = N·L.
inline double lobe(double c, double alpha2) {
    const double d = 0.5 * (1.0 + c) * (alpha2 - 1.0) + 1.0;
    return std::max(c, 0.0) / (d * d);
}

inline glm::vec3 texelDirection(int size, std::size_t index) {
    const int face = static_cast<int>(index) / (size * size);
    const int x = static_cast<int>(index) % size, y = static_cast<int>(index) / size % size;
    return glm::normalize(cubeDirection(face,
                                        (static_cast<float>(x) + 0.5f) / static_cast<float>(size),
                                        (static_cast<float>(y) + 0.5f) / static_cast<float>(size)));
}

inline CubeLevel cubeOf(int size, const std::function<glm::vec3(glm::vec3)>& radiance) {
    CubeLevel level;
    level.size = size;
    for (std::size_t i = 0; i < 6u * size * size; ++i)
        level.texels.push_back(radiance(texelDirection(size, i)));
    return level;
}

// Where to read a filtered lamp of unit flux for the k-th angle: the texel that is closest to it,
// and the kernel there; from the angle to the texel's it goes by the ratio of the lobe's values.
struct KernelSample {
    std::size_t texel;
    double exact;
};
inline KernelSample kernelSample(int size, const glm::dvec3& lamp, int roughness, int k) {
    const double alpha2 = std::pow(kFilterRoughness[roughness], 4.0);
    const double wanted = glm::radians(kKernelAngleDeg[k]);
    double angle = 1e9;
    KernelSample sample{};
    for (std::size_t i = 0; i < 6u * size * size; ++i) {
        const double chord = glm::length(lamp - glm::dvec3(texelDirection(size, i)));
        const double t = 2.0 * std::asin(std::min(0.5 * chord, 1.0));
        if (std::abs(t - wanted) < std::abs(angle - wanted)) {
            angle = t;
            sample.texel = i;
        }
    }
    sample.exact =
        kKernel[roughness][k] * lobe(std::cos(angle), alpha2) / lobe(std::cos(wanted), alpha2);
    return sample;
}

// A disc of radiance 1 around a texel of a 16² cubemap that is nearly in a corner, where the 1024²
// texels of the result are smallest; one that it covers in part has that share. Texels of width w,
// each a point of light at its centre, make the peak of a lobe w² / (12 alpha²) too high: at r =
// 0.1 by 0.07 % here, by 5 % in the middle of a face of 256² texels.
inline constexpr std::size_t kDiscTexel = 4u * 16 * 16 + 15 * 16 + 15;

inline CubeLevel discCube(double halfAngleDeg) {
    constexpr int kSize = 1024, kParts = 16, kRow = 64;
    const glm::vec3 towards = texelDirection(16, kDiscTexel);
    const std::vector<float> omega = cubeSolidAngles(kSize);
    const double half = std::sin(glm::radians(halfAngleDeg) / 2.0);
    const auto edge = static_cast<float>(2.0 * half);
    CubeLevel cube{kSize, std::vector<glm::vec3>(6u * kSize * kSize, glm::vec3(0.0f))};
    double flux = 0.0;
    const auto fill = [&](std::size_t i) {
        const float distance = glm::length(texelDirection(kSize, i) - towards);
        if (distance > edge + 0.002f)
            return;
        const bool whole = distance < edge - 0.002f;
        int inside = 0;
        for (int k = 0; k < kParts * kParts && !whole; ++k) {
            const auto at = [&](std::size_t texel, int part) {
                return (static_cast<float>(texel) + (static_cast<float>(part) + 0.5f) / kParts) /
                       kSize;
            };
            const glm::vec3 part = glm::normalize(
                cubeDirection(static_cast<int>(i / (kSize * kSize)), at(i % kSize, k % kParts),
                              at(i / kSize % kSize, k / kParts)));
            inside += glm::length(part - towards) < edge ? 1 : 0;
        }
        const float share = whole ? 1.0f : static_cast<float>(inside) / (kParts * kParts);
        cube.texels[i] = glm::vec3(share);
        flux += static_cast<double>(share) * omega[i % omega.size()];
    };
    for (std::size_t row = 0; row < cube.texels.size(); row += kRow)
        if (glm::length(texelDirection(kSize, row) - towards) < edge + 0.15f)
            for (std::size_t i = row; i < row + kRow; ++i)
                fill(i);
    // Its flux exactly: the parts of a texel count too coarsely for the Sun.
    for (glm::vec3& value : cube.texels)
        value *= static_cast<float>(4.0 * M_PI * half * half / flux);
    return cube;
}

// P_l of the angle to an axis, l = 1 … 4.
inline double band(const glm::vec3& d, int l) {
    const double x = glm::dot(glm::dvec3(d), glm::normalize(glm::dvec3(0.3, -0.5, 0.8)));
    const double x2 = x * x;
    return l == 1   ? x
           : l == 2 ? 0.5 * (3.0 * x2 - 1.0)
           : l == 3 ? 0.5 * x * (5.0 * x2 - 3.0)
                    : 0.125 * ((35.0 * x2 - 30.0) * x2 + 3.0);
}

} // namespace patina::reference
