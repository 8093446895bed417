// Films under way: kept, read back, gone on with.
#include "core/trace/file/FilmFile.h"

#include "core/job/Parallel.h"
#include "core/trace/file/FilmMerge.h"
#include "core/trace/file/FilmTiles.h"
#include "core/trace/file/FilmTracer.h"
#include "tests/core/trace/CornellScene.h"
#include "tests/support/TemporaryFolder.h"

#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <memory>
#include <set>
#include <sstream>

namespace patina {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class FilmFiles : public ::testing::Test {
  protected:
    [[nodiscard]] fs::path file(const std::string& name) const { return m_folder.path() / name; }

    static FilmManifest manifest() {
        FilmManifest m;
        m.width = 40;
        m.height = 24;
        m.settings = {{"samples", "64"}, {"seed", "0"}};
        m.display = {{"view.exposureEv", "0"}};
        m.inputs = {{1, 2}, {3, 4}, {5, 6}, {7, 8}};
        m.camera = {{0.278f, 0.273f, 0.28f}, 180.0f, 0.0f, 1.08f, 39.3f, {true, 1.2f, 1.1f}};
        m.scene = "builtin:cornell-box";
        m.sets = {"material.metallic=1"};
        return m;
    }
    static TraceView view() {
        TraceView view;
        view.width = 40;
        view.height = 24;
        view.camera = manifest().camera;
        return view;
    }
    static const TraceScene& scene() {
        static const TraceScene room =
            TraceScene::build(test::cornellBox(test::kCornellWalls[0], true), {}).value();
        return room;
    }
    const test::TemporaryFolder m_folder;
};

std::string contentOf(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
}

} // namespace

TEST_F(FilmFiles, AreReadAsTheyWereWritten) {
    FilmManifest m = manifest();
    m.hasOutputs = true;
    Film film(40, 24);
    TraceOutputs outputs(40, 24);
    TraceTiles tiles;
    tiles.outputs = &outputs;
    ASSERT_TRUE(tracePaths(scene(), view(), {}, film, 0, 3, {}, nullptr, tiles).ok());
    for (const int count : {1, 2, 5, 9}) {
        Film joined;
        TraceOutputs joinedOutputs;
        std::vector<fs::path> files;
        for (int shard = 0; shard < count; ++shard) {
            m.shard = {shard, count};
            m.complete = true;
            files.push_back(file("part" + std::to_string(shard)));
            ASSERT_TRUE(writeFilm(files.back(), m, film, outputs, StateFileName::OfUser).ok());
            EXPECT_TRUE(looksLikeFilm(files.back()));
            const Result<FilmManifest> read = readFilm(files.back(), joined, joinedOutputs);
            ASSERT_TRUE(read.ok()) << read.error().text();
            EXPECT_TRUE(*read == m);
        }
        EXPECT_TRUE(joined == film) << count;
        EXPECT_TRUE(joinedOutputs == outputs) << count;
        const Result<JoinedFilm> merged = joinFilms(files);
        ASSERT_TRUE(merged.ok());
        EXPECT_TRUE(merged->film == film);
        EXPECT_TRUE(merged->outputs == outputs);
        EXPECT_EQ(merged->manifest.samples, 3u);
    }
}

TEST_F(FilmFiles, EachPixelIsOfOneShard) {
    for (const auto& [width, height] : {std::pair{40, 24}, {1, 1}, {16, 16}, {17, 33}, {300, 5}})
        for (const int count : {1, 2, 3, 8}) {
            std::multiset<std::size_t> seen;
            for (int shard = 0; shard < count; ++shard) {
                std::size_t pixels = 0;
                forShardRows(width, height, {shard, count},
                             [&](std::size_t first, std::size_t length) {
                                 for (std::size_t i = first; i < first + length; ++i)
                                     seen.insert(i);
                                 pixels += length;
                             });
                EXPECT_EQ(pixels, shardPixels(width, height, {shard, count}));
            }
            EXPECT_EQ(seen.size(), static_cast<std::size_t>(width * height));
            EXPECT_EQ(std::set<std::size_t>(seen.begin(), seen.end()).size(), seen.size());
        }
}

