// Image-based light against the usual way to compute it, both single-threaded and on all cores: the
// whole of it (cube 256², all roughness levels, irradiance cube, SH, DFG table 128²) from the same
// picture. Process CPU time; the counters say how far each is from the exact sum over all texels.
//
// The yardstick is what Karis 2013 describes and Filament's cmgen does: importance sampling of the
// GGX lobe with 1024 samples a texel, which are computed once per level, and a trilinear lookup at
// the mip level that fits their density (Colbert & Krivanek 2007).
//
//   PATINA_BENCHMARK_HDR=a.hdr:b.hdr bench_ibl
//
// adds pictures to the built-in sky with a sun of 1e5; each is enlarged or reduced to 2048 × 1024.
#include "core/io/ImageIO.h"
#include "core/job/Parallel.h"
#include "core/light/CubeSampling.h"
#include "core/light/Cubemap.h"
#include "core/light/Ibl.h"
#include "core/light/Prefilter.h"
#include "core/math/Sampling.h"
#include "core/math/SphericalHarmonics.h"
#include "core/worker/WorkerClient.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <numbers>
#include <sstream>
#include <string>

namespace {

using namespace patina;

constexpr int kWidth = 2048, kCube = 256, kLevels = IblSettings().levels, kIrradiance = 32,
              kSamples = 1024;

// Of a face of a level, and its perceptual roughness: as computeIbl() makes them.
int sideOf(int level) {
    return levelSide(LevelSpacing::Lobes, level, kCube);
}
float roughnessOf(int level) {
    return levelRoughness(LevelSpacing::Lobes, level, kLevels, kCube);
}
// Narrower lobes see texels as more than points: no sum over points is exact.
constexpr float kExact = 0.1f;

// ---- Environments
// --------------------------------------------------------------------------------

Image sunnySky() {
    Image image(kWidth, kWidth / 2, 3, PixelType::F32, ColorEncoding::Linear);
    const glm::vec3 sun = glm::normalize(glm::vec3(0.4f, 0.5f, -0.3f));
    for (int y = 0; y < kWidth / 2; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const glm::vec3 d =
                shading::directionFromLatLong({(static_cast<float>(x) + 0.5f) / kWidth,
                                               (static_cast<float>(y) + 0.5f) / (kWidth / 2.0f)});
            const glm::vec3 radiance =
                glm::dot(d, sun) > 0.99998f ? glm::vec3(1e5f) : glm::vec3(0.4f + 0.3f * d.y);
            for (int c = 0; c < 3; ++c)
                image.f32()[(static_cast<std::size_t>(y) * kWidth + x) * 3 + c] = radiance[c];
        }
    return image;
}

// Bilinear; good enough to have pixels of one size.
Image resized(const Image& from) {
    Image to(kWidth, kWidth / 2, 3, PixelType::F32, ColorEncoding::Linear);
    const auto at = [&](int x, int y, int c) {
        x = (x + from.width()) % from.width();
        y = std::clamp(y, 0, from.height() - 1);
        return from.f32()[(static_cast<std::size_t>(y) * from.width() + x) * from.channels() + c];
    };
    for (int y = 0; y < to.height(); ++y)
        for (int x = 0; x < to.width(); ++x) {
            const float u = (static_cast<float>(x) + 0.5f) * static_cast<float>(from.width()) /
                                static_cast<float>(to.width()) -
                            0.5f;
            const float v = (static_cast<float>(y) + 0.5f) * static_cast<float>(from.height()) /
                                static_cast<float>(to.height()) -
                            0.5f;
            const int x0 = static_cast<int>(std::floor(u)), y0 = static_cast<int>(std::floor(v));
            const float fx = u - static_cast<float>(x0), fy = v - static_cast<float>(y0);
            for (int c = 0; c < 3; ++c)
                to.f32()[(static_cast<std::size_t>(y) * kWidth + x) * 3 + c] =
                    (at(x0, y0, c) * (1 - fx) + at(x0 + 1, y0, c) * fx) * (1 - fy) +
                    (at(x0, y0 + 1, c) * (1 - fx) + at(x0 + 1, y0 + 1, c) * fx) * fy;
        }
    return to;
}

// ---- The yardstick
// -------------------------------------------------------------------------------

struct Sample {
    glm::vec3 l; // around n = +Z
    float weight;
    float lod;
};

std::vector<Sample> lobeSamples(float alpha) {
    const float texelShare = 4.0f * shading::kPi / (6.0f * kCube * kCube);
    std::vector<Sample> samples;
    for (int s = 0; s < kSamples; ++s) {
        const glm::vec2 u = sobolOwen2D(static_cast<std::uint32_t>(s), 1);
        const float cos2 = (1.0f - u.x) / (1.0f + (alpha * alpha - 1.0f) * u.x);
        const float NoH = std::sqrt(cos2), sinH = std::sqrt(1.0f - cos2);
        const float phi = shading::kTwoPi * u.y;
        const glm::vec3 l(2.0f * NoH * sinH * std::cos(phi), 2.0f * NoH * sinH * std::sin(phi),
                          2.0f * cos2 - 1.0f);
        if (l.z <= 0.0f)
            continue;
        const float pdf = shading::D_GGX(NoH, alpha) * 0.25f;
        const float share = 4.0f / (kSamples * pdf); // four times a sample's: Filament's K = 4
        samples.push_back({l, l.z, std::max(0.5f * std::log2(share / texelShare), 0.0f)});
    }
    return samples;
}

using Mips = std::vector<CubeLevel>;

glm::vec3 bilinear(const CubeLevel& level, const CubePosition& at) {
    // Within the face, as cmgen does
    const auto n = static_cast<float>(level.size);
    const float x = std::clamp(at.s * n - 0.5f, 0.0f, n - 1.0f);
    const float y = std::clamp(at.t * n - 0.5f, 0.0f, n - 1.0f);
    const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
    const int x1 = std::min(x0 + 1, level.size - 1), y1 = std::min(y0 + 1, level.size - 1);
    const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
    const glm::vec3* face =
        level.texels.data() + static_cast<std::size_t>(at.face) * level.size * level.size;
    const auto texel = [&](int i, int j) { return face[j * level.size + i]; };
    return (texel(x0, y0) * (1 - fx) + texel(x1, y0) * fx) * (1 - fy) +
           (texel(x0, y1) * (1 - fx) + texel(x1, y1) * fx) * fy;
}

glm::vec3 texelDirection(int size, std::size_t i) {
    const auto side = static_cast<float>(size);
    const std::size_t n = static_cast<std::size_t>(size);
    return glm::normalize(cubeDirection(static_cast<int>(i / (n * n)),
                                        (static_cast<float>(i % n) + 0.5f) / side,
                                        (static_cast<float>(i / n % n) + 0.5f) / side));
}

CubeLevel importanceSampled(const Mips& mips, int size, float alpha) {
    const std::vector<Sample> samples = lobeSamples(alpha);
    CubeLevel out{size, std::vector<glm::vec3>(6u * size * size)};
    parallelFor({}, out.texels.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const glm::vec3 n = texelDirection(size, i);
            glm::vec3 t, b, sum(0.0f);
            orthonormalBasis(n, t, b);
            float weights = 0.0f;
            for (const Sample& sample : samples) {
                const CubePosition at =
                    cubePosition(t * sample.l.x + b * sample.l.y + n * sample.l.z);
                const float lod = std::min(sample.lod, static_cast<float>(mips.size() - 1));
                const auto fine = static_cast<std::size_t>(lod);
                const std::size_t coarse = std::min(fine + 1, mips.size() - 1);
                const float share = lod - static_cast<float>(fine);
                sum += (bilinear(mips[fine], at) * (1.0f - share) +
                        bilinear(mips[coarse], at) * share) *
                       sample.weight;
                weights += sample.weight;
            }
            out.texels[i] = sum / weights;
        }
    });
    return out;
}

