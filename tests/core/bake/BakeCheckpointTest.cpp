// Bakes in parts and in several runs end in the very bits of one that was left alone.
#include "core/bake/Bake.h"
#include "core/bake/transfer/BakeMerge.h"
#include "core/bake/transfer/ResumableTracer.h"
#include "core/base/AtomicFile.h"
#include "tests/core/bake/BakeTestScene.h"
#include "tests/support/FullDisk.h"
#include "tests/support/TemporaryFolder.h"

#include <atomic>
#include <csignal>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace fs = std::filesystem;
using namespace patina;
using ::testing::HasSubstr;

namespace {

// Cancels the job when it has received so many ranges.
class CancellingSink : public TileSink {
  public:
    CancellingSink(JobControl& control, int ranges)
        : m_control(control)
        , m_left(ranges) {}
    void vertices(Id, std::size_t, int, std::span<const float>) override { count(); }

  private:
    void count() {
        if (--m_left == 0)
            m_control.cancel();
    }
    JobControl& m_control;
    std::atomic<int> m_left;
};

class BakeCheckpoint : public ::testing::Test {
  protected:
    BakeCheckpoint() {
        settings.order = 3;
        settings.samples = 128;
        settings.fitted = false;
        manifest.inputs = hashBakeInputs(inputs);
        manifest.settings = {{"order", "3"}, {"samples", "128"}};
        manifest.scene = "builtin:bowl";
    }

    [[nodiscard]] Result<BakeArtifact> bake(BakeTracer* tracer, TileSink& sink,
                                            const JobContext& job) const {
        return bakePrtVertex(inputs, settings, sink, job, tracer);
    }
    [[nodiscard]] Result<BakeArtifact> bake(BakeTracer* tracer = nullptr) const {
        TileSink sink;
        return bake(tracer, sink, JobContext());
    }
    // The bake's part `index` of `count` in a file.
    fs::path part(int index, int count) const {
        ResumeSettings resume;
        resume.manifest = manifest;
        resume.manifest.shard = {index, count};
        resume.part = folder / fmt::format("{}-{}.part", index, count);
        ResumableTracer tracer(resume);
        const Result<BakeArtifact> none = bake(&tracer);
        EXPECT_TRUE(none.ok()) << none.error().text();
        EXPECT_TRUE(none->vertices.empty());
        return resume.part;
    }
    [[nodiscard]] Result<BakeArtifact> merge(const std::vector<fs::path>& files) const {
        Result<std::vector<BakePart>> parts = readBakeParts(files);
        if (!parts)
            return parts.error();
        JoiningTracer tracer(*parts, manifest);
        return bake(&tracer);
    }

