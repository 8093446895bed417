// Path tracing against the bare limit: the very rays that its paths cast at 640 × 360, recorded in
// their order, through the same kind of hierarchy in a loop that does nothing else. Both alternate
// within one run, and CPU time is compared, so that a busy machine slows both alike.
//
// The linker leads the calls of Embree that RayScene makes to the recorder here (--wrap), so that
// nothing in the tracer knows of it. PATINA_FLIGHT_HELMET: path of that model's .gltf, which is not
// ours to ship; without it that scene is skipped.
#include "core/document/Document.h"
#include "core/job/Parallel.h"
#include "core/library/Library.h"
#include "core/scene/Scene.h"
#include "core/trace/document/DocumentTraceInputs.h"
#include "core/trace/path/PathTracer.h"
#include "core/worker/WorkerClient.h"

#include <algorithm>
#include <atomic>
#include <benchmark/benchmark.h>
#include <chrono>
#include <cstdlib>
#include <embree3/rtcore.h>
#include <optional>
#include <string>
#include <sys/resource.h>
#include <vector>

using namespace patina;

namespace {

// One ray as it was cast.
struct CastRay {
    float origin[3], direction[3], distance;
    bool closest; // what it meets first, or only whether there is something
};

// Of the one thread that records; null: nobody does.
std::vector<CastRay>* recorder = nullptr;
RTCScene recordedScene = nullptr;

void record(RTCScene scene, const RTCRay& ray, bool closest) {
    recordedScene = scene;
    recorder->push_back(
        {{ray.org_x, ray.org_y, ray.org_z}, {ray.dir_x, ray.dir_y, ray.dir_z}, ray.tfar, closest});
}

} // namespace

extern "C" {
void __real_rtcIntersect1(RTCScene scene, RTCIntersectContext* context, RTCRayHit* ray);
void __real_rtcOccluded1(RTCScene scene, RTCIntersectContext* context, RTCRay* ray);

void __wrap_rtcIntersect1(RTCScene scene, RTCIntersectContext* context, RTCRayHit* ray) {
    if (recorder != nullptr)
        record(scene, ray->ray, true);
    __real_rtcIntersect1(scene, context, ray);
}

void __wrap_rtcOccluded1(RTCScene scene, RTCIntersectContext* context, RTCRay* ray) {
    if (recorder != nullptr)
        record(scene, *ray, false);
    __real_rtcOccluded1(scene, context, ray);
}
}