// The table of Karis 2013 with Smith's G, 1024 samples an entry.
void sampledDfgTable() {
    std::vector<glm::vec2> points;
    for (int s = 0; s < kSamples; ++s)
        points.push_back(sobolOwen2D(static_cast<std::uint32_t>(s), 1));
    std::vector<glm::vec2> table(128u * 128);
    parallelFor({}, table.size(), 128, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const float NoV = (static_cast<float>(i % 128) + 0.5f) / 128.0f;
            const float r = (static_cast<float>(i / 128) + 0.5f) / 128.0f, alpha = r * r;
            const glm::vec3 v(std::sqrt(1.0f - NoV * NoV), 0.0f, NoV);
            glm::vec2 sum(0.0f);
            for (const glm::vec2& u : points) {
                const float cos2 = (1.0f - u.x) / (1.0f + (alpha * alpha - 1.0f) * u.x);
                const float NoH = std::sqrt(cos2), sinH = std::sqrt(1.0f - cos2);
                const float phi = shading::kTwoPi * u.y;
                const glm::vec3 h(sinH * std::cos(phi), sinH * std::sin(phi), NoH);
                const float VoH = std::max(glm::dot(v, h), 0.0f);
                const float NoL = 2.0f * VoH * NoH - NoV;
                if (NoL <= 0.0f)
                    continue;
                const float w = shading::V_SmithGGXCorrelated(NoV, NoL, alpha) * 4.0f * VoH * NoL /
                                std::max(NoH, 1e-6f);
                const float Fc = std::pow(1.0f - VoH, 5.0f);
                sum += glm::vec2(1.0f - Fc, Fc) * w;
            }
            table[i] = sum / static_cast<float>(kSamples);
        }
    });
    benchmark::DoNotOptimize(table.data());
}

