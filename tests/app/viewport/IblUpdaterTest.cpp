// Light in the background: something at once, everything soon, and only of the newest environment.
#include "app/editor/viewport/IblUpdater.h"
#include "app/editor/job/UiTasks.h"
#include "tests/support/TemporaryFolder.h"

#include <QSignalSpy>
#include <QTest>
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <numbers>

namespace patina::editor {
namespace {

ImagePtr sky(float brightness, int width = 256) {
    Image image(width, width / 2, 3, PixelType::F32, ColorEncoding::Linear);
    for (float& value : image.f32())
        value = brightness;
    return std::make_shared<const Image>(std::move(image));
}

// Of a uniform sky: L = L_00 Y_00.
float brightness(const EnvironmentTexels& texels) {
    return texels.radianceSh[0].x / std::sqrt(4.0f * std::numbers::pi_v<float>);
}

// Waits until the light is as fine as it gets, and takes it.
EnvironmentTexelsPtr takeFull(IblUpdater& updater, QSignalSpy& ready) {
    for (;;) {
        if (EnvironmentTexelsPtr texels = updater.take();
            texels && texels->side == IblSettings().cubeSize)
            return texels;
        if (!ready.wait(30'000)) {
            ADD_FAILURE() << "nothing came";
            return nullptr;
        }
    }
}

struct IblUpdaterTest : ::testing::Test {
    TaskRunner runner{postToThisThread()};
};

TEST_F(IblUpdaterTest, AnswersSoonThenInFull) {
    const test::TemporaryFolder folder;
    IblUpdater updater(runner, folder.path());
    QSignalSpy ready(&updater, &IblUpdater::ready);
    std::shared_ptr<const IblMaps> maps; // somebody shows them
    QObject::connect(&updater, &IblUpdater::mapsReady, [&] { maps = updater.maps(); });
    EXPECT_EQ(updater.take(), nullptr);
    const ImagePtr image = sky(2.0f);
    updater.request(image);
    ASSERT_TRUE(ready.wait(30'000));
    const EnvironmentTexelsPtr quick = updater.take();
    ASSERT_NE(quick, nullptr);
    EXPECT_EQ(updater.take(), nullptr) << "it is taken";
    ASSERT_NE(maps, nullptr);
    EXPECT_EQ(updater.maps(), maps);
    EXPECT_EQ(maps->prefiltered.front().size, quick->side);
    EXPECT_EQ(quick->side, IblSettings::quick().cubeSize);
    EXPECT_EQ(quick->image, image);
    EXPECT_EQ(quick->background->front().width, 256);
    EXPECT_EQ(quick->background->front().texels[0], 0x4000) << "2 as a half float";
    EXPECT_NEAR(brightness(*quick), 2.0f, 1e-4f);
    const EnvironmentTexelsPtr full = takeFull(updater, ready);
    EXPECT_EQ(ready.count(), 2);
    EXPECT_EQ(full->image, image);
    EXPECT_EQ(maps->prefiltered.front().size, full->side);
    EXPECT_NEAR(maps->prefiltered.back().texels[0].x, 2.0f, 1e-4f);
    EXPECT_EQ(full->background, quick->background) << "made once";
    EXPECT_NEAR(brightness(*full), 2.0f, 1e-4f);
}

TEST_F(IblUpdaterTest, KeepsNoMapsThatNobodyShowsAndMakesThemAgain) {
    const test::TemporaryFolder folder;
    IblUpdater updater(runner, folder.path());
    QSignalSpy ready(&updater, &IblUpdater::ready);
    updater.requestMaps(); // of nothing
    updater.request(sky(2.0f));
    const EnvironmentTexelsPtr full = takeFull(updater, ready);
    // The file of the cache may still be on its way out.
    ASSERT_TRUE(QTest::qWaitFor([&] { return updater.maps() == nullptr; }, 60'000));
    std::shared_ptr<const IblMaps> maps;
    QSignalSpy mapsReady(&updater, &IblUpdater::mapsReady);
    QObject::connect(&updater, &IblUpdater::mapsReady, [&] { maps = updater.maps(); });
    updater.requestMaps();
    updater.requestMaps();
    ASSERT_TRUE(mapsReady.wait(60'000));
    ASSERT_NE(maps, nullptr);
    EXPECT_EQ(maps->prefiltered.front().size, full->side);
    EXPECT_NEAR(maps->prefiltered.back().texels[0].x, 2.0f, 1e-4f);
    EXPECT_TRUE(updater.finished());
    EXPECT_EQ(updater.take(), nullptr) << "the picture's light is as it was";
    EXPECT_EQ(mapsReady.count(), 1);
    maps.reset();
    EXPECT_EQ(updater.maps(), nullptr);
}

TEST_F(IblUpdaterTest, RemembersAcrossSessions) {
    const test::TemporaryFolder folder;
    EnvironmentTexelsPtr computed;
    {
        IblUpdater updater(runner, folder.path());
        QSignalSpy ready(&updater, &IblUpdater::ready);
        updater.request(sky(3.0f));
        computed = takeFull(updater, ready);
    } // its end waits for the file
    ASSERT_EQ(folder.files().size(), 1u);
    IblUpdater updater(runner, folder.path());
    QSignalSpy ready(&updater, &IblUpdater::ready);
    updater.request(sky(3.0f)); // another image of the same content
    ASSERT_TRUE(ready.wait(30'000));
    const EnvironmentTexelsPtr known = updater.take();
    ASSERT_NE(known, nullptr);
    EXPECT_EQ(known->prefiltered.texels, computed->prefiltered.texels);
    EXPECT_EQ(known->background->front().texels, computed->background->front().texels);
}

// A new OpenGL context has lost what was taken.
TEST_F(IblUpdaterTest, PreparesAgainWhatWasLost) {
    const test::TemporaryFolder folder;
    IblUpdater updater(runner, folder.path());
    QSignalSpy ready(&updater, &IblUpdater::ready);
    updater.renew(); // nothing was there
    const ImagePtr image = sky(2.0f);
    updater.request(image);
    const EnvironmentTexelsPtr before = takeFull(updater, ready);
    updater.renew();
    const EnvironmentTexelsPtr again = takeFull(updater, ready);
    ASSERT_NE(again, nullptr);
    EXPECT_EQ(again->image, image);
    EXPECT_EQ(again->prefiltered.texels, before->prefiltered.texels);
}

TEST_F(IblUpdaterTest, TheNewestWins) {
    const test::TemporaryFolder folder;
    IblUpdater updater(runner, folder.path());
    QSignalSpy ready(&updater, &IblUpdater::ready);
    ImagePtr last;
    for (int i = 1; i <= 20; ++i)
        updater.request(last = sky(static_cast<float>(i), 1024));
    const EnvironmentTexelsPtr full = takeFull(updater, ready);
    EXPECT_EQ(full->image, last) << "light and background are of one environment";
    EXPECT_NEAR(brightness(*full), 20.0f, 1e-3f);
    EXPECT_LE(ready.count(), 3) << "small of the first, small and full of the last: no others";
    const ImagePtr same = sky(5.0f);
    updater.request(same);
    updater.request(same);
    updater.request(nullptr);
    EXPECT_EQ(takeFull(updater, ready)->image, same);
}

TEST_F(IblUpdaterTest, WorksWithoutAFolderToWriteTo) {
    const test::TemporaryFolder folder;
    std::ofstream(folder / "file") << "in the way";
    IblUpdater updater(runner, folder.path() / "file" / "cache");
    QSignalSpy ready(&updater, &IblUpdater::ready);
    updater.request(sky(1.0f));
    EXPECT_NE(takeFull(updater, ready), nullptr);
}

} // namespace
} // namespace patina::editor
