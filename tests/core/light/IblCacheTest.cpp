// The cache of image-based light: what goes in comes out, damage is noticed, the oldest goes first.
#include "core/light/IblCache.h"

#include "core/base/AtomicFile.h"
#include "tests/support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <fstream>

namespace patina {
namespace {

namespace fs = std::filesystem;

Image sky(float brightness) {
    Image image(16, 8, 3, PixelType::F32, ColorEncoding::Linear);
    for (std::size_t i = 0; i < image.f32().size(); ++i)
        image.f32()[i] = brightness + static_cast<float>(i % 7);
    return image;
}

IblMaps mapsOf(const Image& image) {
    return *computeIbl(
        image, {.cubeSize = 16, .levels = 3, .irradianceSize = 4, .spacing = LevelSpacing::Even},
        {});
}

void expectSame(const IblMaps& a, const IblMaps& b) {
    EXPECT_EQ(a.spacing, b.spacing);
    ASSERT_EQ(a.prefiltered.size(), b.prefiltered.size());
    for (std::size_t i = 0; i < a.prefiltered.size(); ++i) {
        EXPECT_EQ(a.prefiltered[i].size, b.prefiltered[i].size);
        EXPECT_EQ(a.prefiltered[i].texels, b.prefiltered[i].texels);
    }
    EXPECT_EQ(a.irradiance.size, b.irradiance.size);
    EXPECT_EQ(a.irradiance.texels, b.irradiance.texels);
    EXPECT_EQ(a.irradianceSh, b.irradianceSh);
    EXPECT_EQ(a.radianceSh, b.radianceSh);
}

TEST(IblCache, ReturnsWhatWasStored) {
    const test::TemporaryFolder folder;
    const IblCache cache(folder.path() / "new" / "deep");
    const Image image = sky(1.0f);
    const Hash key = IblCache::key(image, {16, 3, 4});
    EXPECT_FALSE(cache.find(key).has_value());
    const IblMaps maps = mapsOf(image);
    ASSERT_TRUE(cache.store(key, maps).ok());
    const std::optional<IblMaps> found = cache.find(key);
    ASSERT_TRUE(found.has_value());
    expectSame(*found, maps);

    const IblMaps without = *computeIbl(image, {16, 2}, {}); // no irradiance cube
    const Hash other = IblCache::key(image, {16, 2});
    ASSERT_TRUE(cache.store(other, without).ok());
    expectSame(*cache.find(other), without);
    expectSame(*cache.find(key), maps);
}

TEST(IblCache, KeyIsOfContentAndSettings) {
    const Image image = sky(1.0f);
    Image changed = image;
    changed.f32()[100] += 1e-6f * changed.f32()[100];
    const Hash key = IblCache::key(image, {});
    EXPECT_EQ(IblCache::key(Image(image), {}), key);
    EXPECT_NE(IblCache::key(changed, {}), key);
    EXPECT_NE(IblCache::key(image, {.cubeSize = 128}), key);
    EXPECT_NE(IblCache::key(image, {.levels = 6}), key);
    EXPECT_NE(IblCache::key(image, {.spacing = LevelSpacing::Even}), key);
    EXPECT_NE(IblCache::key(image, {.irradianceSize = 32}), key);
    EXPECT_NE(IblCache::key(image, {.cellSize = 0.2f}), key);
    // The same numbers in another shape
    Image tall(8, 16, 3, PixelType::F32, ColorEncoding::Linear);
    std::ranges::copy(image.f32(), tall.f32().begin());
    EXPECT_NE(IblCache::key(tall, {}), key);
}

TEST(IblCache, DamageIsNoticedAndRepaired) {
    const test::TemporaryFolder folder;
    const IblCache cache(folder.path());
    const Image image = sky(2.0f);
    const Hash key = IblCache::key(image, {16, 3, 4});
    const IblMaps maps = mapsOf(image);
    ASSERT_TRUE(cache.store(key, maps).ok());
    const Bytes good = *readFile(cache.file(key), 1 << 20);

    std::vector<Bytes> bad;
    for (const std::size_t at :
         {std::size_t{0}, std::size_t{9}, good.size() / 2, good.size() - 1}) {
        bad.push_back(good);
        bad.back()[at] ^= std::byte{4};
    }
    bad.push_back({});
    bad.emplace_back(good.begin(), good.begin() + 10);
    bad.emplace_back(good.begin(), good.end() - 1);
    bad.push_back(good);
    bad.back().push_back(std::byte{0});
    for (const Bytes& bytes : bad) {
        ASSERT_TRUE(writeFileAtomically(cache.file(key), bytes).ok());
        EXPECT_FALSE(cache.find(key).has_value()) << bytes.size();
        EXPECT_FALSE(fs::exists(cache.file(key)));
        ASSERT_TRUE(cache.store(key, maps).ok());
        EXPECT_TRUE(cache.find(key).has_value());
    }
}

TEST(IblCache, RefusesSizesThatDoNotFit) {
    // A valid hash around an impossible header: huge sizes must not be allocated.
    const test::TemporaryFolder folder;
    const IblCache cache(folder.path());
    const Image image = sky(1.0f);
    const Hash key = IblCache::key(image, {});
    ASSERT_TRUE(cache.store(key, mapsOf(image)).ok());
    const Bytes whole = readFile(cache.file(key), 1 << 20).value();
    // Returns whether the file is still taken with its counts (levels, size, spacing, irradiance)
    // replaced.
    const auto taken = [&](const std::uint32_t(&counts)[4]) {
        Bytes bytes(whole.begin(), whole.end() - sizeof(Hash));
        std::memcpy(bytes.data() + 8, counts, sizeof(counts));
        const Hash hash = hashBytes(bytes);
        bytes.resize(whole.size());
        std::memcpy(bytes.data() + bytes.size() - sizeof(hash), &hash, sizeof(hash));
        EXPECT_TRUE(writeFileAtomically(cache.file(key), bytes).ok());
        return cache.find(key).has_value();
    };
    EXPECT_TRUE(taken({3, 16, 1, 4})); // as they were
    for (const auto& counts : {std::array<std::uint32_t, 4>{0, 16, 1, 4},
                               {3, 4096, 1, 4},
                               {3, 17, 1, 4},
                               {4'000'000'000u, 16, 1, 4},
                               {8, 16, 1, 4},
                               {3, 16, 0, 4},
                               {3, 16, 2, 4},
                               {3, 16, 1, 8},
                               {3, 16, 1, 4'000'000'000u}})
        EXPECT_FALSE(taken({counts[0], counts[1], counts[2], counts[3]})) << counts[1];
}

TEST(IblCache, ForgetsWhatWasUsedLongestAgo) {
    const test::TemporaryFolder folder;
    const IblMaps maps = mapsOf(sky(1.0f));
    // 6 (16² + 8² + 4² + 4²) texels and a little
    const std::uint64_t each = memoryBytes(maps) - sizeof(IblMaps) + 24 + 73 * 12 + 16;
    const IblCache cache(folder.path(), 3 * each);
    std::vector<Hash> keys;
    for (int i = 0; i < 5; ++i) {
        keys.push_back(IblCache::key(sky(static_cast<float>(i)), {}));
        ASSERT_TRUE(cache.store(keys[i], maps).ok());
        EXPECT_EQ(fs::file_size(cache.file(keys[i])), each);
        // An hour apart; the first is used again after the third.
        fs::last_write_time(cache.file(keys[i]),
                            fs::file_time_type::clock::now() - std::chrono::hours(20 - i));
        if (i == 2) {
            EXPECT_TRUE(cache.find(keys[0]).has_value());
        }
    }
    const std::vector<bool> kept{true, false, false, true, true};
    for (int i = 0; i < 5; ++i)
        EXPECT_EQ(fs::exists(cache.file(keys[i])), kept[i]) << i;
    std::ofstream(folder / "notes.txt") << "not ours";
    ASSERT_TRUE(IblCache(folder.path(), 1).store(keys[1], maps).ok());
    EXPECT_TRUE(fs::exists(cache.file(keys[1]))) << "the newest stays, however little may stay";
    EXPECT_EQ(folder.files().size(), 2u);
}

TEST(IblCache, AFolderThatCannotBeMadeIsAnError) {
    const test::TemporaryFolder folder;
    std::ofstream(folder / "file") << "in the way";
    const IblCache cache(folder.path() / "file" / "cache");
    const Image image = sky(1.0f);
    const Hash key = IblCache::key(image, {});
    EXPECT_FALSE(cache.store(key, mapsOf(image)).ok());
    EXPECT_FALSE(cache.find(key).has_value());
}

} // namespace
} // namespace patina
