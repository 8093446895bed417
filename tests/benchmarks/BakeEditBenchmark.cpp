// Whether the editor stays fluid while a bake runs at low priority: the same edits, an orbit and a
// drag of a slider, while the bake runs and while it pauses, by turns, so that what else the
// machine does touches both.
#include "tests/benchmarks/WindowStage.h"

#include "app/editor/job/BakeService.h"
#include "app/editor/job/JobManager.h"
#include "app/editor/panel/ParameterRow.h"
#include "app/editor/widget/Slider.h"
#include "core/job/Parallel.h"

#include <QFile>
#include <QTemporaryDir>
#include <fmt/format.h>
#include <string>

namespace patina::editor {
namespace {

constexpr int kSide = 320;  // vertices around the torus and around its tube
constexpr int kSteps = 12;  // of an edit
constexpr int kBlocks = 6;  // edits
constexpr int kQuiet = 400; // ms that a paused bake has traced nothing more
constexpr double kSlower = 1.5;

// A torus with bumps that shadow each other.
std::string bumpyTorusObj() {
    constexpr double kStep = 2.0 * 3.14159265358979323846 / kSide;
    std::string text;
    for (int i = 0; i < kSide; ++i)
        for (int j = 0; j < kSide; ++j) {
            const double u = i * kStep, v = j * kStep;
            const double tube = 0.4 + 0.05 * std::sin(12.0 * u) * std::sin(5.0 * v);
            const double around = 1.0 + tube * std::cos(v);
            text += fmt::format("v {:.5f} {:.5f} {:.5f}\n", around * std::cos(u),
                                tube * std::sin(v), -around * std::sin(u));
        }
    for (int i = 0; i < kSide; ++i)
        for (int j = 0; j < kSide; ++j) {
            const int right = (i + 1) % kSide, up = (j + 1) % kSide;
            text += fmt::format("f {} {} {} {}\n", i * kSide + j + 1, right * kSide + j + 1,
                                right * kSide + up + 1, i * kSide + up + 1);
        }
    return text;
}

BakeRequest transferOfFiveBands(int samples) {
    BakeRequest request;
    request.kind = BakeKind::PrtVertex;
    request.prt.order = 5;
    request.prt.samples = samples;
    return request;
}

// With a bake attached, the picture costs the same before the next one and during it.
bool openBakedTorus(WindowStage& stage) {
    stage.viewport().setFixedSize(1280, 720);
    const QTemporaryDir folder;
    const QString path = folder.filePath(QStringLiteral("torus.obj"));
    QFile file(path);
    const std::string text = bumpyTorusObj();
    if (!file.open(QIODevice::WriteOnly) || file.write(text.data(), qint64(text.size())) < 0)
        return false;
    file.close();
    if (!stage.open(path))
        return false;
    stage.session.bakes.start(transferOfFiveBands(32));
    return WindowStage::eventually([&] {
               return stage.document().bakes.size() == 1 && stage.session.jobs.runningCount() == 0;
           }) &&
           stage.rests();
}

Slider* roughnessSlider(const WindowStage& stage) {
    for (const ParameterRow* row : stage.window.findChildren<ParameterRow*>())
        if (row->info().id == "material.perceptualRoughness")
            return row->findChild<Slider*>();
    return nullptr;
}

// An orbit and back, and the roughness up and down, with the button held: piece `block` of it.
// Milliseconds of each step.
std::vector<double> edit(WindowStage& stage, int block) {
    std::vector<double> times;
    const auto move = [&](QWidget& widget, QPoint from, auto to) {
        QTest::mousePress(&widget, Qt::LeftButton, Qt::NoModifier, from);
        for (int i = 1; i <= kSteps; ++i)
            times.push_back(stage.untilFrame([&] { QTest::mouseMove(&widget, to(i)); }));
        QTest::mouseRelease(&widget, Qt::LeftButton, Qt::NoModifier, to(kSteps));
    };
    Slider* slider = roughnessSlider(stage);
    if (block % 2 == 0 || slider == nullptr) {
        const QPoint middle = stage.viewport().rect().center();
        move(stage.viewport(), middle,
             [&](int i) { return middle + QPoint(10 + 8 * std::min(i, kSteps - i), i); });
    } else {
        const QPoint handle(slider->handleX(), slider->height() / 2);
        move(*slider, handle, [&](int i) { return handle + QPoint(i % 2 == 0 ? -i : 4 + i, 0); });
    }
    return times;
}

// The share of times within 1.5 times the others', edit by edit.
double shareWithin(const std::vector<double>& times, const std::vector<double>& others) {
    double within = 0.0;
    for (std::size_t i = 0; i < times.size(); ++i)
        within += times[i] <= kSlower * others[i] ? 1.0 : 0.0;
    return 100.0 * within / static_cast<double>(times.size());
}

void editDuringBake(benchmark::State& state, WindowStage& stage) {
    if (!openBakedTorus(stage))
        return state.SkipWithError("the scene could not be opened");
    for (const int block : {0, 1})
        (void)edit(stage, block); // what is drawn for the first time
    JobManager& jobs = stage.session.jobs;
    const ThreadLimit limit(static_cast<int>(state.range(0)));
    stage.session.bakes.start(transferOfFiveBands(16384),
                              JobPriority::Low); // longer than anyone waits here
    const auto rays = [&] { return jobs.jobs().back().progress.workDone; };
    if (!WindowStage::eventually([&] { return rays() > 0.0; }))
        return state.SkipWithError("the bake does not run");
    const quint64 bake = jobs.jobs().back().id;
    std::vector<double> pausing, baking;
    double traced = 0.0, seconds = 0.0;
    int block = 0;
    for (auto _ : state) {
        jobs.pause(bake);
        for (double before = -1.0; before != rays();) { // ranges under way come to their end
            before = rays();
            QTest::qWait(kQuiet);
        }
        const std::vector<double> first = edit(stage, block);
        jobs.resume(bake);
        QTest::qWait(kQuiet);
        const double start = WindowStage::clockMs(CLOCK_MONOTONIC), known = rays();
        const std::vector<double> second = edit(stage, block++);
        seconds += (WindowStage::clockMs(CLOCK_MONOTONIC) - start) * 1e-3;
        traced += rays() - known;
        pausing.insert(pausing.end(), first.begin(), first.end());
        baking.insert(baking.end(), second.begin(), second.end());
    }
    jobs.cancelAll();
    (void)WindowStage::eventually([&] { return jobs.runningCount() == 0; });
    state.counters["pausing_median_ms"] = quantile(pausing, 0.5);
    state.counters["pausing_p95_ms"] = quantile(pausing, 0.95);
    state.counters["baking_median_ms"] = quantile(baking, 0.5);
    state.counters["baking_p95_ms"] = quantile(baking, 0.95);
    state.counters["within_1.5x_percent"] = shareWithin(baking, pausing);
    state.counters["the_other_way_percent"] = shareWithin(pausing, baking);
    state.counters["million_rays_per_s"] = traced / seconds * 1e-6;
}

} // namespace

void registerBakeEditBenchmarks(WindowStage& stage) {
    benchmark::RegisterBenchmark("editDuringBake",
                                 [&](benchmark::State& s) { editDuringBake(s, stage); })
        ->ArgName("threads")
        ->Arg(1)
        ->Arg(2)
        ->Iterations(kBlocks)
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
}

} // namespace patina::editor
