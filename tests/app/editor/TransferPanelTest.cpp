// The Transfer dock in its window: a known transfer, looked at from a pinned point.
#include "core/document/ViewChoices.h"
#include "core/light/Light.h"
#include "tests/app/editor/EditorFixture.h"

#include "app/editor/panel/TransferPanel.h"
#include "app/editor/widget/BandBars.h"
#include "app/editor/widget/PictureTile.h"
#include "core/bake/Bake.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/bake/local/NearLightAt.h"
#include "core/edit/EditSession.h"
#include "core/math/SphericalHarmonics.h"

#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <numbers>

namespace patina::editor {
namespace {

struct TransferPanelTest : EditorTest {
    void SetUp() override {
        EditorTest::SetUp();
        controller().openScene(QStringLiteral("builtin:sphere")); // quickly drawn
        ASSERT_TRUE(settled(*session));
        window->resize(1440, 900);
        window->viewport().setFixedSize(400, 240);   // software OpenGL pays for each pixel
        QApplication::setActiveWindow(window.get()); // there is no window manager
        window->viewport().setFocus();
        dock = window->findChild<QDockWidget*>(QStringLiteral("transfer"));
        ASSERT_FALSE(dock->isVisible()) << "hidden at first";
        QTest::keyClick(window.get(), Qt::Key_6, Qt::ControlModifier);
        ASSERT_TRUE(eventually([this] { return dock->isVisible(); }));
    }
    void TearDown() override {
        session->probe.setPin(std::nullopt);
        QTest::keyClick(window.get(), Qt::Key_6, Qt::ControlModifier);
        EXPECT_TRUE(eventually([this] { return !dock->isVisible(); }));
        EXPECT_EQ(session->lobe.lobe(), nullptr) << "the lobe goes with its dock";
    }
    static TransferPanel& panel() { return *window->findChild<TransferPanel*>(); }

    // Nothing is hidden: T_lm = A_l Y_lm(n) / pi, of three bands.
    static BakeArtifactPtr openBake() {
        BakeArtifact bake;
        bake.kind = BakeKind::PrtVertex;
        bake.order = 3;
        bake.transfer = TransferKind::Unshadowed;
        bake.inputs = hashBakeInputs(bakeInputs(document()));
        for (const MeshInstance& mesh : document().meshes) {
            VertexBake& vertices = bake.vertices.emplace_back();
            vertices.mesh = mesh.id;
            vertices.stride = 9;
            for (const glm::vec3& normal : mesh.mesh->normals) {
                std::array<float, 9> y{};
                evaluateSh(3, glm::normalize(glm::mat3(mesh.placement.matrix()) * normal), y);
                for (int l = 0, i = 0; l < 3; ++l)
                    for (int m = -l; m <= l; ++m, ++i)
                        vertices.values.push_back(static_cast<float>(
                            cosineConvolution(l) / std::numbers::pi * y[std::size_t(i)]));
            }
        }
        return std::make_shared<const BakeArtifact>(std::move(bake));
    }
    static void pin() {
        const Camera& camera = document().view.camera;
        const Bounds bounds = document().bounds();
        render::Inspection at;
        at.mesh = document().meshes.front().id;
        at.material = document().meshes.front().material;
        const glm::vec3 normal = glm::normalize(camera.position() - bounds.center());
        at.values[shading::kRecordPosition] =
            glm::vec4(bounds.center() + 0.6f * bounds.radius() * normal, 1.0f);
        at.values[shading::kViewShadingNormal] = glm::vec4(normal, 0.0f);
        session->probe.setPin(at);
    }
    static bool studied() { return panel().upToDate() && panel().pictures() != nullptr; }
    static void keep(const QString& name) {
        const QString target = qEnvironmentVariable("PATINA_SCREENSHOTS");
        if (target.isEmpty())
            return;
        EXPECT_TRUE(eventually([] { return window->viewport().isSettled(); }));
        window->grab().save(target + QLatin1Char('/') + name);
    }

