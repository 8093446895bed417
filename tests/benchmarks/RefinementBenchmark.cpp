// How long the viewport keeps input waiting while it refines its picture at rest: the window's
// thread is watched from the end of a drag on. PATINA_REFINED_SCENE: a file or built-in scene;
// PATINA_REFINED_WINDOW and PATINA_REFINED_SIZE: of the window and of the viewport in it, e.g.
// 1920x1080; PATINA_REFINED_VIEW: the view to show, or "split".
#include "tests/benchmarks/WindowStage.h"

#include "app/editor/viewport/ViewState.h"
#include "core/document/Views.h"

#include <QEventLoop>
#include <QTimer>
#include <fmt/format.h>

namespace patina::editor {
namespace {

// A turn of the event loop: what comes after it began waits until it has ended.
struct Turn {
    double wallMs = 0.0;
    double threadMs = 0.0,
           processMs = 0.0;              // of processors: what else the machine does is not in it
    double paintMs = 0.0, sheetMs = 0.0; // of which frames and thumbnails took
};

// Beats as often as the event loop lets it.
class Watch {
  public:
    explicit Watch(ViewportWidget& viewport) {
        QObject::connect(&viewport.sheets(), &SheetScheduler::passDrawn, &m_beat,
                         [this](int, double ms) { m_turn.sheetMs += ms; });
        QObject::connect(&m_beat, &QTimer::timeout, &m_beat,
                         [&, this] { end(viewport.takeSlowestFrameMs()); });
        viewport.takeSlowestFrameMs();
        begin();
        m_beat.start(1);
    }
    // Handles events as a program does, until `condition` holds; false after five minutes.
    template <class Condition>
    [[nodiscard]] bool run(Condition condition) {
        QEventLoop loop;
        QTimer limit;
        limit.setSingleShot(true);
        QObject::connect(&limit, &QTimer::timeout, &loop, [&] { loop.exit(1); });
        const auto beat = QObject::connect(&m_beat, &QTimer::timeout, &loop, [&] {
            if (condition())
                loop.exit(0);
        });
        limit.start(300'000);
        const bool held = loop.exec() == 0;
        QObject::disconnect(beat);
        return held;
    }
    [[nodiscard]] const std::vector<Turn>& turns() const { return m_turns; }
    [[nodiscard]] Turn longest() const {
        return *std::max_element(m_turns.begin(), m_turns.end(),
                                 [](const Turn& a, const Turn& b) { return a.wallMs < b.wallMs; });
    }

  private:
    void begin() {
        m_turn = {WindowStage::clockMs(CLOCK_MONOTONIC),
                  WindowStage::clockMs(CLOCK_THREAD_CPUTIME_ID),
                  WindowStage::clockMs(CLOCK_PROCESS_CPUTIME_ID), 0.0, 0.0};
    }
    void end(double paintMs) {
        m_turns.push_back({WindowStage::clockMs(CLOCK_MONOTONIC) - m_turn.wallMs,
                           WindowStage::clockMs(CLOCK_THREAD_CPUTIME_ID) - m_turn.threadMs,
                           WindowStage::clockMs(CLOCK_PROCESS_CPUTIME_ID) - m_turn.processMs,
                           paintMs, m_turn.sheetMs});
        begin();
    }

    QTimer m_beat;
    Turn m_turn;
    std::vector<Turn> m_turns;
};

QSize pixels(const char* variable) {
    const QStringList sides = qEnvironmentVariable(variable).split('x');
    return {sides.value(0).toInt(), sides.value(1).toInt()};
}

// An iteration is the time from the end of a drag to the refined picture.
void refineAfterADrag(benchmark::State& state, WindowStage& stage) {
    ViewportWidget& viewport = stage.viewport();
    const QSize window = pixels("PATINA_REFINED_WINDOW"), size = pixels("PATINA_REFINED_SIZE");
    if (!window.isEmpty())
        stage.window.resize(window);
    if (!size.isEmpty() || window.isEmpty())
        viewport.setFixedSize(size.isEmpty() ? QSize(1280, 720) : size);
    if (!stage.open(
            qEnvironmentVariable("PATINA_REFINED_SCENE", QStringLiteral("builtin:shader-ball"))))
        return state.SkipWithError("the scene could not be opened");
    if (const QString view = qEnvironmentVariable("PATINA_REFINED_VIEW");
        view == QLatin1String("split"))
        stage.session.views.edit([](render::ViewSettings& s) { s.split.emplace(); });
    else if (const ViewInfo* info = view.isEmpty() ? nullptr : findView(view.toStdString()))
        stage.session.views.show(info->kind);
    if (!stage.rests())
        return state.SkipWithError("the picture does not come to rest");
    Turn longest;
    std::size_t above50 = 0;
    for (auto _ : state) {
        const QPoint center = viewport.rect().center();
        state.PauseTiming();
        QTest::mousePress(&viewport, Qt::LeftButton, Qt::NoModifier, center);
        for (int i = 1; i <= 24; ++i)
            (void)stage.untilFrame([&] { QTest::mouseMove(&viewport, center + QPoint(6 * i, i)); });
        QTest::mouseRelease(&viewport, Qt::LeftButton, Qt::NoModifier, center + QPoint(144, 24));
        state.ResumeTiming();
        Watch watch(viewport);
        if (!watch.run([&] { return viewport.isSettled(); })) {
            state.SkipWithError("the picture is not refined");
            break;
        }
        if (watch.longest().wallMs > longest.wallMs)
            longest = watch.longest();
        above50 += static_cast<std::size_t>(
            std::count_if(watch.turns().begin(), watch.turns().end(),
                          [](const Turn& turn) { return turn.wallMs > 50.0; }));
    }
    stage.session.views.set({});
    state.counters["longest_turn_ms"] = longest.wallMs;
    state.counters["its_thread_ms"] = longest.threadMs;
    state.counters["its_process_ms"] = longest.processMs;
    state.counters["its_frame_ms"] = longest.paintMs;
    state.counters["its_thumbnails_ms"] = longest.sheetMs;
    state.counters["turns_above_50_ms"] = static_cast<double>(above50);
    state.SetLabel(fmt::format("window {} x {}, viewport {} x {}", stage.window.width(),
                               stage.window.height(), viewport.width(), viewport.height()));
}

} // namespace

void registerRefinementBenchmarks(WindowStage& stage) {
    benchmark::RegisterBenchmark("refineAfterADrag",
                                 [&](benchmark::State& s) { refineAfterADrag(s, stage); })
        ->Iterations(3)
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
}

} // namespace patina::editor
