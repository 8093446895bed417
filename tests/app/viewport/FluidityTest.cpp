// What a drag may rely on: every move is shown before the next, whatever else goes on, and what
// goes on is not held up by the drag. How long frames take is for benchmarks (bench_window).

#include "core/document/ViewChoices.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "tests/app/editor/EditorFixture.h"

#include "app/editor/job/BakeService.h"
#include "app/editor/panel/ParameterRow.h"
#include "app/editor/viewport/IblUpdater.h"
#include "app/editor/widget/Slider.h"
#include "core/bake/Bake.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/edit/EditSession.h"
#include "core/job/Parallel.h"
#include "core/library/Library.h"

#include <QElapsedTimer>
#include <QSignalSpy>
#include <algorithm>
#include <utility>
#include <vector>

namespace patina::editor {
namespace {

class FluidityTest : public EditorTest {
  protected:
    void SetUp() override {
        EditorTest::SetUp();
        viewport().setFixedSize(480, 270);
        QObject::connect(&viewport(), &ViewportWidget::frameRendered, &m_here,
                         [this](double, PictureState state) { m_frames.push_back(state); });
    }
    static ViewportWidget& viewport() { return window->viewport(); }
    static QPoint center() { return viewport().rect().center(); }
    static QSize full() { return viewport().size() * viewport().devicePixelRatioF(); }
    static bool rests() {
        return eventually([] { return viewport().isSettled(); });
    }
    // Five maps, the studio's light and four lights.
    static void openLitSphere() {
        controller().openScene(QStringLiteral("builtin:sphere"));
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
        ASSERT_TRUE(rests());
    }
    // One more move of the orbit with the button held; its frame is drawn before anything else.
    void moveOn() {
        const std::size_t frames = m_frames.size();
        const int i = ++m_moves;
        QTest::mouseMove(&viewport(), center() + QPoint(10 + i % 80, i % 7)); // more than a click
        ASSERT_TRUE(eventually([&] { return m_frames.size() > frames; })) << i;
    }
    static Slider* roughness() {
        for (const ParameterRow* row : window->findChildren<ParameterRow*>())
            if (row->info().id == "material.perceptualRoughness")
                return row->findChild<Slider*>();
        return nullptr;
    }

    std::vector<PictureState> m_frames;
    int m_moves = 0;
    QObject m_here;
};

TEST_F(FluidityTest, EveryMoveOfADragIsShownAndRestIsSharp) {
    openLitSphere();
    const int steps = undoCount();
    QTest::mousePress(&viewport(), Qt::LeftButton, Qt::NoModifier, center());
    m_frames.clear();
    for (int i = 0; i < 12; ++i) {
        const float yaw = document().view.camera.yawDeg;
        ASSERT_NO_FATAL_FAILURE(moveOn());
        EXPECT_NE(document().view.camera.yawDeg, yaw);
        EXPECT_LE(viewport().frameSize().width(), full().width());
    }
    for (const PictureState state : m_frames)
        EXPECT_EQ(state, PictureState::Moving) << "nothing is refined while the button is held";
    QTest::mouseRelease(&viewport(), Qt::LeftButton, Qt::NoModifier, center());
    ASSERT_TRUE(rests());
    EXPECT_EQ(viewport().frameSize(), full());
    EXPECT_EQ(m_frames.back(), PictureState::Refined);
    EXPECT_EQ(undoCount(), steps) << "looking is no edit";
}

TEST_F(FluidityTest, AnEnvironmentArrivesWhileTheButtonIsHeld) {
    openLitSphere();
    QSignalSpy light(&session->ibl, &IblUpdater::ready);
    const auto sky = [] { return viewport().grabFramebuffer().pixel(4, 4); };
    QTest::mousePress(&viewport(), Qt::LeftButton, Qt::NoModifier, center());
    m_frames.clear();
    ASSERT_NO_FATAL_FAILURE(moveOn());
    controller().setParameter(parameter("environment.background"), {Scope::Environment, 0},
                              static_cast<int>(BackgroundMode::Environment));
    controller().setEnvironment(QStringLiteral("builtin:sunset"));
    const QRgb old = sky();
    QElapsedTimer clock;
    clock.start();
    while ((light.isEmpty() || sky() == old) && clock.elapsed() < 60'000)
        ASSERT_NO_FATAL_FAILURE(moveOn());
    EXPECT_FALSE(light.isEmpty());
    EXPECT_NE(sky(), old) << "shown, too";
    for (const PictureState state : m_frames)
        EXPECT_NE(state, PictureState::Refined);
    QTest::mouseRelease(&viewport(), Qt::LeftButton, Qt::NoModifier, center());
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(document().environment().source, "builtin:sunset");
}

// An orbit and a slider's drag, while a bake runs at low priority: each step has its frame, and the
// bake comes out as if nobody had touched anything.
TEST_F(FluidityTest, EveryEditIsShownWhileABakeRunsAndTheBakeIsTheSame) {
    controller().openScene(QStringLiteral("builtin:sphere"));
    ASSERT_TRUE(settled(*session) && rests());
    BakeRequest request;
    request.kind = BakeKind::PrtVertex;
    request.prt.order = 3;
    request.prt.samples = 512;
    Slider* slider = roughness();
    ASSERT_NE(slider, nullptr);
    session->bakes.start(request, JobPriority::Low);
    const auto runs = [] { return session->jobs.runningCount() > 0; };
    ASSERT_TRUE(eventually([&] { return session->jobs.jobs().back().progress.workDone > 0.0; }));
    ASSERT_TRUE(runs());

    QTest::mousePress(&viewport(), Qt::LeftButton, Qt::NoModifier, center());
    for (int i = 0; i < 4; ++i)
        ASSERT_NO_FATAL_FAILURE(moveOn());
    QTest::mouseRelease(&viewport(), Qt::LeftButton, Qt::NoModifier, center());
    const QPoint handle(slider->handleX(), slider->height() / 2);
    QTest::mousePress(slider, Qt::LeftButton, Qt::NoModifier, handle);
    for (int i = 1; i <= 4; ++i) {
        const std::size_t frames = m_frames.size();
        QTest::mouseMove(slider, handle + QPoint(i % 2 == 0 ? -i : 4 + i, 0));
        ASSERT_TRUE(eventually([&] { return m_frames.size() > frames; })) << i;
    }
    QTest::mouseRelease(slider, Qt::LeftButton, Qt::NoModifier, handle);
    EXPECT_GT(undoCount(), 0);

    ASSERT_TRUE(eventually([&] { return !runs() && document().bakes.size() == 1; }));
    TileSink sink;
    EXPECT_EQ(document().bakes[0]->vertices,
              bakePrtVertex(bakeInputs(document()), request.prt, sink, {})->vertices);
}

} // namespace
} // namespace patina::editor
