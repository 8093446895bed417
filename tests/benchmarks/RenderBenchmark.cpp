// Frame time of the built-in start scene at 1280 × 720 on whatever draws here (llvmpipe without a
// GPU), with and without image-based light, multisampling and overlays.
#include "core/document/Scene.h"
#include "core/math/Camera.h"
#include "render/Renderer.h"
#include "render/scene/EnvironmentLight.h"

#include <benchmark/benchmark.h>
#include <memory>

namespace patina::render {
namespace {

struct Stage {
    std::unique_ptr<gl::Context> context;
    std::unique_ptr<Renderer> renderer;
    Document document;
};

// Null when there is no OpenGL.
std::unique_ptr<Stage> makeStage(bool withIbl) {
    auto stage = std::make_unique<Stage>();
    auto context = gl::Context::createHeadless();
    if (!context)
        return nullptr;
    stage->context = std::move(*context);
    auto renderer = Renderer::create(*stage->context);
    if (!renderer)
        return nullptr;
    stage->renderer = std::move(*renderer);
    stage->document = startDocument();
    stage->renderer->setDocument(stage->document, Change::everything());
    if (withIbl && stage->document.environment.image) {
        const auto maps = computeIbl(*stage->document.environment.image, {}, JobContext());
        if (!maps)
            return nullptr;
        stage->renderer->setIbl(*maps);
    } else {
        stage->renderer->setIbl(uniformIbl(glm::vec3(0.5f)));
    }
    return stage;
}

void drawFrames(benchmark::State& state, bool withIbl, int samples, bool overlays) {
    const auto stage = makeStage(withIbl);
    if (!stage) {
        state.SkipWithError("no OpenGL 4.5");
        return;
    }
    FrameSettings frame;
    frame.width = 1280;
    frame.height = 720;
    frame.samples = samples;
    frame.camera =
        frameBounds(stage->document.view.camera, stage->document.bounds(), 1280.0f / 720.0f);
    frame.showOverlays = overlays;
    for (auto _ : state) {
        if (!stage->renderer->render(frame, 0))
            state.SkipWithError("rendering failed");
        benchmark::DoNotOptimize(stage->renderer->pick(0, 0)); // waits for the frame
    }
    state.SetLabel(stage->context->info().renderer);
}

BENCHMARK_CAPTURE(drawFrames, uniform_light_1x, false, 1, false)
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(drawFrames, ibl_1x, true, 1, false)
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(drawFrames, ibl_4x, true, 4, false)
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(drawFrames, ibl_4x_overlays, true, 4, true)
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);

// What a new environment costs the thread that draws: the light, and a 2048 × 1024 background. Must
// stay below 100 ms, or a frame stalls.
void uploadLight(benchmark::State& state) {
    const auto stage = makeStage(false);
    if (!stage) {
        state.SkipWithError("no OpenGL 4.5");
        return;
    }
    const auto maps = computeIbl(*stage->document.environment.image, {}, JobContext());
    EnvironmentLight light(*stage->context);
    for (auto _ : state) {
        light.setIbl(*maps);
        benchmark::DoNotOptimize(light.dfg().readFloats(1)); // waits for the driver
    }
}
BENCHMARK(uploadLight)->Unit(benchmark::kMillisecond)->UseRealTime();

void uploadBackground(benchmark::State& state) {
    const auto stage = makeStage(false);
    if (!stage) {
        state.SkipWithError("no OpenGL 4.5");
        return;
    }
    EnvironmentLight light(*stage->context);
    const auto image =
        std::make_shared<const Image>(Image(2048, 1024, 3, PixelType::F32, ColorEncoding::Linear));
    for (auto _ : state) {
        light.setBackground(nullptr);
        light.setBackground(image);
        benchmark::DoNotOptimize(light.dfg().readFloats(1));
    }
}
BENCHMARK(uploadBackground)->Unit(benchmark::kMillisecond)->UseRealTime();

} // namespace
} // namespace patina::render