IblMaps yardstick(const Image& environment) {
    IblMaps maps;
    benchmark::DoNotOptimize(projectLatLong(environment, 5).data());
    Mips mips{cubeFromLatLong(environment, kCube, {})};
    maps.prefiltered.push_back(mips.front());
    while (mips.back().size > 1)
        mips.push_back(halveCube(mips.back()));
    for (int i = 1; i < kLevels; ++i) {
        const float r = roughnessOf(i);
        maps.prefiltered.push_back(importanceSampled(mips, sideOf(i), r * r));
    }
    maps.irradiance = importanceSampled(mips, kIrradiance, 1.0f);
    for (glm::vec3& texel : maps.irradiance.texels)
        texel *= std::numbers::pi_v<float>;
    sampledDfgTable();
    return maps;
}

IblMaps ours(const Image& environment) {
    IblMaps maps = *computeIbl(
        environment, {.cubeSize = kCube, .levels = kLevels, .irradianceSize = kIrradiance}, {});
    benchmark::DoNotOptimize(computeDfgTable(128).width());
    return maps;
}

// ---- Truth
// ---------------------------------------------------------------------------------------

// Exact sums for some texels of every level, made once for an environment.
struct Truth {
    struct Level {
        int number = 0;
        std::vector<std::size_t> index;
        std::vector<glm::dvec3> radiance;
    };
    std::vector<Level> levels;
};

Truth exactSums(const Image& environment) {
    const CubeLevel base = cubeFromLatLong(environment, kCube, {});
    const std::vector<float> omega = cubeSolidAngles(kCube);
    std::vector<glm::vec4> cells;
    for (std::size_t i = 0; i < base.texels.size(); ++i)
        cells.emplace_back(texelDirection(kCube, i), omega[i % omega.size()]);
    Truth truth;
    for (int i = 1; i < kLevels; ++i) {
        const int size = sideOf(i);
        const double r = roughnessOf(i), a2 = std::pow(r, 4.0);
        if (roughnessOf(i) < kExact)
            continue;
        const std::size_t count = 6u * size * size,
                          step = std::max<std::size_t>(count / 200, 1) | 1u;
        Truth::Level& level = truth.levels.emplace_back();
        level.number = i;
        for (std::size_t k = 0; k < count; k += step)
            level.index.push_back(k);
        level.radiance.resize(level.index.size());
        parallelFor({}, level.index.size(), 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t k = begin; k < end; ++k) {
                const glm::dvec3 n(texelDirection(size, level.index[k]));
                glm::dvec3 sum(0.0);
                double weights = 0.0;
                for (std::size_t c = 0; c < cells.size(); ++c) {
                    const glm::dvec3 d = n - glm::dvec3(cells[c]);
                    const double t = 0.25 * glm::dot(d, d), cosine = 1.0 - 2.0 * t;
                    if (cosine <= 0.0)
                        continue;
                    const double b = t + a2 * (1.0 - t);
                    const double w = cosine * cells[c].w / (b * b);
                    sum += w * glm::dvec3(base.texels[c]);
                    weights += w;
                }
                level.radiance[k] = sum / weights;
            }
        });
    }
    return truth;
}

