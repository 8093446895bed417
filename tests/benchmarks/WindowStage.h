// The editor's window for benchmarks: run them through tests/support/with-xvfb, with nothing else
// running. What is measured is what a user waits for, Qt's part included.
#pragma once

#include "app/editor/MainWindow.h"
#include "app/editor/Session.h"
#include "app/editor/viewport/ViewportWidget.h"

#include <QTest>
#include <algorithm>
#include <benchmark/benchmark.h>
#include <cmath>
#include <ctime>
#include <vector>

namespace patina::editor {

struct WindowStage {
    Session session;
    MainWindow window{session};

    [[nodiscard]] ViewportWidget& viewport() { return window.viewport(); }
    [[nodiscard]] DocumentController& controller() { return session.controller; }
    [[nodiscard]] const Document& document() { return session.controller.document(); }

    // False after five minutes.
    template <class Condition>
    [[nodiscard]] static bool eventually(Condition condition) {
        return QTest::qWaitFor(condition, 300'000);
    }
    [[nodiscard]] bool open(const QString& scene) {
        controller().openScene(scene);
        return eventually([&] { return !controller().tasks().busy(); });
    }
    // As fine as it gets, with even what nobody waits for compiled.
    [[nodiscard]] bool rests() {
        return eventually([&] { return viewport().isSettled() && !viewport().compilesPrograms(); });
    }
    // From what `act` does until the next frame is drawn: milliseconds, below 0 where none came.
    template <class Act>
    [[nodiscard]] double untilFrame(Act act) {
        bool drawn = false;
        QObject here; // its end ends the connection
        QObject::connect(&viewport(), &ViewportWidget::frameRendered, &here, [&] { drawn = true; });
        const double start = clockMs(CLOCK_MONOTONIC);
        act();
        return eventually([&] { return drawn; }) ? clockMs(CLOCK_MONOTONIC) - start : -1.0;
    }
    [[nodiscard]] static double clockMs(clockid_t clock) {
        timespec now{};
        clock_gettime(clock, &now);
        return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
    }
};

inline double quantile(std::vector<double> times, double q) {
    std::sort(times.begin(), times.end());
    return times[static_cast<std::size_t>(std::lround(q * static_cast<double>(times.size() - 1)))];
}

// Each registers what it measures; `stage` outlives the benchmarks.
void registerFrameBenchmarks(WindowStage& stage);
void registerBakeEditBenchmarks(WindowStage& stage);
void registerComparisonBenchmarks(WindowStage& stage);
void registerRefinementBenchmarks(WindowStage& stage);

} // namespace patina::editor
