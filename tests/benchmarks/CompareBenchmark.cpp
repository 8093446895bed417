// What comparing two pictures costs: FLIP and SSIM of a whole frame.
#include "core/compare/Flip.h"
#include "core/compare/Metrics.h"
#include "core/compare/Ssim.h"

#include <benchmark/benchmark.h>
#include <cmath>

using namespace patina;

namespace {

constexpr int kWidth = 1920, kHeight = 1080;

// Smooth and fine detail over some stops of light, different everywhere.
Image frame(float phase, bool hdr) {
    Image image(kWidth, kHeight, 3, PixelType::F32, ColorEncoding::Linear);
    std::size_t i = 0;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            for (int c = 0; c < 3; ++c) {
                const float s = 0.01f * static_cast<float>(x) + phase,
                            t = 0.013f * static_cast<float>(y);
                const float detail = std::sin(40.0f * s) * std::cos(35.0f * t);
                image.f32()[i++] = std::exp2(3.0f * std::sin(s + t) - 1.0f) *
                                   (0.6f + 0.3f * detail + 0.05f * static_cast<float>(c));
            }
    return hdr ? image : convertImage(image, PixelType::U8, ColorEncoding::Srgb);
}

void flip(benchmark::State& state) {
    const bool hdr = state.range(0) != 0;
    const Image image = frame(0.0f, hdr), reference = frame(0.02f, hdr);
    double score = 0, exposures = 1;
    for (auto _ : state) {
        const Result<Flip> result = computeFlip(image, reference, JobContext());
        score = result->error.summary.mean;
        exposures = result->exposures ? result->exposures->count : 1;
    }
    state.counters["flip"] = score;
    state.counters["exposures"] = exposures;
}
// 0: LDR, 1: HDR. Processor time of all threads.
BENCHMARK(flip)->ArgName("hdr")->Arg(0)->Arg(1)->MeasureProcessCPUTime()->Unit(
    benchmark::kMillisecond);

void ssim(benchmark::State& state) {
    const Image image = frame(0.0f, false), reference = frame(0.02f, false);
    for (auto _ : state)
        benchmark::DoNotOptimize(computeSsim(image, reference, JobContext())->mean);
}
BENCHMARK(ssim)->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);

void metrics(benchmark::State& state) {
    const Image image = frame(0.0f, false), reference = frame(0.02f, false);
    for (auto _ : state)
        benchmark::DoNotOptimize(compareImages(image, reference)->rmse);
}
BENCHMARK(metrics)->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);

} // namespace
