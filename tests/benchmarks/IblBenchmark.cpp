// Image-based light against the usual way to compute it: importance sampling of the GGX lobe with
// 1024 samples that read a mip level matching their density (Karis 2013; Colbert & Krivanek 2007).
#include "core/job/Parallel.h"
#include "core/light/Cubemap.h"
#include "core/light/Ibl.h"
#include "core/light/Prefilter.h"
#include "core/math/Sampling.h"

#include <benchmark/benchmark.h>

#include <cmath>

namespace {

using namespace patina;

Image sunnySky(int width) {
    const int height = width / 2;
    Image image(width, height, 3, PixelType::F32, ColorEncoding::Linear);
    const glm::vec3 sun = glm::normalize(glm::vec3(0.4f, 0.5f, -0.3f));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::vec3 d = shading::directionFromLatLong(
                {(static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                 (static_cast<float>(y) + 0.5f) / static_cast<float>(height)});
            const glm::vec3 radiance =
                glm::dot(d, sun) > 0.99998f ? glm::vec3(1e5f) : glm::vec3(0.4f + 0.3f * d.y);
            for (int c = 0; c < 3; ++c)
                image.f32()[(static_cast<std::size_t>(y) * width + x) * 3 + c] = radiance[c];
        }
    return image;
}

// The yardstick: nearest texel of the level whose texels are about four times a sample's share.
CubeLevel importanceSampled(const CubePyramid& pyramid, int size, float alpha, int samples) {
    CubeLevel out;
    out.size = size;
    out.texels.resize(6 * static_cast<std::size_t>(size) * size);
    const auto& levels = pyramid.levels();
    const float texelShare =
        4.0f * shading::kPi /
        (6.0f * static_cast<float>(levels[0].radiance.size * levels[0].radiance.size));
    const auto side = static_cast<float>(size);
    parallelFor({}, out.texels.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const int face = static_cast<int>(i) / (size * size);
            const glm::vec3 n =
                glm::normalize(cubeDirection(face, (static_cast<float>(i % size) + 0.5f) / side,
                                             (static_cast<float>(i / size % size) + 0.5f) / side));
            glm::vec3 t, b, sum(0.0f);
            orthonormalBasis(n, t, b);
            float weights = 0.0f;
            for (int s = 0; s < samples; ++s) {
                const glm::vec2 u = sobolOwen2D(static_cast<std::uint32_t>(s), 1);
                const float cos2 = (1.0f - u.x) / (1.0f + (alpha * alpha - 1.0f) * u.x);
                const float NoH = std::sqrt(cos2), sinH = std::sqrt(1.0f - cos2);
                const float phi = shading::kTwoPi * u.y;
                const glm::vec3 h =
                    t * (sinH * std::cos(phi)) + b * (sinH * std::sin(phi)) + n * NoH;
                const glm::vec3 l = 2.0f * NoH * h - n;
                const float NoL = glm::dot(n, l);
                if (NoL <= 0.0f)
                    continue;
                const float pdf = shading::D_GGX(NoH, alpha) * 0.25f;
                const float share = 4.0f / (static_cast<float>(samples) * pdf);
                const float lod = std::max(0.5f * std::log2(share / texelShare), 0.0f);
                const CubeLevel& level =
                    levels[std::min(static_cast<std::size_t>(lod + 0.5f), levels.size() - 1)]
                        .radiance;
                const CubePosition at = cubePosition(l);
                const auto n0 = static_cast<float>(level.size);
                const int x = std::min(static_cast<int>(at.s * n0), level.size - 1);
                const int y = std::min(static_cast<int>(at.t * n0), level.size - 1);
                sum +=
                    NoL *
                    level.texels[(static_cast<std::size_t>(at.face) * level.size + y) * level.size +
                                 x];
                weights += NoL;
            }
            out.texels[i] = sum / weights;
        }
    });
    return out;
}

void ibl(benchmark::State& state) {
    const Image sky = sunnySky(1024);
    const auto size = static_cast<int>(state.range(0));
    const IblSettings settings = size == 128 ? IblSettings::quick() : IblSettings{size, 7};
    for (auto _ : state)
        benchmark::DoNotOptimize(computeIbl(sky, settings, {}).ok());
}
BENCHMARK(ibl)->Arg(128)->Arg(256)->Unit(benchmark::kMillisecond)->UseRealTime();

void cubemap(benchmark::State& state) {
    const Image sky = sunnySky(1024);
    for (auto _ : state)
        benchmark::DoNotOptimize(cubeFromLatLong(sky, static_cast<int>(state.range(0)), {}).size);
}
BENCHMARK(cubemap)->Arg(128)->Arg(256)->Unit(benchmark::kMillisecond)->UseRealTime();

// One 32² level of roughness 0.5 of a 128² cube, both ways.
void prefilterCells(benchmark::State& state) {
    const CubePyramid pyramid(cubeFromLatLong(sunnySky(1024), 128, {}));
    for (auto _ : state)
        benchmark::DoNotOptimize(prefilterGGX(pyramid, 32, 0.25f, {}, {}).size);
}
BENCHMARK(prefilterCells)->Unit(benchmark::kMillisecond)->UseRealTime();

void prefilterImportanceSampling1024(benchmark::State& state) {
    const CubePyramid pyramid(cubeFromLatLong(sunnySky(1024), 128, {}));
    for (auto _ : state)
        benchmark::DoNotOptimize(importanceSampled(pyramid, 32, 0.25f, 1024).size);
}
BENCHMARK(prefilterImportanceSampling1024)->Unit(benchmark::kMillisecond)->UseRealTime();

void dfgTable(benchmark::State& state) {
    for (auto _ : state)
        benchmark::DoNotOptimize(computeDfgTable(128).width());
}
BENCHMARK(dfgTable)->Unit(benchmark::kMillisecond)->UseRealTime();

} // namespace