TEST_F(FilmFiles, WhatMakesNoSenseIsRefused) {
    const FilmManifest m = manifest();
    const auto refused = [&](const fs::path& path) {
        Film film;
        TraceOutputs outputs;
        const Result<FilmManifest> read = readFilm(path, film, outputs);
        EXPECT_FALSE(read.ok());
        EXPECT_EQ(read.error().kind, ErrorKind::InputBroken);
        return read.error().message;
    };
    Film film(40, 24);
    film.at(3, 4).sum.y = std::nan("");
    ASSERT_TRUE(writeFilm(file("nan"), m, film, {}, StateFileName::OfUser).ok());
    EXPECT_THAT(refused(file("nan")), HasSubstr("out of range"));
    film.at(3, 4) = {};
    film.at(3, 4).coverage = 2.0f;
    ASSERT_TRUE(writeFilm(file("cover"), m, film, {}, StateFileName::OfUser).ok());
    EXPECT_THAT(refused(file("cover")), HasSubstr("out of range"));
    FilmManifest wordy = m;
    wordy.display["view.toneMap"] = std::string(70'000, 'x');
    ASSERT_TRUE(writeFilm(file("long"), wordy, Film(40, 24), {}, StateFileName::OfUser).ok());
    EXPECT_THAT(refused(file("long")), HasSubstr("\"view.toneMap\" has 70012 characters"));

    // Any byte that is cut or changed is found out.
    film.at(3, 4) = {};
    ASSERT_TRUE(writeFilm(file("whole"), m, film, {}, StateFileName::OfUser).ok());
    const std::string whole = contentOf(file("whole"));
    for (std::size_t at = 0; at < whole.size(); at += 997) {
        std::string changed = whole;
        changed[at] = static_cast<char>(changed[at] ^ 0x40);
        std::ofstream(file("changed"), std::ios::binary) << changed;
        refused(file("changed"));
        std::ofstream(file("cut"), std::ios::binary) << whole.substr(0, at);
        refused(file("cut"));
    }
}

// A picture is not believed before its files are as large as it, all of them: nothing is done for
// pixels that are only spoken of.
TEST_F(FilmFiles, PixelsThatAreNotThereAreNotBelieved) {
    const FilmManifest m = manifest();
    ASSERT_TRUE(writeFilm(file("whole"), m, Film(40, 24), {}, StateFileName::OfUser).ok());
    const std::string whole = contentOf(file("whole"));
    const StateFormat format{{'P', 'a', 't', 'i', 'n', 'a', 'F', 'm'}, 1, {}, {}};
    const auto write = [&](const std::string& name, int side, int shard, int shards) {
        std::string text = whole.substr(16, whole.find("\n}") + 2 - 16);
        const auto replace = [&](const std::string& what, const std::string& by) {
            text.replace(text.find(what), what.size(), by);
        };
        replace("40", std::to_string(side));
        replace("24", std::to_string(side));
        replace("0,\n  1\n", std::to_string(shard) + "," + std::to_string(shards));
        replace("false,\n \"samples", "true,\n \"samples");
        ASSERT_TRUE(writeStateFile(file(name), format, text, {}, StateFileName::OfUser).ok());
    };
    const auto refusal = [&](const std::vector<fs::path>& files) {
        const Result<FilmManifest> read = readFilmManifest(files[0]);
        EXPECT_FALSE(read.ok());
        const Result<JoinedFilm> joined = joinFilms(files);
        EXPECT_FALSE(joined.ok());
        EXPECT_EQ(joined.ok() ? std::string() : joined.error().message,
                  read.ok() ? std::string() : read.error().message);
        return read.ok() ? std::string() : read.error().message;
    };
    const std::clock_t begin = std::clock();
    write("huge", 1 << 20, 0, 1);
    EXPECT_THAT(refusal({file("huge")}), HasSubstr("32768 a side"));
    write("shard", 1 << 20, 1, 2); // of which nobody counts the tiles
    EXPECT_THAT(refusal({file("shard")}), HasSubstr("1048576 × 1048576 pixels"));
    write("empty", 32768, 0, 1); // 64 GiB
    EXPECT_THAT(refusal({file("empty")}), HasSubstr("its end is missing"));
    // All parts, of which each has pixels, but these.
    write("a", 16384, 0, 2);
    write("b", 16384, 1, 2);
    EXPECT_THAT(refusal({file("a"), file("b")}), HasSubstr("its end is missing"));
    EXPECT_LT(std::clock() - begin, 2 * CLOCKS_PER_SEC);
}

TEST_F(FilmFiles, SayWhatDiffers) {
    const FilmManifest m = manifest();
    FilmManifest other = m;
    EXPECT_FALSE(whyDifferent(m, other).has_value());
    other.sets = {};
    other.shard = {1, 2};
    other.samples = 5;
    EXPECT_FALSE(whyDifferent(m, other).has_value());
    other.settings["samples"] = "128";
    EXPECT_EQ(*whyDifferent(m, other), "samples (64 there, 128 here)");
    other.settings.erase("samples");
    EXPECT_EQ(*whyDifferent(m, other), "samples (64 there, none here)");
    other = m;
    other.inputs.lights = {9, 9};
    EXPECT_EQ(*whyDifferent(m, other), "the lights of builtin:cornell-box, which changed");
    other.scene = "room.glb";
    EXPECT_EQ(*whyDifferent(m, other), "the lights (builtin:cornell-box there, room.glb here)");
    other = m;
    other.display["view.exposureEv"] = "1";
    EXPECT_EQ(*whyDifferent(m, other), "view.exposureEv (0 there, 1 here)");
}

// From every state that a checkpoint may hold: between passes and within one, also where the noise
// was looked at last.
TEST_F(FilmFiles, GoOnToTheSameEnd) {
    FilmTracerSettings settings;
    settings.manifest = manifest();
    settings.samples = 256;
    settings.noise = 0.25;
    const auto trace = [&](const FilmTracerSettings& with) {
        auto tracer = std::make_unique<FilmTracer>(with);
        const Result<void> traced = tracer->trace(scene(), view(), {}, {});
        EXPECT_TRUE(traced.ok()) << (traced ? "" : traced.error().text());
        return tracer;
    };
    const auto whole = trace(settings);
    const std::uint32_t samples = whole->manifest().samples;
    ASSERT_TRUE(whole->manifest().complete);
    ASSERT_GT(samples, 3u);
    ASSERT_LT(samples, 256u);
    ASSERT_LE(*whole->noise(), 0.25);

    settings.checkpoint = file("a.checkpoint");
    settings.resume = true;
    std::uint32_t done = 0;
    for (std::uint32_t pass = 1; done <= samples; pass = std::min(2 * pass, 16u)) {
        for (const bool within : {false, true}) {
            if (within && done == samples)
                continue; // the next pass is never begun
            Film film(40, 24);
            if (done > 0) {
                ASSERT_TRUE(tracePaths(scene(), view(), {}, film, 0, done, {}).ok());
            }
            TraceTiles half;
            half.shard = {0, 2};
            if (within) {
                ASSERT_TRUE(
                    tracePaths(scene(), view(), {}, film, done, pass, {}, nullptr, half).ok());
            }
            ASSERT_TRUE(
                writeFilm(settings.checkpoint, settings.manifest, film, {}, StateFileName::Own)
                    .ok());
            for (const int threads : {1, 7}) {
                const ThreadLimit limit(threads);
                const auto resumed = trace(settings);
                EXPECT_TRUE(resumed->film() == whole->film()) << done << " " << within;
                EXPECT_EQ(resumed->manifest().samples, samples);
                EXPECT_EQ(resumed->resumedFrom(), std::optional(done));
                EXPECT_EQ(resumed->noise(), whole->noise());
            }
        }
        done += pass;
    }
}

} // namespace patina
