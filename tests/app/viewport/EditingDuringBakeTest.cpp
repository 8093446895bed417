// Whether the editor stays fluid while a bake runs at low priority: the same edits, an orbit and a
// drag of a slider, while a bake runs and while it rests. Times are printed, not asserted, for they
// depend on the machine; FigureSize.h says how to get figures worth reading.

#include "tests/app/editor/EditorFixture.h"
#include "tests/app/viewport/FigureSize.h"

#include "app/editor/job/BakeRunner.h"
#include "app/editor/panel/ParameterRow.h"
#include "app/editor/widget/Slider.h"
#include "core/job/Parallel.h"

#include <QElapsedTimer>
#include <QFile>
#include <QTimer>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <string>
#include <vector>

namespace patina::editor {
namespace {

constexpr double kSlower = 1.5;

// A torus with bumps that shadow each other.
std::string bumpyTorusObj(int side) {
    const double step = 2.0 * 3.14159265358979323846 / side;
    std::string text;
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j) {
            const double u = i * step, v = j * step;
            const double tube = 0.4 + 0.05 * std::sin(12.0 * u) * std::sin(5.0 * v);
            const double around = 1.0 + tube * std::cos(v);
            text += fmt::format("v {:.5f} {:.5f} {:.5f}\n", around * std::cos(u),
                                tube * std::sin(v), -around * std::sin(u));
        }
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j) {
            const int right = (i + 1) % side, up = (j + 1) % side;
            text += fmt::format("f {} {} {} {}\n", i * side + j + 1, right * side + j + 1,
                                right * side + up + 1, i * side + up + 1);
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

using Times = std::vector<double>; // of the edits, in their order, ms

double quantile(Times times, double q) {
    std::sort(times.begin(), times.end());
    return times[static_cast<std::size_t>(std::lround(q * static_cast<double>(times.size() - 1)))];
}

// The share of times within 1.5 times the others', edit by edit.
double shareWithin(const Times& times, const Times& others) {
    std::size_t within = 0;
    for (std::size_t i = 0; i < times.size(); ++i)
        within += times[i] <= kSlower * others[i] ? 1 : 0;
    return 100.0 * static_cast<double>(within) / static_cast<double>(times.size());
}

class EditingDuringABake : public EditorTest {
  protected:
    static ViewportWidget& viewport() { return window->viewport(); }

    void open() {
        viewport().setFixedSize(m_size.viewport);
        const QString path = folder.filePath(QStringLiteral("torus.obj"));
        QFile file(path);
        ASSERT_TRUE(file.open(QIODevice::WriteOnly));
        const std::string text = bumpyTorusObj(m_size.torusSide);
        file.write(text.data(), static_cast<qint64>(text.size()));
        file.close();
        controller().openScene(path);
        ASSERT_TRUE(settled(*session));
        ASSERT_GE(document().meshes.front().mesh->vertexCount(),
                  static_cast<std::size_t>(m_size.torusSide * m_size.torusSide));
        // With a bake attached, the picture costs the same before the next one and during it.
        BakeRunner runner(controller(), session->jobs);
        runner.start(transferOfFiveBands(32));
        ASSERT_TRUE(eventually([] { return document().bakes.size() == 1; }));
        ASSERT_TRUE(eventually([] { return session->jobs.runningCount() == 0; }));
    }
    void rest() const {
        const QSize full = viewport().size() * viewport().devicePixelRatioF();
        ASSERT_TRUE(eventually(
            [&] { return viewport().frameSize() == full && !viewport().waitsForPrograms(); }));
        if (!m_size.compiled)
            return;
        const auto compiled = [] { return !viewport().compilesPrograms(); };
        ASSERT_TRUE(QTest::qWaitFor(compiled, 240'000)); // low priority, on a busy machine
        QTest::qWait(300);
    }

    // What the user sees of `act`: until its frame is drawn and the window put together.
    template <class Act>
    static double until(int& frames, Act act) {
        const int before = frames;
        QTimer tooLong; // wakes the loop below
        tooLong.start(30'000);
        QElapsedTimer clock;
        clock.start();
        act();
        while (frames == before && clock.elapsed() < 30'000)
            QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
        EXPECT_GT(frames, before);
        return static_cast<double>(clock.nsecsElapsed()) * 1e-6;
    }

    // An orbit and back, and the roughness up and down, with the button held: piece `block` of it.
    Times edit(int block) const {
        int frames = 0;
        QObject counter; // its end ends the connection
        QObject::connect(&viewport(), &ViewportWidget::frameRendered, &counter, [&] { ++frames; });
        Times times;
        if (block % 2 == 0) {
            const QPoint middle = viewport().rect().center();
            QTest::mousePress(&viewport(), Qt::LeftButton, Qt::NoModifier, middle);
            for (int i = 1; i <= m_size.steps; ++i)
                times.push_back(until(frames, [&] {
                    QTest::mouseMove(&viewport(),
                                     middle + QPoint(10 + 8 * std::min(i, m_size.steps - i), i));
                }));
            QTest::mouseRelease(&viewport(), Qt::LeftButton, Qt::NoModifier, middle);
            return times;
        }
        Slider* slider = nullptr;
        for (const ParameterRow* row : window->findChildren<ParameterRow*>())
            if (row->info().id == "material.perceptualRoughness")
                slider = row->findChild<Slider*>();
        if (slider == nullptr) {
            ADD_FAILURE() << "no slider";
            return times;
        }
        const int x = slider->handleX(), y = slider->height() / 2;
        QTest::mousePress(slider, Qt::LeftButton, Qt::NoModifier, {x, y});
        for (int i = 1; i <= m_size.steps; ++i)
            times.push_back(until(frames, [&] {
                QTest::mouseMove(slider, {i % 2 == 0 ? x - i : x + 4 + i, y});
            }));
        QTest::mouseRelease(slider, Qt::LeftButton, Qt::NoModifier, {x, y});
        return times;
    }

    const FigureSize m_size = figureSize();

    static double rays() { return session->jobs.jobs().back().progress.workDone; }

    struct Pairs {
        Times resting, baking; // of the same edits
    };

    // Edits with a bake that rests and with one that runs on so many threads, by turns: what else
    // the machine does touches both.
    Pairs editByTurns(int threads) const {
        const ThreadLimit limit(threads);
        BakeRunner runner(controller(), session->jobs);
        runner.start(transferOfFiveBands(16384), JobPriority::Low); // longer than anyone waits here
        EXPECT_TRUE(eventually([] { return rays() > 0.0; }));
        const quint64 bake = session->jobs.jobs().back().id;
        Pairs pairs;
        double traced = 0.0, seconds = 0.0;
        // Few short edits may pass while a busy machine traces nothing: then they go on for a
        // minute.
        QElapsedTimer sinceBegin;
        sinceBegin.start();
        for (int block = 0;
             block < m_size.blocks || (traced == 0.0 && sinceBegin.elapsed() < 60'000); ++block) {
            session->jobs.pause(bake);
            for (double before = -1.0; before != rays();) { // ranges under way come to their end
                before = rays();
                QTest::qWait(m_size.quietMs);
            }
            const Times resting = edit(block);
            session->jobs.resume(bake);
            QTest::qWait(m_size.quietMs);
            const double first = rays();
            QElapsedTimer clock;
            clock.start();
            const Times baking = edit(block);
            seconds += static_cast<double>(clock.elapsed()) * 1e-3;
            traced += rays() - first;
            pairs.resting.insert(pairs.resting.end(), resting.begin(), resting.end());
            pairs.baking.insert(pairs.baking.end(), baking.begin(), baking.end());
        }
        std::printf("[ figures  ] the bake on %d thread%s traced %.2f M rays/s between frames\n",
                    threads, threads == 1 ? "" : "s", traced / seconds * 1e-6);
        EXPECT_GT(traced, 0.0) << "the bake goes on, too";
        session->jobs.cancelAll();
        EXPECT_TRUE(eventually([] { return session->jobs.runningCount() == 0; }));
        return pairs;
    }
};

TEST_F(EditingDuringABake, StaysFluid) {
    open();
    rest();
    for (const int block : {0, 1})
        (void)edit(block); // what is drawn for the first time
    for (const int threads : {1, 2}) {
        rest();
        const Pairs pairs = editByTurns(threads);
        ASSERT_EQ(pairs.resting.size(), pairs.baking.size());
        ASSERT_GE(pairs.baking.size(), static_cast<std::size_t>(m_size.blocks * m_size.steps));
        std::printf("[ figures  ] frames while a bake on %d thread%s rests: %.1f ms (median), %.1f "
                    "ms (95th percentile); runs: %.1f ms and %.1f ms; %.1f %% within %.1f times "
                    "the same edit's time while it rests (%.1f %% the other way round)\n",
                    threads, threads == 1 ? "" : "s", quantile(pairs.resting, 0.5),
                    quantile(pairs.resting, 0.95), quantile(pairs.baking, 0.5),
                    quantile(pairs.baking, 0.95), shareWithin(pairs.baking, pairs.resting), kSlower,
                    shareWithin(pairs.resting, pairs.baking));
    }
}

} // namespace
} // namespace patina::editor
