// How long the viewport keeps input waiting while it refines its picture at rest: the window's
// thread is watched from the end of a drag on. Figures are printed, not asserted, for they depend
// on the machine. PATINA_REFINED_SCENE: a file or built-in scene; PATINA_REFINED_WINDOW and
// PATINA_REFINED_SIZE: of the window and of the viewport in it, e.g. 1920x1080;
// PATINA_REFINED_VIEW: the view to show, or "split"; PATINA_REFINED_RUNS: how many drags.

#include "tests/app/editor/EditorFixture.h"
#include "tests/app/viewport/FigureSize.h"

#include "app/editor/viewport/ViewState.h"
#include "core/document/Views.h"

#include <QElapsedTimer>
#include <QEventLoop>
#include <QTimer>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <vector>

namespace patina::editor {
namespace {

double clockMs(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

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
        QObject::connect(&viewport, &ViewportWidget::frameRendered, &m_beat,
                         [this] { ++m_frames; });
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
    [[nodiscard]] int frames() const { return m_frames; }
    [[nodiscard]] std::vector<Turn> turns() const {
        std::vector<Turn> sorted = m_turns;
        std::sort(sorted.begin(), sorted.end(),
                  [](const Turn& a, const Turn& b) { return a.wallMs > b.wallMs; });
        return sorted;
    }

  private:
    void begin() {
        m_turn = {clockMs(CLOCK_MONOTONIC), clockMs(CLOCK_THREAD_CPUTIME_ID),
                  clockMs(CLOCK_PROCESS_CPUTIME_ID), 0.0, 0.0};
    }
    void end(double paintMs) {
        m_turns.push_back({clockMs(CLOCK_MONOTONIC) - m_turn.wallMs,
                           clockMs(CLOCK_THREAD_CPUTIME_ID) - m_turn.threadMs,
                           clockMs(CLOCK_PROCESS_CPUTIME_ID) - m_turn.processMs, paintMs,
                           m_turn.sheetMs});
        begin();
    }

    QTimer m_beat;
    Turn m_turn;
    std::vector<Turn> m_turns;
    int m_frames = 0;
};

class RefinementTimeTest : public EditorTest {
  protected:
    static ViewportWidget& viewport() { return window->viewport(); }

    static QSize pixels(const char* variable) {
        const QStringList sides = qEnvironmentVariable(variable).split('x');
        return {sides.value(0).toInt(), sides.value(1).toInt()};
    }
    static void print(const char* what, const Turn& turn) {
        std::printf(
            "[ figures  ]   %s %.0f ms (processor: %.0f ms of the window's thread, %.0f ms of "
            "all; frame or slice %.0f ms, thumbnails %.0f ms)\n",
            what, turn.wallMs, turn.threadMs, turn.processMs, turn.paintMs, turn.sheetMs);
    }
};

TEST_F(RefinementTimeTest, FromTheEndOfADragToTheRefinedPicture) {
    const QSize windowSize = pixels("PATINA_REFINED_WINDOW");
    QSize size = pixels("PATINA_REFINED_SIZE");
    const bool chosen = !windowSize.isEmpty() || !size.isEmpty();
    if (!windowSize.isEmpty())
        window->resize(windowSize);
    if (!chosen)
        size = figureSize().viewport;
    if (!size.isEmpty())
        viewport().setFixedSize(size);
    controller().openScene(
        qEnvironmentVariable("PATINA_REFINED_SCENE",
                             chosen ? QStringLiteral("builtin:shader-ball") : figureSize().model));
    ASSERT_TRUE(QTest::qWaitFor([] { return !controller().tasks().busy(); }, 300'000));
    if (const QString view = qEnvironmentVariable("PATINA_REFINED_VIEW");
        view == QLatin1String("split"))
        session->views.edit([](render::ViewSettings& s) { s.split.emplace(); });
    else if (const ViewInfo* info = view.isEmpty() ? nullptr : findView(view.toStdString()))
        session->views.show(info->kind);
    PictureState state = PictureState::Moving;
    QObject here;
    QObject::connect(&viewport(), &ViewportWidget::frameRendered, &here,
                     [&](double, PictureState now) { state = now; });
    const auto refined = [&] {
        return viewport().isSettled() && state == PictureState::Refined &&
               !viewport().compilesPrograms();
    };
    ASSERT_TRUE(QTest::qWaitFor(refined, 300'000));
    const int runs = qEnvironmentVariableIntValue("PATINA_REFINED_RUNS");
    for (int run = 0; run < std::max(runs, 1); ++run) {
        const QPoint center = viewport().rect().center();
        QTest::mousePress(&viewport(), Qt::LeftButton, Qt::NoModifier, center);
        std::vector<Turn> moving;
        {
            Watch watch(viewport());
            for (int i = 1; i <= 24; ++i) {
                const int frames = watch.frames();
                QTest::mouseMove(&viewport(), center + QPoint(6 * i, i));
                ASSERT_TRUE(watch.run([&] { return watch.frames() > frames; }));
            }
            moving = watch.turns();
        }
        QTest::mouseRelease(&viewport(), Qt::LeftButton, Qt::NoModifier, center + QPoint(144, 24));
        QElapsedTimer all;
        all.start();
        Watch watch(viewport());
        ASSERT_TRUE(watch.run(refined));
        const std::vector<Turn> turns = watch.turns();
        ASSERT_GE(turns.size(), 4u);
        std::printf(
            "[ figures  ] window %d x %d, viewport %d x %d: refined %lld ms after the drag, "
            "%d frames; input waited longer than 50 ms %lld times, at most\n",
            window->width(), window->height(), viewport().width(), viewport().height(),
            static_cast<long long>(all.elapsed()), watch.frames(),
            static_cast<long long>(std::count_if(turns.begin(), turns.end(),
                                                 [](const Turn& t) { return t.wallMs > 50.0; })));
        for (std::size_t i = 0; i < 4; ++i)
            print("-", turns[i]);
        if (!moving.empty())
            print("while it moved at most", moving.front());
    }
    session->views.set({});
}

} // namespace
} // namespace patina::editor
