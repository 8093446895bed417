// Spherical harmonics: what a frame pays when the light turns, and a bake for its basis.
#include "core/math/Sampling.h"
#include "core/math/ShRotation.h"

#include <array>
#include <benchmark/benchmark.h>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

using namespace patina;

namespace {

// The whole of it: the band matrices of a new rotation, and coloured coefficients turned by them.
void fullRotation(benchmark::State& state) {
    const auto order = static_cast<int>(state.range(0));
    std::vector<glm::vec3> in(static_cast<std::size_t>(shCount(order)), glm::vec3(0.3f, 0.5f, 1.f));
    std::vector<glm::vec3> out(in.size());
    std::array<glm::dmat3, 16> rotations;
    for (std::size_t i = 0; i < rotations.size(); ++i)
        rotations[i] = glm::dmat3(glm::rotate(glm::dmat4(1.0), 0.4 * static_cast<double>(i),
                                              glm::normalize(glm::dvec3(1.0, 2.0, 2.0))));
    std::size_t next = 0;
    for (auto _ : state) {
        ShRotation(rotations[next++ % rotations.size()], order)
            .apply(std::span<const glm::vec3>(in), out);
        benchmark::DoNotOptimize(out.data());
        benchmark::ClobberMemory();
    }
}
BENCHMARK(fullRotation)->Arg(3)->Arg(5)->Arg(6)->Arg(8);

std::vector<glm::vec3> directions() {
    std::vector<glm::vec3> result(1024);
    for (std::uint32_t i = 0; i < result.size(); ++i)
        result[i] = uniformSphere(sobolOwen2D(i, 1));
    return result;
}

void report(benchmark::State& state) {
    state.counters["per direction"] = benchmark::Counter(
        1024.0, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void basisOneByOne(benchmark::State& state) {
    const auto order = static_cast<int>(state.range(0));
    const std::vector<glm::vec3> from = directions();
    std::array<float, kMaxShOrder * kMaxShOrder> y{};
    for (auto _ : state)
        for (const glm::vec3& direction : from) {
            evaluateSh(order, direction, y);
            benchmark::DoNotOptimize(y);
        }
    report(state);
}
BENCHMARK(basisOneByOne)->Arg(3)->Arg(5)->Arg(6)->Arg(8);

void sumOverDirections(benchmark::State& state) {
    const auto order = static_cast<int>(state.range(0));
    const std::vector<glm::vec3> from = directions();
    std::array<float, kMaxShOrder * kMaxShOrder> sums{};
    for (auto _ : state) {
        sumSh(order, from, sums);
        benchmark::DoNotOptimize(sums);
    }
    report(state);
}
BENCHMARK(sumOverDirections)->Arg(3)->Arg(5)->Arg(6)->Arg(8);

} // namespace