    QDockWidget* dock = nullptr;
};

TEST_F(TransferPanelTest, TellsWhatIsMissing) {
    EXPECT_TRUE(
        eventually([] { return panel().message().contains(QStringLiteral("no radiance")); }));
    controller().attachBake(openBake());
    EXPECT_TRUE(eventually([] {
        return panel().message().contains(QStringLiteral("Point at")) || panel().pictures();
    }));
}

TEST_F(TransferPanelTest, ShowsThePinnedPointBandByBand) {
    controller().attachBake(openBake());
    pin();
    ASSERT_TRUE(eventually([] { return studied() && panel().pictures()->rays > 0; }));
    const TransferPictures& shown = *panel().pictures();
    const TransferStudy& all = shown.study;
    EXPECT_NEAR(all.visibility, 1.0f, 0.02f) << "nothing is in the way";
    ASSERT_EQ(all.byBand.size(), 3u);
    glm::vec3 sum(0.0f);
    for (const glm::vec3& band : all.byBand)
        sum += band;
    EXPECT_LT(glm::distance(sum, all.radiance), 1e-4f * glm::length(sum));
    // Three bands of a clamped cosine are 3/32 + z/2 + 15/32 z² over pi, lowest at z = -8/15.
    EXPECT_NEAR(all.function.lowest * std::numbers::pi_v<float>, 3.0f / 32.0f - 2.0f / 15.0f,
                0.01f);
    EXPECT_GT(all.function.highest, 0.25f);
    ASSERT_NE(session->lobe.lobe(), nullptr);
    EXPECT_EQ(session->lobe.lobe(), shown.lobe);
    keep(QStringLiteral("transfer.png"));

    auto* bars = panel().findChild<BandBars*>();
    const glm::vec3 whole = all.radiance, first = all.byBand[1];
    QTest::mouseClick(bars, Qt::LeftButton, {}, bars->bandArea(1).center().toPoint());
    ASSERT_TRUE(
        eventually([&] { return studied() && panel().pictures()->study.radiance != whole; }));
    EXPECT_LT(glm::distance(panel().pictures()->study.radiance + first, whole),
              1e-4f * glm::length(whole));
    QTest::mouseClick(bars, Qt::LeftButton, Qt::ShiftModifier,
                      bars->bandArea(1).center().toPoint());
    ASSERT_TRUE(eventually([&] {
        return studied() && glm::distance(panel().pictures()->study.radiance, first) < 1e-5f;
    })) << "band 1 alone";
    EXPECT_NEAR(panel().pictures()->study.function.negativeShare, 0.5, 0.01)
        << "half of band 1 is below zero";
    keep(QStringLiteral("transfer-solo.png"));
    bars->setFocus();
    QTest::keyClick(bars, Qt::Key_Right);                    // to band 1
    QTest::keyClick(bars, Qt::Key_Space, Qt::ShiftModifier); // all again
    ASSERT_TRUE(
        eventually([&] { return studied() && panel().pictures()->study.radiance == whole; }));
    EXPECT_EQ(undoCount(), 0) << "a bake that is made is no step; looking is no edit";
}

// A cross-fade meets the point as exactly the mix of both environments' light.
TEST_F(TransferPanelTest, FollowsTheMixOfTwoEnvironments) {
    controller().attachBake(openBake());
    controller().addEnvironment(QStringLiteral("builtin:sunset"),
                                DocumentController::EnvironmentUse::FadeTo);
    ASSERT_TRUE(eventually(
        [] { return !controller().tasks().busy() && document().secondEnvironment() != nullptr; }));
    pin();
    std::vector<glm::vec3> last;
    const auto at = [&](float fade) {
        controller().setParameter(*findParameter("environment.fade"), {Scope::Environment, 0},
                                  fade);
        EXPECT_TRUE(eventually([&] {
            return studied() && panel().pictures()->study.light.size() == 9 &&
                   panel().pictures()->study.light != last;
        })) << fade;
        last = panel().pictures()->study.light;
        return last;
    };
    const auto first = at(0.0f), half = at(0.25f), second = at(1.0f);
    const float size = std::max(first[0].x, second[0].x);
    EXPECT_GT(std::abs(first[0].x - second[0].x), 0.01f * size);
    for (std::size_t i = 0; i < half.size(); ++i)
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(half[i][c], 0.75f * first[i][c] + 0.25f * second[i][c], 1e-4f * size)
                << i << ' ' << c;
}

TEST_F(TransferPanelTest, ShowsTheEnvironmentInAnyNumberOfBands) {
    controller().attachBake(openBake());
    pin();
    ASSERT_TRUE(eventually([] { return studied(); }));
    auto* choice = panel().findChild<QComboBox*>(QStringLiteral("transferLightBands"));
    QImage last;
    for (int i = 0; i < choice->count(); ++i) {
        choice->setCurrentIndex(i);
        ASSERT_TRUE(eventually([&] { return studied() && panel().pictures()->sum != last; })) << i;
        last = panel().pictures()->sum;
    }
    EXPECT_EQ(choice->count(), 8);
}

// What local lights send directly comes by rays in the picture: it is in no band, and said besides.
TEST_F(TransferPanelTest, AddsLocalLightsAsThePictureHasThem) {
    controller().attachBake(openBake());
    controller().setParameter(parameter("view.lighting"), {Scope::View, 0},
                              static_cast<int>(LightingMode::Shadowed));
    pin();
    ASSERT_TRUE(eventually([] { return studied() && panel().pictures()->rays > 0; }));
    const glm::vec3 before = panel().pictures()->study.radiance;
    EXPECT_EQ(panel().pictures()->study.tracedLights, 0u);
    controller().addLight(LightType::Point);
    Light light = document().lights.back();
    light.position = document().view.camera.position();
    controller().changeLight(light, 0, QStringLiteral("move"));
    ASSERT_TRUE(eventually([] {
        return session->nearShadows.upToDate() && studied() &&
               panel().pictures()->study.tracedLights == 1;
    }));
    const TransferStudy& study = panel().pictures()->study;
    EXPECT_LT(glm::distance(study.radiance, before), 1e-5f * glm::length(before));
    const glm::vec3 place(session->probe.pin()->value(shading::kRecordPosition));
    const NearLightAt at =
        nearLightAt(document(), session->nearShadows.shown(),
                    *nearestMeshPoint(document(), session->probe.pin()->mesh, place));
    EXPECT_GT(study.local.x, 0.0f);
    EXPECT_EQ(study.local, at.radiance);
    EXPECT_TRUE(panel()
                    .findChild<QLabel*>(QStringLiteral("transferNumbers"))
                    ->text()
                    .contains(QStringLiteral("by rays instead of bands")));
}

} // namespace
} // namespace patina::editor
