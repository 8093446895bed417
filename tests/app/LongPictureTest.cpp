// Traced pictures as farms render them: split over processes, killed, resumed, merged; and what
// they say when that cannot be.
#include "CommandRunner.h"
#include "KilledRun.h"
#include "core/base/FileLock.h"

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace fs = std::filesystem;
using namespace patina;
using namespace patina::test;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

namespace {

// Boxes in a room, with tiles that are cut at the right and below.
class LongPicture : public ::testing::Test {
  protected:
    [[nodiscard]] std::vector<std::string> arguments(const std::string& output,
                                                     const std::vector<std::string>& more) const {
        std::vector<std::string> all{"render", "builtin:cornell-box", "--renderer", "path",
                                     "-o",     m_folder / output};
        if (std::ranges::count(more, "--size") == 0)
            all.insert(all.end(), {"--size", "72x53"});
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    [[nodiscard]] Outcome render(const std::string& output, const std::vector<std::string>& more,
                                 const RunOptions& options = {}) const {
        return runPatina(arguments(output, more), options);
    }
    [[nodiscard]] Outcome merge(const std::vector<std::string>& parts,
                                const std::string& output) const {
        std::vector<std::string> all{"merge", "-o", m_folder / output};
        for (const std::string& part : parts)
            all.push_back(m_folder / part);
        return runPatina(all);
    }
    [[nodiscard]] std::string bytes(const std::string& name) const {
        return readBytes(m_folder / name);
    }
    TemporaryFolder m_folder;
};

TEST_F(LongPicture, SameBytesForAnyThreadsAndShards) {
    // Of an odd number of samples, displayed and linear, with and without alpha.
    const std::vector<std::vector<std::string>> pictures = {
        {"--samples", "11"},
        {"--samples", "3", "--seed", "5", "--background", "transparent", "--exposure", "1.5",
         "--tone-map", "reinhard"},
        {"--samples", "2", "--exposure", "auto", "--max-bounces", "1"}};
    for (const std::vector<std::string>& picture : pictures) {
        // Tiles and threads do not ask what is drawn: of one picture all pairings, of the others
        // one.
        const bool all = &picture == &pictures[0];
        const std::vector<const char*> threadCounts =
            all ? std::vector{"1", "2", "7"} : std::vector{"2"};
        for (const char* threads : threadCounts)
            for (const char* ending : {".exr", ".png"}) {
                std::vector<std::string> more = picture;
                more.insert(more.end(), {"--threads", threads});
                const Outcome whole = render(threads + std::string(ending), more);
                ASSERT_EQ(whole.status, 0) << whole.err;
            }
        for (const int count : all ? std::vector{1, 3, 8} : std::vector{3}) {
            std::vector<std::string> parts;
            for (int k = count; k >= 1; --k) {
                parts.push_back("part" + std::to_string(k));
                std::vector<std::string> more = picture;
                more.insert(more.end(),
                            {"--shard", std::to_string(k) + "/" + std::to_string(count)});
                const Outcome part = render(parts.back(), more);
                ASSERT_EQ(part.status, 0) << part.err;
            }
            for (const char* ending : {".exr", ".png"}) {
                const Outcome merged = merge(parts, std::string("merged") + ending);
                ASSERT_EQ(merged.status, 0) << merged.err;
                for (const char* threads : threadCounts)
                    EXPECT_EQ(bytes(std::string("merged") + ending),
                              bytes(threads + std::string(ending)))
                        << count << " parts, " << threads << " threads, " << ending;
            }
        }
    }
}

TEST_F(LongPicture, MoreShardsThanTiles) {
    ASSERT_EQ(render("whole.exr", {"--samples", "2", "--size", "20x7"}).status, 0);
    for (const char* k : {"1", "2", "3"}) {
        const Outcome part = render(std::string("part") + k, {"--samples", "2", "--size", "20x7",
                                                              "--shard", std::string(k) + "/3"});
        ASSERT_EQ(part.status, 0) << part.err;
    }
    const Outcome merged = merge({"part1", "part2", "part3"}, "merged.exr");
    ASSERT_EQ(merged.status, 0) << merged.err;
    EXPECT_EQ(bytes("merged.exr"), bytes("whole.exr"));
}

TEST_F(LongPicture, MergeRefusesWhatDoesNotGoTogether) {
    const std::vector<std::string> usual{"--samples", "2"};
    const auto part = [&](const std::string& name, const char* shard,
                          const std::vector<std::string>& more = {}) {
        std::vector<std::string> all = usual;
        all.insert(all.end(), {"--shard", shard});
        all.insert(all.end(), more.begin(), more.end());
        const Outcome outcome = render(name, all);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
    };
    part("a", "1/2");
    part("b", "2/2");
    part("c", "2/3");
    part("seed", "2/2", {"--seed", "7"});
    part("size", "2/2", {"--size", "72x54"});
    part("camera", "2/2", {"--camera", "10,5"});
    part("exposure", "2/2", {"--exposure", "1"});
    part("material", "2/2", {"--set", "material.metallic=1"});
    part("light", "2/2", {"--environment", "builtin:white"});
    part("alpha", "2/2", {"--background", "transparent"});
    const auto refuses = [&](const std::vector<std::string>& parts, int status, const auto& said) {
        const Outcome outcome = merge(parts, "out.exr");
        EXPECT_EQ(outcome.status, status) << outcome.err;
        EXPECT_THAT(outcome.err, said);
        EXPECT_FALSE(fs::exists(m_folder / "out.exr"));
    };
    refuses({"a"}, 66, HasSubstr("of 2 parts, 2 is missing"));
    refuses({"a", "b", "a"}, 65, HasSubstr("it is part 1 of 2, and so is"));
    refuses({"a", "c"}, 65, HasSubstr("it is one of 3 parts"));
    refuses({"a", "seed"}, 65, HasSubstr("seed (0 there, 7 here)"));
    refuses({"a", "size"}, 65, HasSubstr("72 × 53 pixels there, 72 × 54 here"));
    refuses({"a", "camera"}, 65, HasSubstr("camera ("));
    refuses({"a", "exposure"}, 65, HasSubstr("view.exposureEv (0 there, 1 here)"));
    refuses({"a", "material"}, 65, HasSubstr("the materials"));
    refuses({"a", "light"}, 65, HasSubstr("the environment"));
    refuses({"a", "alpha"}, 65, HasSubstr("background (visible there, transparent here)"));
    refuses({"a", "not-there"}, 66, HasSubstr("not-there"));

    // Cut, longer, edited.
    const std::string whole = bytes("b");
    writeBytes(m_folder / "cut", whole.substr(0, whole.size() - 8));
    refuses({"a", "cut"}, 65, HasSubstr("its end is missing"));
    writeBytes(m_folder / "long", whole + "x");
    refuses({"a", "long"}, 65, HasSubstr("something follows its end"));
    std::string edited = whole;
    edited[whole.size() - 100] ^= 1;
    writeBytes(m_folder / "edited", edited);
    refuses({"a", "edited"}, 65, HasSubstr("its values were changed"));
    edited = whole;
    edited[edited.find("\"seed\"") + 1] = 'S';
    writeBytes(m_folder / "edited", edited);
    refuses({"a", "edited"}, 65, HasSubstr("its description was changed"));
    writeBytes(m_folder / "text", "no part");
    refuses({"a", "text"}, 65, HasSubstr("this is no part"));

    EXPECT_EQ(merge({"b", "a"}, "picture.bmp").status, 2);
    EXPECT_EQ(merge({"b", "a"}, "nowhere/a.exr").status, 73);
    EXPECT_EQ(merge({"b", "a"}, "out.exr").status, 0);
}

TEST_F(LongPicture, RefusesOptionsThatExcludeEachOther) {
    for (const auto& [more, said] : std::vector<std::pair<std::vector<std::string>, const char*>>{
             {{"--shard", "1/2", "--noise", "5"}, "--noise"},
             {{"--shard", "1/2", "--keep-partial"}, "--keep-partial"},
             {{"--shard", "3/2"}, "part 3 of 2"},
             {{"--shard", "auto"}, "--shard auto finds no scheduler"},
             {{"--checkpoint", "often"}, "--checkpoint takes a time"},
             {{"--renderer", "raster", "--shard", "1/2"}, "--shard is for --renderer path"},
             {{"--renderer", "raster", "--resume"}, "--resume is for --renderer path"},
             {{"--renderer", "raster", "--checkpoint", "1s"},
              "--checkpoint is for --renderer path"}}) {
        RunOptions alone;
        for (const char* name :
             {"SLURM_ARRAY_TASK_ID", "SGE_TASK_ID", "LSB_JOBINDEX", "AWS_BATCH_JOB_ARRAY_INDEX",
              "CI_NODE_INDEX", "OMPI_COMM_WORLD_RANK", "PMI_RANK", "SLURM_PROCID"})
            alone.environment[name] = std::nullopt;
        std::vector<std::string> all{"render", "builtin:cornell-box", "-o", m_folder / "no.exr"};
        if (more.front() != "--renderer")
            all.insert(all.end(), {"--renderer", "path"});
        all.insert(all.end(), more.begin(), more.end());
        const Outcome outcome = runPatina(all, alone);
        EXPECT_EQ(outcome.status, 2) << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr(said));
    }
    EXPECT_THAT(m_folder.files(), ElementsAre());
}

TEST_F(LongPicture, KilledTenTimesAndResumedItIsTheSame) {
    const std::vector<std::string> options{"--samples", "200", "--seed", "3", "--noise", "0.5"};
    const Outcome whole = render("whole.exr", options);
    ASSERT_EQ(whole.status, 0) << whole.err;

    const std::string output = m_folder / "killed.exr", checkpoint = output + ".checkpoint";
    std::vector<std::string> more = options;
    more.insert(more.end(), {"--threads", "1", "--resume", "--checkpoint", "0.005", "--quiet"});
    for (int moment = 0; moment < 10; ++moment) {
        // Also while a checkpoint is being written, and between two.
        ASSERT_TRUE(killAfterACheckpoint(arguments("killed.exr", more), checkpoint,
                                         std::chrono::microseconds(moment * 1300)))
            << "the picture was done before kill " << moment;
        EXPECT_FALSE(fs::exists(output));
        EXPECT_TRUE(fs::exists(checkpoint));
    }
    more = options;
    more.insert(more.end(), {"--resume", "--json"});
    const Outcome resumed = render("killed.exr", more);
    ASSERT_EQ(resumed.status, 0) << resumed.err;
    EXPECT_EQ(bytes("killed.exr"), bytes("whole.exr"));
    EXPECT_GE(resumed.json()["resumedFrom"], 0);
    EXPECT_THAT(m_folder.files(), ElementsAre("killed.exr", "whole.exr"));
}

TEST_F(LongPicture, AnInterruptLeavesACheckpointToGoOnFrom) {
    const std::vector<std::string> options{"--samples", "200", "--threads", "1"};
    ASSERT_EQ(render("whole.exr", options).status, 0);
    for (const int signal : {SIGINT, SIGTERM}) {
        RunOptions interrupt;
        interrupt.signal = signal;
        interrupt.signalWhen = "%";
        std::vector<std::string> more = options;
        more.insert(more.end(), {"--checkpoint", "1h", "--json"});
        const Outcome stopped = render("a.exr", more, interrupt);
        ASSERT_EQ(stopped.status, 75) << stopped.err;
        EXPECT_EQ(stopped.json()["error"]["exitStatus"], 75);
        EXPECT_THAT(stopped.json()["error"]["message"].get<std::string>(), HasSubstr("--resume"));
        EXPECT_THAT(m_folder.files(), ElementsAre("a.exr.checkpoint", "whole.exr"));

        const auto checkpoint = runPatina({"info", m_folder / "a.exr.checkpoint", "--json"}).json();
        EXPECT_EQ(checkpoint["kind"], "checkpoint");
        EXPECT_EQ(checkpoint["picture"]["complete"], false);
        EXPECT_GT(checkpoint["picture"]["done"], 0.0);
        EXPECT_LT(checkpoint["picture"]["done"], 1.0);
        EXPECT_EQ(checkpoint["picture"]["settings"]["samples"], "200");

        const Outcome other = render("a.exr", {"--samples", "300", "--resume"});
        EXPECT_EQ(other.status, 65);
        EXPECT_THAT(other.err, AllOf(HasSubstr("a.exr.checkpoint"),
                                     HasSubstr("samples (200 there, 300 here)")));

        more.back() = "--resume";
        const Outcome resumed = render("a.exr", more);
        ASSERT_EQ(resumed.status, 0) << resumed.err;
        EXPECT_EQ(bytes("a.exr"), bytes("whole.exr"));
        EXPECT_THAT(m_folder.files(), ElementsAre("a.exr", "whole.exr"));
        fs::remove(m_folder / "a.exr");
    }
}

TEST_F(LongPicture, ACheckpointThatCannotBeWrittenIsAWarning) {
    const std::vector<std::string> options{"--samples", "16"};
    ASSERT_EQ(render("whole.exr", options).status, 0);
    fs::create_directory(m_folder / "a.exr.checkpoint");
    std::vector<std::string> more = options;
    more.insert(more.end(), {"--checkpoint", "0.001", "--json"});
    const Outcome outcome = render("a.exr", more);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(bytes("a.exr"), bytes("whole.exr"));
    EXPECT_THAT(
        outcome.json()["warnings"].get<std::vector<std::string>>(),
        Contains(AllOf(HasSubstr("the picture goes on"), HasSubstr("a.exr.checkpoint"))).Times(1));
}

// The disk is full for the checkpoints, and not for the picture.
TEST_F(LongPicture, AFullDiskAtACheckpointLosesNothing) {
    const std::vector<std::string> options{"--samples", "16"};
    ASSERT_EQ(render("whole.png", options).status, 0);
    // Writing beyond the limit fails, as it does on a full disk, where nobody wants the signal.
    RunOptions limited;
    limited.program = "/bin/sh";
    std::vector<std::string> all{"-c", "trap '' XFSZ; exec prlimit --fsize=100000 \"$@\"", "sh",
                                 std::string(std::getenv("PATINA_BIN_DIR")) + "/patina"};
    for (std::string& word :
         arguments("a.png", {"--samples", "16", "--checkpoint", "0.001", "--json"}))
        all.push_back(std::move(word));
    const Outcome outcome = runPatina(all, limited);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(bytes("a.png"), bytes("whole.png"));
    EXPECT_THAT(outcome.json()["warnings"].get<std::vector<std::string>>(),
                Contains(HasSubstr("no checkpoint could be kept")));
    EXPECT_THAT(m_folder.files(), ElementsAre("a.png", "whole.png"));
}

TEST_F(LongPicture, APictureThatCannotBeWrittenIsKeptElsewhere) {
    ASSERT_EQ(render("whole.exr", {"--samples", "2"}).status, 0);
    const TemporaryFolder elsewhere;
    fs::create_symlink("/dev/full", m_folder / "a.exr");
    RunOptions run;
    run.environment["TMPDIR"] = elsewhere.path();
    const Outcome outcome = render("a.exr", {"--samples", "2", "--json"}, run);
    EXPECT_EQ(outcome.status, 74) << outcome.err;
    ASSERT_EQ(elsewhere.files().size(), 1u) << outcome.err;
    EXPECT_THAT(outcome.json()["error"]["message"].get<std::string>(),
                HasSubstr("; the picture is kept in " + elsewhere / elsewhere.files()[0]));
    EXPECT_EQ(readBytes(elsewhere / elsewhere.files()[0]), bytes("whole.exr"));
}

// Something takes the name of the result while it is traced.
TEST_F(LongPicture, WhatCannotBeWrittenIsKeptAsACheckpoint) {
    for (const bool part : {true, false}) {
        const std::string output = part ? "part" : "a.exr";
        std::vector<std::string> options{"--samples", "40", "--threads", "1", "--json"};
        if (part)
            options.insert(options.end(), {"--shard", "1/2"});
        ASSERT_EQ(render("whole.exr", options).status, 0);
        const TemporaryFolder elsewhere;
        RunOptions run;
        run.environment["TMPDIR"] = elsewhere.path();
        run.signalWhen = "%";
        run.when = [&] { fs::create_directory(m_folder / output); };
        const Outcome outcome = render(output, options, run);
        EXPECT_EQ(outcome.status, 73) << outcome.err;
        EXPECT_THAT(outcome.json()["error"]["message"].get<std::string>(),
                    HasSubstr("is kept in " + m_folder / (output + ".checkpoint")));
        fs::remove(m_folder / output);
        options.emplace_back("--resume");
        const Outcome resumed = render(output, options);
        ASSERT_EQ(resumed.status, 0) << resumed.err;
        EXPECT_EQ(resumed.json()["resumedFrom"], 40);
        EXPECT_EQ(bytes(output), bytes("whole.exr"));
        EXPECT_FALSE(fs::exists(m_folder / (output + ".checkpoint")));
    }
}

TEST_F(LongPicture, OneProcessWritesAFile) {
    {
        const Result<FileLock> held = FileLock::take(m_folder / "a.exr");
        ASSERT_TRUE(held.ok());
        const Outcome refused = render("a.exr", {"--samples", "1"});
        EXPECT_EQ(refused.status, 73) << refused.err;
        EXPECT_FALSE(fs::exists(m_folder / "a.exr"));
    }
    const Result<FileLock> held = FileLock::take(m_folder / "a.exr.checkpoint");
    ASSERT_TRUE(held.ok());
    const Outcome outcome = render("a.exr", {"--samples", "4", "--checkpoint", "0.001", "--json"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.json()["warnings"].get<std::vector<std::string>>(),
                Contains(HasSubstr("another program traces this picture")));
    EXPECT_FALSE(fs::exists(m_folder / "a.exr.checkpoint"));
    EXPECT_TRUE(fs::exists(m_folder / "a.exr"));
}

} // namespace
