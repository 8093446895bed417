// The viewport's context is destroyed again and again: the picture comes back as it was. How often:
// PATINA_CONTEXT_LOSSES (1 by default; the demand is 20).

#include "core/light/Light.h"
#include "tests/app/editor/EditorFixture.h"

#include "app/editor/viewport/IblUpdater.h"
#include "core/edit/EditSession.h"

#include <QImage>
#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace patina::editor {
namespace {

class ContextLoss : public EditorTest {
  protected:
    // Settled: nothing is drawn any more, however the scene is refined.
    static QImage picture() {
        ViewportWidget& viewport = window->viewport();
        viewport.setFocus();
        QImage before;
        const bool still = eventually([&] {
            if (!viewport.isSettled() || session->controller.tasks().busy() ||
                !session->ibl.finished())
                return false;
            const QImage now = viewport.grabFramebuffer();
            const bool same = !now.isNull() && now == before;
            before = now;
            return same && viewport.isSettled();
        });
        EXPECT_TRUE(still);
        return before;
    }
    // Out of the window and back: two windows, two contexts.
    static void loseContext() {
        const QByteArray layout = window->saveState(); // the docks take the room meanwhile
        QWidget* centre = window->takeCentralWidget();
        centre->setParent(nullptr);
        centre->resize(700, 500);
        centre->show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(centre, 60'000));
        centre->hide();
        window->setCentralWidget(centre);
        centre->show();
        EXPECT_TRUE(window->restoreState(layout));
        QCoreApplication::processEvents();
    }
};

int largestDifference(const QImage& a, const QImage& b) {
    int largest = a.size() == b.size() ? 0 : 256;
    for (int y = 0; y < a.height() && largest < 256; ++y)
        for (int x = 0; x < a.width(); ++x) {
            const QRgb p = a.pixel(x, y), q = b.pixel(x, y);
            largest = std::max({largest, std::abs(qRed(p) - qRed(q)),
                                std::abs(qGreen(p) - qGreen(q)), std::abs(qBlue(p) - qBlue(q))});
        }
    return largest;
}

TEST_F(ContextLoss, ThePictureComesBackFromWhatTheProcessorHolds) {
    controller().addLight(LightType::Spot);
    controller().setParameter(parameter("environment.rotationDeg"), {Scope::Environment, 0}, 70.0f);
    window->viewport().setAddsSlowFrames(true); // or a busy moment decides how smooth it gets
    const QImage before = picture();
    ASSERT_FALSE(before.isNull());
    const QString pictures = qEnvironmentVariable("PATINA_SCREENSHOTS"); // empty: none are kept
    if (!pictures.isEmpty())
        before.save(pictures + QStringLiteral("/context-before.png"));
    int contexts = 0;
    const auto counting = QObject::connect(&window->viewport(), &ViewportWidget::contextReady,
                                           &window->viewport(), [&] { ++contexts; });
    const char* text = std::getenv("PATINA_CONTEXT_LOSSES");
    const int losses = text ? std::atoi(text) : 1;
    int worst = 0;
    for (int i = 0; i < losses; ++i) {
        SCOPED_TRACE(i);
        loseContext();
        const QImage after = picture();
        worst = std::max(worst, largestDifference(before, after));
        if (worst > 2 && !pictures.isEmpty())
            after.save(pictures + QStringLiteral("/context-after.png"));
        ASSERT_LE(worst, 2) << "of 255";
    }
    QObject::disconnect(counting);
    EXPECT_GE(contexts, losses) << "the contexts were not lost";
    EXPECT_TRUE(controller().isModified());
    std::printf("%d losses, %d new contexts, largest difference %d of 255\n", losses, contexts,
                worst);
}

} // namespace
} // namespace patina::editor
