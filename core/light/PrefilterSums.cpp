#include "core/light/PrefilterSums.h"

#include <cmath>
#include <numbers>

namespace patina::detail {

namespace {

constexpr float kInvPi = std::numbers::inv_pi_v<float>;

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

template <class V>
[[gnu::always_inline]] inline V squareRoot(V value) {
    constexpr int kLanes = sizeof(V) / sizeof(float);
    for (int i = 0; i < kLanes; ++i) // one instruction, vectorised
        value[i] = std::sqrt(value[i]);
    return value;
}

// The lobe D(h) N·L, but for a constant, is c / s² with c = N·L and s = (1 + c)/2 (alpha² - 1) + 1.
// With d = |N - L|² = 2 (1 - c), s is alpha² + (1 - alpha²) d / 4: no cancellation at the peak.
template <int lanes>
struct Lobe {
    using V = typename Simd<lanes>::Type;
    V c, inverse; // 1 / s

    [[gnu::always_inline]] Lobe(const TileDirections& tile, int first, float x, float y, float z,
                                float alpha2) {
        const V dx = Simd<lanes>::load(tile.x + first) - x;
        const V dy = Simd<lanes>::load(tile.y + first) - y;
        const V dz = Simd<lanes>::load(tile.z + first) - z;
        const V d = dx * dx + dy * dy + dz * dz;
        c = 1.0f - 0.5f * d;
        inverse = 1.0f / (alpha2 + (0.25f - 0.25f * alpha2) * d);
    }
    [[gnu::always_inline]] V value() const {
        const V zero = {};
        return (c > zero ? c : zero) * (inverse * inverse);
    }
    // The mean over a disc, in closed form on the plane: of 1 / (a² + x²)² over a disc of radius ρ
    // at distance x it is 2 / (R (R + X)), X = a² + x² - ρ², R² = X² + 4 a² ρ²; here
    // X = s - t, R² = X² + 4 alpha² t with t = (1 - alpha²) ρ² / 4, ρ² = solid angle / pi.
    [[gnu::always_inline]] V discMean(float solidAngle, float alpha2) const {
        const V zero = {};
        const float t = (0.25f - 0.25f * alpha2) * solidAngle * kInvPi;
        const V x = 1.0f / inverse - t, r = squareRoot(x * x + 4.0f * alpha2 * t);
        return (c > zero ? c : zero) * (2.0f / (r * (r + x)));
    }
    // Its Laplacian on the sphere, (1 - c²) f'' - 2c f' with ' = d/dc, times s²; b = 1 - alpha².
    [[gnu::always_inline]] V laplacian(float b) const {
        const V c2 = c * c;
        return inverse * b * (2.0f - 4.0f * c2 + 1.5f * b * inverse * (c - c * c2)) - 2.0f * c;
    }
};

// A cell weighs what the lobe is on average over it, to fourth order in its width: to the value in
// the middle comes half the second moment of the area along an axis, `spread` times its solid
// angle, times the Laplacian. Cells across the horizon have the mean of max(c, 0), (c + h)² / 4h,
// where they reach h to either side.
template <int lanes>
[[gnu::always_inline]] inline void
weigh(const TileDirections& tile, std::span<const glm::vec4> cells, float spread,
      const LobeShape& shape, CellWeights& weights, float* total) {
    using V = typename Simd<lanes>::Type;
    constexpr int kGroups = Simd<lanes>::kGroups;
    const V zero = {};
    const float alpha2 = shape.alpha2;
    V sum[kGroups] = {};
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const glm::vec4& cell = cells[i];
        const float moment = spread * cell.w, h = std::sqrt(6.0f * moment);
        const float overFourH = spread > 0.0f ? 0.25f / h : 0.0f;
#pragma GCC unroll 16
        for (int group = 0; group < kGroups; ++group) {
            const Lobe<lanes> lobe(tile, group * lanes, cell.x, cell.y, cell.z, alpha2);
            V weight;
            if (spread > 0.0f) {
                const V above = lobe.c > zero ? lobe.c : zero;
                const V reach = h + lobe.c - 2.0f * above; // h - |c|
                const V inside = reach > zero ? reach : zero;
                const V smooth = moment * lobe.laplacian(1.0f - alpha2);
                weight = (above + inside * inside * overFourH + (lobe.c > zero ? smooth : zero)) *
                         (lobe.inverse * lobe.inverse);
            } else
                weight = shape.discs ? lobe.discMean(cell.w, alpha2) : lobe.value();
            weight *= cell.w;
            Simd<lanes>::store(weights.of[i] + group * lanes, weight);
            sum[group] += weight;
        }
    }
    for (int group = 0; group < kGroups; ++group)
        Simd<lanes>::add(total + group * lanes, sum[group]);
}

// Four registers of texels by three colours: twelve accumulators that depend on nothing else.
template <int lanes>
[[gnu::always_inline]] inline void add(const CellWeights& weights, const CellPlaces& places,
                                       const glm::vec4* radiance, TileSums& sums) {
    constexpr int kAtOnce = 4;
    const std::size_t count = places.x.size();
    alignas(64) int index[kChunk];
    for (std::size_t i = 0; i < count; ++i)
        index[i] = places.first + places.alongX * places.x[i] + places.alongY * places.y[i];
    for (int first = 0; first < kTileTexels; first += kAtOnce * lanes) {
        typename Simd<lanes>::Type red[kAtOnce] = {}, green[kAtOnce] = {}, blue[kAtOnce] = {};
        for (std::size_t i = 0; i < count; ++i) {
            const glm::vec4& light = radiance[index[i]];
#pragma GCC unroll 4
            for (int k = 0; k < kAtOnce; ++k) {
                auto weight = Simd<lanes>::load(weights.of[i] + first + k * lanes);
#if defined(__x86_64__) && !defined(__clang__) // clang-tidy refuses the constraint outside of
                                               // functions for AVX-512
                // Keeps it in a register where there are enough: the compiler would rather load it
                // three times, and loads are what limits this loop.
                if constexpr (lanes == 16)
                    asm("" : "+v"(weight));
#endif
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
[[gnu::always_inline]] inline void addBrightTexels(const TileDirections& tile,
                                                   std::span<const CubePyramid::BrightTexel> bright,
                                                   const LobeShape& shape, TileSums& sums) {
    for (int first = 0; first < kTileTexels; first += lanes) {
        typename Simd<lanes>::Type red = {}, green = {}, blue = {};
        for (const CubePyramid::BrightTexel& texel : bright) {
            const Lobe<lanes> lobe(tile, first, texel.direction.x, texel.direction.y,
                                   texel.direction.z, shape.alpha2);
            const auto weight =
                shape.discs ? lobe.discMean(texel.solidAngle, shape.alpha2) : lobe.value();
            red += weight * texel.flux.x;
            green += weight * texel.flux.y;
            blue += weight * texel.flux.z;
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
                                 float spread, const LobeShape& shape, CellWeights& weights,       \
                                 float* total) {                                                   \
        weigh<lanes>(tile, cells, spread, shape, weights, total);                                  \
    }                                                                                              \
    __VA_ARGS__ void add##name(const CellWeights& weights, const CellPlaces& places,               \
                               const glm::vec4* radiance, TileSums& sums) {                        \
        add<lanes>(weights, places, radiance, sums);                                               \
    }                                                                                              \
    __VA_ARGS__ void addBrightTexels##name(const TileDirections& tile,                             \
                                           std::span<const CubePyramid::BrightTexel> bright,       \
                                           const LobeShape& shape, TileSums& sums) {               \
        addBrightTexels<lanes>(tile, bright, shape, sums);                                         \
    }                                                                                              \
    constexpr PrefilterSums k##name = {weigh##name, add##name, addBrightTexels##name};

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