namespace {

constexpr int kWidth = 640, kHeight = 360;

struct Stage {
    TraceScene scene;
    TraceView view;
    int standIns = 0; // maps that could not be read
};

// Those of the library are named in its materials, and read here. What cannot be read is looked up
// in the same map of another material, so that it costs what it should. Their number.
int readMaps(WorkerClient& worker, TraceInputs& inputs) {
    constexpr MapSlot Material::*kSlots[] = {&Material::baseColorMap, &Material::metallicMap,
                                             &Material::perceptualRoughnessMap,
                                             &Material::normalMap};
    int standIns = 0;
    for (const auto slot : kSlots) {
        ImagePtr standIn;
        for (Material& material : inputs.materials) {
            MapSlot& map = material.*slot;
            if (map.assigned() && !map.image)
                if (Result<ImagePtr> image =
                        loadMapImage(worker, map.source, ColorEncoding::Linear))
                    map.image = *std::move(image);
            if (map.image)
                standIn = map.image;
        }
        for (Material& material : inputs.materials)
            if (MapSlot& map = material.*slot; map.assigned() && !map.image) {
                map.image = standIn;
                ++standIns;
            }
    }
    return standIns;
}

Result<Stage> stageOf(const std::string& source, const std::string& material,
                      const std::string& environment) {
    WorkerClient worker;
    Result<OpenedScene> opened = openScene(worker, source);
    if (!opened)
        return opened.error();
    Document& document = opened->document;
    if (!material.empty())
        for (Material& slot : document.materials) {
            const Id id = slot.id;
            slot = *library::material(material);
            slot.id = id;
        }
    TraceInputs inputs = traceInputs(document);
    const int standIns = readMaps(worker, inputs);
    if (!environment.empty())
        inputs.environments = {{*library::environment(environment), 0.0f, glm::vec3(1.0f)}};
    Result<TraceScene> scene = TraceScene::build(inputs, {});
    if (!scene)
        return scene.error();
    TraceView view;
    view.width = kWidth;
    view.height = kHeight;
    view.camera = document.view.camera;
    return Stage{*std::move(scene), view, standIns};
}

double traceSeconds() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
           1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

double wallClock() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

// Best seconds of all runs: CPU of all threads, and by the clock.
struct Best {
    double cpu = 1e9, wall = 1e9;
    template <typename F>
    void run(F f) {
        const double cpuBefore = traceSeconds(), wallBefore = wallClock();
        f();
        cpu = std::min(cpu, traceSeconds() - cpuBefore);
        wall = std::min(wall, wallClock() - wallBefore);
    }
};

// Into a film that is there already: memory that is new costs more than what is done with it.
std::uint64_t tracePass(const Stage& stage, std::uint32_t samples, Film& film) {
    std::ranges::fill(film.pixels(), Film::Pixel{});
    TraceRays rays;
    (void)tracePaths(stage.scene, stage.view, {}, film, 0, samples, {}, &rays);
    benchmark::DoNotOptimize(film.at(kWidth / 2, kHeight / 2).sum.y);
    return rays.count;
}

// Ray by ray in the order of the paths.
std::size_t bareRays(RTCScene scene, const std::vector<CastRay>& rays) {
    const FlushDenormals flush;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    std::size_t hits = 0;
    for (const CastRay& cast : rays) {
        RTCRayHit ray{};
        ray.ray = {cast.origin[0],
                   cast.origin[1],
                   cast.origin[2],
                   0.0f,
                   cast.direction[0],
                   cast.direction[1],
                   cast.direction[2],
                   0.0f,
                   cast.distance,
                   ~0u,
                   0,
                   0};
        ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        if (cast.closest) {
            __real_rtcIntersect1(scene, &context, &ray);
            hits += ray.hit.geomID != RTC_INVALID_GEOMETRY_ID ? 1 : 0;
        } else {
            __real_rtcOccluded1(scene, &context, &ray.ray);
            hits += ray.ray.tfar < 0.0f ? 1 : 0;
        }
    }
    return hits;
}

// `least`: the share of the bare loop's rays per second that is wanted.
void tracerAgainstBareLoop(benchmark::State& state, const Result<Stage>& made, double least) {
    if (!made) {
        state.SkipWithError(made.error().message.c_str());
        return;
    }
    const Stage& stage = *made;
    Film film(kWidth, kHeight);
    std::vector<CastRay> rays;
    {
        const ThreadLimit one(1);
        recorder = &rays;
        tracePass(stage, 1, film);
        recorder = nullptr;
    }
    Best tracer, bare, both, single;
    std::size_t hits = 0;
    std::uint64_t cast = 0;
    constexpr std::uint32_t kSamples = 4; // for the threads: long enough to end together
    for (auto _ : state) {
        {
            const ThreadLimit one(1);
            tracer.run([&] { cast = tracePass(stage, 1, film); });
            bare.run([&] { hits = bareRays(recordedScene, rays); });
            single.run([&] { tracePass(stage, kSamples, film); });
        }
        const ThreadLimit two(2);
        both.run([&] { tracePass(stage, kSamples, film); });
    }
    if (cast != rays.size())
        state.SkipWithError("other rays than those that were recorded");
    const auto count = static_cast<double>(rays.size());
    state.counters["Mrays/s"] = 1e-6 * count / tracer.cpu;
    state.counters["bare Mrays/s"] = 1e-6 * count / bare.cpu;
    state.counters["share"] = bare.cpu / tracer.cpu;
    state.counters["wanted"] = least;
    state.counters["rays/path"] = count / (kWidth * kHeight);
    state.counters["hits"] = static_cast<double>(hits) / count;
    state.counters["stand-in maps"] = stage.standIns;
    state.counters["1 to 2"] = single.wall / both.wall; // at least 1.85
}

void flightHelmet(benchmark::State& state) {
    const char* path = std::getenv("PATINA_FLIGHT_HELMET");
    if (path == nullptr) {
        state.SkipWithError("PATINA_FLIGHT_HELMET names no model");
        return;
    }
    tracerAgainstBareLoop(state, stageOf(path, {}, "studio"), 0.5);
}

void shaderBall(benchmark::State& state) {
    tracerAgainstBareLoop(state, stageOf("builtin:shader-ball", "worn-painted-metal", "clear-sky"),
                          0.35);
}

void cornellBox(benchmark::State& state) {
    tracerAgainstBareLoop(state, stageOf("builtin:cornell-box", {}, {}), 0.25);
}

BENCHMARK(flightHelmet)->Iterations(5)->Unit(benchmark::kMillisecond);
BENCHMARK(shaderBall)->Iterations(5)->Unit(benchmark::kMillisecond);
BENCHMARK(cornellBox)->Iterations(5)->Unit(benchmark::kMillisecond);

} // namespace
