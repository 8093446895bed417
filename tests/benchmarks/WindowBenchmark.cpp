// Frames in the editor's window: a drag, an environment that arrives meanwhile, views that are
// shown for the first time.
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "tests/benchmarks/WindowStage.h"

#include "app/editor/Startup.h"
#include "app/editor/style/Style.h"
#include "core/document/Views.h"
#include "core/edit/EditSession.h"
#include "core/library/Library.h"

#include <QApplication>
#include <QFile>
#include <QSettings>
#include <QTemporaryDir>
#include <string>
#include <utility>

namespace patina::editor {
namespace {

constexpr QSize kViewport{1280, 720};

// 100,352 triangles with five maps, the studio's light and four lights.
bool openLitKnot(WindowStage& stage) {
    stage.viewport().setFixedSize(kViewport);
    if (!stage.open(QStringLiteral("builtin:torus-knot")))
        return false;
    DocumentController& controller = stage.controller();
    const Id material = stage.document().materials.front().id;
    const Material maps = library::material("worn-painted-metal").value();
    for (const auto& [name, slot] :
         {std::pair("material.baseColor.map", &maps.baseColorMap),
          std::pair("material.metallic.map", &maps.metallicMap),
          std::pair("material.perceptualRoughness.map", &maps.perceptualRoughnessMap),
          std::pair("material.normal.map", &maps.normalMap),
          std::pair("material.occlusion.map", &maps.occlusionMap)})
        controller.setMap(*findParameter(name), Target{Scope::Material, material},
                          QString::fromStdString(slot->source));
    for (int i = 0; i < 4; ++i)
        controller.addLight(i < 2 ? LightType::Point : LightType::Directional);
    return WindowStage::eventually([&] { return !controller.tasks().busy(); }) && stage.rests();
}

// An orbit with the left button held, a frame for each iteration.
void orbit(benchmark::State& state, WindowStage& stage) {
    ViewportWidget& viewport = stage.viewport();
    const QPoint center = viewport.rect().center();
    std::vector<double> times;
    double longestThread = 0.0;
    int coarsest = viewport.width(), i = 0;
    QTest::mousePress(&viewport, Qt::LeftButton, Qt::NoModifier, center);
    for (auto _ : state) {
        const double thread = WindowStage::clockMs(CLOCK_THREAD_CPUTIME_ID);
        const int x = i % 160 < 80 ? i % 160 : 160 - i % 160;
        const QPoint to = center + QPoint(10 + x, i % 7); // more than a click
        times.push_back(stage.untilFrame([&] { QTest::mouseMove(&viewport, to); }));
        if (times.back() < 0.0) {
            state.SkipWithError("no frame was drawn");
            break;
        }
        longestThread =
            std::max(longestThread, WindowStage::clockMs(CLOCK_THREAD_CPUTIME_ID) - thread);
        coarsest = std::min(coarsest, viewport.frameSize().width());
        ++i;
    }
    QTest::mouseRelease(&viewport, Qt::LeftButton, Qt::NoModifier, center);
    if (times.empty())
        return;
    state.counters["median_ms"] = quantile(times, 0.5);
    state.counters["p95_ms"] = quantile(times, 0.95);
    state.counters["slowest_ms"] = quantile(times, 1.0);
    state.counters["longest_thread_ms"] = longestThread;
    state.counters["coarsest_width"] = coarsest;
}

void drag(benchmark::State& state, WindowStage& stage) {
    if (!openLitKnot(stage))
        return state.SkipWithError("the scene could not be opened");
    orbit(state, stage);
}

void dragWhileAnEnvironmentArrives(benchmark::State& state, WindowStage& stage) {
    if (!openLitKnot(stage))
        return state.SkipWithError("the scene could not be opened");
    stage.controller().setEnvironment(QStringLiteral("builtin:sunset"));
    orbit(state, stage);
}

// Every view in turn, until it is on the screen. MESA_SHADER_CACHE_DIR: an empty folder for what
// is new to the driver, too.
void showView(benchmark::State& state, WindowStage& stage, bool compiled) {
    if (!openLitKnot(stage))
        return state.SkipWithError("the scene could not be opened");
    if (!compiled) // the programs are others
        (void)stage.controller().addLight(LightType::Rectangle);
    std::size_t i = 0;
    double slowest = 0.0;
    for (auto _ : state) {
        const ViewInfo& info = views()[i++ % views().size()];
        const double milliseconds = stage.untilFrame([&] {
            stage.session.views.show(info.kind);
            stage.viewport().update(); // also of what is shown already
        });
        const bool shown =
            WindowStage::eventually([&] { return !stage.viewport().waitsForPrograms(); });
        if (milliseconds < 0.0 || !shown) {
            state.SkipWithError("no frame was drawn");
            break;
        }
        if (milliseconds > slowest) {
            slowest = milliseconds;
            state.SetLabel("slowest: " + std::string(info.id));
        }
    }
    stage.session.views.set({});
    state.counters["slowest_ms"] = slowest;
}

} // namespace

void registerFrameBenchmarks(WindowStage& stage) {
    const auto add = [&](const char* name, auto run) {
        return benchmark::RegisterBenchmark(name, run)
            ->Unit(benchmark::kMillisecond)
            ->MeasureProcessCPUTime()
            ->UseRealTime();
    };
    const auto all = static_cast<benchmark::IterationCount>(views().size());
    add("drag", [&](benchmark::State& s) { drag(s, stage); })->Iterations(60);
    add("dragWhileAnEnvironmentArrives", [&](benchmark::State& s) {
        dragWhileAnEnvironmentArrives(s, stage);
    })->Iterations(60);
    add("showView/compiled", [&](benchmark::State& s) {
        showView(s, stage, true);
    })->Iterations(all);
    add("showView/notCompiled", [&](benchmark::State& s) {
        showView(s, stage, false);
    })->Iterations(all);
}

} // namespace patina::editor

int main(int argc, char* argv[]) {
    using namespace patina::editor;
    benchmark::Initialize(&argc, argv);
    prepareApplication();
    QTemporaryDir folder; // settings and caches of its own
    QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope, folder.path());
    qputenv("XDG_CACHE_HOME", QFile::encodeName(folder.path()));
    qputenv("XDG_DATA_HOME", QFile::encodeName(folder.path()));
    QApplication application(argc, argv);
    applyStyle(application);
    WindowStage stage;
    stage.window.show();
    if (!QTest::qWaitForWindowExposed(&stage.window, 60'000))
        return 1;
    registerFrameBenchmarks(stage);
    registerBakeEditBenchmarks(stage);
    registerComparisonBenchmarks(stage);
    registerRefinementBenchmarks(stage);
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
