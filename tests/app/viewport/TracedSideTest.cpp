// One side of the split traced while the other shows what the viewport draws: by real keys, with
// the pointer on either side.
#include "app/editor/trace/TracedSide.h"
#include "app/editor/trace/PathBadge.h"
#include "app/editor/trace/PathError.h"
#include "app/editor/viewport/ViewSplitModel.h"
#include "core/document/ViewChoices.h"
#include "core/edit/Parameters.h"
#include "core/material/Material.h"
#include "tests/app/editor/EditorFixture.h"

#include <QComboBox>
#include <QCursor>
#include <QLabel>

namespace patina::editor {
namespace {

constexpr int kWidth = 160, kHeight = 120;

class TracedSideWindow : public EditorTest {
  protected:
    void SetUp() override {
        session->paths.setOn(false);
        session->wall.setOn(false);
        session->views.set({});
        EditorTest::SetUp();
        viewport().setFixedSize(kWidth, kHeight);
        viewport().setAddsSlowFrames(true);   // pictures are compared, on busy machines too
        viewport().setOverlaysVisible(false); // which only the drawn picture has
        window->activateWindow();
        ASSERT_TRUE(QTest::qWaitForWindowActive(window.get(), 30'000));
        viewport().setFocus();
        ASSERT_TRUE(settled(*session)); // what the light is prepared from comes in later
        ASSERT_TRUE(eventually([] { return viewport().isSettled(); }));
        m_drawn = viewport().grabFramebuffer();
    }
    void TearDown() override {
        session->paths.setOn(false);
        session->views.set({});
        viewport().setOverlaysVisible(true);
    }

    static ViewportWidget& viewport() { return window->viewport(); }
    static PathView& paths() { return session->paths; }
    static TracedSide& side() { return session->side; }
    static const render::ViewSettings& shown() { return session->views.settings(); }
    static PathBadge& badge() { return *viewport().findChild<PathBadge*>(); }
    static std::string text() {
        return badge().findChild<QLabel*>(QStringLiteral("pathBadgeText"))->text().toStdString();
    }
    // Away from the line and its handles.
    static void pointAt(ViewSide where) {
        const int x = where == ViewSide::Shown ? kWidth / 5 : kWidth * 4 / 5;
        pointAt(QPoint(x, kHeight / 4));
    }
    static void pointAt(const QPoint& place) {
        QCursor::setPos(viewport().mapToGlobal(place));
        ASSERT_TRUE(eventually([&] { return viewport().mapFromGlobal(QCursor::pos()) == place; }));
    }
    static void key(Qt::Key code, Qt::KeyboardModifiers modifiers = {}) {
        QTest::keyClick(&viewport(), code, modifiers);
    }
    static bool hasSamples(std::uint32_t count) {
        return eventually([=] { return paths().progress().samples >= count; });
    }
    // The drawn side is as fine as it gets, whatever the traced one is yet.
    static bool isDrawn() {
        bool refined = false;
        const auto follow = QObject::connect(
            &viewport(), &ViewportWidget::frameRendered,
            [&](double, PictureState state) { refined = state == PictureState::Refined; });
        const bool done = eventually([&] { return refined; });
        QObject::disconnect(follow);
        return done;
    }
    // A side of a picture, without the pixels beside the line.
    static QImage half(const QImage& picture, ViewSide where) {
        constexpr int kBeside = 4;
        return picture.copy(where == ViewSide::Shown ? 0 : kWidth / 2 + kBeside, 0,
                            kWidth / 2 - kBeside, kHeight);
    }
    static QImage now(ViewSide where) { return half(viewport().grabFramebuffer(), where); }
    [[nodiscard]] QImage drawn(ViewSide where) const { return half(m_drawn, where); }
    static double mean(const QImage& picture) {
        double sum = 0.0;
        for (int y = 0; y < picture.height(); ++y)
            for (int x = 0; x < picture.width(); ++x)
                sum += qGray(picture.pixel(x, y));
        return sum / (picture.width() * picture.height());
    }

  private:
    QImage m_drawn; // before
};

TEST_F(TracedSideWindow, TheKeyTracesTheSideThatThePointerIsOn) {
    key(Qt::Key_V);
    ASSERT_TRUE(shown().split);
    const render::ViewChoice other = shown().split->other;
    const int steps = undoCount();
    pointAt(ViewSide::Other);
    key(Qt::Key_F12);
    EXPECT_EQ(side().side(), ViewSide::Other);
    EXPECT_EQ(shown().split->other.kind, shading::kViewFinal);
    ASSERT_TRUE(hasSamples(4));
    EXPECT_THAT(text(), testing::HasSubstr("per pixel"));
    ASSERT_TRUE(isDrawn());
    EXPECT_EQ(now(ViewSide::Shown), drawn(ViewSide::Shown)) << "as the viewport draws it";
    EXPECT_NE(now(ViewSide::Other), drawn(ViewSide::Other));
    EXPECT_NEAR(mean(now(ViewSide::Other)), mean(drawn(ViewSide::Other)), 25.0)
        << "of the same scene, exposed alike";
    EXPECT_TRUE(window->actions().pathTraced->isChecked());

    // Over to the other side, by the same key: what was there before is there again.
    pointAt(ViewSide::Shown);
    key(Qt::Key_F12);
    EXPECT_EQ(side().side(), ViewSide::Shown);
    EXPECT_EQ(shown().split->other, other);
    EXPECT_TRUE(window->actions().pathTraced->isChecked()) << "it is on";
    key(Qt::Key_F12);
    EXPECT_FALSE(paths().isOn());
    EXPECT_FALSE(side().side());
    EXPECT_TRUE(shown().split) << "two views yet";
    EXPECT_FALSE(window->actions().pathTraced->isChecked());
    EXPECT_EQ(undoCount(), steps) << "looking changes nothing";
}

TEST_F(TracedSideWindow, ATracedPictureIsSplitFromTheDrawnOne) {
    key(Qt::Key_F12);
    ASSERT_TRUE(hasSamples(1));
    key(Qt::Key_V);
    ASSERT_TRUE(shown().split);
    EXPECT_EQ(shown().split->other.kind, shading::kViewFinal);
    EXPECT_EQ(side().side(), ViewSide::Shown);
    const ViewSplitModel names(session->views, side());
    EXPECT_THAT(names.leftName().toStdString(), testing::HasSubstr("path traced"));
    EXPECT_THAT(names.rightName().toStdString(), testing::HasSubstr("drawn"));
    ASSERT_TRUE(hasSamples(2));
    ASSERT_TRUE(isDrawn());
    EXPECT_EQ(now(ViewSide::Other), drawn(ViewSide::Other));
    EXPECT_NE(now(ViewSide::Shown), drawn(ViewSide::Shown));
    pointAt(ViewSide::Shown);
    key(Qt::Key_F12, Qt::ShiftModifier); // the same side, by the other tracer
    EXPECT_TRUE(paths().isWhitted());
    EXPECT_THAT(names.leftName().toStdString(), testing::HasSubstr("Whitted"));

    key(Qt::Key_V); // what is left of the line stays
    EXPECT_FALSE(shown().split);
    EXPECT_TRUE(paths().isOn());
    key(Qt::Key_V);
    pointAt(ViewSide::Other);
    key(Qt::Key_F12);
    EXPECT_EQ(side().side(), ViewSide::Other);
    EXPECT_FALSE(paths().isWhitted());
    key(Qt::Key_Escape);
    EXPECT_FALSE(shown().split);
    EXPECT_FALSE(paths().isOn());
}

TEST_F(TracedSideWindow, BothSidesFollowEdits) {
    key(Qt::Key_F12);
    key(Qt::Key_V);
    ASSERT_TRUE(hasSamples(2));
    ASSERT_TRUE(isDrawn());
    EXPECT_EQ(now(ViewSide::Other), drawn(ViewSide::Other));
    const std::uint64_t number = paths().number();
    const ImagePtr before = paths().picture();
    controller().setParameter(*findParameter("material.baseColor"),
                              {Scope::Material, document().materials.front().id},
                              glm::vec3(0.9f, 0.1f, 0.1f));
    // The drawn side is there with the next frame, whatever the tracer does meanwhile.
    EXPECT_NE(now(ViewSide::Other), drawn(ViewSide::Other));
    EXPECT_EQ(paths().picture(), before) << "not a pass yet";
    ASSERT_TRUE(eventually([&] { return paths().number() > number; }));
    ASSERT_TRUE(hasSamples(2));
    EXPECT_NE(paths().picture(), before);
    controller().undoStack().undo();
    ASSERT_TRUE(isDrawn());
    EXPECT_EQ(now(ViewSide::Other), drawn(ViewSide::Other));
}

TEST_F(TracedSideWindow, AnotherViewOnItsSideIsDrawnAsUsual) {
    key(Qt::Key_F12);
    key(Qt::Key_V);
    ASSERT_TRUE(hasSamples(1));
    session->views.show(shading::kViewBaseColor);
    EXPECT_THAT(text(), testing::HasSubstr("as usual"));
    const QImage traced = now(ViewSide::Shown);
    ASSERT_TRUE(eventually([&] { return now(ViewSide::Shown) != traced; }));
    session->views.show(shading::kViewFinal);
    EXPECT_THAT(text(), testing::Not(testing::HasSubstr("as usual")));
}

TEST_F(TracedSideWindow, TheBadgeStandsOnItsSide) {
    viewport().setFixedSize(900, 320);
    QApplication::processEvents();
    key(Qt::Key_F12);
    auto* errors = badge().findChild<QComboBox*>(QStringLiteral("pathShown"));
    session->pathError.setShown(PathPicture::Visible);
    key(Qt::Key_V);
    EXPECT_EQ(session->pathError.shown(), PathPicture::Traced) << "it would cover both";
    EXPECT_FALSE(errors->isVisible());
    EXPECT_LT(badge().geometry().center().x(), 450);
    pointAt(QPoint(800, 60));
    key(Qt::Key_F12);
    EXPECT_EQ(side().side(), ViewSide::Other);
    EXPECT_GT(badge().geometry().center().x(), 450);
    session->views.edit([](render::ViewSettings& settings) { settings.split->angleDeg = 180.0f; });
    EXPECT_LT(badge().geometry().center().x(), 450);
    key(Qt::Key_Escape);
    key(Qt::Key_F12);
    EXPECT_TRUE(errors->isVisible());
}

} // namespace
} // namespace patina::editor
