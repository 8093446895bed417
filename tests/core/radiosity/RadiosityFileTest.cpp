// Radiosity in several runs and in parts ends in the very bits of one that was left alone; files
// that make no sense are refused.
#include "core/base/AtomicFile.h"
#include "core/job/Parallel.h"
#include "core/radiosity/document/LitDocument.h"
#include "core/radiosity/file/RadiosityMerge.h"
#include "core/radiosity/file/ResumableRadiosity.h"
#include "tests/core/radiosity/RadiosityScenes.h"
#include "tests/support/TemporaryFolder.h"

#include <array>
#include <atomic>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <set>
#include <sstream>

namespace patina::test {

using namespace radiosity;
namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

namespace {

// Walls of unequal colours, so that no two elements have the same light.
TraceInputs tintedRoom() {
    std::vector<Wall> walls = unitCube(0.6f);
    walls[2].reflectance = {0.8f, 0.3f, 0.1f};
    return sceneOf(walls);
}

RadiositySettings longSettings(radiosity::Solver solver) {
    RadiositySettings settings;
    settings.maxArea = 0.03;
    settings.factors.resolution = 32;
    settings.lightSamples = 8;
    settings.classic = true; // so that there is much to shoot
    settings.solve.solver = solver;
    settings.solve.residual = 1e-4;
    settings.solve.shotsPerStep = 5;
    return settings;
}

// The same by hemicubes: so few rays are noise, which divides nothing.
RadiositySettings dividedSettings(radiosity::Solver solver) {
    RadiositySettings settings = longSettings(solver);
    settings.factors.method = FactorMethod::Hemicube;
    settings.factors.resolution = 8;
    settings.maxArea = 0.12;
    return settings;
}

RadiosityManifest roomManifest(const TraceInputs& inputs) {
    RadiosityManifest manifest;
    manifest.settings = {{"resolution", "32"}};
    manifest.inputs = hashTraceInputs(inputs);
    manifest.scene = "builtin:room";
    return manifest;
}

// Cancels its job after so many pieces of work.
class CancellingKeeper : public ResumableRadiosity {
  public:
    CancellingKeeper(RadiosityKeeping keeping, JobControl& control, int pieces)
        : ResumableRadiosity(std::move(keeping))
        , m_control(control)
        , m_left(pieces) {}
    void between(const SolverView& solver) override {
        ResumableRadiosity::between(solver);
        if (--m_left == 0)
            m_control.cancel();
    }

  private:
    JobControl& m_control;
    std::atomic<int> m_left;
};

std::string fileContent(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
}

void writeContent(const fs::path& file, const std::string& content) {
    std::ofstream(file, std::ios::binary) << content;
}

class RadiosityFiles : public ::testing::Test {
  protected:
    [[nodiscard]] fs::path file(const std::string& name) const { return m_folder.path() / name; }

    static Solved whole(const RadiositySettings& settings,
                        const TraceInputs& inputs = tintedRoom()) {
        const auto scene = RadiosityScene::make(inputs, settings, {});
        EXPECT_TRUE(scene) << scene.error().text();
        auto solved = (*scene)->solve(settings, {});
        EXPECT_TRUE(solved) << solved.error().text();
        return *std::move(solved);
    }

    // A part of the room's form factors, in a file.
    fs::path part(const std::string& name, const ElementShard& shard,
                  const RadiositySettings& settings, RadiosityManifest manifest) const {
        manifest.shard = shard;
        ResumableRadiosity keeper({std::move(manifest)});
        const Result<void> found =
            RadiosityScene::findPart(tintedRoom(), settings, shard, {}, keeper);
        EXPECT_TRUE(found) << found.error().text();
        const Result<void> written = keeper.writePart(file(name));
        EXPECT_TRUE(written) << written.error().text();
        return file(name);
    }
    fs::path part(const std::string& name, const ElementShard& shard) const {
        return part(name, shard, longSettings(radiosity::Solver::GaussSeidel),
                    roomManifest(tintedRoom()));
    }

