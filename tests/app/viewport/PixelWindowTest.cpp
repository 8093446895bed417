// Explaining pixels in the real window, by real keys and mouse: hovering, pinning, following,
// copying.

#include "app/editor/panel/ExplanationModel.h"
#include "app/editor/panel/PixelPanel.h"
#include "app/editor/viewport/PinMarker.h"
#include "app/editor/viewport/PixelPicker.h"
#include "app/editor/widget/ContributionChart.h"
#include "core/light/Light.h"
#include "core/light/Lights.h"
#include "core/material/Material.h"
#include "tests/app/editor/EditorFixture.h"
#include "tests/support/Events.h"

#include <QClipboard>
#include <QDir>
#include <QDockWidget>
#include <QGuiApplication>
#include <QJsonDocument>
#include <QJsonObject>
#include <QLabel>
#include <QToolButton>
#include <QTreeView>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

namespace patina::editor {
namespace {

using testing::HasSubstr;

class PixelWindowTest : public EditorTest {
  protected:
    void SetUp() override {
        EditorTest::SetUp();
        viewport().setFixedSize(360, 300); // software OpenGL pays for each pixel
        window->activateWindow();
        ASSERT_TRUE(QTest::qWaitForWindowActive(window.get(), 30'000));
        viewport().setFocus();
        session->probe.setPin(std::nullopt);
        session->probe.setHover(std::nullopt);
        window->resetLayout();
        QTest::keyClick(&viewport(), Qt::Key_Home);
        settleFrames();
    }
    void TearDown() override {
        if (const char* pictures = std::getenv("PATINA_SCREENSHOTS")) {
            const auto* test = testing::UnitTest::GetInstance()->current_test_info();
            window->grab().save(
                QDir(QString::fromLocal8Bit(pictures))
                    .filePath(QString::fromLatin1(test->name()) + QStringLiteral(".png")));
        }
    }

    static ViewportWidget& viewport() { return window->viewport(); }
    static PixelProbe& probe() { return session->probe; }
    static PixelPanel& panel() { return *window->findChild<PixelPanel*>(); }
    static PinMarker& marker() { return *window->findChild<PinMarker*>(); }
    static QToolButton& button(const char* name) {
        return *find<QToolButton>(panel(), QString::fromLatin1(name));
    }
    static QString text(const char* objectName) {
        return panel().findChild<QLabel*>(QLatin1String(objectName))->text();
    }
    static QPoint center() { return viewport().rect().center(); }
    static void openPanel() {
        if (!panel().isVisible())
            QTest::keyClick(window.get(), Qt::Key_1, Qt::ControlModifier);
        ASSERT_TRUE(eventually([] { return panel().isVisible(); }));
        settleFrames();
    }
    // Until the picture of the present layout is there.
    static void settleFrames() {
        test::handleEvents();
        // Pixels of the coarser frames of a drag are several of the window's.
        ASSERT_TRUE(eventually([] { return viewport().isSettled(); }));
        viewport().grabFramebuffer();
    }
    // Rests there until that very place has been looked at.
    static void hover(const QPoint& at) {
        probe().setHover(std::nullopt);
        // On a busy machine both moves arrive as one; when the pointer was there already, that is
        // none: then they come again, further apart.
        int looks = 0, apart = 1;
        ASSERT_TRUE(eventually([&] {
            if (looks == 0)
                QTest::mouseMove(&viewport(), at + QPoint(3, 0));
            if (looks == apart)
                QTest::mouseMove(&viewport(), at);
            if (++looks == 40) {
                looks = 0;
                apart = std::min(2 * apart, 20);
            }
            const auto& pixel = probe().hover();
            const auto near = [](int a, int b, int size, int whole) {
                return std::abs(a - b * whole / size) <= 1;
            };
            return pixel && near(pixel->x, at.x(), viewport().width(), pixel->width) &&
                   near(pixel->y, at.y(), viewport().height(), pixel->height);
        }));
    }
    static void setRoughness(float roughness) {
        controller().setParameter(*findParameter("material.perceptualRoughness"),
                                  {Scope::Material, selectedMaterial().id}, roughness);
    }
    static glm::vec3 pinnedPosition() {
        return glm::vec3(probe().pin()->value(shading::kRecordPosition));
    }
};

TEST_F(PixelWindowTest, FocusHereTakesTheDistanceOfWhatIsClicked) {
    const auto focusHere = [] {
        viewport().setFocus();
        QTest::keyClick(&viewport(), Qt::Key_P, Qt::ShiftModifier);
        EXPECT_EQ(viewport().cursor().shape(), Qt::CrossCursor);
    };
    const Camera before = document().view.camera;
    const Id selected = session->selection.mesh();
    const int steps = controller().undoStack().count();
    focusHere();
    QTest::mouseClick(&viewport(), Qt::LeftButton, Qt::NoModifier, {4, 4}); // the background
    EXPECT_EQ(document().view.camera, before);
    EXPECT_NE(viewport().cursor().shape(), Qt::CrossCursor);
    focusHere();
    QTest::keyClick(&viewport(), Qt::Key_Escape);
    EXPECT_NE(viewport().cursor().shape(), Qt::CrossCursor);
    EXPECT_EQ(controller().undoStack().count(), steps);

    focusHere();
    QTest::mouseClick(&viewport(), Qt::LeftButton, Qt::NoModifier, center());
    const Lens lens = document().view.camera.lens;
    EXPECT_TRUE(lens.depthOfField);
    EXPECT_EQ(session->selection.mesh(), selected) << "the click was the focus'";
    // The same point by the pin.
    openPanel();
    QTest::mouseClick(&viewport(), Qt::LeftButton, Qt::AltModifier, center());
    ASSERT_TRUE(probe().pin().has_value());
    const float depth = glm::dot(pinnedPosition() - before.position(), before.forward());
    EXPECT_NEAR(lens.focusDistance, depth, 0.02f * depth);
    EXPECT_NE(lens.focusDistance, before.lens.focusDistance);
    controller().undoStack().undo();
    EXPECT_EQ(document().view.camera.lens, before.lens);
    EXPECT_EQ(controller().undoStack().count(), steps + 1);
}

TEST_F(PixelWindowTest, HoveringExplainsWhatIsUnderThePointer) {
    QTest::mouseMove(&viewport(), center());
    ASSERT_TRUE(eventually([] { return viewport().isSettled(); }));
    QTest::qWait(50); // nothing to wait for: it shows that nothing comes
    EXPECT_FALSE(probe().hover().has_value()) << "nobody has asked";

    openPanel();
    hover(center());
    ASSERT_TRUE(eventually([] { return panel().explanation().has_value(); }));
    const render::Explanation model = *panel().explanation();
    EXPECT_EQ(model.mesh, document().meshes[0].name);
    EXPECT_TRUE(model.agrees());
    EXPECT_LE(model.difference.value_or(255.0f), 1.0f);
    const auto* tree = panel().findChild<QTreeView*>();
    EXPECT_GE(tree->model()->rowCount(), 5);
    EXPECT_TRUE(
        text("pixelTitle").startsWith(QString::fromStdString(render::hexText(model.displayed))));

    // The frame that is shown there has that colour (dithered), at rest: pixels of coarser frames
    // cover more of a texture.
    ASSERT_TRUE(eventually([] { return viewport().isSettled(); }));
    const QImage frame = viewport().grabFramebuffer();
    const QColor shown = frame.pixelColor(center());
    hover(center());
    ASSERT_EQ(probe().hover()->width, frame.width());
    EXPECT_NEAR(shown.redF(), probe().hover()->displayed.r, 3.0 / 255.0);
    EXPECT_NEAR(shown.greenF(), probe().hover()->displayed.g, 3.0 / 255.0);

    hover({4, 4});
    EXPECT_TRUE(
        eventually([] { return text("pixelSubtitle").startsWith(QStringLiteral("Background")); }));
}

TEST_F(PixelWindowTest, APinStaysOnTheSurfaceAndFollowsTheMaterial) {
    openPanel();
    hover(center() + QPoint(10, 14));
    QTest::keyClick(&viewport(), Qt::Key_P);
    ASSERT_TRUE(probe().pin().has_value());
    const glm::vec3 position = pinnedPosition();
    ASSERT_TRUE(marker().place().has_value());
    EXPECT_LT(std::hypot(marker().place()->x() - center().x() - 10,
                         marker().place()->y() - center().y() - 14),
              1.5);
    const auto roughness = [] { return probe().pin()->value(shading::kViewPerceptualRoughness).x; };

    // Live while a number is dragged. Values are compared at rest: pixels of coarser frames cover
    // more of the map.
    const float asOpened = roughness();
    setRoughness(0.9f);
    ASSERT_TRUE(eventually([&] { return roughness() != asOpened && viewport().isSettled(); }));
    const float scale = roughness();
    setRoughness(0.45f);
    EXPECT_TRUE(eventually([&] { return std::abs(roughness() - 0.5f * scale) < 0.02f; }));
    setRoughness(0.1f);
    ASSERT_TRUE(eventually([&] { return roughness() < 0.2f; }));
    ASSERT_TRUE(eventually([&] {
        return panel().explanation() &&
               std::abs(panel().explanation()->sum.x - probe().pin()->radiance.x) < 1e-3f;
    }));
    std::printf("looking at a pixel took %.1f ms, the slowest frame %.1f ms\n",
                viewport().picker().lookMs(), viewport().takeSlowestFrameMs());

    // It moves with the camera, and the point stays the same.
    const QPointF before = *marker().place();
    QTest::mousePress(&viewport(), Qt::LeftButton, Qt::NoModifier, center());
    QTest::mouseMove(&viewport(), center() + QPoint(20, 4));
    QTest::mouseMove(&viewport(), center() + QPoint(40, 8));
    QTest::mouseRelease(&viewport(), Qt::LeftButton, Qt::NoModifier, center() + QPoint(40, 8));
    const QPointF after = *marker().place();
    EXPECT_GT(std::hypot(after.x() - before.x(), after.y() - before.y()), 4.0);
    const float yaw = document().view.camera.yawDeg;
    ASSERT_TRUE(eventually([&] {
        return probe().pinState() == PinState::Seen &&
               std::abs(probe().pin()->x - after.x() * probe().pin()->width / viewport().width()) <
                   2.0;
    })) << yaw;
    EXPECT_LT(glm::distance(pinnedPosition(), position), 0.05f);

    // From behind it is hidden, and said to be.
    Camera camera = document().view.camera;
    camera.yawDeg += 180.0f;
    controller().setCamera(camera);
    viewport().update();
    ASSERT_TRUE(eventually([] { return probe().pinState() == PinState::Hidden; }));
    EXPECT_TRUE(eventually([] { return text("pixelState").contains(QStringLiteral("hides")); }));
    EXPECT_LT(glm::distance(pinnedPosition(), position), 0.05f) << "the last numbers stay";
    // Beside the picture, too.
    camera.target += 50.0f * camera.right();
    controller().setCamera(camera);
    viewport().update();
    ASSERT_TRUE(eventually([] { return probe().pinState() == PinState::Outside; }));
    EXPECT_FALSE(marker().place().has_value());

    QTest::keyClick(&viewport(), Qt::Key_Home);
    QTest::keyClick(&viewport(), Qt::Key_P);
    EXPECT_FALSE(probe().pin().has_value());
    EXPECT_FALSE(marker().place().has_value());
    EXPECT_EQ(undoCount(), 3) << "only the numbers of the material";
}

TEST_F(PixelWindowTest, AltClickPinsAndOpensTheDock) {
    ASSERT_FALSE(panel().isVisible());
    const auto selected = session->selection.mesh();
    QTest::mouseClick(&viewport(), Qt::LeftButton, Qt::AltModifier, center());
    ASSERT_TRUE(probe().pin().has_value());
    EXPECT_TRUE(eventually([] { return panel().isVisible(); }));
    EXPECT_EQ(session->selection.mesh(), selected) << "it selects nothing";
    EXPECT_GE(panel().height(), 180);
    ASSERT_TRUE(eventually([] { return find<QToolButton>(panel(), "Unpin") != nullptr; }));
    EXPECT_TRUE(button("Unpin").isChecked());
    // Beside the model: no pin.
    QTest::mouseClick(&viewport(), Qt::LeftButton, Qt::AltModifier, {4, 4});
    EXPECT_FALSE(probe().pin().has_value());
    // The same where the window manager takes Alt + click; the camera stays where it is.
    const Camera camera = document().view.camera;
    const Qt::KeyboardModifiers second = Qt::ControlModifier | Qt::ShiftModifier;
    QTest::mouseClick(&viewport(), Qt::LeftButton, second, center());
    EXPECT_TRUE(probe().pin().has_value());
    EXPECT_EQ(session->selection.mesh(), selected);
    QTest::mouseClick(&viewport(), Qt::LeftButton, second, {4, 4});
    EXPECT_FALSE(probe().pin().has_value());
    EXPECT_EQ(document().view.camera, camera);

    ASSERT_TRUE(eventually([] { return find<QToolButton>(panel(), "Pin") != nullptr; }));

    // The button arms a click, which pins, and takes the pin away again.
    button("Pin").click();
    EXPECT_TRUE(viewport().picker().isPicking());
    EXPECT_EQ(viewport().cursor().shape(), Qt::CrossCursor);
    QTest::mouseClick(&viewport(), Qt::LeftButton, Qt::NoModifier, viewport().rect().center());
    ASSERT_TRUE(probe().pin().has_value());
    EXPECT_FALSE(viewport().picker().isPicking());
    ASSERT_TRUE(eventually([] { return find<QToolButton>(panel(), "Unpin") != nullptr; }));
    button("Unpin").click();
    EXPECT_FALSE(probe().pin().has_value());
    EXPECT_FALSE(marker().place().has_value());
    ASSERT_TRUE(eventually([] { return find<QToolButton>(panel(), "Pin") != nullptr; }));
    button("Pin").click();
    viewport().setFocus();
    QTest::keyClick(&viewport(), Qt::Key_Escape);
    EXPECT_FALSE(viewport().picker().isPicking());

    // A new scene has no pin.
    QTest::mouseClick(&viewport(), Qt::LeftButton, Qt::AltModifier, viewport().rect().center());
    ASSERT_TRUE(probe().pin().has_value());
    controller().newDocument();
    ASSERT_TRUE(settled(*session));
    EXPECT_TRUE(eventually([] { return !probe().pin().has_value(); }));
}

TEST_F(PixelWindowTest, ThePanelCopiesOpensFormulasAndShowsChannels) {
    openPanel();
    controller().addLight(LightType::Directional);
    hover(center());
    QTest::keyClick(&viewport(), Qt::Key_P);
    ASSERT_TRUE(probe().pin().has_value());
    ASSERT_TRUE(eventually(
        [] { return panel().explanation() && panel().explanation()->contributions.size() == 4; }));

    button("Copy as Text").click();
    EXPECT_THAT(QGuiApplication::clipboard()->text().toStdString(), HasSubstr("ρd · kD · AO"));
    button("Copy as JSON").click();
    const QJsonObject json =
        QJsonDocument::fromJson(QGuiApplication::clipboard()->text().toUtf8()).object();
    EXPECT_TRUE(json.value(QStringLiteral("agrees")).toBool()) << toText(*panel().explanation());
    EXPECT_TRUE(json.value(QStringLiteral("sections")).toObject().contains("environment"));

    // A click on a bar opens its formula.
    auto* chart = panel().findChild<ContributionChart*>();
    auto* tree = panel().findChild<QTreeView*>();
    auto* model = panel().findChild<ExplanationModel*>();
    const QModelIndex specular = model->find(QStringLiteral("environment/specularIbl"));
    ASSERT_TRUE(specular.isValid());
    EXPECT_FALSE(tree->isExpanded(specular));
    QTest::mouseClick(chart, Qt::LeftButton, Qt::NoModifier,
                      {30, 8 + chart->rowHeight() + chart->rowHeight() / 2});
    EXPECT_TRUE(tree->isExpanded(specular));
    EXPECT_EQ(tree->currentIndex(), specular);

    // New numbers leave it open.
    setRoughness(0.33f);
    const auto x = probe().pin()->radiance.x;
    EXPECT_TRUE(eventually([&] { return probe().pin()->radiance.x != x; }));
    settleFrames();
    EXPECT_TRUE(eventually([] { return panel().explanation()->agrees(); }))
        << toText(*panel().explanation());
    EXPECT_TRUE(tree->isExpanded(model->find(QStringLiteral("environment/specularIbl"))));

    const QImage before = chart->grab().toImage();
    button("Channels").click();
    EXPECT_TRUE(chart->channels());
    EXPECT_NE(chart->grab().toImage(), before);
    button("Channels").click();
}

// Wide and short as at the bottom, narrow and tall as at the side.
TEST_F(PixelWindowTest, ThePanelFlows) {
    openPanel();
    hover(center());
    QTest::keyClick(&viewport(), Qt::Key_P);
    PixelPanel alone(controller(), probe(), viewport().picker());
    auto* chart = alone.findChild<ContributionChart*>();
    auto* tree = alone.findChild<QTreeView*>();
    alone.resize(800, 260);
    alone.show();
    ASSERT_TRUE(eventually([&] { return alone.explanation().has_value(); }));
    test::handleEvents(); // for the layout
    const auto left = [&](const QWidget* w) { return w->mapTo(&alone, QPoint()).x(); };
    const auto top = [&](const QWidget* w) { return w->mapTo(&alone, QPoint()).y(); };
    EXPECT_GT(left(tree), left(chart) + 200);
    EXPECT_GT(tree->height(), 150);
    const auto keep = [&](const char* name) {
        if (const char* pictures = std::getenv("PATINA_SCREENSHOTS"))
            alone.grab().save(QDir(QString::fromLocal8Bit(pictures)).filePath(QLatin1String(name)));
    };
    keep("pixel-wide.png");
    alone.resize(356, 600);
    ASSERT_TRUE(eventually([&] { return top(tree) > top(chart) + 60; }));
    EXPECT_LE(left(tree), 12);
    test::handleEvents();
    EXPECT_EQ(alone.width(), 356) << "it can be as narrow as the right docks";
    EXPECT_GT(tree->height(), 280);
    keep("pixel-narrow.png");
}

} // namespace
} // namespace patina::editor
