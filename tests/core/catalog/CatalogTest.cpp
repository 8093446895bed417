// Entries of a catalog: made from files, kept, sorted, searched, compared.
#include "core/catalog/CatalogCache.h"
#include "core/catalog/CatalogEntry.h"
#include "core/catalog/CatalogOrder.h"
#include "core/io/ImageIO.h"
#include "core/library/Library.h"
#include "core/light/Environment.h"
#include "core/light/EnvironmentResample.h"
#include "core/worker/WorkerClient.h"
#include "tests/core/catalog/Pictures.h"
#include "tests/support/TemporaryFolder.h"

#include <chrono>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace patina;
using namespace patina::test;
using testing::ElementsAre;
using testing::HasSubstr;

namespace fs = std::filesystem;

namespace {

class CatalogTest : public testing::Test {
  protected:
    static void SetUpTestSuite() { s_worker = std::make_unique<WorkerClient>(); }
    static void TearDownTestSuite() { s_worker.reset(); }

    std::string save(const Image& image, const std::string& name) {
        const fs::path file = m_folder / name;
        fs::create_directories(file.parent_path());
        const Result<void> saved = saveImage(*s_worker, image, file);
        EXPECT_TRUE(saved.ok()) << saved.error().text();
        return file.string();
    }
    CatalogEntry entry(const std::string& source) {
        Result<CatalogEntry> made = makeCatalogEntry(*s_worker, source);
        EXPECT_TRUE(made.ok()) << (made.ok() ? "" : made.error().text());
        return made.ok() ? *std::move(made) : CatalogEntry();
    }
    CatalogEntryPtr shared(const std::string& source) {
        return std::make_shared<const CatalogEntry>(entry(source));
    }

    TemporaryFolder m_folder;
    static std::unique_ptr<WorkerClient> s_worker;
};

std::unique_ptr<WorkerClient> CatalogTest::s_worker;

// Of made-up measures.
CatalogEntryPtr named(const std::string& title, const EnvironmentMeasures& measures = {}) {
    CatalogEntry entry;
    entry.source = "/" + title;
    entry.title = title;
    entry.measures = measures;
    return std::make_shared<const CatalogEntry>(std::move(entry));
}

std::vector<std::string> titles(const std::vector<CatalogEntryPtr>& entries, CatalogSort sort,
                                bool descending = false) {
    std::vector<std::string> result;
    for (const std::size_t i : sortedEntries(entries, sort, descending))
        result.push_back(entries[i]->title);
    return result;
}

} // namespace

TEST_F(CatalogTest, AnEntrySaysWhatTheFileIs) {
    const Disc disc{60, 40, 4, 1000, 1};
    const std::string file = save(disc.picture(128), "noon.hdr");
    const CatalogEntry noon = entry(file);
    EXPECT_EQ(noon.source, file);
    EXPECT_EQ(noon.title, "noon");
    EXPECT_EQ(noon.fileBytes, fs::file_size(file));
    EXPECT_EQ(noon.width, 256);
    EXPECT_EQ(noon.height, 128);
    EXPECT_EQ(noon.layout, "Lat-long");
    EXPECT_TRUE(noon.notices.empty());
    ASSERT_TRUE(noon.measures.source);
    EXPECT_NEAR(noon.measures.source->elevationDeg, 40, 0.5);
}

TEST_F(CatalogTest, BuiltInEnvironmentsAreEntriesToo) {
    for (const library::Entry& one : library::environments()) {
        const CatalogEntry made = entry("builtin:" + one.name);
        EXPECT_EQ(made.title, one.title);
        EXPECT_EQ(made.width, 1024);
        EXPECT_EQ(made.fileBytes, 0u);
    }
    EXPECT_FALSE(makeCatalogEntry(*s_worker, "builtin:nothing").ok());
}

TEST_F(CatalogTest, SixFacesAreOneEntry) {
    Image face(16, 16, 3, PixelType::F32, ColorEncoding::Linear);
    std::ranges::fill(face.f32(), 0.5f);
    std::string first;
    std::uint64_t bytes = 0;
    for (const char* name : {"nx", "py", "ny", "pz", "nz", "px"}) {
        first = save(face, std::string("sky_") + name + ".exr");
        bytes += fs::file_size(first);
    }
    const CatalogEntry sky = entry(first);
    EXPECT_EQ(sky.fileBytes, bytes);
    EXPECT_EQ(sky.width, 16);
    EXPECT_EQ(sky.height, 16);
    EXPECT_NEAR(sky.measures.meanLuminance, 0.5, 1e-3);
    // Each face counts for the key.
    const Hash before = *catalogKey(first);
    fs::last_write_time(m_folder / "sky_pz.exr",
                        fs::last_write_time(first) + std::chrono::seconds(5));
    EXPECT_NE(*catalogKey(first), before);
}

