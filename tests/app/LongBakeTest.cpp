// Long bakes as farms run them: split over processes, killed, resumed, merged; and what they say
// when that cannot be.
#include "app/cli/LongBake.h"
#include "CommandRunner.h"
#include "KilledRun.h"
#include "core/base/FileLock.h"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace fs = std::filesystem;
using namespace patina;
using namespace patina::test;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

namespace {

cli::Variables variables(std::map<std::string, std::string> values) {
    return [values = std::move(values)](const char* name) -> std::optional<std::string> {
        const auto found = values.find(name);
        return found == values.end() ? std::nullopt : std::optional(found->second);
    };
}

TEST(ShardOption, CountsFromOne) {
    EXPECT_EQ(cli::parseShard("1/1", variables({})).value(), (PassShard{0, 1}));
    EXPECT_EQ(cli::parseShard("2/8", variables({})).value(), (PassShard{1, 8}));
    EXPECT_EQ(cli::parseShard("8/8", variables({})).value(), (PassShard{7, 8}));
    for (const char* wrong : {"0/8", "9/8", "1/0", "-1/8", "1/-8", "2", "2/", "/8", "2/8/9", "a/b",
                              "1.5/2", " 1/2", "", "1/99999999", "auto"}) {
        const Result<PassShard> shard = cli::parseShard(wrong, variables({}));
        ASSERT_FALSE(shard.ok()) << wrong;
        EXPECT_EQ(shard.error().kind, ErrorKind::Usage);
    }
}

TEST(ShardOption, AsksTheScheduler) {
    const auto shard = [](std::map<std::string, std::string> values) {
        return cli::parseShard("auto", variables(std::move(values))).value();
    };
    EXPECT_EQ(shard({{"SLURM_ARRAY_TASK_ID", "14"},
                     {"SLURM_ARRAY_TASK_MIN", "10"},
                     {"SLURM_ARRAY_TASK_MAX", "16"},
                     {"SLURM_ARRAY_TASK_STEP", "2"},
                     {"SLURM_ARRAY_TASK_COUNT", "4"},
                     {"SLURM_PROCID", "0"},
                     {"SLURM_NTASKS", "1"}}),
              (PassShard{2, 4}));
    EXPECT_EQ(shard({{"SGE_TASK_ID", "7"},
                     {"SGE_TASK_FIRST", "3"},
                     {"SGE_TASK_LAST", "10"},
                     {"SGE_TASK_STEPSIZE", "2"}}),
              (PassShard{2, 4}));
    EXPECT_EQ(shard({{"SGE_TASK_ID", "undefined"}, {"PMI_RANK", "2"}, {"PMI_SIZE", "3"}}),
              (PassShard{2, 3}));
    EXPECT_EQ(shard({{"LSB_JOBINDEX", "5"}, {"LSB_JOBINDEX_END", "5"}}), (PassShard{4, 5}));
    EXPECT_EQ(shard({{"LSB_JOBINDEX", "0"},
                     {"LSB_JOBINDEX_END", "0"},
                     {"OMPI_COMM_WORLD_RANK", "1"},
                     {"OMPI_COMM_WORLD_SIZE", "2"}}),
              (PassShard{1, 2}));
    EXPECT_EQ(shard({{"AWS_BATCH_JOB_ARRAY_INDEX", "0"}, {"AWS_BATCH_JOB_ARRAY_SIZE", "6"}}),
              (PassShard{0, 6}));
    EXPECT_EQ(shard({{"CI_NODE_INDEX", "6"}, {"CI_NODE_TOTAL", "6"}}), (PassShard{5, 6}));
    EXPECT_EQ(shard({{"SLURM_PROCID", "3"}, {"SLURM_NTASKS", "4"}}), (PassShard{3, 4}));
    // An array with holes cannot be told from its numbers.
    EXPECT_THAT(cli::parseShard("auto", variables({{"SLURM_ARRAY_TASK_ID", "9"},
                                                   {"SLURM_ARRAY_TASK_MIN", "1"},
                                                   {"SLURM_ARRAY_TASK_COUNT", "3"}}))
                    .error()
                    .message,
                HasSubstr("SLURM_ARRAY_TASK_ID=9 asks for part 9 of 3"));
}

TEST(CheckpointOption, TakesTimes) {
    EXPECT_EQ(cli::parseInterval("30").value(), 30.0);
    EXPECT_EQ(cli::parseInterval("0.5s").value(), 0.5);
    EXPECT_EQ(cli::parseInterval("5min").value(), 300.0);
    EXPECT_EQ(cli::parseInterval("2m").value(), 120.0);
    EXPECT_EQ(cli::parseInterval("1h").value(), 3600.0);
    for (const char* wrong : {"", "s", "0", "-1s", "5 min", "inf", "nan", "5d"})
        EXPECT_FALSE(cli::parseInterval(wrong).ok()) << wrong;
}

// Two square grids, a floor and a wall at its edge, that shadow and light each other.
std::string cornerObj(int side = 24) { // cells
    std::string text;
    for (int grid = 0; grid < 2; ++grid)
        for (int row = 0; row <= side; ++row)
            for (int column = 0; column <= side; ++column) {
                const double u = static_cast<double>(column) / side;
                const double v = static_cast<double>(row) / side;
                text += grid == 0 ? fmt::format("v {} 0 {}\n", u, -v)
                                  : fmt::format("v 0 {} {}\n", u, -v);
                text += fmt::format("vt {} {}\n", 0.5 * (u + grid), v);
            }
    for (int grid = 0; grid < 2; ++grid)
        for (int row = 0; row < side; ++row)
            for (int column = 0; column < side; ++column) {
                const int a = (grid * (side + 1) + row) * (side + 1) + column + 1;
                const int b = a + 1, c = a + side + 1, d = c + 1;
                text += grid == 0 ? fmt::format("f {0}/{0} {1}/{1} {3}/{3} {2}/{2}\n", a, b, c, d)
                                  : fmt::format("f {0}/{0} {2}/{2} {3}/{3} {1}/{1}\n", a, b, c, d);
            }
    return text;
}

TEST(MemoryOption, TakesSizes) {
    EXPECT_EQ(cli::parseSize("--max-memory", "1000").value(), 1000u);
    EXPECT_EQ(cli::parseSize("--max-memory", "1.5KiB").value(), 1536u);
    EXPECT_EQ(cli::parseSize("--max-memory", "512MiB").value(), 512u << 20);
    EXPECT_EQ(cli::parseSize("--max-memory", "4G").value(), std::uint64_t{4} << 30);
    EXPECT_EQ(cli::parseSize("--max-memory", "4GB").value(), 4'000'000'000u);
    for (const char* wrong : {"", "0", "-1G", "4 GiB", "4gib", "lots", "inf", "nan", "9999999T"})
        EXPECT_FALSE(cli::parseSize("--max-memory", wrong).ok()) << wrong;
    EXPECT_EQ(cli::parseSize("--hit-memory", "0", 0).value(), 0u); // traces anew
    EXPECT_NE(cli::parseSize("--hit-memory", "-1", 0).error().message.find("--hit-memory takes"),
              std::string::npos);
}

class LongBake : public ::testing::Test {
  protected:
    LongBake() { writeBytes(m_scene, cornerObj()); }

    // patina bake prt with `more`, into `output` of the folder.
    [[nodiscard]] Outcome bake(const std::string& output, std::vector<std::string> more,
                               const RunOptions& options = {},
                               const std::string& scene = {}) const {
        std::vector<std::string> arguments{"bake", "prt", scene.empty() ? m_scene : scene, "-o",
                                           m_folder / output};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runPatina(arguments, options);
    }
    [[nodiscard]] std::string bytes(const std::string& name) const {
        return readBytes(m_folder / name);
    }
    // Bakes all parts and merges them.
    [[nodiscard]] Outcome bakeInParts(int count, const std::vector<std::string>& options,
                                      const std::string& output) const {
        std::vector<std::string> merge{"merge", "-o", m_folder / output};
        for (int k = count; k >= 1; --k) {
            const std::string name = "part-" + std::to_string(k) + ".of." + std::to_string(count);
            std::vector<std::string> more = options;
            more.insert(more.end(), {"--shard", std::to_string(k) + "/" + std::to_string(count)});
            const Outcome part = bake(name, more);
            EXPECT_EQ(part.status, 0) << part.err;
            merge.push_back(m_folder / name);
        }
        return runPatina(merge);
    }
    TemporaryFolder m_folder, m_sceneFolder;
    const std::string m_scene = m_sceneFolder / "corner.obj";
};

TEST_F(LongBake, SameBytesForAnyThreadsAndShards) {
    const std::vector<std::string> options{"--order", "2", "--samples", "64"};
    for (const char* threads : {"1", "2", "7"}) {
        std::vector<std::string> more = options;
        more.insert(more.end(), {"--threads", threads});
        const Outcome whole = bake(std::string(threads) + ".exr", more);
        ASSERT_EQ(whole.status, 0) << whole.err;
    }
    EXPECT_EQ(bytes("2.exr"), bytes("1.exr"));
    EXPECT_EQ(bytes("7.exr"), bytes("1.exr"));
    for (const int count : {1, 3, 8}) {
        const Outcome merged = bakeInParts(count, options, "merged.exr");
        ASSERT_EQ(merged.status, 0) << merged.err;
        EXPECT_EQ(bytes("merged.exr"), bytes("1.exr")) << count;
    }
}

// Which tiles are traced further is decided between passes, by one thread.
TEST_F(LongBake, SameBytesToAToleranceForAnyThreads) {
    for (const char* threads : {"1", "2", "7"}) {
        const Outcome whole =
            bake(std::string(threads) + ".exr", {"--order", "3", "--samples", "512", "--tolerance",
                                                 "0.002", "--threads", threads});
        ASSERT_EQ(whole.status, 0) << whole.err;
    }
    EXPECT_EQ(bytes("2.exr"), bytes("1.exr"));
    EXPECT_EQ(bytes("7.exr"), bytes("1.exr"));
}

TEST_F(LongBake, SameBytesWithBouncesPerTexelAndPacked) {
    const std::vector<std::vector<std::string>> kinds = {
        {"--order", "2", "--samples", "32", "--bounces", "2", "--bounce-samples", "8"},
        {"--order", "2", "--samples", "32", "--target", "texel", "--size", "16"},
        {"--order", "2", "--samples", "32", "--no-fit", "--store", "quantised", "--bits", "6"}};
    for (const std::vector<std::string>& options : kinds) {
        const Outcome whole = bake("whole.exr", options);
        ASSERT_EQ(whole.status, 0) << whole.err;
        const Outcome merged = bakeInParts(2, options, "merged.exr");
        ASSERT_EQ(merged.status, 0) << merged.err;
        EXPECT_EQ(bytes("merged.exr"), bytes("whole.exr"));
    }
}

TEST_F(LongBake, KilledTenTimesAndResumedItIsTheSame) {
    const std::vector<std::string> options{"--order", "3", "--samples", "16384", "--no-fit"};
    const Outcome whole = bake("whole.exr", options);
    ASSERT_EQ(whole.status, 0) << whole.err;

    const std::string output = m_folder / "killed.exr", checkpoint = output + ".checkpoint";
    for (int moment = 0; moment < 10; ++moment) {
        const std::vector<std::string> arguments{
            "bake",     "prt",          m_scene, "-o",       output,      "--order",
            "3",        "--samples",    "16384", "--no-fit", "--threads", "1",
            "--resume", "--checkpoint", "0.005", "--quiet"};
        // Also while a checkpoint is being written, and between two.
        ASSERT_TRUE(
            killAfterACheckpoint(arguments, checkpoint, std::chrono::microseconds(moment * 1300)))
            << "the bake was done before kill " << moment;
        EXPECT_FALSE(fs::exists(output));
        EXPECT_TRUE(fs::exists(checkpoint));
    }
    // What a kill leaves that hits the instant between naming a file and renaming it; no process
    // has this number (the kernel's limit is 4,194,304).
    std::ofstream(m_folder / ".killed.exr.checkpoint.4200000.part") << "whole";
    std::ofstream(m_folder / ".killed.exr.4200000.part") << "whole";
    std::vector<std::string> more = options;
    more.insert(more.end(), {"--resume", "--json"});
    const Outcome resumed = bake("killed.exr", more);
    ASSERT_EQ(resumed.status, 0) << resumed.err;
    EXPECT_EQ(bytes("killed.exr"), bytes("whole.exr"));
    EXPECT_GE(resumed.json()["resumedFrom"], 0);
    EXPECT_LT(resumed.json()["rays"].get<double>(),
              16384 * resumed.json()["counts"]["vertices"].get<double>());
    EXPECT_THAT(m_folder.files(), ElementsAre("killed.exr", "whole.exr"));
}

TEST_F(LongBake, AnInterruptLeavesACheckpointToGoOnFrom) {
    const std::vector<std::string> options{"--order",  "2",         "--samples", "16384",
                                           "--no-fit", "--threads", "1"};
    ASSERT_EQ(bake("whole.exr", options).status, 0);
    for (const int signal : {SIGINT, SIGTERM}) {
        RunOptions interrupt;
        interrupt.signal = signal;
        interrupt.signalWhen = "%";
        std::vector<std::string> more = options;
        more.insert(more.end(), {"--checkpoint", "1h", "--json"});
        const Outcome stopped = bake("a.exr", more, interrupt);
        ASSERT_EQ(stopped.status, 75) << stopped.err;
        EXPECT_EQ(stopped.json()["error"]["exitStatus"], 75);
        EXPECT_EQ(stopped.json()["error"]["kind"], "cancelled");
        EXPECT_THAT(stopped.json()["error"]["message"].get<std::string>(), HasSubstr("--resume"));
        EXPECT_THAT(m_folder.files(), ElementsAre("a.exr.checkpoint", "whole.exr"));

        const Outcome other =
            bake("a.exr", {"--order", "3", "--samples", "16384", "--no-fit", "--resume"});
        EXPECT_EQ(other.status, 65);
        EXPECT_THAT(other.err,
                    AllOf(HasSubstr("a.exr.checkpoint"), HasSubstr("order (2 there, 3 here)")));

        more.back() = "--resume";
        const Outcome resumed = bake("a.exr", more);
        ASSERT_EQ(resumed.status, 0) << resumed.err;
        EXPECT_EQ(bytes("a.exr"), bytes("whole.exr"));
        EXPECT_THAT(m_folder.files(), ElementsAre("a.exr", "whole.exr"));
        fs::remove(m_folder / "a.exr");
    }
}

// Importing takes its time; a farm that takes the machine back then must not lose the task.
TEST_F(LongBake, AnInterruptDuringTheImportIsForNowToo) {
    const std::string scene = m_sceneFolder / "large.obj";
    writeBytes(scene, cornerObj(300));
    for (const auto& [given, status] : {std::pair{true, 75}, std::pair{false, 143}}) {
        writeBytes(m_folder / "a.exr.checkpoint", "of an earlier bake");
        RunOptions interrupt;
        interrupt.signal = SIGTERM;
        interrupt.signalWhen = "will be replaced"; // said before the scene is opened
        std::vector<std::string> options{"--samples", "16384", "--json"};
        if (given)
            options.insert(options.end(), {"--checkpoint", "1h"});
        const Outcome stopped = bake("a.exr", options, interrupt, scene);
        EXPECT_EQ(stopped.status, status) << stopped.err;
        EXPECT_EQ(stopped.json()["error"]["exitStatus"], status);
        EXPECT_EQ(bytes("a.exr.checkpoint"), "of an earlier bake") << "no ray was cast";
    }
}

TEST_F(LongBake, InfoSaysWhatPartsAndCheckpointsAre) {
    const auto info = [&](const std::string& name) {
        return runPatina({"info", m_folder / name, "--json"}).json();
    };
    ASSERT_EQ(bake("b", {"--order", "2", "--samples", "64", "--shard", "2/3"}).status, 0);
    const auto part = info("b");
    EXPECT_EQ(part["kind"], "part");
    EXPECT_EQ(part["bake"]["holds"], "radiance transfer per vertex");
    EXPECT_EQ(part["bake"]["shard"]["part"], 2);
    EXPECT_EQ(part["bake"]["shard"]["of"], 3);
    EXPECT_EQ(part["bake"]["done"], 1.0);
    EXPECT_EQ(part["bake"]["samplesDone"], 64);
    EXPECT_EQ(part["bake"]["scene"], m_scene);
    EXPECT_EQ(part["bake"]["settings"]["order"], "2");

    RunOptions interrupt;
    interrupt.signal = SIGINT;
    interrupt.signalWhen = "%";
    ASSERT_EQ(bake("a.exr",
                   {"--samples", "16384", "--no-fit", "--threads", "1", "--checkpoint", "1h"},
                   interrupt)
                  .status,
              75);
    const auto checkpoint = info("a.exr.checkpoint");
    EXPECT_EQ(checkpoint["kind"], "checkpoint");
    EXPECT_EQ(checkpoint["bake"]["complete"], false);
    const double done = checkpoint["bake"]["done"];
    EXPECT_GT(done, 0.0);
    EXPECT_LT(done, 1.0);
    EXPECT_GE(done, checkpoint["bake"]["samplesDone"].get<double>() / 16384.0);
    const Outcome text = runPatina({"info", m_folder / "a.exr.checkpoint"});
    EXPECT_THAT(text.out, AllOf(HasSubstr("checkpoint of a bake, unfinished"),
                                HasSubstr("% of its rays"), HasSubstr("--resume")));

    const std::string whole = bytes("b");
    writeBytes(m_folder / "cut", whole.substr(0, 100));
    const Outcome cut = runPatina({"info", m_folder / "cut"});
    EXPECT_EQ(cut.status, 65);
    EXPECT_THAT(cut.err, HasSubstr("its end is missing"));
}

TEST_F(LongBake, ACheckpointThatCannotBeWrittenIsAWarning) {
    const std::vector<std::string> options{"--order", "2", "--samples", "256"};
    ASSERT_EQ(bake("whole.exr", options).status, 0);
    fs::create_directory(m_folder / "a.exr.checkpoint");
    std::vector<std::string> more = options;
    more.insert(more.end(), {"--checkpoint", "0.001", "--json"});
    const Outcome outcome = bake("a.exr", more);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(bytes("a.exr"), bytes("whole.exr"));
    const auto warnings = outcome.json()["warnings"].get<std::vector<std::string>>();
    EXPECT_THAT(
        warnings,
        Contains(AllOf(HasSubstr("the bake goes on"), HasSubstr("a.exr.checkpoint"))).Times(1));
}

// At the end the result is there, and its place is full or gone: it is kept elsewhere.
TEST_F(LongBake, ABakeThatCannotBeWrittenIsKeptElsewhere) {
    const std::vector<std::string> options{"--order", "2", "--samples", "16384", "--no-fit"};
    ASSERT_EQ(bake("whole.exr", options).status, 0);
    for (const bool full : {true, false}) {
        const TemporaryFolder elsewhere;
        const std::string folder = m_folder / (full ? "full" : "gone");
        fs::create_directory(folder);
        if (full)
            fs::create_symlink("/dev/full", folder + "/a.exr");
        RunOptions run;
        run.environment["TMPDIR"] = elsewhere.path();
        if (!full) {
            run.signalWhen = "%";
            run.when = [&] { fs::remove_all(folder); };
        }
        std::vector<std::string> more = options;
        more.emplace_back("--json");
        const Outcome outcome = bake((full ? "full" : "gone") + std::string("/a.exr"), more, run);
        EXPECT_EQ(outcome.status, full ? 74 : 73) << outcome.err;
        ASSERT_EQ(elsewhere.files().size(), 1u) << outcome.err;
        const std::string kept = elsewhere / elsewhere.files()[0];
        EXPECT_THAT(outcome.json()["error"]["message"].get<std::string>(),
                    HasSubstr("; the bake is kept in " + kept));
        EXPECT_EQ(readBytes(kept), bytes("whole.exr"));
    }
}

// Whatever limits the size of files: it is known before the first ray.
TEST_F(LongBake, WhatDoesNotFitOnTheDiskIsRefusedBeforeTheFirstRay) {
    RunOptions limited;
    limited.program = "/usr/bin/prlimit";
    const std::string patina = std::string(std::getenv("PATINA_BIN_DIR")) + "/patina";
    const Outcome outcome =
        runPatina({"--fsize=250000", patina, "bake", "prt", m_scene, "-o", m_folder / "a.exr",
                   "--order", "8", "--samples", "32", "--json"},
                  limited);
    EXPECT_EQ(outcome.status, 74) << outcome.err;
    EXPECT_THAT(outcome.json()["error"]["message"].get<std::string>(),
                AllOf(HasSubstr("can be written there"), HasSubstr("0.2 MiB")));
    EXPECT_FALSE(outcome.json().contains("rays"));
    EXPECT_THAT(m_folder.files(), IsEmpty());
}

TEST_F(LongBake, TwoBakesIntoOneFileAreRefused) {
    const Result<FileLock> first = FileLock::take(m_folder / "a.exr");
    ASSERT_TRUE(first.ok());
    const Outcome second = bake("a.exr", {"--samples", "32"});
    EXPECT_EQ(second.status, 73);
    EXPECT_THAT(second.err, AllOf(HasSubstr("a.exr"), HasSubstr(std::to_string(::getpid())),
                                  HasSubstr("is writing this file already")));
    EXPECT_EQ(bake("b.exr", {"--samples", "32", "--order", "1"}).status, 0);
}

TEST_F(LongBake, MergeSaysWhatDoesNotFit) {
    const auto part = [&](const char* name, const char* shard, const char* samples = "32",
                          const std::string& scene = {}) {
        const Outcome outcome =
            bake(name, {"--order", "1", "--samples", samples, "--shard", shard}, {}, scene);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return m_folder / name;
    };
    const auto merge = [&](std::vector<std::string> parts) {
        parts.insert(parts.begin(), {"merge", "-o", m_folder / "out.exr"});
        return runPatina(parts);
    };
    const std::string a = part("a", "1/2"), b = part("b", "2/2");
    const Outcome gap = merge({a});
    EXPECT_EQ(gap.status, 66);
    EXPECT_THAT(gap.err, HasSubstr("of 2 parts, 2 is missing"));
    const Outcome overlap = merge({a, b, part("again", "2/2")});
    EXPECT_EQ(overlap.status, 65);
    EXPECT_THAT(overlap.err, AllOf(HasSubstr("/again"), HasSubstr("is part 2 of 2, and so is")));
    const Outcome foreign = merge({a, part("other", "2/2", "64")});
    EXPECT_EQ(foreign.status, 65);
    EXPECT_THAT(foreign.err, AllOf(HasSubstr("/other"), HasSubstr("samples (32 there, 64 here)")));
    const Outcome scene = merge({a, part("plane", "2/2", "32", "builtin:plane")});
    EXPECT_EQ(scene.status, 65);
    EXPECT_THAT(scene.err, AllOf(HasSubstr("/plane"), HasSubstr("builtin:plane")));
    const std::string whole = bytes("b");
    writeBytes(m_folder / "cut", whole.substr(0, whole.size() - 1));
    const Outcome cut = merge({a, m_folder / "cut"});
    EXPECT_EQ(cut.status, 65);
    EXPECT_THAT(cut.err, AllOf(HasSubstr("/cut"), HasSubstr("its end is missing")));
    writeBytes(m_folder / "text", "hello, world, I am no part");
    EXPECT_THAT(merge({a, m_folder / "text"}).err, HasSubstr("/text: this is no part"));
    EXPECT_FALSE(fs::exists(m_folder / "out.exr"));
    EXPECT_EQ(merge({b, a}).status, 0);
}

TEST_F(LongBake, MergeFindsTheSceneOrIsToldWhereItIs) {
    const std::string obj = "o Corner\nv 0 0 0\nv 1 0 0\nv 0 0 -1\nv 0 1 0\nf 1 2 3\nf 1 4 2\n";
    writeBytes(m_folder / "scene.obj", obj);
    const Outcome whole =
        bake("whole.exr", {"--order", "1", "--samples", "32"}, {}, m_folder / "scene.obj");
    ASSERT_EQ(whole.status, 0) << whole.err;
    ASSERT_EQ(
        bake("p", {"--order", "1", "--samples", "32", "--shard", "1/1"}, {}, m_folder / "scene.obj")
            .status,
        0);
    fs::rename(m_folder / "scene.obj", m_folder / "moved.obj");
    const Outcome lost = runPatina({"merge", m_folder / "p", "-o", m_folder / "out.exr"});
    EXPECT_EQ(lost.status, 66);
    EXPECT_THAT(lost.err, AllOf(HasSubstr("scene.obj"), HasSubstr("--scene")));
    const Outcome told = runPatina(
        {"merge", m_folder / "p", "-o", m_folder / "out.exr", "--scene", m_folder / "moved.obj"});
    ASSERT_EQ(told.status, 0) << told.err;
    EXPECT_EQ(bytes("out.exr"), bytes("whole.exr"));
    writeBytes(m_folder / "scene.obj", obj + "v 0 0 5\nf 1 2 5\n");
    const Outcome changed = runPatina({"merge", m_folder / "p", "-o", m_folder / "out.exr"});
    EXPECT_EQ(changed.status, 65);
    EXPECT_THAT(changed.err,
                AllOf(HasSubstr("/p: it does not fit"), HasSubstr("which was changed")));
}

TEST_F(LongBake, OptionsThatExcludeEachOtherAreRefused) {
    const std::vector<std::vector<std::string>> wrong = {
        {"--shard", "0/2"},
        {"--shard", "auto"},
        {"--shard", "1/2", "--keep-partial"},
        {"--shard", "1/2", "--tolerance", "0.01"},
        {"--shard", "1/2", "--transfer", "unshadowed"},
        {"--checkpoint", "soon"},
        {"--max-memory", "some"},
        {"--max-memory", "100KiB"},
        {"--transfer", "shadowed", "--bounces", "2"},
        {"--hit-memory", "1GiB"},
        {"--bounces", "2", "--hit-memory", "some"},
        {"--size", "64"},
        {"--no-fit", "--target", "texel"},
        {"--bits", "8"},
        {"--order", "0"},
        {"--order", "9"},
        {"--samples", "0"},
        {"--bounces", "65"},
        {"--tolerance", "-1"},
        {"--method", "magic"}};
    for (const std::vector<std::string>& options : wrong) {
        RunOptions noArray;
        noArray.environment = {{"SLURM_ARRAY_TASK_ID", ""}};
        const Outcome outcome = bake("x.exr", options, noArray);
        EXPECT_EQ(outcome.status, 2) << options.front() << " " << outcome.err;
    }
    EXPECT_THAT(m_folder.files(), IsEmpty());
}

} // namespace
