// How many lights a second are ranked under radiance transfer: 100,000 vertices, order 5, pictures
// of 128 × 128.
#include "core/bake/Bake.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/document/Document.h"
#include "core/library/Library.h"
#include "core/library/Meshes.h"
#include "core/material/Material.h"
#include "core/rank/LightSweep.h"
#include "tests/reference/ReferenceSweep.h"

#include <benchmark/benchmark.h>
#include <memory>

using namespace patina;

namespace {

constexpr int kSide = 128, kRotations = 36;

Document knot() {
    Document document;
    Material& material = document.materials.emplace_back();
    material.id = document.takeId();
    Mesh mesh = library::makeTorusKnot(1600, 63);
    (void)sanitizeMesh(mesh);
    MeshInstance& instance = document.meshes.emplace_back();
    instance.id = document.takeId();
    instance.material = material.id;
    instance.mesh = std::make_shared<const Mesh>(std::move(mesh));
    return document;
}

struct Stage {
    Document document = knot();
    std::size_t vertices = document.meshes[0].mesh->vertexCount();
    BakeArtifact bake;
    Camera camera;
    SweepPixels pixels;
    std::vector<SweepEnvironment> environments;

    Stage() {
        PrtSettings settings;
        settings.order = 5;
        settings.samples = 64; // what they hold does not change what they cost
        TileSink sink;
        bake = *bakePrtVertex(bakeInputs(document), settings, sink, {});
        camera = frameBounds({}, document.bounds(), 1.0f);
        pixels = *traceSweepPixels(document, &bake, camera, kSide, kSide, {});
        for (const library::Entry& entry : library::environments())
            environments.push_back(
                measureEnvironment(entry.title, **library::environment(entry.name), {}));
    }
};

const Stage& stage() {
    static const Stage shared;
    return shared;
}

void report(benchmark::State& state, std::size_t lights) {
    state.counters["lights"] = static_cast<double>(lights);
    state.counters["lights/s"] = benchmark::Counter(static_cast<double>(lights),
                                                    benchmark::Counter::kIsIterationInvariantRate);
    state.counters["vertices"] = static_cast<double>(stage().vertices);
    state.counters["pixels"] = static_cast<double>(stage().pixels.count());
}

void ranking(benchmark::State& state) {
    SweepSettings settings;
    settings.rotations = kRotations;
    const Stage& scene = stage();
    for (auto _ : state)
        benchmark::DoNotOptimize(
            sweepLights(scene.pixels, scene.environments, settings, {})->scores.size());
    report(state, stage().environments.size() * kRotations);
}
BENCHMARK(ranking)->MeasureProcessCPUTime()->UseRealTime()->Unit(benchmark::kMillisecond);

// The same, plainly: tests/reference/ReferenceSweep.h.
void plainRanking(benchmark::State& state) {
    SweepSettings settings;
    settings.rotations = 6;
    const Stage& scene = stage();
    for (auto _ : state)
        benchmark::DoNotOptimize(
            test::referenceSweep(scene.pixels, scene.environments, settings).scores.size());
    report(state, stage().environments.size() * 6);
}
BENCHMARK(plainRanking)->MeasureProcessCPUTime()->UseRealTime()->Unit(benchmark::kMillisecond);

// Once for a scene and a camera.
void castingPixels(benchmark::State& state) {
    for (auto _ : state)
        benchmark::DoNotOptimize(
            traceSweepPixels(stage().document, &stage().bake, stage().camera, kSide, kSide, {})
                ->count());
}
BENCHMARK(castingPixels)->MeasureProcessCPUTime()->UseRealTime()->Unit(benchmark::kMillisecond);

// Once for an environment of 1024 × 512.
void measuring(benchmark::State& state) {
    const ImagePtr image = *library::environment("studio");
    for (auto _ : state)
        benchmark::DoNotOptimize(measureEnvironment("studio", *image, {}).darkestShare);
}
BENCHMARK(measuring)->MeasureProcessCPUTime()->UseRealTime()->Unit(benchmark::kMillisecond);

} // namespace
