// The GGX prefilter with N = V = R by its definition: a sum over every texel of the cubemap that
// level 0 is, for one direction at a time. And how far a lookup is from it.
#pragma once

#include "core/document/Document.h"
#include "core/io/ImageIO.h"
#include "core/job/Parallel.h"
#include "core/library/Library.h"
#include "core/light/CubeSampling.h"
#include "core/light/Cubemap.h"
#include "core/light/GeneratedEnvironment.h"
#include "core/math/Sampling.h"
#include "core/math/Shading.h"
#include "core/worker/WorkerClient.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <functional>
#include <glm/geometric.hpp>
#include <numeric>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace patina::reference {

class EnvironmentSum {
  public:
    // From this roughness on a texel is a point; a narrower lobe sees what a mirror shows: texels
    // with bilinear light between them.
    static constexpr float kPointRoughness = 0.1f;

    explicit EnvironmentSum(CubeLevel base)
        : m_base(std::move(base)) {
        const std::vector<float> omega = cubeSolidAngles(m_base.size);
        for (std::size_t i = 0; i < m_base.texels.size(); ++i)
            m_texels.add(direction(i), omega[i % omega.size()], m_base.texels[i]);
    }

    // Of unit direction `d`, for each perceptual roughness above 0.
    [[nodiscard]] std::vector<glm::vec3> at(const glm::vec3& d,
                                            std::span<const float> roughness) const {
        Cells far = m_texels, near;
        for (std::size_t i = 0; i < m_base.texels.size(); ++i) {
            const glm::vec3 texel = direction(i);
            if (glm::distance(texel, d) < kNear) {
                far.weight[i] = 0.0f;
                // Parts narrower than the lobe of the least roughness, where its peak may be
                const float off = glm::distance(texel, d);
                split(i, off < kPeak ? 32 : (off < 0.3f * kNear ? 8 : 4), near);
            }
        }
        std::vector<glm::vec3> result;
        for (const float r : roughness) {
            const float alpha2 = r * r * r * r;
            const glm::dvec4 sum = r >= kPointRoughness - 1e-6f
                                       ? m_texels.sum(d, alpha2)
                                       : far.sum(d, alpha2) + near.sum(d, alpha2);
            result.emplace_back(glm::dvec3(sum) / sum.w);
        }
        return result;
    }

    // Unit vector to a texel.
    [[nodiscard]] glm::vec3 direction(std::size_t texel) const {
        const auto n = static_cast<std::size_t>(m_base.size);
        const auto side = static_cast<float>(n);
        return glm::normalize(cubeDirection(static_cast<int>(texel / (n * n)),
                                            (static_cast<float>(texel % n) + 0.5f) / side,
                                            (static_cast<float>(texel / n % n) + 0.5f) / side));
    }
    [[nodiscard]] const CubeLevel& base() const { return m_base; }

  private:
    static constexpr float kNear = 0.16f, kPeak = 0.02f; // radians

    struct Cells {
        std::vector<float> x, y, z, weight, red, green, blue;

        void add(const glm::vec3& d, float solidAngle, const glm::vec3& radiance) {
            x.push_back(d.x);
            y.push_back(d.y);
            z.push_back(d.z);
            weight.push_back(solidAngle);
            red.push_back(radiance.x);
            green.push_back(radiance.y);
            blue.push_back(radiance.z);
        }
        // Radiance times weight, and the weight.
        [[nodiscard]] glm::dvec4 sum(const glm::vec3& d, float alpha2) const {
            constexpr std::size_t kLanes = 4, kPiece = 4096; // floats err little in a piece
            using V [[gnu::vector_size(kLanes * sizeof(float))]] = float;
            const auto load = [](const std::vector<float>& from, std::size_t i) {
                V value;
                __builtin_memcpy(&value, from.data() + i, sizeof(value));
                return value;
            };
            glm::dvec4 total(0.0);
            std::size_t i = 0;
            while (i + kLanes <= x.size()) {
                V r = {}, g = {}, b = {}, w = {};
                const V zero = {};
                for (const std::size_t end = std::min(i + kPiece, x.size() / kLanes * kLanes);
                     i < end; i += kLanes) {
                    const V dx = load(x, i) - d.x, dy = load(y, i) - d.y, dz = load(z, i) - d.z;
                    const V square = dx * dx + dy * dy + dz * dz;
                    const V c = 1.0f - 0.5f * square;
                    const V s = alpha2 + (0.25f - 0.25f * alpha2) * square;
                    const V one = (c > zero ? c : zero) * load(weight, i) / (s * s);
                    r += one * load(red, i);
                    g += one * load(green, i);
                    b += one * load(blue, i);
                    w += one;
                }
                for (std::size_t k = 0; k < kLanes; ++k)
                    total += glm::dvec4(r[k], g[k], b[k], w[k]);
            }
            for (; i < x.size(); ++i) {
                const double square =
                    std::pow(x[i] - d.x, 2) + std::pow(y[i] - d.y, 2) + std::pow(z[i] - d.z, 2);
                const double s = alpha2 + 0.25 * (1.0 - alpha2) * square;
                total += std::max(1.0 - 0.5 * square, 0.0) * weight[i] / (s * s) *
                         glm::dvec4(red[i], green[i], blue[i], 1.0);
            }
            return total;
        }
    };