// Root mean square error of a level over its root mean square, in percent.
double errorPercent(const Truth::Level& truth, const CubeLevel& level) {
    double squares = 0.0, norm = 0.0;
    for (std::size_t k = 0; k < truth.index.size(); ++k) {
        const glm::dvec3 error = glm::dvec3(level.texels[truth.index[k]]) - truth.radiance[k];
        squares += glm::dot(error, error);
        norm += glm::dot(truth.radiance[k], truth.radiance[k]);
    }
    return 100.0 * std::sqrt(squares / norm);
}

// ---- The benchmarks
// ------------------------------------------------------------------------------

struct Environment {
    std::string name;
    Image image;
    std::unique_ptr<Truth> truth; // made when first asked for

    const Truth& exact() {
        if (!truth)
            truth = std::make_unique<Truth>(exactSums(image));
        return *truth;
    }
};

void measure(benchmark::State& state, Environment& environment, IblMaps (*compute)(const Image&),
             int threads) {
    IblMaps maps;
    {
        const ThreadLimit limit(threads);
        for (auto _ : state)
            maps = compute(environment.image);
    }
    const Truth& truth = environment.exact();
    for (const Truth::Level& level : truth.levels)
        state.counters["rmse" + std::to_string(level.number) + "%"] =
            errorPercent(level, maps.prefiltered[static_cast<std::size_t>(level.number)]);
}

void addEnvironment(std::string name, Image image) {
    auto environment =
        std::make_shared<Environment>(Environment{std::move(name), std::move(image), {}});
    for (const int threads : {1, 0})
        for (const bool isOurs : {true, false})
            benchmark::RegisterBenchmark((environment->name + (isOurs ? "/patina" : "/yardstick") +
                                          (threads == 1 ? "/one_thread" : "/all_threads"))
                                             .c_str(),
                                         [environment, isOurs, threads](benchmark::State& state) {
                                             measure(state, *environment, isOurs ? ours : yardstick,
                                                     threads);
                                         })
                ->Unit(benchmark::kMillisecond)
                ->MeasureProcessCPUTime()
                ->Iterations(isOurs ? 5 : 1);
}

// The steps of it, and the version that the editor shows first.
void addSteps() {
    const auto sky = std::make_shared<const Image>(sunnySky());
    const auto pyramid = std::make_shared<const CubePyramid>(cubeFromLatLong(*sky, kCube, {}));
    const auto add = [](const char* name, auto&& step) {
        benchmark::RegisterBenchmark(name,
                                     [step](benchmark::State& state) {
                                         for (auto _ : state)
                                             step();
                                     })
            ->Unit(benchmark::kMillisecond)
            ->MeasureProcessCPUTime();
    };
    add("step/harmonics", [sky] { benchmark::DoNotOptimize(projectLatLong(*sky, 5).data()); });
    add("step/cubemap", [sky] { benchmark::DoNotOptimize(cubeFromLatLong(*sky, kCube, {}).size); });
    add("step/prefilter_256", [pyramid] {
        benchmark::DoNotOptimize(prefilterGGX(*pyramid, 256, 0.009f, {0.25f, 0.25f}, {}).size);
    });
    add("step/prefilter_128", [pyramid] {
        benchmark::DoNotOptimize(
            prefilterGGX(*pyramid, 128, 1.0f / 36.0f, {0.09f, 0.063f}, {}).size);
    });
    add("step/prefilter_64", [pyramid] {
        benchmark::DoNotOptimize(prefilterGGX(*pyramid, 64, 1.0f / 9.0f, {}, {}).size);
    });
    add("step/irradiance", [pyramid] {
        benchmark::DoNotOptimize(prefilterGGX(*pyramid, kIrradiance, 1.0f, {}, {}).size);
    });
    add("step/dfg", [] { benchmark::DoNotOptimize(computeDfgTable(128).width()); });
    add("quick",
        [sky] { benchmark::DoNotOptimize(computeIbl(*sky, IblSettings::quick(), {}).ok()); });
}

} // namespace

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    addEnvironment("sun", sunnySky());
    if (const char* list = std::getenv("PATINA_BENCHMARK_HDR")) {
        WorkerClient worker;
        std::istringstream paths(list);
        for (std::string path; std::getline(paths, path, ':');) {
            const Result<LoadedImage> image = loadImage(worker, path);
            if (!image) {
                std::fprintf(stderr, "%s\n", image.error().text().c_str());
                return 1;
            }
            addEnvironment(
                std::filesystem::path(path).stem().string(),
                resized(convertImage(image->image(), PixelType::F32, ColorEncoding::Linear)));
        }
    }
    addSteps();
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
