// The innermost loop of bounces: what the hits of one element find in the rows of numbers of all
// elements, in the widest instructions of the machine. (core/bake/bounce/BounceSolver.cpp uses it.)
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

namespace patina::detail {

// Red, green, blue, red …: to multiply numbers that come as RGB triples, whatever the width of an
// instruction.
struct AlbedoPattern {
    alignas(32) std::array<float, 24> values{};
    AlbedoPattern() = default;
    explicit AlbedoPattern(const glm::vec3& rho)
        : values{rho.r, rho.g, rho.b, rho.r, rho.g, rho.b, rho.r, rho.g,
                 rho.b, rho.r, rho.g, rho.b, rho.r, rho.g, rho.b, rho.r,
                 rho.g, rho.b, rho.r, rho.g, rho.b, rho.r, rho.g, rho.b} {}
};

struct GatherHit {
    std::uint32_t corners[3] = {}; // rows
    float weights[3] = {};
    const AlbedoPattern* albedo = nullptr;
};

// Numbers of a row of `count`: padded so that every instruction is a whole one. count <= 48.
[[nodiscard]] constexpr std::size_t gatherRow(std::size_t count) {
    return count <= 4 ? 4 : (count + 7) / 8 * 8;
}
inline constexpr std::size_t kMaxGatherCoefficients = 16;

// `sums` gets Σ_h albedo_h Σ_k weight_hk row(corner_hk). Every set comes to the same bits: no
// multiplication is fused with an addition.
struct BounceGather {
    // Rows of RGB triples, `coefficients` of them; sums: gatherRow(3 coefficients).
    void (*colored)(std::span<const GatherHit> hits, const float* rows, std::size_t coefficients,
                    float* sums);
    // Rows that are the same for red, green and blue, gatherRow(coefficients) numbers each: what
    // is interpolated is so once. The same sums, as RGB triples.
    void (*grey)(std::span<const GatherHit> hits, const float* rows, std::size_t coefficients,
                 float* sums);
};

// Those that this machine can run, the fastest first.
[[nodiscard]] std::span<const BounceGather> bounceGathers();

} // namespace patina::detail
