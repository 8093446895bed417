#include "core/bake/bounce/BounceGather.h"

namespace patina::detail {
namespace {

template <std::size_t lanes>
struct Simd {
    typedef float Type __attribute__((vector_size(lanes * sizeof(float)))); // NOLINT: GCC's
    [[gnu::always_inline]] static inline Type load(const float* from) {
        Type value;
        __builtin_memcpy(&value, from, sizeof(Type));
        return value;
    }
    [[gnu::always_inline]] static inline void store(float* to, const Type& value) {
        __builtin_memcpy(to, &value, sizeof(Type));
    }
};

template <std::size_t lanes, std::size_t vectors>
[[gnu::always_inline]] inline void colored(std::span<const GatherHit> hits, const float* rows,
                                           float* sums) {
    using S = Simd<lanes>;
    constexpr std::size_t row = lanes * vectors;
    typename S::Type sum[vectors] = {};
    for (const GatherHit& hit : hits) {
        const float* a = rows + std::size_t{hit.corners[0]} * row;
        const float* b = rows + std::size_t{hit.corners[1]} * row;
        const float* c = rows + std::size_t{hit.corners[2]} * row;
        const float wa = hit.weights[0], wb = hit.weights[1], wc = hit.weights[2];
        // The pattern repeats after three vectors of 4 as of 8.
        typename S::Type albedo[3];
        for (std::size_t i = 0; i < 3; ++i)
            albedo[i] = S::load(hit.albedo->values.data() + i * lanes);
#pragma GCC unroll 12
        for (std::size_t i = 0; i < vectors; ++i)
            sum[i] += albedo[i % 3] * (wa * S::load(a + i * lanes) + wb * S::load(b + i * lanes) +
                                       wc * S::load(c + i * lanes));
    }
#pragma GCC unroll 12
    for (std::size_t i = 0; i < vectors; ++i)
        S::store(sums + i * lanes, sum[i]);
}

template <std::size_t lanes, std::size_t vectors>
[[gnu::always_inline]] inline void grey(std::span<const GatherHit> hits, const float* rows,
                                        std::size_t coefficients, float* sums) {
    using S = Simd<lanes>;
    constexpr std::size_t row = lanes * vectors;
    typename S::Type sum[3][vectors] = {};
    for (const GatherHit& hit : hits) {
        const float* a = rows + std::size_t{hit.corners[0]} * row;
        const float* b = rows + std::size_t{hit.corners[1]} * row;
        const float* c = rows + std::size_t{hit.corners[2]} * row;
        const float wa = hit.weights[0], wb = hit.weights[1], wc = hit.weights[2];
#pragma GCC unroll 4
        for (std::size_t i = 0; i < vectors; ++i) {
            const auto value = wa * S::load(a + i * lanes) + wb * S::load(b + i * lanes) +
                               wc * S::load(c + i * lanes);
            sum[0][i] += hit.albedo->values[0] * value;
            sum[1][i] += hit.albedo->values[1] * value;
            sum[2][i] += hit.albedo->values[2] * value;
        }
    }
    float planes[3][row];
    for (std::size_t channel = 0; channel < 3; ++channel)
        for (std::size_t i = 0; i < vectors; ++i)
            S::store(planes[channel] + i * lanes, sum[channel][i]);
    for (std::size_t i = 0; i < coefficients; ++i)
        for (std::size_t channel = 0; channel < 3; ++channel)
            sums[3 * i + channel] = planes[channel][i];
}

// Rows as gatherRow() has them.
template <std::size_t lanes>
[[gnu::always_inline]] inline void coloredRows(std::span<const GatherHit> hits, const float* rows,
                                               std::size_t coefficients, float* sums) {
    constexpr std::size_t step = 8 / lanes;
    switch (gatherRow(3 * coefficients)) {
    case 4:
        return colored<4, 1>(hits, rows, sums);
    case 8:
        return colored<lanes, step>(hits, rows, sums);
    case 16:
        return colored<lanes, 2 * step>(hits, rows, sums);
    case 24:
        return colored<lanes, 3 * step>(hits, rows, sums);
    case 32:
        return colored<lanes, 4 * step>(hits, rows, sums);
    case 40:
        return colored<lanes, 5 * step>(hits, rows, sums);
    default:
        return colored<lanes, 6 * step>(hits, rows, sums);
    }
}

template <std::size_t lanes>
[[gnu::always_inline]] inline void greyRows(std::span<const GatherHit> hits, const float* rows,
                                            std::size_t coefficients, float* sums) {
    constexpr std::size_t step = 8 / lanes;
    switch (gatherRow(coefficients)) {
    case 4:
        return grey<4, 1>(hits, rows, coefficients, sums);
    case 8:
        return grey<lanes, step>(hits, rows, coefficients, sums);
    default:
        return grey<lanes, 2 * step>(hits, rows, coefficients, sums);
    }
}

#define PT_GATHER(name, lanes, ...)                                                                \
    __VA_ARGS__ void colored##name(std::span<const GatherHit> hits, const float* rows,             \
                                   std::size_t coefficients, float* sums) {                        \
        coloredRows<lanes>(hits, rows, coefficients, sums);                                        \
    }                                                                                              \
    __VA_ARGS__ void grey##name(std::span<const GatherHit> hits, const float* rows,                \
                                std::size_t coefficients, float* sums) {                           \
        greyRows<lanes>(hits, rows, coefficients, sums);                                           \
    }                                                                                              \
    constexpr BounceGather k##name = {colored##name, grey##name};

PT_GATHER(Baseline, 4)
#if defined(__x86_64__)
PT_GATHER(Avx2, 8, [[gnu::target("avx2")]])
#endif
#undef PT_GATHER

} // namespace

std::span<const BounceGather> bounceGathers() {
#if defined(__x86_64__)
    static constexpr BounceGather kAll[] = {kAvx2, kBaseline};
    return std::span(kAll).subspan(__builtin_cpu_supports("avx2") ? 0 : 1);
#else
    return std::span(&kBaseline, 1);
#endif
}

} // namespace patina::detail