    const test::TemporaryFolder temporary;
    const fs::path folder = temporary.path();
    // 26 x 14 vertices in the bowl: six ranges, and two of the disc.
    const BakeInputs inputs = test::sceneOf({test::bowlMesh(25, 13), test::discMesh(0.5, 0.2)});
    PrtSettings settings;
    BakeManifest manifest;
};

TEST_F(BakeCheckpoint, PartsTogetherAreTheWhole) {
    const Result<BakeArtifact> whole = bake();
    ASSERT_TRUE(whole.ok());
    for (const int count : {1, 3, 8, 40}) { // 40: more parts than ranges, so some are empty
        std::vector<fs::path> files;
        for (int index = count - 1; index >= 0; --index)
            files.push_back(part(index, count));
        const Result<BakeArtifact> merged = merge(files);
        ASSERT_TRUE(merged.ok()) << merged.error().text();
        EXPECT_EQ(*merged, *whole) << count;
    }
}

// Values are fitted when all points are there.
TEST_F(BakeCheckpoint, PartsOfAFittedBakeTooAreTheWhole) {
    settings.fitted = true;
    settings.samples = 32;
    const Result<BakeArtifact> whole = bake();
    ASSERT_TRUE(whole.ok());
    for (const int count : {1, 3, 8}) {
        std::vector<fs::path> files;
        for (int index = 0; index < count; ++index)
            files.push_back(part(index, count));
        const Result<BakeArtifact> merged = merge(files);
        ASSERT_TRUE(merged.ok()) << merged.error().text();
        EXPECT_EQ(*merged, *whole) << count;
    }
}

TEST_F(BakeCheckpoint, ACancelledBakeGoesOnWhereItWas) {
    const Result<BakeArtifact> whole = bake();
    ASSERT_TRUE(whole.ok());
    ResumeSettings resume;
    resume.manifest = manifest;
    resume.checkpoint = folder / "a.checkpoint";
    resume.resume = resume.keepOnCancel = true;
    double rays = 0;
    int runs = 0;
    for (const int ranges : {1, 2, 3, 5, 7, 4, 1}) {
        JobControl control;
        CancellingSink sink(control, ranges);
        ResumableTracer tracer(resume);
        const Result<BakeArtifact> cancelled = bake(&tracer, sink, control.context());
        ASSERT_FALSE(cancelled.ok()) << ranges;
        EXPECT_EQ(cancelled.error().kind, ErrorKind::Cancelled);
        EXPECT_TRUE(tracer.keptCheckpoint());
        EXPECT_EQ(tracer.resumedFrom() >= 0, runs++ > 0);
        rays += control.progress().workDone;
    }
    JobControl control;
    TileSink sink;
    ResumableTracer tracer(resume);
    const Result<BakeArtifact> resumed = bake(&tracer, sink, control.context());
    ASSERT_TRUE(resumed.ok()) << resumed.error().text();
    EXPECT_TRUE(tracer.complete());
    EXPECT_EQ(*resumed, *whole);
    // No range that was done is traced again.
    double points = 0;
    for (const VertexBake& mesh : whole->vertices)
        points += static_cast<double>(mesh.values.size()) / 9;
    EXPECT_EQ(rays + control.progress().workDone, 128 * points);
}

TEST_F(BakeCheckpoint, CancelLeavesNothingUnlessAskedFor) {
    ResumeSettings resume;
    resume.manifest = manifest;
    resume.checkpoint = folder / "a.checkpoint";
    JobControl control;
    CancellingSink sink(control, 3);
    ResumableTracer tracer(resume);
    EXPECT_FALSE(bake(&tracer, sink, control.context()).ok());
    EXPECT_FALSE(tracer.keptCheckpoint());
    EXPECT_FALSE(fs::exists(resume.checkpoint));
}

TEST_F(BakeCheckpoint, OneThatCannotBeWrittenIsAWarning) {
    const Result<BakeArtifact> whole = bake();
    ResumeSettings resume;
    resume.manifest = manifest;
    resume.checkpoint = folder / "full.checkpoint";
    fs::create_directory(resume.checkpoint);
    resume.everySeconds = 1e-9; // at every range
    std::vector<Error> warnings;
    resume.warn = [&](const Error& error) { warnings.push_back(error); };
    ResumableTracer tracer(resume);
    const Result<BakeArtifact> baked = bake(&tracer);
    ASSERT_TRUE(baked.ok());
    EXPECT_EQ(*baked, *whole);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings.front().kind, ErrorKind::CannotCreate);
    EXPECT_THAT(warnings.front().text(), HasSubstr("full.checkpoint"));
    EXPECT_FALSE(tracer.keptCheckpoint());
}

