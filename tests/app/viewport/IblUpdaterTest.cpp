// Light in the background: something at once, everything soon, and only of the newest environment.
#include "app/editor/viewport/IblUpdater.h"
#include "tests/support/TemporaryFolder.h"

#include <QSignalSpy>
#include <fstream>
#include <gtest/gtest.h>

namespace patina::editor {
namespace {

ImagePtr sky(float brightness, int width = 256) {
    Image image(width, width / 2, 3, PixelType::F32, ColorEncoding::Linear);
    for (float& value : image.f32())
        value = brightness;
    return std::make_shared<const Image>(std::move(image));
}

// Waits until the maps are as large as they get.
void waitForFull(const IblUpdater& updater, QSignalSpy& ready) {
    while (!updater.maps() || updater.maps()->prefiltered.front().size != IblSettings().cubeSize)
        ASSERT_TRUE(ready.wait(30'000));
}

TEST(IblUpdater, AnswersSoonThenInFull) {
    const test::TemporaryFolder folder;
    IblUpdater updater(folder.path());
    QSignalSpy ready(&updater, &IblUpdater::ready);
    EXPECT_EQ(updater.maps(), nullptr);
    updater.request(sky(2.0f));
    ASSERT_TRUE(ready.wait(30'000));
    EXPECT_EQ(updater.maps()->prefiltered.front().size, IblSettings::quick().cubeSize);
    EXPECT_NEAR(updater.maps()->prefiltered.back().texels[0].x, 2.0f, 1e-4f);
    waitForFull(updater, ready);
    EXPECT_EQ(ready.count(), 2);
    EXPECT_NEAR(updater.maps()->prefiltered.back().texels[0].x, 2.0f, 1e-4f);
}

TEST(IblUpdater, RemembersAcrossSessions) {
    const test::TemporaryFolder folder;
    std::shared_ptr<const IblMaps> computed;
    {
        IblUpdater updater(folder.path());
        QSignalSpy ready(&updater, &IblUpdater::ready);
        updater.request(sky(3.0f));
        waitForFull(updater, ready);
        computed = updater.maps();
    } // its end waits for the file
    ASSERT_EQ(folder.files().size(), 1u);
    IblUpdater updater(folder.path());
    QSignalSpy ready(&updater, &IblUpdater::ready);
    updater.request(sky(3.0f)); // another image of the same content
    ASSERT_TRUE(ready.wait(30'000));
    for (std::size_t i = 0; i < computed->prefiltered.size(); ++i)
        EXPECT_EQ(updater.maps()->prefiltered[i].texels, computed->prefiltered[i].texels);
}

TEST(IblUpdater, TheNewestWins) {
    const test::TemporaryFolder folder;
    IblUpdater updater(folder.path());
    QSignalSpy ready(&updater, &IblUpdater::ready);
    for (int i = 1; i <= 20; ++i)
        updater.request(sky(static_cast<float>(i), 1024));
    waitForFull(updater, ready);
    EXPECT_NEAR(updater.maps()->prefiltered.back().texels[0].x, 20.0f, 1e-3f);
    EXPECT_LE(ready.count(), 3) << "small of the first, small and full of the last: no others";
    const ImagePtr same = sky(5.0f);
    updater.request(same);
    updater.request(same);
    updater.request(nullptr);
    waitForFull(updater, ready);
}

TEST(IblUpdater, WorksWithoutAFolderToWriteTo) {
    const test::TemporaryFolder folder;
    std::ofstream(folder / "file") << "in the way";
    IblUpdater updater(folder.path() / "file" / "cache");
    QSignalSpy ready(&updater, &IblUpdater::ready);
    updater.request(sky(1.0f));
    waitForFull(updater, ready);
}

} // namespace
} // namespace patina::editor
