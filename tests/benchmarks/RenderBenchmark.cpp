// Frame time of the built-in start scene at 1280 × 720 on whatever draws here (llvmpipe without a
// GPU), with and without image-based light, multisampling and overlays.
#include "core/document/ViewChoices.h"
#include "core/math/Camera.h"
#include "core/scene/Scene.h"
#include "render/SceneRenderer.h"
#include "render/ViewRenderer.h"
#include "render/scene/DfgTextures.h"
#include "render/scene/EnvironmentLight.h"
#include "render/scene/TextureCache.h"

#include <benchmark/benchmark.h>
#include <chrono>
#include <ctime>
#include <epoxy/gl.h>
#include <memory>

namespace patina::render {
namespace {

struct Stage {
    std::unique_ptr<gl::Context> context;
    std::unique_ptr<SceneRenderer> scene;
    std::unique_ptr<ViewRenderer> renderer;
    Document document;
};

// Null when there is no OpenGL.
std::unique_ptr<Stage> makeStage(bool withIbl) {
    auto stage = std::make_unique<Stage>();
    auto context = gl::Context::createHeadless();
    if (!context)
        return nullptr;
    stage->context = std::move(*context);
    auto scene = SceneRenderer::create(*stage->context);
    if (!scene)
        return nullptr;
    stage->scene = std::move(*scene);
    stage->renderer = std::make_unique<ViewRenderer>(*stage->scene);
    stage->document = startDocument();
    stage->scene->setDocument(stage->document);
    if (withIbl && stage->document.environment().image) {
        const auto maps = computeIbl(*stage->document.environment().image, {}, JobContext());
        if (!maps)
            return nullptr;
        const ImagePtr& image = stage->document.environment().image;
        stage->scene->setEnvironment(std::make_shared<const EnvironmentTexels>(
            makeEnvironmentTexels(image, *maps, *makeBackground(*image, JobContext()))));
    } else {
        stage->scene->setIbl(uniformIbl(glm::vec3(0.5f)));
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

// Two views over one scene, each with its camera, lighting and target: what both cost drawn in
// turns over the sum of each drawn alone. An iteration is all three; milliseconds of all threads.
void twoViews(benchmark::State& state) {
    const auto stage = makeStage(true);
    if (!stage) {
        state.SkipWithError("no OpenGL 4.5");
        return;
    }
    FrameSettings left;
    left.width = 640;
    left.height = 720;
    left.samples = 1;
    left.camera =
        frameBounds(stage->document.view.camera, stage->document.bounds(), 640.0f / 720.0f);
    FrameSettings right = left;
    right.camera.yawDeg += 60.0f;
    right.look = stage->document.view;
    right.look->background = BackgroundMode::Blurred;
    ViewRenderer second(*stage->scene);
    const auto draw = [&](ViewRenderer& view, const FrameSettings& frame) {
        timespec begin{}, end{};
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &begin);
        if (!view.render(frame, 0))
            state.SkipWithError("rendering failed");
        benchmark::DoNotOptimize(view.pick(0, 0)); // waits for the frame
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &end);
        return 1e3 * static_cast<double>(end.tv_sec - begin.tv_sec) +
               1e-6 * static_cast<double>(end.tv_nsec - begin.tv_nsec);
    };
    constexpr int kFrames = 5;
    double leftMs = 0.0, rightMs = 0.0, bothMs = 0.0;
    for (auto _ : state) {
        draw(*stage->renderer, left); // what was drawn last was another
        for (int i = 0; i < kFrames; ++i)
            leftMs += draw(*stage->renderer, left);
        draw(second, right);
        for (int i = 0; i < kFrames; ++i)
            rightMs += draw(second, right);
        for (int i = 0; i < kFrames; ++i) {
            bothMs += draw(*stage->renderer, left);
            bothMs += draw(second, right);
        }
    }
    const double frames = kFrames * static_cast<double>(state.iterations());
    state.counters["left_ms"] = leftMs / frames;
    state.counters["right_ms"] = rightMs / frames;
    state.counters["both_ms"] = bothMs / frames;
    state.counters["both_over_sum"] = bothMs / (leftMs + rightMs);
}
BENCHMARK(twoViews)->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond)->Iterations(10);

// What looking at one pixel costs: which mesh lies there, and every number of the equation.
void lookAtPixel(benchmark::State& state, bool everything) {
    const auto stage = makeStage(true);
    if (!stage) {
        state.SkipWithError("no OpenGL 4.5");
        return;
    }
    FrameSettings frame;
    frame.width = 1280;
    frame.height = 720;
    frame.camera =
        frameBounds(stage->document.view.camera, stage->document.bounds(), 1280.0f / 720.0f);
    if (!stage->renderer->render(frame, 0))
        state.SkipWithError("rendering failed");
    const auto look = [&] {
        if (everything)
            benchmark::DoNotOptimize(stage->renderer->inspect(640, 360).ok());
        else
            benchmark::DoNotOptimize(stage->renderer->pick(640, 360));
    };
    // The first time at a material the driver compiles a program.
    const auto begin = std::chrono::steady_clock::now();
    look();
    state.counters["first_ms"] =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    for (auto _ : state)
        look();
}
BENCHMARK_CAPTURE(lookAtPixel, pick, false)->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(lookAtPixel, inspect, true)
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);