// Another program computes the same bake: its checkpoint is neither read nor touched.
TEST_F(BakeCheckpoint, OneThatAnotherProcessWritesIsLeftAlone) {
    const Result<BakeArtifact> whole = bake();
    ResumeSettings resume;
    resume.manifest = manifest;
    resume.checkpoint = folder / "a.checkpoint";
    resume.everySeconds = 1e-9; // at every range
    resume.resume = resume.keepOnCancel = true;
    std::vector<Error> warnings;
    resume.warn = [&](const Error& error) { warnings.push_back(error); };
    {
        JobControl control;
        CancellingSink sink(control, 2);
        ResumableTracer tracer(resume);
        ASSERT_FALSE(bake(&tracer, sink, control.context()).ok());
        ASSERT_TRUE(tracer.keptCheckpoint());
    }
    const Result<Bytes> before = readFile(resume.checkpoint, 1 << 24);
    ASSERT_TRUE(before.ok());

    // The other process, in the middle of its bake.
    int ready[2];
    ASSERT_EQ(::pipe(ready), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        const Result<FileLock> held = FileLock::take(resume.checkpoint);
        const char answer = held.ok() ? 'y' : 'n';
        if (::write(ready[1], &answer, 1) == 1)
            ::pause();
        ::_exit(1);
    }
    char answer = 'n';
    ASSERT_EQ(::read(ready[0], &answer, 1), 1);
    EXPECT_EQ(answer, 'y');
    {
        ResumableTracer tracer(resume);
        const Result<BakeArtifact> baked = bake(&tracer);
        ASSERT_TRUE(baked.ok());
        EXPECT_EQ(*baked, *whole);
        EXPECT_EQ(tracer.resumedFrom(), -1);
        EXPECT_FALSE(tracer.keptCheckpoint());
        EXPECT_FALSE(tracer.removeCheckpoint());
    }
    {
        ResumableTracer tracer(resume); // one that has not begun
        EXPECT_FALSE(tracer.removeCheckpoint());
    }
    ASSERT_EQ(warnings.size(), 2u);
    EXPECT_THAT(warnings.front().text(), HasSubstr("another program computes this bake"));
    EXPECT_THAT(warnings.front().text(), HasSubstr(std::to_string(child)));
    EXPECT_EQ(readFile(resume.checkpoint, 1 << 24).value(), *before);

    // It was killed: whoever comes next resumes what it left.
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    ::close(ready[0]);
    ::close(ready[1]);
    ResumableTracer tracer(resume);
    const Result<BakeArtifact> resumed = bake(&tracer);
    ASSERT_TRUE(resumed.ok());
    EXPECT_EQ(*resumed, *whole);
    EXPECT_GE(tracer.resumedFrom(), 0);
    EXPECT_EQ(warnings.size(), 2u);
    // Two bakes of one process are two, too.
    ResumableTracer second(resume);
    EXPECT_FALSE(second.removeCheckpoint());
    EXPECT_EQ(warnings.size(), 3u);
    EXPECT_TRUE(tracer.removeCheckpoint());
    EXPECT_FALSE(fs::exists(resume.checkpoint));
}

// What a bake does with a disk that runs full under it and has room again later. Says on standard
// error what is wrong; returns how much.
int writeOntoAFullDisk(const fs::path& folder, BakeManifest manifest) {
    int wrong = 0;
    const auto expect = [&wrong](bool holds, const std::string& what) {
        if (!holds)
            std::fprintf(stderr, "wrong: %s\n", what.c_str());
        wrong += holds ? 0 : 1;
    };
    test::FullDisk disk(folder);
    std::fprintf(stderr, "a disk of its own: %s\n", disk.isOwn() ? "yes" : "no");
    constexpr std::size_t kPoints = 5000, kValues = 9; // 190 kB
    const std::vector<PointRange> ranges = {{0, kPoints}};
    manifest.points = kPoints;
    manifest.ranges = ranges.size();
    PassState state;
    state.values.assign(kPoints * kValues, 0.25f);
    state.hiddenSky.assign(kPoints, 0.5f);
    state.error.assign(kPoints, 0.0f);
    state.passes.assign(kPoints, 1);
    state.wanted.assign(kPoints, 1);
    state.samplesDone = 16;
    const fs::path file = folder / "a.checkpoint";
    std::vector<Error> warnings;
    Checkpointer checkpointer(file, manifest, ranges,
                              [&](const Error& error) { warnings.push_back(error); });
    const auto samplesKept = [&] {
        PassState kept;
        const Result<void> read = readBakeState(file, ranges, kValues, kept);
        expect(read.ok(), read.ok() ? "" : read.error().text());
        return kept == state ? kept.samplesDone : -kept.samplesDone;
    };
    expect(checkpointer.write(state, false, 0.1), "the first is written");
    expect(samplesKept() == 16, "the first is whole");

    constexpr rlim_t kFree = 64 << 10; // a part of the next one fits
    disk.fill(kFree);
    state.samplesDone = 32;
    for (int attempt = 0; attempt < 2; ++attempt)
        expect(!checkpointer.write(state, false, 0.2), "the disk is full");
    expect(warnings.size() == 1, "one warning is enough");
    for (const Error& warning : warnings) {
        expect(warning.kind == ErrorKind::Io, "an error of writing");
        expect(warning.text().find(disk.isOwn()
                                       ? "a.checkpoint: the disk is full"
                                       : "a.checkpoint: writing failed") != std::string::npos,
               warning.text());
    }
    disk.free();
    state.samplesDone = 16;
    expect(samplesKept() == 16, "the first is still there");
    std::size_t files = 0;
    for ([[maybe_unused]] const fs::directory_entry& entry : fs::directory_iterator(folder))
        ++files;
    expect(files == 1, "nothing half-written lies about");

    state.samplesDone = 48;
    expect(checkpointer.write(state, false, 0.3), "there is room again");
    expect(samplesKept() == 48, "the next one is whole");
    return wrong;
}