TEST_F(CatalogTest, WhatIsKeptIsWhatWasMade) {
    const CatalogCache cache(m_folder / "cache");
    std::vector<std::string> sources{save(Disc().picture(64), "disc.exr"),
                                     save(uniform(glm::dvec3(0.0)), "black.hdr"),
                                     save(uniform({0.1, 1.0, 0.1}), "green.hdr")};
    Image odd(30, 20, 3, PixelType::F32, ColorEncoding::Linear);
    std::ranges::fill(odd.f32(), 1.0f);
    sources.push_back(save(odd, "odd.exr")); // stretched, which is a notice
    EXPECT_FALSE(entry(sources.back()).notices.empty());
    for (const std::string& source : sources) {
        const Hash key = *catalogKey(source);
        EXPECT_FALSE(cache.find(key));
        const CatalogEntry made = entry(source);
        ASSERT_TRUE(cache.store(key, made).ok());
        const std::optional<CatalogEntry> found = cache.find(key);
        ASSERT_TRUE(found);
        EXPECT_EQ(*found, made) << source;
    }
}

TEST_F(CatalogTest, AChangedFileHasAnotherKey) {
    const std::string file = save(uniform(glm::dvec3(1.0)), "sky.hdr");
    const Hash key = *catalogKey(file);
    EXPECT_EQ(*catalogKey(file), key);
    fs::last_write_time(file, fs::last_write_time(file) + std::chrono::seconds(1));
    const Hash later = *catalogKey(file);
    EXPECT_NE(later, key);
    const fs::file_time_type time = fs::last_write_time(file);
    std::ofstream(file, std::ios::app) << "more";
    fs::last_write_time(file, time);
    EXPECT_NE(*catalogKey(file), later);
    fs::copy_file(file, m_folder / "other.hdr");
    EXPECT_NE(*catalogKey((m_folder / "other.hdr").string()), *catalogKey(file));
}

TEST_F(CatalogTest, ADamagedEntryIsDropped) {
    const CatalogCache cache(m_folder / "cache");
    const std::string source = "builtin:studio";
    const Hash key = *catalogKey(source);
    const CatalogEntry made = entry(source);
    ASSERT_TRUE(cache.store(key, made).ok());
    const auto size = fs::file_size(cache.file(key));
    for (const std::uintmax_t left : {size - 1, size / 2, std::uintmax_t{20}, std::uintmax_t{0}}) {
        fs::resize_file(cache.file(key), left);
        EXPECT_FALSE(cache.find(key)) << left;
        EXPECT_FALSE(fs::exists(cache.file(key)));
        ASSERT_TRUE(cache.store(key, made).ok());
    }
    {
        std::fstream file(cache.file(key), std::ios::in | std::ios::out | std::ios::binary);
        file.seekp(static_cast<std::streamoff>(size / 2));
        file.put('\x5a');
        file.put('\x5a');
    }
    EXPECT_FALSE(cache.find(key));
    ASSERT_TRUE(cache.store(key, made).ok());
    EXPECT_EQ(cache.find(key), made);
}

TEST_F(CatalogTest, TheFolderIsBounded) {
    const CatalogEntry made = entry("builtin:overcast");
    const CatalogCache unbounded(m_folder / "one");
    ASSERT_TRUE(unbounded.store(Hash{1, 1}, made).ok());
    const std::uint64_t one = fs::file_size(unbounded.file(Hash{1, 1}));
    const CatalogCache cache(m_folder / "cache", 3 * one);
    for (std::uint64_t i = 0; i < 8; ++i)
        ASSERT_TRUE(cache.store(Hash{0, i}, made).ok());
    EXPECT_EQ(std::distance(fs::directory_iterator(m_folder / "cache"), fs::directory_iterator()),
              3);
    EXPECT_TRUE(cache.find(Hash{0, 7}));
}

TEST_F(CatalogTest, FilesThatCannotBeRead) {
    const std::string broken = m_folder.write("broken.hdr", "#?RADIANCE\nnothing").string();
    const std::string empty = m_folder.write("empty.exr", "").string();
    const std::string huge =
        m_folder.write("huge.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 999999 +X 999999\n")
            .string();
    for (const std::string& file : {broken, empty, huge}) {
        EXPECT_TRUE(catalogKey(file).ok());
        const Result<CatalogEntry> made = makeCatalogEntry(*s_worker, file);
        ASSERT_FALSE(made.ok()) << file;
        EXPECT_EQ(made.error().kind, ErrorKind::InputBroken) << file;
        EXPECT_FALSE(made.error().message.empty());
        EXPECT_EQ(made.error().file, file);
    }
    const std::string gone = (m_folder / "gone.hdr").string();
    ASSERT_FALSE(catalogKey(gone).ok());
    EXPECT_EQ(catalogKey(gone).error().kind, ErrorKind::InputMissing);
    EXPECT_EQ(makeCatalogEntry(*s_worker, gone).error().kind, ErrorKind::InputMissing);
}