// What a new environment of 2048 × 1024 costs the thread that draws when it takes it over at once.
// The editor's comes in pieces; together they must not cost much more than this.
void uploadEnvironment(benchmark::State& state) {
    const auto stage = makeStage(false);
    if (!stage) {
        state.SkipWithError("no OpenGL 4.5");
        return;
    }
    const ImagePtr& image = stage->document.environment().image;
    const auto maps = computeIbl(*image, {}, JobContext());
    const HalfMipmapsPtr background = *makeBackground(*image, JobContext());
    const EnvironmentTexels texels = makeEnvironmentTexels(image, *maps, background);
    EnvironmentTexels other = texels; // an environment of its own
    other.image = std::make_shared<const Image>(*image);
    EnvironmentLight light(*stage->context);
    DfgTextures tables(*stage->context);
    const gl::Texture& dfg = tables.of({});
    for (bool even = true; auto _ : state) {
        light.set(even ? texels : other);
        even = !even;
        benchmark::DoNotOptimize(dfg.readFloats(1)); // waits for the driver
    }
}
BENCHMARK(uploadEnvironment)->Unit(benchmark::kMillisecond)->UseRealTime();

// Three maps of numbers, 4096 × 4096 in 8 bits, at the moment a material takes them: as three
// textures (false) or packed into one, with mipmaps. Channels: of each image; files hold 1 or 3.
void uploadMaps(benchmark::State& state, bool packed) {
    auto context = gl::Context::createHeadless();
    if (!context) {
        state.SkipWithError("no OpenGL 4.5");
        return;
    }
    std::vector<ImageChannel> maps;
    for (int i = 0; i < 3; ++i) {
        Image image(4096, 4096, static_cast<int>(state.range(0)), PixelType::U8,
                    ColorEncoding::Data);
        for (std::size_t k = 0; k < image.u8().size(); ++k) // pages that are there
            image.u8()[k] = static_cast<std::uint8_t>(k * 37 + static_cast<std::size_t>(i));
        maps.push_back({std::make_shared<const Image>(std::move(image)), 0});
    }
    for (auto _ : state) {
        std::vector<gl::Texture> textures;
        if (packed)
            textures.push_back(makePackedTexture(**context, maps));
        else
            for (const ImageChannel& map : maps)
                textures.push_back(makeTexture(**context, *map.image));
        glFinish();
        benchmark::DoNotOptimize(textures);
    }
}
BENCHMARK_CAPTURE(uploadMaps, apart, false)
    ->ArgName("channels")
    ->Arg(1)
    ->Arg(3)
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(uploadMaps, packed, true)
    ->ArgName("channels")
    ->Arg(1)
    ->Arg(3)
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

// The same preparation on the thread that computes: background, and the atlas of the light.
void prepareTexels(benchmark::State& state) {
    const Document document = startDocument();
    const ImagePtr& image = document.environment().image;
    const auto maps = computeIbl(*image, {}, JobContext());
    for (auto _ : state)
        benchmark::DoNotOptimize(
            makeEnvironmentTexels(image, *maps, *makeBackground(*image, JobContext())));
}
BENCHMARK(prepareTexels)->Unit(benchmark::kMillisecond)->UseRealTime();

} // namespace
} // namespace patina::render