    void split(std::size_t texel, int parts, Cells& to) const {
        const auto n = static_cast<std::size_t>(m_base.size);
        const auto side = static_cast<float>(n), count = static_cast<float>(parts);
        for (int k = 0; k < parts * parts; ++k) {
            const auto position = [&](std::size_t at, int part) {
                return (static_cast<float>(at) + (static_cast<float>(part) + 0.5f) / count) / side;
            };
            const glm::vec3 d =
                cubeDirection(static_cast<int>(texel / (n * n)), position(texel % n, k % parts),
                              position(texel / n % n, k / parts));
            const float square = glm::dot(d, d);
            // dω = dA / |d|³ on the cube's face, which is 2 wide
            to.add(d / std::sqrt(square),
                   4.0f / (side * side * count * count * square * std::sqrt(square)),
                   sampleCube(m_base, d));
        }
    }

    CubeLevel m_base;
    Cells m_texels;
};

// 1/40 … 1
inline std::vector<float> fortyRoughnesses() {
    std::vector<float> result(40);
    for (int i = 0; i < 40; ++i)
        result[static_cast<std::size_t>(i)] = static_cast<float>(i + 1) / 40.0f;
    return result;
}

// Where lookups are compared: all over the sphere, then as many around the brightest texels, where
// lobes are seen at their peak and at their flanks.
inline std::vector<glm::vec3> lookupDirections(const EnvironmentSum& environment,
                                               std::uint32_t count) {
    std::vector<glm::vec3> result;
    for (std::uint32_t i = 0; i < count; ++i)
        result.push_back(uniformSphere(sobolOwen2D(i, 11)));
    const std::vector<glm::vec3>& texels = environment.base().texels;
    std::vector<std::size_t> order(texels.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    constexpr std::uint32_t kBrightest = 100;
    std::partial_sort(order.begin(), order.begin() + kBrightest, order.end(),
                      [&](std::size_t a, std::size_t b) {
                          return texels[a].x + texels[a].y + texels[a].z >
                                 texels[b].x + texels[b].y + texels[b].z;
                      });
    for (std::uint32_t i = 0; i < count; ++i) {
        const float spread =
            0.003f * std::pow(100.0f, (static_cast<float>(i) + 0.5f) / static_cast<float>(count));
        result.push_back(glm::normalize(environment.direction(order[i * 7 % kBrightest]) +
                                        spread * uniformSphere(sobolOwen2D(i, 12))));
    }
    return result;
}

// Of lookups in lookupDirections(), against the exact sums: differences of the channel that differs
// most over the brightest one, direction by direction.
struct LookupError {
    double rms = 0.0;  // over the sphere
    double most = 0.0; // anywhere
};
inline LookupError lookupError(std::span<const glm::vec3> seen, std::span<const glm::vec3> exact) {
    LookupError error;
    for (std::size_t i = 0; i < seen.size(); ++i) {
        const glm::vec3 off = glm::abs(seen[i] - exact[i]);
        const double one = static_cast<double>(std::max({off.x, off.y, off.z})) /
                           static_cast<double>(std::max({exact[i].x, exact[i].y, exact[i].z}));
        error.most = std::max(error.most, one);
        if (i < seen.size() / 2)
            error.rms += one * one;
    }
    error.rms = std::sqrt(error.rms / (static_cast<double>(seen.size()) / 2.0));
    return error;
}

struct NamedEnvironment {
    std::string name;
    ImagePtr image;
};
// A sky with its sun, a street at sunset and softboxes; or the files of PATINA_PREFILTER_HDR=a:b:c.
inline std::vector<NamedEnvironment> lookupEnvironments() {
    std::vector<NamedEnvironment> result;
    if (const char* list = std::getenv("PATINA_PREFILTER_HDR")) {
        WorkerClient worker;
        std::istringstream paths(list);
        for (std::string path; std::getline(paths, path, ':');) {
            const Result<LoadedImage> image = loadImage(worker, path);
            if (!image)
                throw std::runtime_error(image.error().text());
            result.push_back({std::filesystem::path(path).stem().string(),
                              std::make_shared<const Image>(convertImage(
                                  image->image(), PixelType::F32, ColorEncoding::Linear))});
        }
        return result;
    }
    Environment sky;
    sky.kind = EnvironmentKind::Sky;
    result.push_back({"sky", generateEnvironment(environmentRecipe(sky), kEnvironmentHeight)});
    for (const char* name : {"sunset", "studio"})
        result.push_back({name, *library::environment(name)});
    return result;
}

// Directions for each half of lookupDirections(); for files 600, or PATINA_PREFILTER_DIRECTIONS: on
// the edge of a lamp in a night square, where light grows by thousands within a texel, one
// direction errs by half, and of a few it would be the rms.
inline std::uint32_t lookupCount(std::uint32_t ofShipped) {
    if (const char* text = std::getenv("PATINA_PREFILTER_DIRECTIONS"))
        return static_cast<std::uint32_t>(std::max(1, std::atoi(text)));
    return std::getenv("PATINA_PREFILTER_HDR") ? 600 : ofShipped;
}

// The exact sums, roughness by roughness, for each direction.
inline std::vector<std::vector<glm::vec3>> exactSums(const EnvironmentSum& environment,
                                                     std::span<const glm::vec3> directions,
                                                     std::span<const float> roughness) {
    std::vector<std::vector<glm::vec3>> result(roughness.size(),
                                               std::vector<glm::vec3>(directions.size()));
    parallelFor({}, directions.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::vector<glm::vec3> sums = environment.at(directions[i], roughness);
            for (std::size_t r = 0; r < roughness.size(); ++r)
                result[r][i] = sums[r];
        }
    });
    return result;
}

} // namespace patina::reference
