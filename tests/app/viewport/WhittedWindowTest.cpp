// The viewport's picture by the classical ray tracer, and the rays of a clicked pixel: by real keys
// and clicks.
#include "app/editor/trace/PathBadge.h"
#include "app/editor/trace/PathView.h"
#include "app/editor/trace/RayTreeOverlay.h"
#include "app/editor/trace/RayTreePanel.h"
#include "app/editor/trace/RayTreeProbe.h"
#include "app/editor/trace/RayTreeTexts.h"
#include "app/editor/trace/ViewLines.h"
#include "app/editor/trace/WhittedHeat.h"
#include "app/editor/trace/WhittedHeatOverlay.h"
#include "app/editor/viewport/EquationBar.h"
#include "app/editor/widget/NoticeArea.h"
#include "core/edit/Edit.h"
#include "core/edit/Parameters.h"
#include "core/material/Material.h"
#include "tests/app/editor/EditorFixture.h"

#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QSpinBox>
#include <QTreeWidget>
#include <cmath>

namespace patina::editor {
namespace {

class WhittedWindow : public EditorTest {
  protected:
    void SetUp() override {
        session->paths.setOn(false);
        session->wall.setOn(false);
        session->views.set({});
        EditorTest::SetUp();
        viewport().setFixedSize(160, 120);
        dock().hide();
        session->paths.setWhitted({});
        window->activateWindow();
        ASSERT_TRUE(QTest::qWaitForWindowActive(window.get(), 30'000));
        viewport().setFocus();
    }
    void TearDown() override {
        dock().setFloating(false);
        dock().hide();
        session->rayTree.clear();
        session->heat.setShown(std::nullopt);
        session->heat.setLevel(std::nullopt);
        session->paths.setOn(false);
    }

    static ViewportWidget& viewport() { return window->viewport(); }
    static PathView& paths() { return session->paths; }
    static RayTreeProbe& probe() { return session->rayTree; }
    static QDockWidget& dock() {
        return *window->findChild<QDockWidget*>(QStringLiteral("rayTree"));
    }
    static RayTreePanel& panel() { return *window->findChild<RayTreePanel*>(); }
    static QTreeWidget& tree() { return *panel().findChild<QTreeWidget*>(); }
    static RayTreeOverlay& overlay() { return *viewport().findChild<RayTreeOverlay*>(); }
    static void key(Qt::Key code, Qt::KeyboardModifiers modifiers = {}) {
        QTest::keyClick(&viewport(), code, modifiers);
    }
    static std::string text() {
        return viewport()
            .findChild<PathBadge*>()
            ->findChild<QLabel*>(QStringLiteral("pathBadgeText"))
            ->text()
            .toStdString();
    }
    static bool isDone() {
        return eventually([] { return paths().isWhitted() && paths().progress().refined; });
    }
    // The rays of the pixel in the middle, where the ball is, which reflects.
    static void clickTheMiddle() {
        setParameter("material.perceptualRoughness", 0.0f);
        dock().show();
        key(Qt::Key_F12, Qt::ShiftModifier);
        ASSERT_TRUE(isDone());
        QTest::mouseClick(&viewport(), Qt::LeftButton, {}, viewport().rect().center());
        ASSERT_TRUE(eventually([] { return probe().shown() != nullptr; }));
    }
    static void setParameter(const char* name, ParameterValue value) {
        controller().setParameter(*findParameter(name),
                                  {Scope::Material, document().materials.front().id}, value);
    }
};

TEST_F(WhittedWindow, KeysSwitchAmongThreeRenderers) {
    key(Qt::Key_F12, Qt::ShiftModifier);
    EXPECT_TRUE(paths().isWhitted());
    ASSERT_TRUE(isDone());
    ASSERT_TRUE(eventually([] { return text().find("done") != std::string::npos; }));
    EXPECT_THAT(text(), testing::HasSubstr("Whitted"));
    ASSERT_NE(paths().picture(), nullptr);
    EXPECT_EQ(paths().picture()->width(), 160);
    const ImagePtr classical = paths().picture();

    key(Qt::Key_F12);
    EXPECT_TRUE(paths().isOn());
    EXPECT_FALSE(paths().isWhitted());
    ASSERT_TRUE(eventually([] { return paths().progress().samples >= 2; }));
    ASSERT_TRUE(eventually([] { return text().find("paths per pixel") != std::string::npos; }));
    EXPECT_FALSE(std::ranges::equal(classical->f32(), paths().picture()->f32()));

    key(Qt::Key_F12, Qt::ShiftModifier);
    ASSERT_TRUE(isDone());
    EXPECT_TRUE(std::ranges::equal(classical->f32(), paths().picture()->f32()));
    key(Qt::Key_F12, Qt::ShiftModifier);
    EXPECT_FALSE(paths().isOn());
}

// What is said of the picture that the viewport draws is not said of a traced one.
TEST_F(WhittedWindow, EquationAndNoticesAreThoseOfThePictureThatIsShown) {
    setParameter("material.transmission", 1.0f);
    const auto notice = [] {
        for (const NoticeBar* bar : window->notices().bars())
            if (bar->text().contains(QStringLiteral("raster view")))
                return bar;
        return static_cast<const NoticeBar*>(nullptr);
    };
    ASSERT_TRUE(eventually([&] { return notice() != nullptr; }));
    auto* bar = window->findChild<EquationBar*>();
    bar->setFolded(false);
    const auto formula = [&] {
        return bar->findChild<QLabel*>(QStringLiteral("formula"))->text().toStdString();
    };
    auto* note = bar->findChild<QLabel*>(QStringLiteral("dim"));
    const auto* tiles = bar->findChild<QScrollArea*>();
    const std::string drawn = formula();
    EXPECT_THAT(drawn, testing::StartsWith("Final = "));
    EXPECT_TRUE(notice()->isVisible());

    key(Qt::Key_F12, Qt::ShiftModifier);
    EXPECT_THAT(formula(), testing::StartsWith("I = Ia ka + "));
    EXPECT_THAT(note->text().toStdString(), testing::HasSubstr("classical ray tracer"));
    EXPECT_TRUE(note->isVisible());
    EXPECT_FALSE(tiles->isVisible());
    EXPECT_FALSE(notice()->isVisible());
    EXPECT_FALSE(window->notices().isVisible());
    WhittedSettings settings;
    settings.model = LocalModel::Whitted1980;
    session->paths.setWhitted(settings);
    EXPECT_THAT(formula(), testing::HasSubstr("(R·V)"));
    key(Qt::Key_F12);
    EXPECT_THAT(formula(), testing::HasSubstr("∫"));
    key(Qt::Key_F12);
    EXPECT_EQ(formula(), drawn);
    EXPECT_TRUE(tiles->isVisible());
    EXPECT_TRUE(notice()->isVisible());
    bar->setFolded(true);
}

TEST_F(WhittedWindow, AnEmptyDockSaysWhatToDo) {
    dock().show();
    auto* message = panel().findChild<QLabel*>(QStringLiteral("rayTreeMessage"));
    auto* show = panel().findChild<QPushButton*>(QStringLiteral("rayTreeShow"));
    ASSERT_TRUE(eventually([&] { return show->isVisible(); }));
    EXPECT_THAT(message->text().toStdString(), testing::HasSubstr("pixel"));
    QTest::mouseClick(show, Qt::LeftButton);
    EXPECT_TRUE(paths().isWhitted());
    EXPECT_FALSE(show->isVisible());
    EXPECT_THAT(message->text().toStdString(), testing::HasSubstr("Click a pixel"));
    EXPECT_EQ(probe().shown(), nullptr);
    EXPECT_FALSE(overlay().isVisible());
}

TEST_F(WhittedWindow, AClickLaysThePixelOpen) {
    clickTheMiddle();
    const RayTreeProbe::Shown& shown = *probe().shown();
    EXPECT_EQ(shown.pixel, glm::ivec2(79, 59));
    const Image& picture = *paths().picture();
    const float* pixel =
        picture.f32().data() +
        std::size_t{4} * static_cast<std::size_t>(shown.pixel.y * picture.width() + shown.pixel.x);
    EXPECT_EQ(shown.tree.radiance(), glm::vec3(pixel[0], pixel[1], pixel[2]));

    // Every ray is a row, at its place in the tree.
    int rows = 0;
    for (QTreeWidgetItemIterator it(&tree()); *it != nullptr; ++it)
        ++rows;
    EXPECT_EQ(rows, static_cast<int>(shown.tree.nodes().size()));
    EXPECT_EQ(tree().topLevelItemCount(), static_cast<int>(shown.tree.sampleCount()));
    ASSERT_GE(tree().topLevelItem(0)->childCount(), 1);
    EXPECT_TRUE(tree().topLevelItem(0)->text(0).startsWith(QStringLiteral("Camera ray 1 of")));

    // A click on a row marks its ray. Below a viewport that small there is no room for rows.
    dock().setFloating(true);
    dock().resize(720, 360);
    ASSERT_TRUE(overlay().isVisible());
    EXPECT_GE(overlay().drawnRays(), 2);
    tree().topLevelItem(0)->setExpanded(true);
    QTreeWidgetItem* row = tree().topLevelItem(0)->child(0);
    tree().scrollToItem(row);
    ASSERT_TRUE(eventually(
        [&] { return tree().viewport()->rect().contains(tree().visualItemRect(row).center()); }));
    QTest::mouseClick(tree().viewport(), Qt::LeftButton, {}, tree().visualItemRect(row).center());
    EXPECT_EQ(probe().selected(), 1);
    EXPECT_TRUE(row->isSelected());
    EXPECT_FALSE(row->toolTip(0).isEmpty());

    QTest::mouseClick(panel().findChild<QPushButton*>(QStringLiteral("rayTreeClear")),
                      Qt::LeftButton);
    EXPECT_EQ(probe().shown(), nullptr);
    EXPECT_FALSE(overlay().isVisible());
}

// Rays are lines in the colour of their kind, and stay where they are while the camera moves.
TEST_F(WhittedWindow, RaysStayInTheSceneWhileTheCameraMoves) {
    clickTheMiddle();
    const auto before = probe().shown();
    Camera camera = document().view.camera;
    camera.yawDeg += 50.0f;
    controller().setCamera(camera);
    viewport().update();
    ASSERT_TRUE(isDone());
    ASSERT_TRUE(eventually([] { return !controller().tasks().busy(); }));
    const RayTreeProbe::Shown& after = *probe().shown();
    EXPECT_EQ(after.tree.radiance(), before->tree.radiance());
    EXPECT_NE(after.view.camera, document().view.camera);

    // The camera's ray is seen from the side now: a line to the point that it met.
    probe().select(0);
    QImage picture(overlay().size(), QImage::Format_ARGB32_Premultiplied);
    picture.fill(Qt::transparent);
    overlay().render(&picture, {}, {}, QWidget::RenderFlags());
    const RayNode& ray = after.tree.nodes()[0];
    const ViewLines view(document().view.camera, overlay().size());
    ASSERT_TRUE(ray.hit);
    int seen = 0, coloured = 0;
    for (int i = 1; i < 20; ++i) {
        const glm::vec3 at = glm::mix(ray.origin, ray.position, 0.05f * static_cast<float>(i));
        const std::optional<QPointF> place = view.point(at);
        if (!place || !picture.rect().contains(place->toPoint()))
            continue;
        ++seen;
        const QColor color = picture.pixelColor(place->toPoint());
        coloured += color.alpha() > 200 && color.lightness() > 180 ? 1 : 0;
    }
    EXPECT_GT(seen, 3);
    EXPECT_GE(coloured, seen - 1); // the normal lies over its end
}

TEST_F(WhittedWindow, AnEditTracesTheSamePixelAnew) {
    clickTheMiddle();
    const auto before = probe().shown();
    setParameter("material.baseColor", glm::vec3(0.05f, 0.6f, 0.1f));
    ASSERT_TRUE(eventually([&] { return probe().shown() && probe().shown() != before; }));
    EXPECT_EQ(probe().shown()->pixel, before->pixel);
    ASSERT_TRUE(isDone());

    // And settings of the dock.
    auto* model = panel().findChild<QComboBox*>(QStringLiteral("rayTreeModel"));
    const auto patina = probe().shown();
    model->setFocus();
    QTest::keyClick(model, Qt::Key_Down);
    EXPECT_EQ(paths().whitted().model, LocalModel::Whitted1980);
    ASSERT_TRUE(eventually([&] { return probe().shown() != patina; }));
    auto* depth = panel().findChild<QSpinBox*>(QStringLiteral("rayTreeDepth"));
    depth->setValue(0);
    EXPECT_EQ(paths().whitted().maxDepth, 0);

    // Nobody traces rays of a scene that is drawn as usual.
    key(Qt::Key_F12, Qt::ShiftModifier);
    EXPECT_FALSE(paths().isOn());
    EXPECT_NE(probe().shown(), nullptr);
    setParameter("material.baseColor", glm::vec3(0.5f, 0.6f, 0.1f));
    EXPECT_EQ(probe().shown(), nullptr);
}

// The list in the bar shows what the pixels take, and the boxes of the hierarchy.
TEST_F(WhittedWindow, HeatMapsAndBoxesAreShown) {
    auto* heat = viewport().findChild<WhittedHeatOverlay*>();
    auto* list = viewport().findChild<QComboBox*>(QStringLiteral("whittedShown"));
    auto* level = viewport().findChild<QSpinBox*>(QStringLiteral("whittedBoxes"));
    key(Qt::Key_F12);
    EXPECT_FALSE(list->isVisible());
    key(Qt::Key_F12, Qt::ShiftModifier);
    ASSERT_TRUE(isDone());
    EXPECT_TRUE(list->isVisible());
    EXPECT_FALSE(heat->isVisible());
    list->setFocus();
    QTest::keyClick(list, Qt::Key_Down);
    EXPECT_EQ(session->heat.shown(), RayCountKind::Rays);
    EXPECT_TRUE(heat->isVisible());
    ASSERT_TRUE(
        eventually([] { return session->heat.counted() && !session->heat.counted()->coarse; }));
    ASSERT_TRUE(session->heat.picture().has_value());
    EXPECT_EQ(session->heat.picture()->image.size(), QSize(160, 120));
    EXPECT_GE(session->heat.picture()->mean, 4.0); // the corners
    EXPECT_THAT(heat->lines().join(QLatin1Char(' ')).toStdString(),
                testing::HasSubstr("Rays per pixel, mean"));
    const double rays = session->heat.picture()->mean;
    QTest::keyClick(list, Qt::Key_End);
    EXPECT_EQ(session->heat.shown(), RayCountKind::TriangleTestsWithout);
    ASSERT_TRUE(eventually([] { return session->heat.picture().has_value(); }));
    EXPECT_NEAR(session->heat.picture()->mean,
                rays * static_cast<double>(document().triangleCount()), 1.0);

    level->setValue(1);
    EXPECT_EQ(session->heat.boxes().size(), 2u);
    level->setValue(level->maximum());
    EXPECT_GT(session->heat.boxes().size(), 100u);
    EXPECT_LE(session->heat.boxes().size(), WhittedHeat::kMostBoxes);
    level->setValue(level->minimum());
    EXPECT_TRUE(session->heat.boxes().empty());
    list->setFocus();
    while (list->currentIndex() > 0)
        QTest::keyClick(list, Qt::Key_Up);
    EXPECT_FALSE(session->heat.shown().has_value());
    EXPECT_FALSE(heat->isVisible());
}

TEST_F(WhittedWindow, ADragOrAHiddenDockPicksNothing) {
    key(Qt::Key_F12, Qt::ShiftModifier);
    ASSERT_TRUE(isDone());
    QTest::mouseClick(&viewport(), Qt::LeftButton, {}, viewport().rect().center());
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(probe().shown(), nullptr);
    dock().show();
    ASSERT_TRUE(eventually([] { return probe().picks(); }));
    const QPoint middle = viewport().rect().center();
    QTest::mousePress(&viewport(), Qt::LeftButton, {}, middle);
    for (int i = 1; i <= 5; ++i)
        QTest::mouseMove(&viewport(), middle + QPoint(8 * i, 0));
    QTest::mouseRelease(&viewport(), Qt::LeftButton, {}, middle + QPoint(40, 0));
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(probe().shown(), nullptr);
}

} // namespace
} // namespace patina::editor
