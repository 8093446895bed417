// A wall of twelve cells (three environments × four materials on the start scene's ball) beside one
// frame of as many pixels: what all cells cost when each has changed, over what the frame costs.
#include "core/cells/WallAxes.h"
#include "core/edit/Edit.h"
#include "core/light/GeneratedEnvironment.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/scene/Scene.h"
#include "render/SceneRenderer.h"
#include "render/ViewRenderer.h"
#include "render/WallRenderer.h"

#include <benchmark/benchmark.h>
#include <chrono>
#include <epoxy/gl.h>
#include <map>
#include <memory>
#include <vector>

namespace patina::render {
namespace {

constexpr int kColumns = 3, kRows = 4;

EnvironmentTexelsPtr prepare(const ImagePtr& image) {
    const auto maps = computeIbl(*image, {}, JobContext());
    return std::make_shared<const EnvironmentTexels>(
        makeEnvironmentTexels(image, *maps, *makeBackground(*image, JobContext())));
}

// `coarse`: as the editor draws cells during interaction, with the triangles that such small
// pictures show.
void wallOfTwelve(benchmark::State& state, bool coarse) {
    auto context = gl::Context::createHeadless();
    auto scene = context ? SceneRenderer::create(**context)
                         : Result<std::unique_ptr<SceneRenderer>>(context.error());
    if (!scene) {
        state.SkipWithError("no OpenGL 4.5");
        return;
    }
    Document document = startDocument();
    std::vector<Id> environments{document.mix.first}, materials, meshes;
    for (int i = 1; i < kColumns; ++i) {
        Environment sky;
        sky.kind = EnvironmentKind::Sky;
        sky.sky.sunElevationDeg = 20.0f * static_cast<float>(i);
        resolveEnvironment(sky);
        environments.push_back(addEnvironment(document, sky));
    }
    for (const char* name : {"Ball", "builtin:gold", "builtin:leather", "builtin:concrete"})
        materials.push_back(*materialNamed(document, name));
    for (const MeshInstance& mesh : document.meshes)
        if (mesh.name == "Ball")
            meshes.push_back(mesh.id);
    const Result<Wall> wall = makeWall(
        {environmentAxis(document, environments), materialAxis(document, materials, meshes)});
    std::map<ImagePtr, EnvironmentTexelsPtr> lights;
    std::vector<CellView> cells;
    for (const WallCell& cell : cellsOf(*wall)) {
        CellView& view = cells.emplace_back();
        view.document = *documentOf(document, cell.cell);
        const ImagePtr& image = view.document.environment().image;
        EnvironmentTexelsPtr& light = lights[image];
        if (!light)
            light = prepare(image);
        view.light = light;
        view.frame.width = 1280 / kRows;
        view.frame.height = 720 / kColumns;
        view.frame.samples = 1;
        view.frame.coarse = coarse;
        view.frame.camera = frameBounds(document.view.camera, document.bounds(), 4.0f / 3.0f);
    }
    const auto milliseconds = [&](const auto& draw) {
        const auto start = std::chrono::steady_clock::now();
        if (!draw())
            state.SkipWithError("rendering failed");
        glFinish();
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
            .count();
    };
    // The frame is as full of the scene as a cell is: its proportions.
    FrameSettings frame = cells.front().frame;
    frame.coarse = false;
    frame.width *= kRows;
    frame.height *= kColumns;

    WallRenderer renderer(**scene);
    ViewRenderer single(**scene);
    double wallMs = 0.0, frameMs = 0.0;
    float exposure = 0.0f;
    const auto changeAll = [&] { // without another program
        exposure = exposure == 0.0f ? 0.01f : 0.0f;
        for (CellView& cell : cells)
            cell.document.view.exposureEv = exposure;
    };
    const auto drawWall = [&] { return renderer.draw(cells).ok(); };
    const auto drawFrame = [&] { return single.render(frame, ViewRenderer::kNowhere).ok(); };
    for (int warm = 0; warm < 2; ++warm) {
        changeAll();
        milliseconds(drawWall);
        (*scene)->setEnvironment(cells.front().light);
        (*scene)->setDocument(cells.front().document);
        milliseconds(drawFrame);
    }
    for (auto _ : state) {
        changeAll();
        wallMs += milliseconds(drawWall);
        (*scene)->setDocument(cells.front().document);
        frameMs += milliseconds(drawFrame);
    }
    const auto runs = static_cast<double>(state.iterations());
    state.counters["wall_ms"] = wallMs / runs;
    state.counters["frame_ms"] = frameMs / runs;
    state.counters["ratio"] = wallMs / frameMs;
    state.SetLabel((*context)->info().renderer);
}
BENCHMARK_CAPTURE(wallOfTwelve, at_rest, false)->Unit(benchmark::kMillisecond)->Iterations(10);
BENCHMARK_CAPTURE(wallOfTwelve, during_interaction, true)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(10);

} // namespace
} // namespace patina::render