TEST_F(CatalogTest, CancelledLeavesNothing) {
    JobControl control;
    control.cancel();
    const Result<CatalogEntry> made =
        makeCatalogEntry(*s_worker, "builtin:studio", control.context());
    ASSERT_FALSE(made.ok());
    EXPECT_EQ(made.error().kind, ErrorKind::Cancelled);
}

TEST_F(CatalogTest, DuplicatesAreFound) {
    const Image noon = Disc{60, 40, 12, 100, 1}.picture(256);
    const std::string file = save(noon, "noon.exr");
    fs::copy_file(file, m_folder / "copy.exr");
    const EnvironmentMapping mapping =
        *EnvironmentMapping::create(EnvironmentLayout::LatLong, {512, 256});
    const std::string rotated =
        save(resampleEnvironment(noon, mapping, mapping, {45.0f, 1.0f}), "rotated.exr");
    const std::vector<CatalogEntryPtr> entries{
        shared(file), shared((m_folder / "copy.exr").string()), shared("builtin:studio"),
        shared(rotated), shared(save(shrinkLatLong(noon, 256), "small.exr"))};
    const auto same = findSameEntries(entries);
    ASSERT_EQ(same.size(), entries.size());
    EXPECT_FALSE(same[0]);
    ASSERT_TRUE(same[1]);
    EXPECT_EQ(same[1]->of, 0u);
    EXPECT_TRUE(same[1]->exactly);
    EXPECT_FALSE(same[2]);
    ASSERT_TRUE(same[3]);
    EXPECT_EQ(same[3]->of, 0u);
    EXPECT_FALSE(same[3]->exactly);
    EXPECT_NEAR(same[3]->rotationDeg, 45.0f, 0.2f);
    ASSERT_TRUE(same[4]);
    EXPECT_EQ(same[4]->of, 0u);
    EXPECT_NEAR(std::remainder(same[4]->rotationDeg, 360.0f), 0.0f, 0.2f);
}

TEST(CatalogOrder, NamesAsPeopleNumberThem) {
    const std::vector<CatalogEntryPtr> entries{named("sky 10"), named("Sky 2"), named("sky"),
                                               named("alley"), named("sky 2b")};
    EXPECT_THAT(titles(entries, CatalogSort::Name),
                ElementsAre("alley", "sky", "Sky 2", "sky 2b", "sky 10"));
    EXPECT_THAT(titles(entries, CatalogSort::Name, true),
                ElementsAre("sky 10", "sky 2b", "Sky 2", "sky", "alley"));
}

TEST(CatalogOrder, ByEachNumberWithThoseWithoutLast) {
    EnvironmentMeasures low, high, none;
    low.source = BrightestSource{0.2, 0, 10, 1, true};
    high.source = BrightestSource{0.9, 0, 70, 1, true};
    low.temperature = ColorTemperature{3000, 0};
    high.temperature = ColorTemperature{9000, 0};
    low.rangeStops = 5, high.rangeStops = 15, none.rangeStops = 1;
    low.keyToFill = 2, high.keyToFill = 9;
    low.meanLuminance = 1, high.meanLuminance = 4;
    const std::vector<CatalogEntryPtr> entries{named("b high", high), named("c none", none),
                                               named("a low", low)};
    for (const CatalogSort sort :
         {CatalogSort::SunElevation, CatalogSort::SunShare, CatalogSort::Temperature}) {
        EXPECT_THAT(titles(entries, sort), ElementsAre("a low", "b high", "c none"));
        EXPECT_THAT(titles(entries, sort, true), ElementsAre("b high", "a low", "c none"));
    }
    for (const CatalogSort sort :
         {CatalogSort::Range, CatalogSort::KeyToFill, CatalogSort::Brightness}) {
        EXPECT_THAT(titles(entries, sort), ElementsAre("c none", "a low", "b high"));
        EXPECT_THAT(titles(entries, sort, true), ElementsAre("b high", "a low", "c none"));
    }
    // A lamp among others is no sun.
    EnvironmentMeasures even;
    even.source = BrightestSource{0.1, 0, 80, 1, false};
    EXPECT_FALSE(sortNumber(even, CatalogSort::SunElevation));
}

TEST(CatalogOrder, SearchesNameAndTags) {
    EnvironmentMeasures warm;
    warm.meanLuminance = 1.0;
    warm.medianLuminance = 1.0;
    warm.keyToFill = 10.0;
    warm.temperature = ColorTemperature{3000, 0};
    const CatalogEntry entry = *named("Old_Street 4k", warm);
    for (const char* search :
         {"", "  ", "street", "STREET old", "warm", "warm 4k", "high contrast", "contr", "wa"})
        EXPECT_TRUE(matchesSearch(entry, false, search)) << search;
    for (const char* search : {"cool", "street cool", "sun", "ontrast", "duplicate"})
        EXPECT_FALSE(matchesSearch(entry, false, search)) << search;
    EXPECT_TRUE(matchesSearch(entry, true, "dupl street"));
}
