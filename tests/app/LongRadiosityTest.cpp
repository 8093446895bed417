// `patina bake radiosity` as farms run it: split over processes, killed, resumed, merged; and what
// it says when that cannot be.
#include "CommandRunner.h"
#include "KilledRun.h"
#include "core/base/FileLock.h"

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>
#include <sstream>

namespace fs = std::filesystem;
using namespace patina;
using namespace patina::test;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

namespace {

using Words = std::vector<std::string>;

Words words(const std::string& text) {
    std::istringstream stream(text);
    return {std::istream_iterator<std::string>(stream), {}};
}

class LongRadiosity : public ::testing::Test {
  protected:
    [[nodiscard]] Words arguments(const std::string& output, const Words& more) const {
        Words all{"bake", "radiosity", "builtin:cornell-reference", "-o", m_folder / output};
        all.insert(all.end(), {"--set", "environment.enabled=false"});
        if (std::ranges::count(more, "--subdivide") == 0)
            all.insert(all.end(), {"--subdivide", "0.01"});
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    [[nodiscard]] Outcome bake(const std::string& output, const Words& more,
                               const RunOptions& options = {}) const {
        return runPatina(arguments(output, more), options);
    }
    [[nodiscard]] Outcome merge(const Words& parts, const std::string& output) const {
        Words all{"merge", "-o", m_folder / output, "--json"};
        for (const std::string& part : parts)
            all.push_back(m_folder / part);
        return runPatina(all);
    }
    // All parts, the last one first.
    [[nodiscard]] Words parts(int count, const Words& more, const char* threads) const {
        Words names;
        for (int k = count; k >= 1; --k) {
            names.push_back("part" + std::to_string(k));
            Words all = more;
            all.insert(all.end(), {"--shard", std::to_string(k) + "/" + std::to_string(count),
                                   "--threads", threads});
            const Outcome part = bake(names.back(), all);
            EXPECT_EQ(part.status, 0) << part.err;
        }
        return names;
    }
    [[nodiscard]] std::string bytes(const std::string& name) const {
        return readBytes(m_folder / name);
    }
    TemporaryFolder m_folder;
};

TEST_F(LongRadiosity, SameBytesForAnyThreadsAndShards) {
    const Words options{"--exposure", "3", "--resolution", "64"};
    for (const char* threads : {"1", "2", "7"}) {
        Words more = options;
        more.insert(more.end(), {"--threads", threads});
        const Outcome whole = bake(std::string(threads) + ".glb", more);
        ASSERT_EQ(whole.status, 0) << whole.err;
        EXPECT_EQ(bytes(std::string(threads) + ".glb"), bytes("1.glb"));
    }
    const char* threads = "1";
    for (const int count : {1, 3, 8}) {
        const Words files = parts(count, options, threads);
        threads = *threads == '1' ? "2" : "7";
        const Outcome merged = merge(files, "merged.glb");
        ASSERT_EQ(merged.status, 0) << merged.err;
        EXPECT_EQ(bytes("merged.glb"), bytes("1.glb")) << count;
        EXPECT_EQ(merged.json()["exposure"], 3.0);
    }
    // The file's kind is chosen then.
    for (const char* name : {".dae", ".ply"}) {
        ASSERT_EQ(bake(std::string("whole") + name, options).status, 0);
        ASSERT_EQ(merge(parts(2, options, "2"), std::string("merged") + name).status, 0);
    }
    EXPECT_EQ(bytes("merged.ply"), bytes("whole.ply"));
    // But for the time of writing.
    const auto withoutTime = [&](const std::string& name) {
        std::string text = bytes(name);
        for (const char* tag : {"<created>", "<modified>"})
            if (const std::size_t at = text.find(tag); at != std::string::npos)
                text.erase(at, text.find('<', at + 1) - at);
        return text;
    };
    EXPECT_EQ(withoutTime("merged.dae"), withoutTime("whole.dae"));
}

TEST_F(LongRadiosity, ParaboloidsAreTheSameBytesForAnyThreadsAndShards) {
    const Words options = words("--form-factors paraboloid --resolution 64 --exposure 3");
    for (const char* threads : {"1", "2", "7"}) {
        Words more = options;
        more.insert(more.end(), {"--threads", threads});
        const Outcome whole = bake(std::string(threads) + ".glb", more);
        ASSERT_EQ(whole.status, 0) << whole.err;
        EXPECT_EQ(bytes(std::string(threads) + ".glb"), bytes("1.glb"));
    }
    const Outcome merged = merge(parts(3, options, "2"), "merged.glb");
    ASSERT_EQ(merged.status, 0) << merged.err;
    EXPECT_EQ(bytes("merged.glb"), bytes("1.glb"));
    EXPECT_EQ(merged.json()["settings"]["formFactors"], "paraboloid");
    EXPECT_EQ(merged.json()["settings"]["resolution"], 64);
}

TEST_F(LongRadiosity, MergeSolvesAsThePartsWereAskedTo) {
    const Words options =
        words("--solver progressive --classic --iterations 40 --output-every 25 --resolution 64 "
              "--size 16x12 --camera -10,5 --look elements --environment builtin:overcast --set "
              "environment.enabled=true");
    ASSERT_EQ(bake("whole.png", options).status, 0);
    const Outcome merged = merge(parts(2, options, "2"), "merged.png");
    ASSERT_EQ(merged.status, 0) << merged.err;
    EXPECT_EQ(merged.json()["iterations"], 40);
    EXPECT_EQ(bytes("merged.png"), bytes("whole.png"));
    Words steps = m_folder.files();
    std::erase_if(steps, [](const std::string& file) { return !file.starts_with("merged-"); });
    ASSERT_THAT(steps, ::testing::SizeIs(1));
    EXPECT_EQ(bytes(steps[0]), bytes("whole" + steps[0].substr(std::string("merged").size())));
}

// While rows are found, and while light is shot.
TEST_F(LongRadiosity, KilledTenTimesAndResumedItIsTheSame) {
    const std::vector<std::pair<const char*, Words>> runs{
        {"rows", {"--resolution", "8192", "--samples", "1"}},
        {"iterations",
         {"--solver", "progressive", "--classic", "--subdivide", "0.0015", "--resolution", "32",
          "--residual", "1e-10", "--samples", "1"}}};
    for (const auto& [found, options] : runs) {
        const Outcome whole = bake("whole.glb", options);
        ASSERT_EQ(whole.status, 0) << whole.err;
        const std::string output = m_folder / "killed.glb", checkpoint = output + ".checkpoint";
        Words more = options;
        more.insert(more.end(), {"--threads", "1", "--resume", "--checkpoint", "0.02", "--quiet"});
        for (int moment = 0; moment < 5; ++moment) {
            // Also while a checkpoint is being written, and between two.
            ASSERT_TRUE(killAfterACheckpoint(arguments("killed.glb", more), checkpoint,
                                             std::chrono::microseconds(moment * 7000)))
                << "it was done before kill " << moment;
            EXPECT_FALSE(fs::exists(output));
            EXPECT_TRUE(fs::exists(checkpoint));
        }
        more = options;
        more.insert(more.end(), {"--resume", "--json"});
        const Outcome resumed = bake("killed.glb", more);
        ASSERT_EQ(resumed.status, 0) << resumed.err;
        EXPECT_EQ(bytes("killed.glb"), bytes("whole.glb"));
        // A slow machine may not come further than the checkpoint it began with.
        EXPECT_GE(resumed.json()["resumedFrom"][found], 0);
        EXPECT_THAT(m_folder.files(), ElementsAre("killed.glb", "whole.glb"));
        fs::remove(output);
    }
}

TEST_F(LongRadiosity, AnInterruptLeavesACheckpointToGoOnFrom) {
    const Words options{"--resolution", "65536", "--threads", "1"};
    RunOptions interrupt;
    interrupt.signal = SIGTERM;
    interrupt.signalWhen = "computing form factors";
    Words more = options;
    more.insert(more.end(), {"--checkpoint", "1h", "--json"});
    const Outcome stopped = bake("a.glb", more, interrupt);
    ASSERT_EQ(stopped.status, 75) << stopped.err;
    EXPECT_EQ(stopped.json()["error"]["exitStatus"], 75);
    EXPECT_THAT(stopped.json()["error"]["message"].get<std::string>(), HasSubstr("--resume"));
    EXPECT_THAT(m_folder.files(), ElementsAre("a.glb.checkpoint"));

    const auto info = runPatina({"info", m_folder / "a.glb.checkpoint", "--json"}).json();
    EXPECT_EQ(info["kind"], "checkpoint");
    EXPECT_EQ(info["radiosity"]["complete"], false);
    EXPECT_EQ(info["radiosity"]["lit"], info["radiosity"]["elements"]);
    EXPECT_GT(info["radiosity"]["rows"], 0);
    EXPECT_LT(info["radiosity"]["rows"], info["radiosity"]["elements"]);
    EXPECT_EQ(info["radiosity"]["settings"]["resolution"], "65536");

    // The rows that were kept are not found again.
    interrupt.signalWhen = "%";
    more = options;
    more.insert(more.end(), {"--resume", "--json"});
    const Outcome again = bake("a.glb", more, interrupt);
    ASSERT_EQ(again.status, 75) << again.err;
    const auto further = runPatina({"info", m_folder / "a.glb.checkpoint", "--json"}).json();
    EXPECT_GE(further["radiosity"]["rows"], info["radiosity"]["rows"]);

    const Outcome other = bake("a.glb", {"--resolution", "32", "--resume"});
    EXPECT_EQ(other.status, 65);
    EXPECT_THAT(other.err, AllOf(HasSubstr("a.glb.checkpoint"),
                                 HasSubstr("resolution (65536 there, 32 here)")));
    // A part is no whole.
    more = options;
    more.insert(more.end(), {"--shard", "1/2", "--resume"});
    const Outcome part = bake("a.glb", more);
    EXPECT_EQ(part.status, 65);
    EXPECT_THAT(part.err, HasSubstr("the part (part 1 of 1 there, 1 of 2 here)"));
    EXPECT_THAT(m_folder.files(), ElementsAre("a.glb.checkpoint"));
}

TEST_F(LongRadiosity, AFullDiskAtACheckpointLosesNothing) {
    const Words options{"--resolution", "64", "--exposure", "1"};
    ASSERT_EQ(bake("whole.ply", options).status, 0);
    // Writing beyond the limit fails, as it does on a full disk, where nobody wants the signal.
    RunOptions limited;
    limited.program = "/bin/sh";
    Words all{"-c", "trap '' XFSZ; exec prlimit --fsize=60000 \"$@\"", "sh",
              std::string(std::getenv("PATINA_BIN_DIR")) + "/patina"};
    for (std::string& word : arguments(
             "a.ply", {"--resolution", "64", "--exposure", "1", "--checkpoint", "0.001", "--json"}))
        all.push_back(std::move(word));
    const Outcome outcome = runPatina(all, limited);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(bytes("a.ply"), bytes("whole.ply"));
    EXPECT_THAT(outcome.json()["warnings"].get<Words>(),
                Contains(AllOf(HasSubstr("no checkpoint could be kept, the radiosity goes on"),
                               HasSubstr("a.ply.checkpoint")))
                    .Times(1));
    EXPECT_THAT(m_folder.files(), ElementsAre("a.ply", "whole.ply"));
}

// Something takes the name of the result while it is computed.
TEST_F(LongRadiosity, WhatCannotBeWrittenIsKeptAsACheckpoint) {
    const Words options{"--resolution", "4096", "--threads", "1", "--json"};
    ASSERT_EQ(bake("whole.ply", options).status, 0);
    RunOptions run;
    run.signalWhen = "%";
    run.when = [&] { fs::create_directory(m_folder / "a.ply"); };
    const Outcome outcome = bake("a.ply", options, run);
    EXPECT_EQ(outcome.status, 73) << outcome.err;
    EXPECT_THAT(outcome.json()["error"]["message"].get<std::string>(),
                HasSubstr("is kept in " + m_folder / "a.ply.checkpoint"));
    fs::remove(m_folder / "a.ply");
    Words more = options;
    more.emplace_back("--resume");
    const Outcome resumed = bake("a.ply", more);
    ASSERT_EQ(resumed.status, 0) << resumed.err;
    EXPECT_EQ(resumed.json()["resumedFrom"]["iterations"], resumed.json()["iterations"]);
    EXPECT_EQ(bytes("a.ply"), bytes("whole.ply"));
    EXPECT_THAT(m_folder.files(), ElementsAre("a.ply", "whole.ply"));
}

TEST_F(LongRadiosity, MergeSaysWhatDoesNotFit) {
    const Words coarse{"--subdivide", "0.05", "--resolution", "16"};
    const Words files = parts(2, coarse, "1");
    const auto info = runPatina({"info", m_folder / "part2", "--json"}).json();
    EXPECT_EQ(info["kind"], "part");
    EXPECT_EQ(info["radiosity"]["shard"]["part"], 2);
    EXPECT_EQ(info["radiosity"]["complete"], true);
    EXPECT_THAT(runPatina({"info", m_folder / "part2"}).out,
                AllOf(HasSubstr("part of a radiosity, complete"), HasSubstr("patina merge")));
    const auto refuses = [&](const Words& some, int status, const auto& said) {
        const Outcome outcome = merge(some, "out.glb");
        EXPECT_EQ(outcome.status, status) << outcome.err;
        EXPECT_THAT(outcome.err, said);
        EXPECT_FALSE(fs::exists(m_folder / "out.glb"));
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
    edited = whole;
    edited[edited.find("\"16\"") + 1] = '3';
    writeBytes(m_folder / "edited", edited);
    refuses({"part1", "edited"}, 65, HasSubstr("its description was changed"));
    EXPECT_EQ(merge(files, "out.obj").status, 2);
    EXPECT_EQ(merge(files, "nowhere/out.glb").status, 73);
    const Outcome other = runPatina({"merge", m_folder / "part1", m_folder / "part2", "-o",
                                     m_folder / "out.glb", "--scene", "builtin:chess"});
    EXPECT_EQ(other.status, 65);
    EXPECT_THAT(other.err, HasSubstr("the geometry (builtin:cornell-reference there, builtin:chess "
                                     "here)"));
    const Outcome merged = merge(files, "out.glb");
    EXPECT_EQ(merged.status, 0) << merged.err;
}

TEST_F(LongRadiosity, OptionsThatExcludeEachOtherAreRefused) {
    RunOptions alone;
    for (const char* variable :
         {"SLURM_ARRAY_TASK_ID", "SGE_TASK_ID", "LSB_JOBINDEX", "AWS_BATCH_JOB_ARRAY_INDEX",
          "CI_NODE_INDEX", "OMPI_COMM_WORLD_RANK", "PMI_RANK", "SLURM_PROCID"})
        alone.environment[variable] = std::nullopt;
    for (const auto& [more, said] : std::vector<std::pair<Words, const char*>>{
             {{"--shard", "3/2"}, "part 3 of 2"},
             {{"--shard", "auto"}, "--shard auto finds no scheduler"},
             {{"--shard", "1/2", "--keep-partial"}, "--keep-partial"},
             {{"--shard", "1/2", "--subdivide", "adaptive:0.3"}, "--subdivide adaptive"},
             {{"--checkpoint", "often"}, "--checkpoint takes a time"},
             {{"--solver", "hierarchical", "--shard", "1/2"}, "--shard keeps and splits rows"},
             {{"--solver", "hierarchical", "--resume"}, "--resume keeps and splits rows"},
             {{"--solver", "hierarchical", "--checkpoint", "1s"},
              "--checkpoint keeps and splits rows"}}) {
        const Outcome outcome = bake("no.glb", more, alone);
        EXPECT_EQ(outcome.status, 2) << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr(said));
    }
    EXPECT_THAT(m_folder.files(), ElementsAre());
}

TEST_F(LongRadiosity, OneProcessWritesAFile) {
    const Result<FileLock> held = FileLock::take(m_folder / "a.glb");
    ASSERT_TRUE(held.ok());
    const Outcome refused = bake("a.glb", {"--resolution", "16"});
    EXPECT_EQ(refused.status, 73) << refused.err;
    EXPECT_FALSE(fs::exists(m_folder / "a.glb"));
}

} // namespace