TEST_F(BakeCheckpoint, AFullDiskKeepsTheLastOneAndIsTriedAgain) {
    fs::create_directory(folder / "disk");
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0)
        ::_exit(writeOntoAFullDisk(folder / "disk", manifest));
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST_F(BakeCheckpoint, OtherBakesCheckpointsAreRefused) {
    ResumeSettings resume;
    resume.manifest = manifest;
    resume.checkpoint = folder / "a.checkpoint";
    resume.everySeconds = 1e-9;
    {
        ResumableTracer first(resume);
        ASSERT_TRUE(bake(&first).ok());
        ASSERT_TRUE(first.keptCheckpoint());
    }
    resume.resume = true;
    const auto refusal = [&](const BakeManifest& other) {
        ResumeSettings changed = resume;
        changed.manifest = other;
        ResumableTracer tracer(changed);
        const Result<BakeArtifact> baked = bake(&tracer);
        EXPECT_FALSE(baked.ok());
        return baked ? std::string() : baked.error().text();
    };
    BakeManifest other = manifest;
    other.settings["samples"] = "64";
    EXPECT_THAT(refusal(other), HasSubstr("samples (128 there, 64 here)"));
    EXPECT_THAT(refusal(other), HasSubstr("a.checkpoint"));
    other = manifest;
    other.settings["seed"] = "1";
    EXPECT_THAT(refusal(other), HasSubstr("seed (none there, 1 here)"));
    other = manifest;
    other.settings.erase("order");
    EXPECT_THAT(refusal(other), HasSubstr("order (3 there, none here)"));
    other = manifest;
    ++other.inputs.low;
    EXPECT_THAT(refusal(other), HasSubstr("the geometry of builtin:bowl"));
    other.scene = "builtin:cup";
    EXPECT_THAT(refusal(other), HasSubstr("the scene (builtin:bowl there, builtin:cup here)"));
    other = manifest;
    other.albedo.high = 1;
    EXPECT_THAT(refusal(other), HasSubstr("the albedo"));
    other = manifest;
    other.storage.bits = 6;
    EXPECT_THAT(refusal(other), HasSubstr("how the values are stored"));
    other.storage = {BakeStorage::Half, 8};
    EXPECT_THAT(refusal(other), HasSubstr("how the values are stored"));
    other = manifest;
    other.kind = BakeKind::AoVertex;
    EXPECT_THAT(refusal(other), HasSubstr("the kind"));
    other = manifest;
    other.shard = {0, 2};
    EXPECT_THAT(refusal(other), HasSubstr("part 1 of 1 there, 1 of 2 here"));
}

// The file is whole, but nobody writes such a one.
TEST_F(BakeCheckpoint, MergeRefusesNumbersThatCannotBeStored) {
    const BakeManifest sound = manifest;
    const auto isRead = [&] { return readBakeParts(std::vector<fs::path>{part(0, 1)}).ok(); };
    for (const int bits : {-1, 0, kMinStorageBits - 1, kMaxStorageBits + 1, 1 << 30}) {
        manifest.storage = {BakeStorage::Quantised, bits};
        EXPECT_FALSE(isRead()) << bits;
    }
    manifest.storage = {BakeStorage::Quantised, kMinStorageBits};
    EXPECT_TRUE(isRead());
    manifest.kind = BakeKind::AoVertex; // has no bands whose steps they would be
    EXPECT_FALSE(isRead());
    manifest = sound;
}

