// Comparing environments and cells in the editor's window: what a switch of the environment takes,
// frames of a wall while a value is dragged, what a wall of 36 cells holds in memory.
#include "app/editor/wall/WallState.h"
#include "core/edit/EditSession.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "tests/benchmarks/WindowStage.h"

#include <QColor>
#include <QImage>
#include <fstream>
#include <string>
#include <vector>

namespace patina::editor {
namespace {

constexpr QSize kSmall{320, 180}, kLarge{1280, 720};

// MiB that nobody shares with this process.
double privateMiB() {
    std::ifstream rollup("/proc/self/smaps_rollup");
    double kib = 0.0;
    for (std::string line; std::getline(rollup, line);)
        if (line.starts_with("Private_Clean:") || line.starts_with("Private_Dirty:"))
            kib += std::stod(line.substr(line.find(':') + 1));
    return kib / 1024.0;
}

// 2048 × 1024; one is red, the next one blue, none the same as another.
Environment colored(int index) {
    Image image(2048, 1024, 3, PixelType::F32, ColorEncoding::Linear);
    const bool red = index % 2 == 0;
    for (std::size_t i = 0; i < image.f32().size(); ++i)
        image.f32()[i] = i % 3 == (red ? 0U : 2U) ? 0.8f + 1e-3f * static_cast<float>(index) : 0.0f;
    Environment environment;
    environment.source = "/environment-" + std::to_string(index) + ".hdr";
    environment.image = environment.fileImage = std::make_shared<const Image>(std::move(image));
    return environment;
}

struct Arrival {
    double ms = -1.0; // below 0: none came
    int frames = 0;   // the one that shows it, too
};

// Until a frame shows the background of that colour.
template <class Act>
Arrival untilBackground(WindowStage& stage, bool red, Act act) {
    bool shown = false, grabs = false;
    int frames = 0;
    QObject here;
    QObject::connect(&stage.viewport(), &ViewportWidget::frameRendered, &here, [&] {
        if (grabs) // which draws a frame, too
            return;
        ++frames;
        // Qt draws what was rendered after the signal.
        QMetaObject::invokeMethod(
            &here,
            [&] {
                grabs = true;
                const QColor color = stage.viewport().grabFramebuffer().pixelColor(4, 4);
                grabs = false;
                shown = shown || (red ? color.red() > 2 * color.blue() + 20
                                      : color.blue() > 2 * color.red() + 20);
            },
            Qt::QueuedConnection);
    });
    const double start = WindowStage::clockMs(CLOCK_MONOTONIC);
    act();
    if (!WindowStage::eventually([&] { return shown; }))
        return {};
    return {WindowStage::clockMs(CLOCK_MONOTONIC) - start, frames};
}

void switchEnvironment(benchmark::State& state, WindowStage& stage, bool prepared) {
    stage.viewport().setFixedSize(kSmall);
    if (!stage.open(QStringLiteral("builtin:shader-ball")))
        return state.SkipWithError("the scene could not be opened");
    EditSession& session = stage.controller().session();
    std::vector<Id> ids;
    int index = 0;
    for (; index < 2; ++index) {
        ids.push_back(session.addEnvironment(colored(index), "Add"));
        if (!stage.rests())
            return state.SkipWithError("the light was not prepared");
    }
    std::vector<double> times, frames;
    for (auto _ : state) {
        state.PauseTiming();
        Environment next = colored(index); // decoded
        if (!stage.rests())
            return state.SkipWithError("the picture is not settled");
        state.ResumeTiming();
        const bool red = index % 2 == 0;
        const Arrival arrival = untilBackground(stage, red, [&] {
            if (prepared)
                stage.controller().lightWith(ids[red ? 0 : 1]);
            else
                ids.push_back(session.addEnvironment(next, "Add"));
        });
        times.push_back(arrival.ms);
        frames.push_back(arrival.frames);
        if (times.back() < 0.0)
            return state.SkipWithError("the environment was not shown");
        if (!prepared && ids.size() > 4) { // a scene holds no more than so many
            session.removeEnvironment(ids[ids.size() - 2]);
            ids.erase(ids.end() - 2);
        }
        ++index;
    }
    state.counters["median_ms"] = quantile(times, 0.5);
    state.counters["slowest_ms"] = quantile(times, 1.0);
    state.counters["median_frames"] = quantile(frames, 0.5);
}

bool showWall(WindowStage& stage, int columns, int rows) {
    stage.viewport().setFixedSize(kLarge);
    if (!stage.open(QStringLiteral("builtin:shader-ball")) || !stage.rests())
        return false;
    AxisPlan metallic = valuesPlan(*findParameter("material.metallic"), {Scope::Material, 0});
    AxisPlan exposure = valuesPlan(*findParameter("view.exposureEv"), {Scope::View, 0});
    metallic.count = columns;
    exposure.count = rows;
    stage.session.wall.setPlan({.columns = metallic, .rows = exposure});
    return true;
}

void wallMemory(benchmark::State& state, WindowStage& stage) {
    if (!showWall(stage, 6, 6))
        return state.SkipWithError("the scene could not be opened");
    const double before = privateMiB();
    for (auto _ : state) {
        stage.session.wall.setOn(true);
        if (!stage.rests())
            return state.SkipWithError("the wall is not settled");
    }
    state.counters["before_MiB"] = before;
    state.counters["wall_MiB"] = privateMiB() - before;
    stage.session.wall.setOn(false);
}

// A frame for each step of a drag of the roughness, on 4 × 3 cells.
void dragOnWall(benchmark::State& state, WindowStage& stage) {
    if (!showWall(stage, 4, 3))
        return state.SkipWithError("the scene could not be opened");
    stage.session.wall.setOn(true);
    if (!stage.rests())
        return state.SkipWithError("the wall is not settled");
    const Id material = stage.document().materials.front().id;
    std::vector<double> times;
    float value = 0.0f;
    for (auto _ : state) {
        value = value > 0.95f ? 0.0f : value + 0.02f;
        times.push_back(stage.untilFrame([&] {
            stage.controller().setParameter(*findParameter("material.perceptualRoughness"),
                                            {Scope::Material, material}, value);
        }));
        if (times.back() < 0.0)
            return state.SkipWithError("no frame was drawn");
    }
    stage.session.wall.setOn(false);
    state.counters["median_ms"] = quantile(times, 0.5);
    state.counters["p95_ms"] = quantile(times, 0.95);
    state.counters["slowest_ms"] = quantile(times, 1.0);
}

} // namespace

void registerComparisonBenchmarks(WindowStage& stage) {
    const auto add = [&](const char* name, auto run) {
        return benchmark::RegisterBenchmark(name, run)
            ->Unit(benchmark::kMillisecond)
            ->UseRealTime();
    };
    add("switchEnvironment/prepared", [&](benchmark::State& s) {
        switchEnvironment(s, stage, true);
    })->Iterations(20);
    add("switchEnvironment/unprepared2k", [&](benchmark::State& s) {
        switchEnvironment(s, stage, false);
    })->Iterations(10);
    add("wallOf36/memory", [&](benchmark::State& s) { wallMemory(s, stage); })->Iterations(1);
    add("wallOf12/drag", [&](benchmark::State& s) { dragOnWall(s, stage); })->Iterations(60);
}

} // namespace patina::editor
