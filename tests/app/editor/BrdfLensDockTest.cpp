// The BRDF Lens in its window: opened by its key, followed while a slider is dragged, its lobe
// drawn in the viewport.

#include "tests/app/editor/EditorFixture.h"
#include "tests/support/Events.h"

#include "app/editor/panel/BrdfLensPanel.h"
#include "app/editor/panel/MaterialPanel.h"
#include "app/editor/widget/LitSphere.h"
#include "app/editor/widget/LobeView.h"
#include "app/editor/widget/NumberField.h"
#include "app/editor/widget/Slider.h"
#include "core/material/Material.h"

#include <QComboBox>
#include <QDockWidget>
#include <cmath>

namespace patina::editor {
namespace {

struct BrdfLensDockTest : EditorTest {
    void SetUp() override {
        EditorTest::SetUp();
        window->resize(1440, 900);
        QApplication::setActiveWindow(window.get()); // there is no window manager
        window->viewport().setFocus();
        ASSERT_TRUE(eventually([] { return !frame().isNull(); }));
        dock = window->findChild<QDockWidget*>(QStringLiteral("lens"));
        ASSERT_FALSE(dock->isVisible()) << "hidden at first";
        QTest::keyClick(window.get(), Qt::Key_3, Qt::ControlModifier);
        ASSERT_TRUE(eventually([this] { return dock->isVisible() && settled(); }));
    }
    void TearDown() override {
        session->probe.setPin(std::nullopt);
        QTest::keyClick(window.get(), Qt::Key_3, Qt::ControlModifier);
        EXPECT_TRUE(eventually([this] { return !dock->isVisible(); }));
    }
    BrdfLensPanel& panel() { return *window->findChild<BrdfLensPanel*>(); }
    bool settled() {
        return panel().upToDate() && panel().findChild<LobeView*>()->upToDate() &&
               panel().findChild<LitSphere*>()->upToDate() && !panel().result().curves.empty();
    }
    static QImage frame() { return window->viewport().grabFramebuffer(); }
    static void keep(const QString& name) {
        const QString target = qEnvironmentVariable("PATINA_SCREENSHOTS");
        EXPECT_TRUE(eventually([] { return window->viewport().isSettled(); }));
        if (!target.isEmpty())
            window->grab().save(target + QLatin1Char('/') + name);
    }
    // A pinned point of the model in the middle of the view, that faces the camera.
    static render::Inspection pointInView() {
        const Camera& camera = document().view.camera;
        const MeshInstance& mesh = document().meshes.front();
        render::Inspection pin;
        pin.mesh = mesh.id;
        pin.material = session->selection.material();
        const Bounds bounds = document().bounds();
        const glm::vec3 normal = glm::normalize(camera.position() - bounds.center());
        pin.values[shading::kRecordPosition] =
            glm::vec4(bounds.center() + 0.6f * bounds.radius() * normal, 1.0f);
        pin.values[shading::kViewShadingNormal] =
            glm::vec4(glm::normalize(normal + 0.6f * camera.up()), 0.0f);
        pin.values[shading::kViewTangent] = glm::vec4(camera.right(), 0.0f);
        pin.values[shading::kViewBaseColor] = glm::vec4(0.9f, 0.6f, 0.3f, 1.0f);
        pin.values[shading::kViewMetallic] = glm::vec4(0.0f);
        pin.values[shading::kViewPerceptualRoughness] = glm::vec4(0.4f);
        return pin;
    }

    QDockWidget* dock = nullptr;
};

TEST_F(BrdfLensDockTest, OpensBelowTheViewportAndLeavesItRoom) {
    EXPECT_EQ(window->dockWidgetArea(dock), Qt::BottomDockWidgetArea);
    EXPECT_GE(panel().height(), 220);
    EXPECT_GE(window->viewport().height(), 300);
    EXPECT_TRUE(window->actions().lens->isChecked());
    EXPECT_EQ(undoCount(), 0);
    keep(QStringLiteral("lens-window.png"));
}

TEST_F(BrdfLensDockTest, FollowsTheRoughnessSliderWhileItIsDragged) {
    window->findChild<QDockWidget*>(QStringLiteral("material"))->raise();
    auto* materials = window->findChild<MaterialPanel*>();
    ASSERT_TRUE(eventually([&] { return materials->isVisible(); }));
    Slider* slider = nullptr;
    for (Slider* candidate : materials->findChildren<Slider*>())
        if (find<NumberField>(*candidate->parentWidget(), QStringLiteral("Roughness")))
            slider = candidate;
    ASSERT_NE(slider, nullptr);
    const auto peak = [this] { return panel().result().curves.front().distribution.front().y; };
    const float first = peak();
    const float before = selectedMaterial().perceptualRoughness;
    const int y = slider->height() / 2;
    QTest::mousePress(slider, Qt::LeftButton, {}, {slider->handleX(), y});
    for (int step = 1; step <= 3; ++step) {
        const float last = peak();
        QTest::mouseMove(slider, {slider->handleX() - slider->width() / 16, y});
        ASSERT_TRUE(eventually([&] { return peak() != last; }))
            << "it moves with the hand, not after it";
    }
    QTest::mouseRelease(slider, Qt::LeftButton, {}, {slider->handleX(), y});
    ASSERT_TRUE(eventually([this] { return settled(); }));
    EXPECT_LT(selectedMaterial().perceptualRoughness, before);
    EXPECT_GT(peak(), first) << "smoother: a higher, narrower D";
    EXPECT_EQ(undoCount(), 1);
}

TEST_F(BrdfLensDockTest, ItsLobeIsDrawnInTheViewport) {
    session->probe.setPin(pointInView());
    ASSERT_TRUE(eventually([this] { return settled(); }));
    ASSERT_TRUE(eventually([] { return window->viewport().isSettled(); }));
    const QImage without = frame();
    auto& box = *find<QComboBox>(panel(), QStringLiteral("Lobe on the surface"));
    box.setFocus();
    QTest::keyClick(&box, Qt::Key_Down);
    ASSERT_TRUE(eventually([] { return session->lobe.lobe() != nullptr; }));
    EXPECT_TRUE(eventually([&] { return frame() != without; }));
    keep(QStringLiteral("lens-on-surface.png"));
    // Away with it, and with all overlays.
    window->actions().overlays->trigger();
    test::handleEvents();
    window->actions().overlays->trigger();
    QTest::keyClick(&box, Qt::Key_Up);
    ASSERT_TRUE(eventually([] { return session->lobe.lobe() == nullptr; }));
    EXPECT_EQ(undoCount(), 0) << "looking is no edit";
}

} // namespace
} // namespace patina::editor