    // A state of two elements that see each other, with two steps of a solver.
    struct Small {
        SolveState state{2};
        std::vector<glm::dvec3> radiosity{2, glm::dvec3(0.5)}, irradiance{2, glm::dvec3(0.25)};
        std::vector<SolveStep> steps{{1, 0.5}, {2, 0.25}};
        Small() {
            for (std::uint32_t e = 0; e < 2; ++e) {
                state.light.set(e, glm::dvec3(1.0, 2.0, 3.0));
                FactorRow row;
                row.shares = {{1 - e, 0.75f}};
                row.escaped = 0.25f;
                row.rays = 4;
                state.rows.set(e, row);
            }
        }
        [[nodiscard]] SolverView view() const {
            return {radiosity, irradiance, glm::dvec3(0.1), glm::dvec3(0.2), steps, false};
        }
    };
    // What reading says of a small state.
    [[nodiscard]] std::string refusal(const Small& small) const {
        EXPECT_TRUE(
            writeRadiosity(file("bad"), {}, small.state, small.view(), StateFileName::OfUser));
        return refusal("bad");
    }
    [[nodiscard]] std::string refusal(const std::string& name) const {
        SolveState read(2);
        const Result<void> result = readRadiosity(file(name), 0, read);
        EXPECT_FALSE(result.ok());
        if (result)
            return {};
        EXPECT_EQ(result.error().kind, ErrorKind::InputBroken);
        EXPECT_EQ(result.error().file, file(name));
        return result.error().message;
    }
    [[nodiscard]] std::string refusesToJoin(const std::vector<fs::path>& files) const {
        const auto parts = readRadiosityParts(files);
        EXPECT_FALSE(parts.ok());
        return parts ? std::string() : parts.error().text();
    }

    // Cancelled again and again, first after so many pieces of work, then after ever more.
    void solveInRuns(const RadiositySettings& settings, int pieces) const {
        const Solved truth = whole(settings);
        std::set<std::string> moments;
        for (int run = 0;; ++run) {
            ASSERT_LT(run, 500) << "no progress";
            JobControl control;
            RadiosityKeeping keeping{roomManifest(tintedRoom()), file("checkpoint")};
            keeping.everySeconds = 1e9; // at the end of each run alone
            keeping.resume = keeping.keepOnCancel = true;
            CancellingKeeper keeper(std::move(keeping), control, pieces * (run + 1));
            const auto scene =
                RadiosityScene::make(tintedRoom(), settings, control.context(), &keeper);
            const auto solved = scene ? (*scene)->solve(settings, control.context(), {}, &keeper)
                                      : Result<Solved>(scene.error());
            if (!solved) {
                ASSERT_EQ(solved.error().kind, ErrorKind::Cancelled) << solved.error().text();
                keeper.finish(true);
                const auto kept = readRadiosityManifest(file("checkpoint"));
                ASSERT_TRUE(kept) << kept.error().text();
                if (!kept->divided.empty())
                    moments.insert("a division");
                moments.insert(kept->steps > 0 ? "solving" : kept->rows > 0 ? "rows" : "light");
                continue;
            }
            EXPECT_EQ(solved->solution.radiosity, truth.solution.radiosity);
            EXPECT_EQ(solved->solution.irradiance, truth.solution.irradiance);
            EXPECT_EQ(solved->report.history, truth.report.history);
            EXPECT_EQ(solved->report.iterations, truth.report.iterations);
            EXPECT_EQ(solved->report.converged, truth.report.converged);
            EXPECT_GT(run, 3);
            break;
        }
        EXPECT_TRUE(moments.contains("light"));
        EXPECT_TRUE(moments.contains("rows") || shoots(settings.solve.solver));
        EXPECT_EQ(moments.contains("a division"), settings.adaptive > 0.0);
    }

    // What parts of it are joined to is the whole, for any number of them and of threads.
    void expectPartsJoin(const RadiositySettings& settings) const {
        const Solved truth = whole(settings);
        int threads[] = {1, 2, 7};
        for (int i = 0; i < 3; ++i) {
            const int count = std::array{8, 3, 1}[static_cast<std::size_t>(i)];
            const ThreadLimit limit(threads[i]);
            std::vector<fs::path> files;
            for (int k = count - 1; k >= 0; --k)
                files.push_back(part("part" + std::to_string(k), {k, count}, settings,
                                     roomManifest(tintedRoom())));
            const auto parts = readRadiosityParts(files);
            ASSERT_TRUE(parts) << parts.error().text();
            JoinedRadiosity joined(*parts, "builtin:room", hashTraceInputs(tintedRoom()), 0);
            const auto scene = RadiosityScene::make(tintedRoom(), settings, {}, &joined);
            ASSERT_TRUE(scene) << scene.error().text();
            const auto solved = (*scene)->solve(settings, {}, {}, &joined);
            ASSERT_TRUE(solved) << solved.error().text();
            EXPECT_EQ(solved->solution.radiosity, truth.solution.radiosity) << count;
            EXPECT_EQ(solved->solution.irradiance, truth.solution.irradiance) << count;
            EXPECT_EQ(solved->report.history, truth.report.history) << count;
        }
    }

