#include "core/light/PrefilterSums.h"

namespace patina::detail {

namespace {

// `lanes` floats that the compiler keeps in one register.
template <int lanes>
struct Simd {
    using Type [[gnu::vector_size(lanes * sizeof(float))]] = float;
    static constexpr int kGroups = kTileTexels / lanes;

    [[gnu::always_inline]] static Type load(const float* from) {
        Type value;
        __builtin_memcpy(&value, from, sizeof(value));
        return value;
    }
    [[gnu::always_inline]] static void add(float* to, Type value) {
        value += load(to);
        __builtin_memcpy(to, &value, sizeof(value));
    }
    [[gnu::always_inline]] static void store(float* to, Type value) {
        __builtin_memcpy(to, &value, sizeof(value));
    }
};

// max(c, 0) / ((1 + c)/2 (alpha² - 1) + 1)², c = N·L: D(h) N·L but for a constant. With
// t = |N - L|² / 4 = (1 - c) / 2 the bracket is t + alpha² (1 - t): no cancellation at the peak.
template <int lanes, typename V = typename Simd<lanes>::Type>
[[gnu::always_inline]] inline V kernel(const TileDirections& tile, int first, float x, float y,
                                       float z, float alpha2) {
    const V dx = Simd<lanes>::load(tile.x + first) - x;
    const V dy = Simd<lanes>::load(tile.y + first) - y;
    const V dz = Simd<lanes>::load(tile.z + first) - z;
    const V t = (dx * dx + dy * dy + dz * dz) * 0.25f;
    const V cosine = 1.0f - 2.0f * t;
    const V d = t + alpha2 * (1.0f - t);
    const V zero = {};
    return (cosine > zero ? cosine : zero) / (d * d);
}

template <int lanes>
[[gnu::always_inline]] inline void weigh(const TileDirections& tile,
                                         std::span<const glm::vec4> cells, float alpha2,
                                         CellWeights& weights, float* total) {
    for (int group = 0; group < Simd<lanes>::kGroups; ++group) {
        typename Simd<lanes>::Type sum = {};
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const glm::vec4& cell = cells[i];
            const auto weight =
                kernel<lanes>(tile, group * lanes, cell.x, cell.y, cell.z, alpha2) * cell.w;
            Simd<lanes>::store(weights.of[i] + group * lanes, weight);
            sum += weight;
        }
        Simd<lanes>::add(total + group * lanes, sum);
    }
}

// Four registers of texels by three colours: twelve accumulators that depend on nothing else.
template <int lanes>
[[gnu::always_inline]] inline void add(const CellWeights& weights, std::span<const int> index,
                                       const glm::vec4* radiance, TileSums& sums) {
    constexpr int kAtOnce = 4;
    for (int first = 0; first < kTileTexels; first += kAtOnce * lanes) {
        typename Simd<lanes>::Type red[kAtOnce] = {}, green[kAtOnce] = {}, blue[kAtOnce] = {};
        for (std::size_t i = 0; i < index.size(); ++i) {
            const glm::vec4& light = radiance[index[i]];
#pragma GCC unroll 4
            for (int k = 0; k < kAtOnce; ++k) {
                const auto weight = Simd<lanes>::load(weights.of[i] + first + k * lanes);
                red[k] += weight * light.x;
                green[k] += weight * light.y;
                blue[k] += weight * light.z;
            }
        }
        for (int k = 0; k < kAtOnce; ++k) {
            Simd<lanes>::add(sums.red + first + k * lanes, red[k]);
            Simd<lanes>::add(sums.green + first + k * lanes, green[k]);
            Simd<lanes>::add(sums.blue + first + k * lanes, blue[k]);
        }
    }
}

template <int lanes>
[[gnu::always_inline]] inline void addLamps(const TileDirections& tile,
                                            std::span<const CubePyramid::Lamp> lamps, float alpha2,
                                            TileSums& sums) {
    for (int first = 0; first < kTileTexels; first += lanes) {
        typename Simd<lanes>::Type red = {}, green = {}, blue = {};
        for (const CubePyramid::Lamp& lamp : lamps) {
            const auto weight = kernel<lanes>(tile, first, lamp.direction.x, lamp.direction.y,
                                              lamp.direction.z, alpha2);
            red += weight * lamp.flux.x;
            green += weight * lamp.flux.y;
            blue += weight * lamp.flux.z;
        }
        Simd<lanes>::add(sums.red + first, red);
        Simd<lanes>::add(sums.green + first, green);
        Simd<lanes>::add(sums.blue + first, blue);
    }
}

// ---- One set of functions for each kind of processor
// ---------------------------------------------

#define PT_SUMS(name, lanes, ...)                                                                  \
    __VA_ARGS__ void weigh##name(const TileDirections& tile, std::span<const glm::vec4> cells,     \
                                 float alpha2, CellWeights& weights, float* total) {               \
        weigh<lanes>(tile, cells, alpha2, weights, total);                                         \
    }                                                                                              \
    __VA_ARGS__ void add##name(const CellWeights& weights, std::span<const int> index,             \
                               const glm::vec4* radiance, TileSums& sums) {                        \
        add<lanes>(weights, index, radiance, sums);                                                \
    }                                                                                              \
    __VA_ARGS__ void addLamps##name(const TileDirections& tile,                                    \
                                    std::span<const CubePyramid::Lamp> lamps, float alpha2,        \
                                    TileSums& sums) {                                              \
        addLamps<lanes>(tile, lamps, alpha2, sums);                                                \
    }                                                                                              \
    constexpr PrefilterSums k##name = {weigh##name, add##name, addLamps##name};

PT_SUMS(Baseline, 4)
#if defined(__x86_64__)
PT_SUMS(Avx2, 8, [[gnu::target("avx2,fma")]])
PT_SUMS(Avx512, 16, [[gnu::target("avx512f")]])
#endif
#undef PT_SUMS

} // namespace

std::span<const PrefilterSums> prefilterSums() {
#if defined(__x86_64__)
    static constexpr PrefilterSums kAll[] = {kAvx512, kAvx2, kBaseline};
    if (__builtin_cpu_supports("avx512f"))
        return kAll;
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        return std::span(kAll).subspan(1);
    return std::span(kAll).subspan(2);
#else
    return std::span(&kBaseline, 1);
#endif
}

} // namespace patina::detail
