// Light in the background: something at once, everything soon, and only of the newest environment.
#include "app/editor/viewport/IblUpdater.h"
#include "app/editor/job/UiTasks.h"
#include "tests/support/TemporaryFolder.h"

#include <QSignalSpy>
#include <QTest>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

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
    PreparedLights lights(folder.path());
    IblUpdater updater(runner, lights);
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
    PreparedLights lights(folder.path());
    IblUpdater updater(runner, lights);
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
        PreparedLights lights(folder.path());
        IblUpdater updater(runner, lights);
        QSignalSpy ready(&updater, &IblUpdater::ready);
        updater.request(sky(3.0f));
        computed = takeFull(updater, ready);
    } // its end waits for the file
    ASSERT_EQ(folder.files().size(), 1u);
    PreparedLights lights(folder.path());
    IblUpdater updater(runner, lights);
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
    PreparedLights lights(folder.path());
    IblUpdater updater(runner, lights);
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

// The next frame has it: not a small version first, and nothing is read from disk.
TEST_F(IblUpdaterTest, AnEnvironmentThatWasShownIsPreparedStill) {
    const test::TemporaryFolder folder;
    PreparedLights lights(folder.path());
    IblUpdater updater(runner, lights);
    QSignalSpy ready(&updater, &IblUpdater::ready);
    updater.request(sky(1.0f));
    ASSERT_NE(takeFull(updater, ready), nullptr);
    EXPECT_EQ(lights.bytes(), 0u) << "a scene with one environment keeps nothing for later";
    updater.request(sky(2.0f));
    ASSERT_NE(takeFull(updater, ready), nullptr);
    updater.request(sky(3.0f));
    ASSERT_NE(takeFull(updater, ready), nullptr);
    EXPECT_GT(lights.bytes(), 0u);
    ASSERT_TRUE(QTest::qWaitFor([&] { return folder.files().size() == 3u; }, 60'000));
    for (const std::string& file : folder.files())
        std::filesystem::remove(folder / file);
    ready.clear();
    const ImagePtr again = sky(2.0f); // its file was read again
    updater.request(again);
    ASSERT_TRUE(ready.wait(60'000));
    const EnvironmentTexelsPtr texels = updater.take();
    ASSERT_NE(texels, nullptr);
    EXPECT_EQ(texels->side, IblSettings().cubeSize) << "in full at once";
    EXPECT_EQ(texels->image, again);
    EXPECT_NEAR(brightness(*texels), 2.0f, 1e-4f);
    EXPECT_TRUE(updater.finished());
}

TEST_F(IblUpdaterTest, WhatIsInMemoryIsReadyBeforeTheRequestReturns) {
    const test::TemporaryFolder folder;
    PreparedLights lights(folder.path());
    IblUpdater updater(runner, lights);
    QSignalSpy ready(&updater, &IblUpdater::ready);
    std::vector<ImagePtr> pictures;
    std::vector<EnvironmentTexelsPtr> prepared;
    for (const float radiance : {1.0f, 2.0f, 3.0f}) {
        pictures.push_back(sky(radiance));
        updater.request(pictures.back());
        prepared.push_back(takeFull(updater, ready));
        ASSERT_NE(prepared.back(), nullptr);
    }
    updater.request(pictures[1]);
    EXPECT_EQ(updater.take(), prepared[1]) << "the very texels, so that their textures are found";
    EXPECT_TRUE(updater.finished());
    // What is under way for another one does not come in between.
    updater.request(sky(4.0f));
    updater.request(pictures[2]);
    EXPECT_EQ(updater.take(), prepared[2]);
    ready.clear();
    updater.request(sky(5.0f));
    const EnvironmentTexelsPtr last = takeFull(updater, ready);
    ASSERT_NE(last, nullptr);
    EXPECT_NEAR(brightness(*last), 5.0f, 1e-4f);
}

// What was used longest ago goes.
TEST_F(IblUpdaterTest, PreparedLightsKeepToTheirBudget) {
    const test::TemporaryFolder folder;
    const JobContext job;
    const std::array pictures{sky(1.0f), sky(2.0f), sky(3.0f), sky(4.0f)};
    std::vector<IblLight> full;
    for (const ImagePtr& picture : pictures) {
        const Result<IblLight> small =
            firstIbl(IblCache(folder.path()), picture, iblKey(*picture), job);
        ASSERT_TRUE(small);
        const Result<IblLight> light = refinedIbl(*small, job);
        ASSERT_TRUE(light);
        full.push_back(*light);
    }
    PreparedLights measuring(folder.path());
    for (const IblLight& light : full)
        measuring.keep(light);
    const std::size_t three = measuring.bytes(); // the first came when it was the only one
    PreparedLights lights(folder.path(), three * 2 / 3);
    for (const IblLight& light : full)
        lights.keep(light);
    EXPECT_EQ(lights.bytes(), three * 2 / 3);
    const auto isFull = [&](std::size_t i) {
        const Result<IblLight> light = lights.first(pictures[i], job);
        return light && light->full;
    };
    EXPECT_TRUE(isFull(2));
    EXPECT_TRUE(isFull(3));
    EXPECT_FALSE(isFull(1)) << "it was used longest ago";
    EXPECT_TRUE(isFull(2)); // and is the one used last now …
    lights.keep(full[0]);
    EXPECT_TRUE(isFull(2)) << "… so that another one goes";
    EXPECT_FALSE(isFull(3));
    PreparedLights none(folder.path(), 1);
    none.keep(full[0]);
    none.keep(full[1]);
    EXPECT_EQ(none.bytes(), 0u);
}

TEST_F(IblUpdaterTest, TheNewestWins) {
    const test::TemporaryFolder folder;
    PreparedLights lights(folder.path());
    IblUpdater updater(runner, lights);
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
    PreparedLights lights(folder.path() / "file" / "cache");
    IblUpdater updater(runner, lights);
    QSignalSpy ready(&updater, &IblUpdater::ready);
    updater.request(sky(1.0f));
    EXPECT_NE(takeFull(updater, ready), nullptr);
}

} // namespace
} // namespace patina::editor
