// Shadows of one local light at 100,000 vertices: what has to be done anew when it is moved, and
// what comes first.
#include "core/bake/local/NearShadows.h"
#include "core/library/Library.h"
#include "core/library/Meshes.h"
#include "core/light/Light.h"

#include <algorithm>
#include <array>
#include <benchmark/benchmark.h>

using namespace patina;

namespace {

// A torus knot over a floor, both under transfer.
Document knotOnFloor() {
    Document document;
    auto bake = std::make_shared<BakeArtifact>();
    bake->kind = BakeKind::PrtVertex;
    bake->order = 1;
    for (Mesh mesh : {library::makeTorusKnot(1600, 32), library::makePlane(220)}) {
        (void)sanitizeMesh(mesh);
        MeshInstance& instance = document.meshes.emplace_back();
        instance.id = document.takeId();
        instance.mesh = std::make_shared<const Mesh>(std::move(mesh));
        bake->vertices.push_back(
            {instance.id, 1, std::vector<float>(instance.mesh->vertexCount(), 0.1f), {}, {}, {}});
    }
    document.bakes = {bake};
    return document;
}

Light lightOf(Document& document, LightType type) {
    Light light;
    light.id = document.takeId();
    light.type = type;
    light.position = {0.6f, 1.6f, 0.4f};
    light.radius = 0.1f;
    light.width = light.height = 0.3f;
    light.elevationDeg = 90.0f;
    return light;
}

void moveALight(benchmark::State& state, LightType type) {
    Document document = knotOnFloor();
    document.lights = {lightOf(document, type)};
    NearShadowsPtr shadows = *traceNearShadows(nearShadowRequest(document), nullptr, 0, {});
    std::size_t vertices = 0, penumbra = 0;
    for (const NearShares& shares : shadows->shares[0]) {
        vertices += shares->size();
        penumbra += static_cast<std::size_t>(
            std::ranges::count_if(*shares, [](float s) { return s > 0.0f && s < 1.0f; }));
    }
    for (auto _ : state) {
        document.lights[0].position.x += 0.001f;
        shadows = *traceNearShadows(nearShadowRequest(document), shadows, 0, {});
    }
    state.counters["vertices"] = static_cast<double>(vertices);
    state.counters["in penumbra"] = static_cast<double>(penumbra);
    state.counters["vertices/s"] =
        benchmark::Counter(static_cast<double>(vertices) * static_cast<double>(state.iterations()),
                           benchmark::Counter::kIsRate);
}

void firstShadows(benchmark::State& state) {
    Document document = knotOnFloor();
    document.lights = {lightOf(document, LightType::Point)};
    for (auto _ : state)
        benchmark::DoNotOptimize(
            traceNearShadows(nearShadowRequest(document), nullptr, 0, {}).ok());
}

BENCHMARK_CAPTURE(moveALight, point, LightType::Point)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(moveALight, sphere, LightType::Sphere)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(moveALight, rectangle, LightType::Rectangle)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(firstShadows)->UseRealTime()->Unit(benchmark::kMillisecond);

} // namespace