    const TemporaryFolder m_folder;
};

class EveryLongSolver : public RadiosityFiles,
                        public ::testing::WithParamInterface<radiosity::Solver> {};

} // namespace

TEST_P(EveryLongSolver, CancelledAndResumedIsTheSame) {
    solveInRuns(longSettings(GetParam()), 31);
}

// Rounds that divide where light changes are runs of their own.
TEST_F(RadiosityFiles, CancelledAndResumedWhileItDividesItIsTheSame) {
    for (const auto solver : {radiosity::Solver::GaussSeidel, radiosity::Solver::Progressive}) {
        RadiositySettings settings = dividedSettings(solver);
        settings.adaptive = 0.25;
        solveInRuns(settings, 31);
        fs::remove(file("checkpoint"));
    }
}

// What has been shot goes on to the elements that there are after a division.
TEST_F(RadiosityFiles, CancelledAndResumedWhileItDividesAsItShootsItIsTheSame) {
    for (const double patchArea : {0.0, 0.25}) {
        RadiositySettings settings = dividedSettings(radiosity::Solver::Progressive);
        settings.adaptive = 0.3;
        settings.dynamic = true;
        settings.patchArea = patchArea;
        solveInRuns(settings, 31);
        fs::remove(file("checkpoint"));
    }
}

// There is a row for each patch, and direct light of each element.
TEST_F(RadiosityFiles, OfPatchesCancelledAndResumedIsTheSame) {
    RadiositySettings settings = longSettings(radiosity::Solver::Progressive);
    settings.patchArea = 0.12;
    solveInRuns(settings, 31);
    fs::remove(file("checkpoint"));
    settings = dividedSettings(radiosity::Solver::Progressive);
    settings.patchArea = 0.5;
    settings.adaptive = 0.25;
    solveInRuns(settings, 31);
}

TEST_F(RadiosityFiles, OfPatchesInPartsIsTheSame) {
    RadiositySettings settings = longSettings(radiosity::Solver::Progressive);
    settings.patchArea = 0.12;
    expectPartsJoin(settings);
}

TEST_F(RadiosityFiles, WithRowsOfOtherPatchesIsRefused) {
    const Small small;
    ASSERT_TRUE(writeRadiosity(file("rows"), {}, small.state, small.view(), StateFileName::OfUser));
    SolveState onePatch(2, 1);
    const auto read = readRadiosity(file("rows"), 0, onePatch);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().kind, ErrorKind::InputBroken);
}

