// Depth of field in the viewport: the classical ray tracer looks through the lens, and a badge says
// where the drawn picture does not.
#include "app/editor/trace/PathBadge.h"
#include "app/editor/trace/PathView.h"
#include "app/editor/viewport/LensBadge.h"
#include "core/edit/Parameters.h"
#include "tests/app/editor/EditorFixture.h"

#include <QLabel>
#include <QPushButton>
#include <algorithm>
#include <cmath>

namespace patina::editor {
namespace {

class LensWindow : public EditorTest {
  protected:
    void SetUp() override {
        session->paths.setOn(false);
        session->wall.setOn(false);
        session->views.set({});
        EditorTest::SetUp();
        viewport().setFixedSize(160, 120);
        viewport().setAddsSlowFrames(true); // what is at rest is seen through the lens
        window->activateWindow();
        ASSERT_TRUE(QTest::qWaitForWindowActive(window.get(), 30'000));
        viewport().setFocus();
        ASSERT_TRUE(eventually([] { return viewport().isSettled(); }));
    }
    void TearDown() override {
        session->paths.setOn(false);
        session->views.set({});
        closeTheLens();
    }

    static ViewportWidget& viewport() { return window->viewport(); }
    static PathView& paths() { return session->paths; }
    static const LensBadge& lens() { return *viewport().findChild<LensBadge*>(); }
    static std::string text() { return lens().text().toStdString(); }
    static void openTheLens() {
        controller().setParameter(*findParameter("view.depthOfField"), {Scope::View, 0}, true);
        controller().setParameter(*findParameter("view.fStop"), {Scope::View, 0}, 0.2f);
        // Far before the model.
        controller().setParameter(*findParameter("view.focusDistance"), {Scope::View, 0}, 0.5f);
    }
    static void closeTheLens() {
        controller().setParameter(*findParameter("view.depthOfField"), {Scope::View, 0}, false);
    }
};

TEST_F(LensWindow, ABadgeSaysWhereThePictureIsAPinholes) {
    EXPECT_FALSE(lens().isVisible());
    openTheLens();
    ASSERT_TRUE(eventually([] { return lens().isVisible(); })) << "it has just changed";
    EXPECT_THAT(text(), testing::HasSubstr("during interaction"));
    ASSERT_TRUE(eventually([] { return viewport().isSettled(); }));
    ASSERT_TRUE(eventually([] { return !lens().isVisible(); })) << "at rest it is not";

    const QPoint middle = viewport().rect().center();
    QTest::mousePress(&viewport(), Qt::LeftButton, {}, middle);
    QTest::mouseMove(&viewport(), middle + QPoint(20, 0));
    QTest::mouseMove(&viewport(), middle + QPoint(30, 5));
    ASSERT_TRUE(eventually([] { return lens().isVisible(); }));
    EXPECT_TRUE(viewport().rect().intersects(lens().geometry()));
    QTest::mouseRelease(&viewport(), Qt::LeftButton, {}, middle + QPoint(30, 5));
    ASSERT_TRUE(eventually([] { return !lens().isVisible(); }));

    session->views.show(shading::kViewMetallic);
    EXPECT_THAT(text(), testing::HasSubstr("in this view"));
    session->views.showOther(shading::kViewFinal);
    ASSERT_TRUE(
        eventually([] { return text().find("in the picture alone") != std::string::npos; }));
    session->views.set({});
    ASSERT_TRUE(eventually([] { return !lens().isVisible(); }));
    closeTheLens();
    EXPECT_EQ(text(), "");
}

TEST_F(LensWindow, TheClassicalRayTracerLooksThroughIt) {
    const auto* progress = viewport().findChild<QLabel*>(QStringLiteral("pathBadgeText"));
    const auto* pause = viewport().findChild<QPushButton*>(QStringLiteral("pathPause"));
    QTest::keyClick(&viewport(), Qt::Key_F12, Qt::ShiftModifier);
    ASSERT_TRUE(eventually([] { return paths().isWhitted() && paths().progress().refined; }));
    EXPECT_FALSE(paths().progress().noise) << "nothing is spread";
    const ImagePtr sharp = paths().picture();
    openTheLens();
    ASSERT_TRUE(eventually([] { return paths().progress().noise.has_value(); }));
    EXPECT_THAT(progress->text().toStdString(), testing::HasSubstr("samples per pixel"));
    EXPECT_TRUE(pause->isVisible() || paths().progress().refined);
    EXPECT_EQ(text(), "") << "it is no pinhole's";
    const double first = *paths().progress().noise;
    ASSERT_TRUE(eventually([] { return paths().progress().refined; }));
    EXPECT_LE(*paths().progress().noise, first);
    EXPECT_TRUE(*paths().progress().noise <= PathView::kCertain ||
                paths().progress().samples == 256u);
    // Blurred: neighbouring pixels of the ball's edge differ less.
    const auto steepest = [](const Image& image) {
        float most = 0.0f;
        for (int y = 0; y < image.height(); ++y)
            for (int x = 1; x < image.width(); ++x) {
                const std::size_t at = 4 * (static_cast<std::size_t>(y * image.width() + x));
                most = std::max(most, std::abs(image.f32()[at + 1] - image.f32()[at - 3]));
            }
        return most;
    };
    EXPECT_LT(steepest(*paths().picture()), 0.9f * steepest(*sharp));
    closeTheLens();
    ASSERT_TRUE(eventually([&] {
        return paths().progress().refined && !paths().progress().noise &&
               paths().picture()->f32().size() == sharp->f32().size() &&
               std::ranges::equal(paths().picture()->f32(), sharp->f32());
    }));
}

} // namespace
} // namespace patina::editor
