// Who gets thumbnails and when; the drawing itself is a stand-in that says what it was asked for.

#include "app/editor/viewport/SheetScheduler.h"
#include "app/editor/viewport/ScheduleTimer.h"
#include "tests/support/Events.h"

#include <QTest>
#include <algorithm>
#include <chrono>
#include <gmock/gmock.h>
#include <thread>

namespace patina::editor {
namespace {

using namespace shading;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

struct Client final : SheetClient {
    render::ViewSheet wanted;
    std::vector<ViewKind> shown;
    QSize size;
    QRgb color = 0;

    explicit Client(std::vector<ViewKind> kinds)
        : wanted{std::move(kinds), render::ViewMode::Raw, 4, 3} {}
    [[nodiscard]] render::ViewSheet wantedSheet() const override { return wanted; }
    void showThumbnail(ViewKind kind, const QImage& picture) override {
        shown.push_back(kind);
        size = picture.size();
        color = picture.pixel(1, 2);
    }
};

struct SheetSchedulerTest : ::testing::Test {
    FrameSchedule schedule;
    ScheduleTimer turns{schedule};
    SheetScheduler scheduler{schedule};
    std::vector<render::ViewSheet> passes;
    int passMs = 0;
    using Clock = std::chrono::steady_clock;
    using Milliseconds = std::chrono::duration<double, std::milli>;
    Clock::time_point lastEnd;
    Milliseconds shortestGap{1e9}; // between the passes

