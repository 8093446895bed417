// Radiosity of the scenes that are known from elsewhere, to a residual of 1e-3, form factors
// included; and a row of form factors by each method. What the full hemicube matrix with Jacobi
// sweeps would take stands beside it: its rows are all alike, so that a part of them tells.
#include "core/job/Parallel.h"
#include "core/library/Library.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/math/Sampling.h"
#include "core/radiosity/Gathering.h"
#include "core/radiosity/document/LitDocument.h"
#include "core/radiosity/document/LiveRadiosity.h"
#include "core/trace/document/DocumentTraceInputs.h"

#include <benchmark/benchmark.h>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace patina {
namespace {

using namespace radiosity;

Document builtin(const std::string& name) {
    Document document;
    Id id = 0;
    const auto parts = library::model(name); // outlives the loop
    for (const library::ModelPart& part : *parts) {
        Material& material = document.materials.emplace_back(part.material);
        MeshInstance& instance = document.meshes.emplace_back();
        instance.id = material.id = instance.material = ++id;
        instance.name = part.name;
        instance.mesh = part.mesh;
    }
    for (Environment& environment : document.environments)
        environment.enabled = false;
    return document;
}

// Divided to about `elements`.
RadiositySettings settingsFor(const Document& document, double elements) {
    RadiositySettings settings;
    double area = 0.01;
    for (int i = 0; i < 24; ++i) {
        settings.maxArea = area;
        const auto scene = RadiosityScene::make(document, settings, {});
        const auto count = static_cast<double>((*scene)->elements().size());
        if (std::abs(count / elements - 1.0) < 0.005)
            break;
        area *= count / elements;
    }
    return settings;
}

void solveScene(benchmark::State& state, const char* name, double elements) {
    const Document document = builtin(name);
    const RadiositySettings settings = settingsFor(document, elements);
    for (auto _ : state) {
        const auto scene = RadiosityScene::make(document, settings, {});
        const auto solved = (*scene)->solve(settings, {});
        state.counters["elements"] = static_cast<double>((*scene)->elements().size());
        state.counters["sweeps"] = static_cast<double>(solved->report.iterations);
        state.counters["factorMB"] = static_cast<double>(solved->report.factorBytes) / 1e6;
    }
}

// How the time of a solution alone grows with its elements: state.range(0) of them.
void solveBoxBy(benchmark::State& state, Solver solver) {
    const Document document = builtin("cornell-reference");
    RadiositySettings settings = settingsFor(document, static_cast<double>(state.range(0)));
    settings.solve.solver = solver;
    const auto scene = RadiosityScene::make(document, settings, {});
    const auto elements = static_cast<double>((*scene)->elements().size());
    for (auto _ : state) {
        const auto solved = (*scene)->solve(settings, {});
        state.counters["elements"] = elements;
        state.counters["bytesPerElement"] =
            static_cast<double>(solved->report.factorBytes) / elements;
        if (solved->report.links) {
            state.counters["firstLinksPerElement"] =
                static_cast<double>(solved->report.links->first) / elements;
            state.counters["linksPerElement"] =
                static_cast<double>(solved->report.links->last) / elements;
            state.counters["treeBytesPerElement"] =
                static_cast<double>(solved->report.links->treeBytes) / elements;
        }
    }
    state.counters["perElement"] = benchmark::Counter(
        elements, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void rowsBy(benchmark::State& state, FactorMethod method, int resolution) {
    const Document document = builtin("cornell-reference");
    const RadiositySettings settings = settingsFor(document, 3842);
    const auto scene = RadiosityScene::make(document, settings, {});
    FactorSettings factorSettings{method, resolution, 0, true};
    const auto factors =
        *makeFormFactors((*scene)->elements(), *(*scene)->scene().rays(), factorSettings);
    FactorRow row;
    std::uint32_t element = 0;
    for (auto _ : state) {
        factors->row(element, row);
        element = (element + 97) % static_cast<std::uint32_t>((*scene)->elements().size());
    }
    state.SetItemsProcessed(state.iterations()); // rows
}

// What rowsBy/raycast256 takes for its rays alone: as many, drawn before and shot by Embree in the
// same batches.
void bareRays(benchmark::State& state) {
    constexpr std::uint32_t kRays = 256;
    const Document document = builtin("cornell-reference");
    const auto scene = RadiosityScene::make(document, settingsFor(document, 3842), {});
    const ElementMesh& elements = (*scene)->elements();
    std::vector<std::vector<ClosestRay>> rows;
    for (std::uint32_t e = 0; e < elements.size(); ++e) {
        const glm::vec3 normal(elements.face(e).normal);
        glm::vec3 x, y;
        orthonormalBasis(normal, x, y);
        std::vector<ClosestRay>& row = rows.emplace_back(kRays);
        for (std::uint32_t i = 0; i < kRays; ++i) {
            const glm::vec4 u = sobolOwen4D(i, seedFor(0, e));
            const glm::vec3 d = cosineHemisphere({u.z, u.w});
            row[i].ray.origin =
                glm::vec3(elements.samplePosition(e, {u.x, u.y})) + kRayOffset * normal;
            row[i].ray.direction = d.x * x + d.y * y + d.z * normal;
        }
    }
    std::size_t element = 0;
    for (auto _ : state) {
        (*scene)->scene().rays()->intersect(rows[element]);
        benchmark::DoNotOptimize(rows[element].data());
        element = (element + 97) % rows.size();
    }
    state.SetItemsProcessed(state.iterations());
}

// A sweep over kept rows on one core, in bytes of them a second; and the same rows merely read.
void sweepRows(benchmark::State& state, bool solves) {
    const Document document = builtin("cornell-reference");
    const RadiositySettings settings = settingsFor(document, 16000);
    const auto scene = RadiosityScene::make(document, settings, {});
    const auto factors =
        *makeFormFactors((*scene)->elements(), *(*scene)->scene().rays(), settings.factors);
    const auto matrix = FactorMatrix::compute(*factors, (*scene)->elements().size(), 0, {});
    const ThreadLimit limit(1);
    Gathering gathering((*scene)->lit().problem, *matrix, Sweep::GaussSeidel);
    for (auto _ : state) {
        if (solves) {
            gathering.sweep({});
            continue;
        }
        float sum = 0.0f;
        std::uint32_t last = 0;
        for (std::uint32_t e = 0; e < matrix->size(); ++e)
            for (const FactorRow::Share& share : matrix->row(e)) {
                sum += share.factor;
                last ^= share.element;
            }
        benchmark::DoNotOptimize(sum);
        benchmark::DoNotOptimize(last);
    }
    state.SetBytesProcessed(static_cast<std::int64_t>(static_cast<std::size_t>(state.iterations()) *
                                                      matrix->shareCount() *
                                                      sizeof(FactorRow::Share)));
}

// An edit of a solved scene, until its light is there in full: a wall's colour, or a light that has
// moved, its shadows included.
enum class Edited { Color, Light };
void followEdit(benchmark::State& state, Edited edited) {
    Document document = builtin("cornell-reference");
    Light light;
    light.type = LightType::Point;
    light.id = 1000;
    light.position = {0.0f, 0.2f, 0.1f};
    document.lights = {light};
    TraceInputs inputs = traceInputs(document);
    const RadiositySettings settings = settingsFor(document, static_cast<double>(state.range(0)));
    auto live = *followRadiosity(inputs, settings, nullptr, {});
    bool moved = false;
    for (auto _ : state) {
        moved = !moved;
        if (edited == Edited::Color)
            inputs.materials[0].baseColor = glm::vec3(moved ? 0.4f : 0.7f);
        else
            inputs.lights[0].position.x = moved ? 0.1f : -0.1f;
        live = *followRadiosity(inputs, settings, live, {});
    }
    state.counters["elements"] = static_cast<double>(live->elements().size());
}

BENCHMARK_CAPTURE(solveScene, cornell, "cornell-reference", 3842)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(solveScene, wall, "wall", 4098)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(solveScene, chess, "chess", 2130)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(solveBoxBy, gathering, Solver::GaussSeidel)
    ->RangeMultiplier(4)
    ->Range(4000, 64000)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(solveBoxBy, hierarchical, Solver::Hierarchical)
    ->RangeMultiplier(4)
    ->Range(4000, 64000)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(rowsBy, raycast256, FactorMethod::Rays, 256)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(followEdit, color, Edited::Color)
    ->Arg(3842)
    ->Arg(10000)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(followEdit, light, Edited::Light)
    ->Arg(3842)
    ->Arg(10000)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(bareRays)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(sweepRows, solved, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(sweepRows, read, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(rowsBy, hemicube256, FactorMethod::Hemicube, 256)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(rowsBy, hemicube512, FactorMethod::Hemicube, 512)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(rowsBy, paraboloid500, FactorMethod::Paraboloid, 500)
    ->Unit(benchmark::kMicrosecond); // as many texels as hemicube256 has cells
BENCHMARK_CAPTURE(rowsBy, paraboloid1000, FactorMethod::Paraboloid, 1000)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(rowsBy, analytic64, FactorMethod::Analytic, 64)->Unit(benchmark::kMicrosecond);

} // namespace
} // namespace patina