TEST_P(EveryLongSolver, InPartsIsTheSameForAnyShardsAndThreads) {
    expectPartsJoin(longSettings(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(
    Radiosity, EveryLongSolver,
    ::testing::Values(radiosity::Solver::Progressive, radiosity::Solver::Southwell,
                      radiosity::Solver::Overshooting, radiosity::Solver::Jacobi,
                      radiosity::Solver::GaussSeidel, radiosity::Solver::Direct),
    [](const auto& test) { return std::string(name(test.param)); });

TEST_F(RadiosityFiles, EachElementIsOfOneShard) {
    for (const std::uint32_t elements : {0u, 1u, 63u, 64u, 65u, 1000u})
        for (const int count : {1, 2, 3, 8, 40}) {
            std::vector<int> times(elements, 0);
            for (int k = 0; k < count; ++k) {
                const ElementShard shard{k, count};
                std::size_t held = 0;
                for (std::uint32_t e = 0; e < elements; ++e)
                    if (shard.holds(e)) {
                        ++times[e];
                        ++held;
                    }
                EXPECT_EQ(shard.held(elements), held);
            }
            EXPECT_THAT(times, ::testing::Each(1));
        }
}

TEST_F(RadiosityFiles, AreReadAsTheyWereWritten) {
    Small small;
    small.state.divisions = {{0, 1}, {3}};
    RadiosityManifest manifest = roomManifest(tintedRoom());
    manifest.options = {{"exposure", "none"}};
    manifest.sets = {"environment.enabled=false"};
    ASSERT_TRUE(
        writeRadiosity(file("a"), manifest, small.state, small.view(), StateFileName::OfUser));
    EXPECT_TRUE(looksLikeRadiosity(file("a")));
    const auto read = readRadiosityManifest(file("a"));
    ASSERT_TRUE(read) << read.error().text();
    manifest.elementCount = manifest.lit = manifest.rows = manifest.shares = manifest.steps = 2;
    manifest.divided = {2, 1};
    manifest.complete = true;
    manifest.iterations = 2;
    manifest.residual = 0.25;
    EXPECT_TRUE(*read == manifest);
    SolveState state(2);
    ASSERT_TRUE(readRadiosity(file("a"), 0, state));
    EXPECT_EQ(state.divisions, small.state.divisions);
    EXPECT_EQ(state.light.irradiance(1), glm::dvec3(1.0, 2.0, 3.0));
    EXPECT_EQ(state.rows.row(1)[0].element, 0u);
    EXPECT_EQ(state.rows.row(1)[0].factor, 0.75f);
    EXPECT_EQ(state.rows.escaped(1), 0.25f);
    EXPECT_EQ(state.rows.rays(1), 4u);
    EXPECT_EQ(state.solver.radiosity, small.radiosity);
    EXPECT_EQ(state.solver.irradiance, small.irradiance);
    EXPECT_EQ(state.solver.unshotPower, glm::dvec3(0.1));
    EXPECT_EQ(state.solver.lost, glm::dvec3(0.2));
    EXPECT_EQ(state.solver.steps, small.steps);
    // Of rows, those for which there is room.
    SolveState tight(2);
    ASSERT_TRUE(readRadiosity(file("a"), sizeof(FactorRow::Share), tight));
    EXPECT_TRUE(tight.rows.has(0));
    EXPECT_FALSE(tight.rows.has(1));
    EXPECT_TRUE(tight.light.has(1));
}

TEST_F(RadiosityFiles, WhatMakesNoSenseIsRefused) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    const auto withRow = [](const FactorRow& row) {
        Small small;
        small.state.rows = FactorMatrix(2);
        small.state.rows.set(0, row);
        return small;
    };
    const FactorRow good = Small().state.rows.whole(0);
    FactorRow row = good;
    row.shares[0].factor = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THAT(refusal(withRow(row)), HasSubstr("out of range"));
    row.shares[0].factor = -0.5f;
    EXPECT_THAT(refusal(withRow(row)), HasSubstr("out of range"));
    row = good;
    row.shares[0].element = 2;
    EXPECT_THAT(refusal(withRow(row)), HasSubstr("out of range"));
    row.shares = {{1, 0.5f}, {0, 0.25f}};
    EXPECT_THAT(refusal(withRow(row)), HasSubstr("out of range"));
    row = good;
    row.absorbed = std::numeric_limits<float>::infinity();
    EXPECT_THAT(refusal(withRow(row)), HasSubstr("out of range"));
    Small small;
    small.state.light.set(1, {0.0, kNan, 0.0});
    EXPECT_THAT(refusal(small), HasSubstr("out of range"));
    small = Small();
    small.radiosity[1].z = kNan;
    EXPECT_THAT(refusal(small), HasSubstr("out of range"));
    small = Small();
    small.steps = {{2, 0.5}, {1, 0.25}};
    EXPECT_THAT(refusal(small), HasSubstr("out of range"));

    // Any byte that is cut or changed is found out.
    ASSERT_TRUE(
        writeRadiosity(file("whole"), {}, Small().state, Small().view(), StateFileName::OfUser));
    const std::string content = fileContent(file("whole"));
    for (std::size_t at = 0; at < content.size(); at += 7) {
        std::string changed = content;
        changed[at] = static_cast<char>(changed[at] ^ 0x40);
        writeContent(file("changed"), changed);
        EXPECT_THAT(refusal("changed"), ::testing::Not(HasSubstr("scene"))) << at;
        writeContent(file("cut"), content.substr(0, at));
        EXPECT_FALSE(refusal("cut").empty()) << at;
    }
    writeContent(file("long"), content + "x");
    EXPECT_THAT(refusal("long"), AllOf(HasSubstr("something follows"), HasSubstr("bake it anew")));
    writeContent(file("text"), "hello, world, I am no part");
    EXPECT_THAT(refusal("text"), HasSubstr("--shard K/N"));
    std::string other = content;
    other[8] = 99;
    writeContent(file("version"), other);
    EXPECT_THAT(refusal("version"), HasSubstr("another version of Patina (format 99"));
}

// Descriptions that were written to mislead, with a hash that fits.
TEST_F(RadiosityFiles, CountsThatAreNotTrueAreRefused) {
    const auto described = [&](const std::string& from, const std::string& to,
                               std::size_t valueBytes) {
        ASSERT_TRUE(writeRadiosity(file("whole"), {}, Small().state, {}, StateFileName::OfUser));
        const std::string content = fileContent(file("whole"));
        std::uint32_t size = 0;
        std::memcpy(&size, content.data() + 12, sizeof size);
        std::string text = content.substr(16, size);
        ASSERT_NE(text.find(from), std::string::npos) << text;
        text.replace(text.find(from), from.size(), to);
        const StateFormat format{{'P', 'a', 't', 'i', 'n', 'a', 'R', 'd'}, 1, {}, {}};
        const std::vector<std::byte> values(valueBytes);
        const std::span<const std::byte> piece(values);
        ASSERT_TRUE(writeStateFile(file("lie"), format, text, {&piece, 1}, StateFileName::OfUser));
        EXPECT_FALSE(refusal("lie").empty()) << to;
    };
    constexpr std::size_t kTrue = 2 * 48 + 2 * 8;
    described("\"elementCount\": 2", "\"elementCount\": 50000000", kTrue);
    described("\"elementCount\": 2", "\"elementCount\": 4000000000000", kTrue);
    described("\"elementCount\": 2", "\"elementCount\": -2", kTrue);
    described("\"elementCount\": 2", "\"elementCount\": 1e300", kTrue);
    described("\"elementCount\": 2", "\"elementCount\": 1", kTrue - 48);
    described("\"shares\": 2", "\"shares\": 1000000000000000000", kTrue);
    described("\"shares\": 2", "\"shares\": 3", kTrue + 8);
    described("\"rows\": 2", "\"rows\": 1", kTrue);
    described("\"lit\": 2", "\"lit\": 0", kTrue);
    described("\"steps\": 0", "\"steps\": 4294967296", kTrue);
    described("\"divided\": []", "\"divided\": [50000000]", kTrue);
    described("\"divided\": []", "\"divided\": 7", kTrue);
    described("\"shard\": [\n  0,", "\"shard\": [\n  1,", kTrue);
    described("\"ended\": false", "\"ended\": true", kTrue);
    described("\"complete\": true", "\"complete\": \"yes\"", kTrue);
}

TEST_F(RadiosityFiles, DivisionsOfOtherElementsAreRefused) {
    for (const std::vector<std::uint32_t>& round :
         {std::vector<std::uint32_t>{5, 3}, {4'000'000}}) {
        Small small;
        small.state.divisions = {round};
        ASSERT_TRUE(
            writeRadiosity(file("a"), {}, small.state, small.view(), StateFileName::OfUser));
        const auto scene = divided(tintedRoom(), {0.5});
        const Result<void> result = divideAsIn(file("a"), scene->elements);
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().file, file("a"));
        EXPECT_THAT(result.error().message, HasSubstr("bake it anew"));
    }
}

TEST_F(RadiosityFiles, PartsThatDoNotGoTogetherAreRefused) {
    const fs::path a = part("a", {0, 2}), b = part("b", {1, 2});
    EXPECT_TRUE(readRadiosityParts(std::vector{b, a}));
    EXPECT_THAT(refusesToJoin({a}), HasSubstr("of 2 parts, 2 is missing"));
    EXPECT_THAT(refusesToJoin({a, b, part("again", {1, 2})}),
                AllOf(HasSubstr("again"), HasSubstr("it is part 2 of 2, and so is")));
    EXPECT_THAT(refusesToJoin({a, part("third", {1, 3})}), HasSubstr("it is one of 3 parts"));
    const RadiositySettings settings = longSettings(radiosity::Solver::GaussSeidel);
    RadiosityManifest other = roomManifest(tintedRoom());
    other.settings["resolution"] = "64";
    EXPECT_THAT(refusesToJoin({a, part("other", {1, 2}, settings, other)}),
                AllOf(HasSubstr("other"), HasSubstr("resolution (32 there, 64 here)")));
    other = roomManifest(tintedRoom());
    other.options["exposure"] = "2";
    EXPECT_THAT(refusesToJoin({a, part("other", {1, 2}, settings, other)}),
                HasSubstr("exposure (none there, 2 here)"));
    other = roomManifest(tintedRoom());
    other.inputs.lights = {1, 2};
    EXPECT_THAT(refusesToJoin({a, part("other", {1, 2}, settings, other)}),
                HasSubstr("the lights of builtin:room, which changed"));
    RadiositySettings finer = settings;
    finer.maxArea = 0.02; // that the description says nothing of
    EXPECT_THAT(refusesToJoin({a, part("finer", {1, 2}, finer, roomManifest(tintedRoom()))}),
                HasSubstr("the elements that the scene is divided into"));
    SolveState half(200);
    ASSERT_TRUE(
        writeRadiosity(file("half"), roomManifest(tintedRoom()), half, {}, StateFileName::OfUser));
    EXPECT_THAT(refusesToJoin({file("half")}), HasSubstr("not finished"));
    EXPECT_THAT(refusesToJoin({a, file("nowhere")}), HasSubstr("nowhere"));

    // They are of a scene that is not there any more.
    const auto parts = readRadiosityParts(std::vector{a, b});
    TraceInputs changed = tintedRoom();
    changed.materials[1].baseColor = glm::vec3(0.1f);
    JoinedRadiosity joined(*parts, "builtin:room", hashTraceInputs(changed), 0);
    const auto scene = RadiosityScene::make(changed, settings, {}, &joined);
    ASSERT_FALSE(scene);
    EXPECT_THAT(scene.error().text(), AllOf(HasSubstr("it does not fit the scene as it is now"),
                                            HasSubstr("the materials")));
}

TEST_F(RadiosityFiles, ACheckpointOfAnotherRadiosityIsRefusedAndStays) {
    const RadiositySettings settings = longSettings(radiosity::Solver::GaussSeidel);
    RadiosityManifest other = roomManifest(tintedRoom());
    other.settings["resolution"] = "64";
    part("checkpoint", {0, 1}, settings, other);
    const std::string content = fileContent(file("checkpoint"));
    const auto refused = [&](const RadiosityManifest& manifest) {
        RadiosityKeeping keeping{manifest, file("checkpoint")};
        keeping.resume = true;
        ResumableRadiosity keeper(std::move(keeping));
        const auto scene = RadiosityScene::make(tintedRoom(), settings, {}, &keeper);
        EXPECT_FALSE(scene.ok());
        EXPECT_EQ(fileContent(file("checkpoint")), content);
        return scene ? std::string() : scene.error().text();
    };
    EXPECT_THAT(refused(roomManifest(tintedRoom())),
                AllOf(HasSubstr("checkpoint"), HasSubstr("resolution (64 there, 32 here)")));
    other.shard = {0, 2};
    EXPECT_THAT(refused(other), HasSubstr("the part (part 1 of 1 there, 1 of 2 here)"));
    // One that another process writes is not touched either.
    const auto held = FileLock::take(file("checkpoint"));
    ASSERT_TRUE(held.ok());
    std::string warning;
    RadiosityKeeping keeping{roomManifest(tintedRoom()), file("checkpoint"), 0.0};
    keeping.resume = true;
    keeping.warn = [&](const Error& error) { warning = error.text(); };
    ResumableRadiosity keeper(std::move(keeping));
    EXPECT_TRUE(RadiosityScene::make(tintedRoom(), settings, {}, &keeper));
    EXPECT_THAT(warning, HasSubstr("another program computes this radiosity"));
    EXPECT_EQ(fileContent(file("checkpoint")), content);
}

} // namespace patina::test