    void SetUp() override {
        scheduler.setDraw([this](const render::ViewSheet& sheet) -> Result<std::vector<Image>> {
            if (!passes.empty())
                shortestGap = std::min(shortestGap, Milliseconds(Clock::now() - lastEnd));
            passes.push_back(sheet);
            std::this_thread::sleep_for(std::chrono::milliseconds(passMs));
            Image image(sheet.width, sheet.height, 4, PixelType::U8, ColorEncoding::Srgb);
            const auto bytes = image.u8();
            for (std::size_t i = 0; i < bytes.size(); i += 4) {
                bytes[i] = 200;
                bytes[i + 1] = 100;
                bytes[i + 2] = 50;
                bytes[i + 3] = 255;
            }
            lastEnd = Clock::now();
            return std::vector<Image>(sheet.kinds.size(), image);
        });
    }
    void drawAll() {
        bool all = false;
        const auto connection =
            QObject::connect(&scheduler, &SheetScheduler::allDrawn, [&] { all = true; });
        scheduler.wake();
        ASSERT_TRUE(QTest::qWaitFor([&] { return all; }, 30'000));
        QObject::disconnect(connection);
    }
};

TEST_F(SheetSchedulerTest, DrawsNothingWhileTheHandMoves) {
    Client client({kViewD});
    scheduler.add(client);
    scheduler.invalidate();
    patina::test::handleEvents();
    EXPECT_THAT(passes, IsEmpty());
    scheduler.setResting(true);
    drawAll();
    EXPECT_THAT(client.shown, ElementsAre(kViewD));
    scheduler.setResting(false);
    scheduler.invalidate();
    patina::test::handleEvents();
    EXPECT_THAT(passes, SizeIs(1));
}

TEST_F(SheetSchedulerTest, HandsOverThePicturesOfTheSize) {
    Client client({kViewD});
    scheduler.add(client);
    scheduler.setResting(true);
    drawAll();
    EXPECT_EQ(client.size, QSize(4, 3));
    EXPECT_EQ(client.color, qRgb(200, 100, 50));
}

TEST_F(SheetSchedulerTest, DrawsInPassesOfEightInTheClientsOrder) {
    std::vector<ViewKind> kinds(11);
    for (int i = 0; i < 11; ++i)
        kinds[static_cast<std::size_t>(i)] = 20 - i;
    Client client(kinds);
    scheduler.add(client);
    scheduler.setResting(true);
    drawAll();
    ASSERT_THAT(passes, SizeIs(2));
    EXPECT_THAT(passes[0].kinds, SizeIs(8));
    EXPECT_THAT(passes[1].kinds, SizeIs(3));
    EXPECT_EQ(client.shown, kinds);
}

TEST_F(SheetSchedulerTest, DrawsOnlyWhatIsOldOrNew) {
    Client client({kViewD, kViewG});
    scheduler.add(client);
    scheduler.setResting(true);
    drawAll();
    client.wanted.kinds = {kViewG, kViewF}; // scrolled
    drawAll();
    ASSERT_THAT(passes, SizeIs(2));
    EXPECT_THAT(passes[1].kinds, ElementsAre(kViewF));
    client.wanted.kinds = {};
    drawAll();
    EXPECT_THAT(passes, SizeIs(2));
    client.wanted.kinds = {kViewD, kViewF};
    drawAll();
    EXPECT_THAT(passes, SizeIs(2)) << "both are there";
    scheduler.invalidate();
    drawAll();
    ASSERT_THAT(passes, SizeIs(3));
    EXPECT_THAT(passes[2].kinds, ElementsAre(kViewD, kViewF));
    client.wanted.width = 8;
    drawAll();
    ASSERT_THAT(passes, SizeIs(4));
    EXPECT_EQ(passes[3].width, 8);
    client.wanted.mode = render::ViewMode::Contribution;
    drawAll();
    EXPECT_THAT(passes, SizeIs(5));
}

TEST_F(SheetSchedulerTest, ClientsTakeTurns) {
    std::vector<ViewKind> many(16);
    for (int i = 0; i < 16; ++i)
        many[static_cast<std::size_t>(i)] = i;
    Client strip(many), bar({kViewDiffuseIbl});
    scheduler.add(strip);
    scheduler.add(bar);
    scheduler.setResting(true);
    drawAll();
    ASSERT_THAT(passes, SizeIs(3));
    EXPECT_THAT(passes[1].kinds, ElementsAre(kViewDiffuseIbl));
    scheduler.remove(strip);
    scheduler.invalidate();
    drawAll();
    EXPECT_THAT(passes, SizeIs(4));
}

TEST_F(SheetSchedulerTest, AChangeDuringAPassMakesItsPicturesOldAgain) {
    Client client({kViewD});
    scheduler.add(client);
    int changes = 1;
    QObject::connect(&scheduler, &SheetScheduler::passDrawn, [&] {
        if (changes-- > 0)
            scheduler.invalidate();
    });
    scheduler.setResting(true);
    drawAll();
    EXPECT_THAT(client.shown, ElementsAre(kViewD, kViewD));
}

TEST_F(SheetSchedulerTest, PausesForFourTimesAsLongAsItDrew) {
    EXPECT_EQ(SheetScheduler::pauseAfterMs(12.0), 48.0);
    EXPECT_EQ(SheetScheduler::pauseAfterMs(3000.0), 500.0) << "the compiler's time is not repeated";
    Client client({kViewD});
    scheduler.add(client);
    passMs = 20;
    scheduler.setResting(true);
    drawAll();
    scheduler.invalidate();
    drawAll();
    // At least: a busy machine only makes it longer.
    EXPECT_GE(shortestGap.count(), 80.0);
}

TEST_F(SheetSchedulerTest, SlowPassesDrawFewerViewsAtOnce) {
    Client client({0, 1, 2, 3, 4, 5, 6, 7});
    scheduler.add(client);
    passMs = 60;
    scheduler.setResting(true);
    drawAll();
    scheduler.invalidate();
    drawAll();
    ASSERT_GE(passes.size(), 3u);
    EXPECT_THAT(passes[1].kinds, SizeIs(4));
}

TEST_F(SheetSchedulerTest, AFailureIsNotRepeatedBeforeTheSceneChanges) {
    Client client({kViewD});
    int tries = 0;
    scheduler.setDraw([&](const render::ViewSheet&) -> Result<std::vector<Image>> {
        ++tries;
        return Error{ErrorKind::Internal, "the driver refuses", {}, {}};
    });
    scheduler.add(client);
    scheduler.setResting(true);
    drawAll();
    EXPECT_EQ(tries, 1);
    EXPECT_THAT(client.shown, IsEmpty());
    scheduler.invalidate();
    drawAll();
    EXPECT_EQ(tries, 2);
}

} // namespace
} // namespace patina::editor
