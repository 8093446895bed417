// How the picture gets finer at rest: in slices, between which input is handled.

#include "tests/app/editor/EditorFixture.h"

#include <QWheelEvent>
#include <vector>

namespace patina::editor {
namespace {

class RefinementTest : public EditorTest {
  protected:
    static ViewportWidget& viewport() { return window->viewport(); }
    static QSize full() { return viewport().size() * viewport().devicePixelRatioF(); }

    void SetUp() override {
        EditorTest::SetUp();
        viewport().setFixedSize(1024, 576); // too many pixels to be drawn at once in software
        controller().openScene(QStringLiteral("builtin:sphere"));
        ASSERT_TRUE(settled(*session));
        viewport().setAddsSlowFrames(true);
        QObject::connect(&viewport(), &ViewportWidget::frameRendered, &m_here,
                         [this](double, PictureState state) {
                             m_frames.push_back({state, viewport().frameSize() == full()});
                         });
        ASSERT_TRUE(refines());
    }
    void TearDown() override { viewport().setAddsSlowFrames(false); }

    struct Frame {
        PictureState state = PictureState::Moving;
        bool full = false; // in every pixel
    };
    [[nodiscard]] bool refines() const {
        return QTest::qWaitFor(
            [this] {
                return viewport().isSettled() && !viewport().compilesPrograms() &&
                       !m_frames.empty() && m_frames.back().state == PictureState::Refined;
            },
            240'000);
    }
    void drag() const {
        const QPoint center = viewport().rect().center();
        QTest::mousePress(&viewport(), Qt::LeftButton, Qt::NoModifier, center);
        for (int i = 1; i <= 12; ++i) {
            const std::size_t frames = m_frames.size();
            QTest::mouseMove(&viewport(), center + QPoint(6 * i, i));
            ASSERT_TRUE(eventually([&] { return m_frames.size() > frames; })) << i;
        }
        QTest::mouseRelease(&viewport(), Qt::LeftButton, Qt::NoModifier, center + QPoint(72, 12));
    }
    static void turnWheel() {
        const QPointF center = viewport().rect().center();
        QWheelEvent wheel(center, viewport().mapToGlobal(center), {}, {0, 120}, Qt::NoButton,
                          Qt::NoModifier, Qt::NoScrollPhase, false);
        QApplication::sendEvent(&viewport(), &wheel);
    }

    std::vector<Frame> m_frames;
    QObject m_here;
};

TEST_F(RefinementTest, InputComesBeforeTheRestOfAFrame) {
    drag();
    m_frames.clear();
    // What has been shown stays while the next picture is drawn.
    ASSERT_TRUE(eventually([&] {
        viewport().update();
        return !m_frames.empty() && m_frames.back().state == PictureState::Refining;
    }));
    EXPECT_FALSE(m_frames.back().full);
    EXPECT_FALSE(viewport().isSettled());
    const float distance = document().view.camera.distance;
    turnWheel();
    EXPECT_NE(document().view.camera.distance, distance);
    m_frames.clear();
    ASSERT_TRUE(eventually([&] { return !m_frames.empty(); }));
    EXPECT_EQ(m_frames.front().state, PictureState::Moving) << "the finer one is not waited for";

    ASSERT_TRUE(refines());
    EXPECT_TRUE(m_frames.back().full);
}

// Thumbnails have their share of the time while frames are added up.
TEST_F(RefinementTest, ThumbnailsAreDrawnMeanwhile) {
    int passes = 0;
    QObject here;
    QObject::connect(&viewport().sheets(), &SheetScheduler::passDrawn, &here, [&] { ++passes; });
    drag();
    m_frames.clear();
    passes = 0;
    ASSERT_TRUE(refines());
    EXPECT_GT(passes, 0);
}

} // namespace
} // namespace patina::editor
