// Radiosity of the scenes that are known from elsewhere, to a residual of 1e-3, form factors
// included; and a row of form factors by each method. What the full hemicube matrix with Jacobi
// sweeps would take stands beside it: its rows are all alike, so that a part of them tells.
#include "core/library/Library.h"
#include "core/radiosity/document/LitDocument.h"

#include <benchmark/benchmark.h>
#include <cmath>
#include <string>

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
BENCHMARK_CAPTURE(rowsBy, hemicube256, FactorMethod::Hemicube, 256)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(rowsBy, hemicube512, FactorMethod::Hemicube, 512)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(rowsBy, paraboloid500, FactorMethod::Paraboloid, 500)
    ->Unit(benchmark::kMicrosecond); // as many texels as hemicube256 has cells
BENCHMARK_CAPTURE(rowsBy, paraboloid1000, FactorMethod::Paraboloid, 1000)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(rowsBy, analytic64, FactorMethod::Analytic, 64)->Unit(benchmark::kMicrosecond);

} // namespace
} // namespace patina
