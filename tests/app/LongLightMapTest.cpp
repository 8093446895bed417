// `patina bake light` as farms run it: split over processes, killed, resumed, merged; and what it
// says when that cannot be.
#include "CommandRunner.h"
#include "KilledRun.h"
#include "core/base/FileLock.h"

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <initializer_list>

namespace fs = std::filesystem;
using namespace patina;
using namespace patina::test;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

namespace {

using Words = std::vector<std::string>;

Words operator+(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

class LongLightMap : public ::testing::Test {
  protected:
    [[nodiscard]] Words arguments(const std::string& output, const Words& more) const {
        return Words{"bake",   "light", "builtin:cornell-box", "-o", m_folder / output,
                     "--size", "16"} +
               more;
    }
    [[nodiscard]] Outcome bake(const std::string& output, const Words& more,
                               const RunOptions& options = {}) const {
        return runPatina(arguments(output, more), options);
    }
    [[nodiscard]] Outcome merge(const Words& parts, const std::string& output,
                                const Words& more = {}) const {
        Words all{"merge", "-o", m_folder / output, "--json"};
        for (const std::string& part : parts)
            all.push_back(m_folder / part);
        return runPatina(all + more);
    }
    // All parts, the last one first.
    [[nodiscard]] Words parts(int count, const Words& more, const char* threads) const {
        Words names;
        for (int k = count; k >= 1; --k) {
            names.push_back("part" + std::to_string(k));
            const std::string shard = std::to_string(k) + "/" + std::to_string(count);
            const Outcome part =
                bake(names.back(), more + Words{"--shard", shard, "--threads", threads});
            EXPECT_EQ(part.status, 0) << part.err;
        }
        return names;
    }
    [[nodiscard]] nlohmann::json info(const std::string& name) const {
        return runPatina({"info", m_folder / name, "--json"}).json();
    }
    [[nodiscard]] std::string bytes(const std::string& name) const {
        return readBytes(m_folder / name);
    }
    TemporaryFolder m_folder;
};

TEST_F(LongLightMap, SameBytesForAnyThreadsAndShards) {
    // With an environment of its own, which the parts must find again.
    const Words options{"--samples", "16", "--environment", "builtin:overcast"};
    for (const char* threads : {"1", "2", "7"}) {
        const Outcome whole =
            bake(std::string(threads) + ".exr", options + Words{"--threads", threads});
        ASSERT_EQ(whole.status, 0) << whole.err;
        EXPECT_EQ(bytes(std::string(threads) + ".exr"), bytes("1.exr"));
    }
    const char* threads = "1";
    for (const int count : {1, 3, 8}) {
        const Words files = parts(count, options, threads);
        threads = *threads == '1' ? "2" : "7";
        const Outcome merged = merge(files, "merged.exr");
        ASSERT_EQ(merged.status, 0) << merged.err;
        EXPECT_EQ(bytes("merged.exr"), bytes("1.exr")) << count;
        EXPECT_EQ(merged.json()["samplesDone"], 16);
        EXPECT_FALSE(merged.json().contains("rays"));
    }
    const Words rough =
        options + Words{"--no-smooth", "--seed", "7", "--set", "environment.rotationDeg=90"};
    ASSERT_EQ(bake("rough.exr", rough).status, 0);
    EXPECT_NE(bytes("rough.exr"), bytes("1.exr"));
    const Outcome merged = merge(parts(2, rough, "2"), "merged.exr");
    ASSERT_EQ(merged.status, 0) << merged.err;
    EXPECT_EQ(bytes("merged.exr"), bytes("rough.exr"));
}

TEST_F(LongLightMap, KilledTenTimesAndResumedItIsTheSame) {
    const Words options{"--samples", "512"};
    const Outcome whole = bake("whole.exr", options + Words{"--json"});
    ASSERT_EQ(whole.status, 0) << whole.err;
    const std::string output = m_folder / "killed.exr", checkpoint = output + ".checkpoint";
    const Words more =
        options + Words{"--threads", "1", "--resume", "--checkpoint", "0.005", "--quiet"};
    for (int moment = 0; moment < 10; ++moment) {
        // Also while a checkpoint is being written, and between two.
        ASSERT_TRUE(killAfterACheckpoint(arguments("killed.exr", more), checkpoint,
                                         std::chrono::microseconds(moment * 1300)))
            << "the bake was done before kill " << moment;
        EXPECT_FALSE(fs::exists(output));
        EXPECT_TRUE(fs::exists(checkpoint));
    }
    const Outcome resumed = bake("killed.exr", options + Words{"--resume", "--json"});
    ASSERT_EQ(resumed.status, 0) << resumed.err;
    EXPECT_EQ(bytes("killed.exr"), bytes("whole.exr"));
    EXPECT_GE(resumed.json()["resumedFrom"], 0);
    // Each checkpoint was written after texels that it did not begin with.
    EXPECT_LT(resumed.json()["rays"].get<double>(), whole.json()["rays"].get<double>());
    EXPECT_THAT(m_folder.files(), ElementsAre("killed.exr", "whole.exr"));
}

TEST_F(LongLightMap, AnInterruptLeavesACheckpointToGoOnFrom) {
    // Far more than there is time for; the first rays are counted when a texel has them.
    const Words options{"--samples", "65536", "--threads", "1"};
    RunOptions interrupt;
    interrupt.signal = SIGTERM;
    interrupt.signalWhen = "rays/s";
    const Outcome stopped =
        bake("a.exr", options + Words{"--checkpoint", "1h", "--json"}, interrupt);
    ASSERT_EQ(stopped.status, 75) << stopped.err;
    EXPECT_EQ(stopped.json()["error"]["exitStatus"], 75);
    EXPECT_THAT(stopped.json()["error"]["message"].get<std::string>(), HasSubstr("--resume"));
    EXPECT_THAT(m_folder.files(), ElementsAre("a.exr.checkpoint"));
    const auto kept = info("a.exr.checkpoint");
    EXPECT_EQ(kept["kind"], "checkpoint");
    EXPECT_EQ(kept["bake"]["holds"], "light map");
    EXPECT_EQ(kept["bake"]["complete"], false);
    EXPECT_GT(kept["bake"]["done"], 0.0);
    EXPECT_LT(kept["bake"]["done"], 1.0);
    EXPECT_EQ(kept["bake"]["settings"]["samples"], "65536");
    EXPECT_EQ(kept["bake"]["environment"], "the scene's own");
    EXPECT_THAT(runPatina({"info", m_folder / "a.exr.checkpoint"}).out,
                AllOf(HasSubstr("checkpoint of a bake, unfinished"), HasSubstr("light map"),
                      HasSubstr("the command that began it, and --resume\n")));

    // What was kept is not traced again.
    interrupt.signalWhen = "tracing";
    const Outcome again = bake("a.exr", options + Words{"--resume", "--json"}, interrupt);
    ASSERT_EQ(again.status, 75) << again.err;
    EXPECT_GE(info("a.exr.checkpoint")["bake"]["done"], kept["bake"]["done"]);

    // Of another bake, other light, another part.
    const auto refuses = [&](const Words& more, const char* said) {
        const Outcome other = bake("a.exr", more + Words{"--resume"});
        EXPECT_EQ(other.status, 65);
        EXPECT_THAT(other.err, AllOf(HasSubstr("a.exr.checkpoint"), HasSubstr(said)));
    };
    refuses({"--samples", "32"}, "samples (65536 there, 32 here)");
    refuses(options + Words{"--environment", "builtin:overcast"}, "they differ in the light");
    refuses(options + Words{"--shard", "1/2"}, "the part (part 1 of 1 there, 1 of 2 here)");
    EXPECT_THAT(m_folder.files(), ElementsAre("a.exr.checkpoint"));
}

TEST_F(LongLightMap, KeepPartialWritesWhatConverged) {
    RunOptions interrupt;
    interrupt.signal = SIGINT;
    interrupt.signalWhen = "rays/s";
    const Outcome outcome = bake(
        "a.exr", {"--samples", "65536", "--threads", "1", "--keep-partial", "--resume", "--json"},
        interrupt);
    ASSERT_EQ(outcome.status, 75) << outcome.err; // there is more to come
    EXPECT_EQ(outcome.json()["partial"], true);
    EXPECT_LT(outcome.json()["samplesDone"], 65536);
    EXPECT_EQ(info("a.exr")["bake"]["samplesDone"], outcome.json()["samplesDone"]);
    // And from there it can still be finished.
    EXPECT_EQ(info("a.exr.checkpoint")["bake"]["complete"], false);
}

TEST_F(LongLightMap, AFullDiskAtACheckpointLosesNothing) {
    const Words options{"--samples", "64"};
    ASSERT_EQ(bake("whole.exr", options).status, 0);
    fs::create_directory(m_folder / "a.exr.checkpoint");
    const Outcome outcome = bake("a.exr", options + Words{"--checkpoint", "0.001", "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(bytes("a.exr"), bytes("whole.exr"));
    EXPECT_THAT(outcome.json()["warnings"].get<Words>(),
                Contains(AllOf(HasSubstr("no checkpoint could be kept, the bake goes on"),
                               HasSubstr("a.exr.checkpoint")))
                    .Times(1));
}

TEST_F(LongLightMap, MergeSaysWhatDoesNotFit) {
    const Words quick{"--samples", "8"};
    const Words files = parts(2, quick, "1");
    const auto part = info("part2");
    EXPECT_EQ(part["kind"], "part");
    EXPECT_EQ(part["bake"]["shard"]["part"], 2);
    EXPECT_EQ(part["bake"]["complete"], true);
    EXPECT_EQ(part["bake"]["samplesDone"], 8);
    EXPECT_THAT(runPatina({"info", m_folder / "part2"}).out,
                AllOf(HasSubstr("part of a bake, complete"), HasSubstr("patina merge")));
    const auto refuses = [&](const Words& some, int status, const auto& said,
                             const Words& more = {}) {
        const Outcome outcome = merge(some, "out.exr", more);
        EXPECT_EQ(outcome.status, status) << outcome.err;
        EXPECT_THAT(outcome.err, said);
        EXPECT_FALSE(fs::exists(m_folder / "out.exr"));
    };
    refuses({"part1"}, 66, HasSubstr("of 2 parts, 2 is missing"));
    refuses({"part1", "part2", "part1"}, 65, HasSubstr("it is part 1 of 2, and so is"));
    const std::string whole = bytes("part2");
    writeBytes(m_folder / "cut", whole.substr(0, whole.size() - 1));
    refuses({"part1", "cut"}, 65, AllOf(HasSubstr("/cut"), HasSubstr("its end is missing")));
    std::string edited = whole;
    edited[whole.size() - 100] ^= 1;
    writeBytes(m_folder / "edited", edited);
    refuses({"part1", "edited"}, 65, AllOf(HasSubstr("/edited"), HasSubstr("bake it anew")));
    const auto other = [&](const Words& more) {
        const Outcome outcome = bake("other", more + Words{"--shard", "2/2"});
        EXPECT_EQ(outcome.status, 0) << outcome.err;
    };
    other({"--samples", "16"});
    refuses({"part1", "other"}, 65,
            AllOf(HasSubstr("/other"), HasSubstr("samples (8 there, 16 here)")));
    other(quick + Words{"--environment", "builtin:overcast"});
    refuses({"part1", "other"}, 65, AllOf(HasSubstr("/other"), HasSubstr("differ in the light")));
    refuses(files, 65, HasSubstr("the scene (builtin:cornell-box there, builtin:chess here)"),
            {"--scene", "builtin:chess"});
    EXPECT_EQ(merge(files, "out.png").status, 2);
    const Outcome merged = merge(files, "out.exr");
    EXPECT_EQ(merged.status, 0) << merged.err;
}

TEST_F(LongLightMap, MergeSaysThatTheEnvironmentIsGone) {
    ASSERT_EQ(runPatina({"environment", "builtin:overcast", "-o", m_folder / "sky.hdr"}).status, 0);
    const Words options{"--samples", "8", "--environment", m_folder / "sky.hdr"};
    const Words files = parts(2, options, "2");
    fs::rename(m_folder / "sky.hdr", m_folder / "gone.hdr");
    const Outcome lost = merge(files, "out.exr");
    EXPECT_EQ(lost.status, 66);
    EXPECT_THAT(lost.err, AllOf(HasSubstr("/sky.hdr"), HasSubstr("the environment of the parts")));
    fs::rename(m_folder / "gone.hdr", m_folder / "sky.hdr");
    EXPECT_EQ(merge(files, "out.exr").status, 0);
}

TEST_F(LongLightMap, OptionsThatExcludeEachOtherAreRefused) {
    RunOptions noArray;
    noArray.environment = {{"SLURM_ARRAY_TASK_ID", ""}};
    for (const auto& [more, said] : std::vector<std::pair<Words, const char*>>{
             {{"--shard", "3/2"}, "part 3 of 2"},
             {{"--shard", "1/2", "--keep-partial"}, "--keep-partial"},
             {{"--checkpoint", "often"}, "--checkpoint takes a time"},
             {{"--max-memory", "some"}, "--max-memory takes a size"},
             {{"--max-memory", "100KiB"}, "memory"}}) {
        const Outcome outcome = bake("no.exr", more, noArray);
        EXPECT_EQ(outcome.status, 2) << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr(said));
    }
    EXPECT_THAT(m_folder.files(), IsEmpty());
}

TEST_F(LongLightMap, OneProcessWritesAFile) {
    const Result<FileLock> held = FileLock::take(m_folder / "a.exr");
    ASSERT_TRUE(held.ok());
    const Outcome refused = bake("a.exr", {"--samples", "8"});
    EXPECT_EQ(refused.status, 73) << refused.err;
    EXPECT_THAT(refused.err, HasSubstr("is writing this file already"));
    EXPECT_FALSE(fs::exists(m_folder / "a.exr"));
}

} // namespace