TEST_F(BakeCheckpoint, MergeTakesEveryPartOnce) {
    const fs::path a = part(0, 3), b = part(1, 3), c = part(2, 3);
    const auto refusal = [&](const std::vector<fs::path>& files) {
        const Result<std::vector<BakePart>> parts = readBakeParts(files);
        EXPECT_FALSE(parts.ok());
        return parts ? std::string() : parts.error().text();
    };
    EXPECT_THAT(refusal({a, c}), HasSubstr("of 3 parts, 2 is missing"));
    EXPECT_THAT(refusal({b}), HasSubstr("of 3 parts, 1, 3 are missing"));
    EXPECT_THAT(refusal({a, b, c, b}), HasSubstr("1-3.part: it is part 2 of 3, and so is"));
    const fs::path half = part(1, 2);
    EXPECT_THAT(refusal({a, half, c}), HasSubstr("1-2.part: it is one of 2 parts"));
    EXPECT_THAT(refusal({a, folder / "none"}), HasSubstr("none: the file does not exist"));
    EXPECT_THAT(refusal({a, "/dev/null"}), HasSubstr("/dev/null: this is a pipe or a device"));

    // Parts of other settings, and a checkpoint that is no part yet.
    manifest.settings["samples"] = "64";
    settings.samples = 64;
    EXPECT_THAT(refusal({a, part(1, 3), c}),
                HasSubstr("1-3.part: it belongs to another bake than"));
    const fs::path other = part(1, 3);
    ResumeSettings resume;
    resume.manifest = manifest;
    resume.checkpoint = folder / "unfinished";
    resume.keepOnCancel = true;
    JobControl control;
    CancellingSink sink(control, 2);
    ResumableTracer tracer(resume);
    ASSERT_FALSE(bake(&tracer, sink, control.context()).ok());
    EXPECT_THAT(refusal({resume.checkpoint}),
                HasSubstr("unfinished: the bake of this part is not"));
}

TEST_F(BakeCheckpoint, MergeNoticesAChangedScene) {
    const fs::path file = part(0, 1);
    ++manifest.inputs.high;
    const Result<BakeArtifact> merged = merge({file});
    ASSERT_FALSE(merged.ok());
    EXPECT_THAT(merged.error().text(), HasSubstr("0-1.part: it does not fit the scene"));
    EXPECT_THAT(merged.error().text(), HasSubstr("the geometry of builtin:bowl"));
}

TEST_F(BakeCheckpoint, DamageIsFoundWhereverItIs) {
    const fs::path a = part(0, 2), b = part(1, 2);
    const Bytes good = readFile(b, 1 << 24).value();
    ASSERT_TRUE(merge({a, b}).ok());
    const auto refused = [&](const Bytes& bytes, const std::string& what) {
        EXPECT_TRUE(writeFileAtomically(b, bytes).ok());
        const Result<BakeArtifact> merged = merge({a, b});
        ASSERT_FALSE(merged.ok()) << what;
        EXPECT_EQ(merged.error().kind, ErrorKind::InputBroken) << what;
        EXPECT_EQ(merged.error().file, b) << what;
    };
    for (const std::size_t length :
         {std::size_t{0}, std::size_t{7}, std::size_t{15}, std::size_t{200}, good.size() / 2,
          good.size() - 16, good.size() - 1})
        refused(Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(length)),
                fmt::format("cut to {}", length));
    // Every byte of the front, then samples of the rest: one bit each.
    for (std::size_t at = 0; at < good.size(); at += at < 600 ? 23 : good.size() / 23) {
        Bytes bad = good;
        bad[at] ^= std::byte{4};
        refused(bad, fmt::format("byte {} changed", at));
    }
    Bytes longer = good;
    longer.push_back(std::byte{0});
    refused(longer, "a byte more");
}

} // namespace
