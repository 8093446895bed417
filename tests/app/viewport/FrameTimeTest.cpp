// How fluid the viewport is: frame times are printed, not asserted, for they depend on the machine.
// FigureSize.h says how to get figures worth reading, at 1280 × 720.

#include "tests/app/editor/EditorFixture.h"
#include "tests/app/viewport/FigureSize.h"

#include "app/editor/viewport/ViewState.h"
#include "core/document/Views.h"
#include "core/edit/EditSession.h"
#include "core/library/Library.h"

#include <QElapsedTimer>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <fmt/format.h>
#include <string>
#include <utility>
#include <vector>

namespace patina::editor {
namespace {

class FrameTimeTest : public EditorTest {
  protected:
    static ViewportWidget& viewport() { return window->viewport(); }

    // Five maps, the studio's light and four lights.
    static void openLit(const QString& model) {
        viewport().setFixedSize(figureSize().viewport);
        controller().openScene(model);
        ASSERT_TRUE(settled(*session));
        const Id material = document().materials.front().id;
        const Material maps = library::material("worn-painted-metal").value();
        for (const auto& [name, slot] :
             {std::pair("material.baseColor.map", &maps.baseColorMap),
              std::pair("material.metallic.map", &maps.metallicMap),
              std::pair("material.perceptualRoughness.map", &maps.perceptualRoughnessMap),
              std::pair("material.normal.map", &maps.normalMap),
              std::pair("material.occlusion.map", &maps.occlusionMap)})
            controller().setMap(*findParameter(name), Target{Scope::Material, material},
                                QString::fromStdString(slot->source));
        ASSERT_TRUE(settled(*session));
        for (int i = 0; i < 4; ++i)
            controller().addLight(i < 2 ? LightType::Point : LightType::Directional);
    }
    // 100,352 triangles: reduced frames draw fewer.
    static void openLitKnot() {
        openLit(QStringLiteral("builtin:torus-knot"));
        ASSERT_GT(document().triangleCount(), 100'000u);
    }
};

double clockMs(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

// Orbits with the left button held for some time and prints the frames it took.
class Drag {
  public:
    Drag(ViewportWidget& viewport, const char* name)
        : m_viewport(viewport)
        , m_name(name)
        , m_connection(QObject::connect(&viewport, &ViewportWidget::frameRendered, &viewport,
                                        [this](double ms) { frame(ms); })) {}

    void run(int milliseconds) {
        const QPoint center = m_viewport.rect().center();
        QTest::mousePress(&m_viewport, Qt::LeftButton, Qt::NoModifier, center);
        QElapsedTimer clock;
        clock.start();
        const double cpu = clockMs(CLOCK_PROCESS_CPUTIME_ID);
        m_lastThread = clockMs(CLOCK_THREAD_CPUTIME_ID);
        m_sinceFrame.start();
        for (int i = 0; clock.elapsed() < milliseconds; ++i) {
            const std::size_t frames = m_times.size();
            const int x = i % 160 < 80 ? i % 160 : 160 - i % 160;
            QTest::mouseMove(&m_viewport, center + QPoint(10 + x, i % 7)); // more than a click
            ASSERT_TRUE(eventually([&] { return m_times.size() > frames; }));
            m_width = std::min(m_width, m_viewport.frameSize().width());
        }
        const double seconds = static_cast<double>(clock.elapsed()) * 1e-3;
        const double cpuMs = clockMs(CLOCK_PROCESS_CPUTIME_ID) - cpu;
        QTest::mouseRelease(&m_viewport, Qt::LeftButton, Qt::NoModifier, center);
        ASSERT_FALSE(m_times.empty());
        std::vector<double> sorted = m_times;
        std::sort(sorted.begin(), sorted.end());
        const auto quantile = [&](double q) {
            return sorted[static_cast<std::size_t>(q * static_cast<double>(sorted.size() - 1))];
        };
        std::printf(
            "[ figures  ] %s: %.1f frames/s; a frame takes %.1f ms (median), %.1f ms (95th "
            "percentile), %.1f ms (slowest), %.1f ms of processor time; from frame to frame at "
            "most "
            "%.1f ms pass, and the window's thread computes for %.1f ms; coarsest width %d\n",
            m_name, static_cast<double>(sorted.size()) / seconds, quantile(0.5), quantile(0.95),
            sorted.back(), cpuMs / static_cast<double>(sorted.size()), m_longestGap,
            m_longestThread, m_width);
    }
    ~Drag() { QObject::disconnect(m_connection); }
    [[nodiscard]] int coarsestWidth() const { return m_width; }

  private:
    void frame(double ms) {
        m_times.push_back(ms);
        if (!m_sinceFrame.isValid())
            return;
        m_longestGap =
            std::max(m_longestGap, static_cast<double>(m_sinceFrame.nsecsElapsed()) * 1e-6);
        m_sinceFrame.start();
        const double thread = clockMs(CLOCK_THREAD_CPUTIME_ID);
        m_longestThread = std::max(m_longestThread, thread - m_lastThread);
        m_lastThread = thread;
    }

    ViewportWidget& m_viewport;
    const char* m_name;
    std::vector<double> m_times;
    QElapsedTimer m_sinceFrame;
    double m_lastThread = 0.0, m_longestGap = 0.0, m_longestThread = 0.0; // milliseconds
    int m_width = 1 << 16;
    QMetaObject::Connection m_connection;
};

TEST_F(FrameTimeTest, ADragIsFluidAndRestIsSharp) {
    openLitKnot();
    const QSize full = viewport().size() * viewport().devicePixelRatioF();
    ASSERT_TRUE(eventually([&] { return viewport().frameSize() == full; }));
    Drag drag(viewport(), "dragging");
    drag.run(figureSize().dragMs);
    EXPECT_LE(drag.coarsestWidth(), full.width());
    EXPECT_TRUE(eventually([&] { return viewport().frameSize() == full; })) << "refines at rest";
}

TEST_F(FrameTimeTest, AnEnvironmentArrivesWhileTheHandMoves) {
    openLitKnot();
    Drag(viewport(), "dragging before").run(figureSize().dragMs / 3);
    controller().setEnvironment(QStringLiteral("builtin:sunset"));
    Drag(viewport(), "while an environment arrives").run(figureSize().dragMs);
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(document().environment.source, "builtin:sunset");
}

// --- What is new to the driver: set MESA_SHADER_CACHE_DIR to an empty folder for a first time ----

class NewViewsTest : public FrameTimeTest {
  protected:
    static void SetUpTestSuite() {
        FrameTimeTest::SetUpTestSuite();
        openLit(figureSize().model);
    }
    void SetUp() override {} // one document for all

    // At rest, with everything compiled; prints what it took.
    static void settle(const char* what) {
        viewport().takeSlowestFrameMs();
        QElapsedTimer clock;
        clock.start();
        const QSize full = viewport().size() * viewport().devicePixelRatioF();
        int idle = 0; // looks in a row at which nothing is left to do
        const auto rests = [&] {
            const bool busy = viewport().waitsForPrograms() || viewport().compilesPrograms() ||
                              viewport().frameSize() != full;
            idle = busy ? 0 : idle + 1;
            return idle > 60;
        };
        ASSERT_TRUE(QTest::qWaitFor(rests, 240'000)); // low priority, on a busy machine
        std::printf("[ figures  ] %s: all compiled after %lld ms, slowest frame %.0f ms\n", what,
                    static_cast<long long>(clock.elapsed()), viewport().takeSlowestFrameMs());
    }
    // The next frame of `act`: its time, and what the window's thread computed meanwhile.
    struct Figures {
        double slowestMs = 0.0, threadMs = 0.0;
        qint64 shownAfterMs = 0;
    };
    template <class Act>
    static Figures watch(Act act) {
        viewport().takeSlowestFrameMs();
        int frames = 0;
        double longestThread = 0.0, lastThread = clockMs(CLOCK_THREAD_CPUTIME_ID);
        const auto counting =
            QObject::connect(&viewport(), &ViewportWidget::frameRendered, &viewport(), [&] {
                frames = viewport().waitsForPrograms() ? 0 : frames + 1;
                const double thread = clockMs(CLOCK_THREAD_CPUTIME_ID);
                longestThread = std::max(longestThread, thread - std::exchange(lastThread, thread));
            });
        QElapsedTimer clock;
        clock.start();
        act();
        viewport().update(); // also of what is shown already
        EXPECT_TRUE(eventually([&] { return frames > 0; }));
        QObject::disconnect(counting);
        return {viewport().takeSlowestFrameMs(), longestThread, clock.elapsed()};
    }
    static void switchThroughAll(const char* what) {
        std::vector<std::pair<double, std::string>> slowest;
        for (const ViewInfo& info : views()) {
            const Figures figures = watch([&] { session->views.show(info.kind); });
            slowest.emplace_back(figures.threadMs,
                                 fmt::format("{}: frame {:.0f} ms, shown after {} ms", info.id,
                                             figures.slowestMs, figures.shownAfterMs));
        }
        std::sort(slowest.rbegin(), slowest.rend());
        for (std::size_t i = 0; i < 4; ++i)
            std::printf("[ figures  ] %s, %zu views: %.0f ms of the window's thread (%s)\n", what,
                        slowest.size(), slowest[i].first, slowest[i].second.c_str());
        session->views.set({});
    }
};

TEST_F(NewViewsTest, AtOnceAndOnceTheyAreCompiled) {
    const Figures first = watch([&] { session->views.show(shading::kViewNoV); });
    std::printf("[ figures  ] the first view, before anything was compiled: frames of at most "
                "%.0f ms (%.0f ms of the window's thread), shown after %lld ms\n",
                first.slowestMs, first.threadMs, static_cast<long long>(first.shownAfterMs));
    EXPECT_FALSE(session->views.preparing());
    session->views.set({});
    settle("at rest");
    switchThroughAll("compiled in the background");
    (void)controller().addLight(LightType::Directional);
    settle("a shadowed light later");
    switchThroughAll("with a shadowed light");
}

} // namespace
} // namespace patina::editor
