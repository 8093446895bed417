// Radiosity that is kept from one session to the next: found again it is, byte for byte, what was
// solved; another scene finds what still holds of it, and nothing else.
#include "core/radiosity/document/ElementLinks.h"
#include "core/radiosity/document/KeptRadiosity.h"
#include "core/radiosity/document/LiveRadiosity.h"
#include "core/radiosity/file/RadiosityFile.h"
#include "tests/core/radiosity/RadiosityScenes.h"
#include "tests/support/TemporaryFolder.h"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>
#include <limits>
#include <map>
#include <string>

namespace patina::test {

using namespace radiosity;

namespace {

namespace fs = std::filesystem;

ImagePtr skyImage() {
    auto image = std::make_shared<Image>(8, 4, 3, PixelType::F32, ColorEncoding::Linear);
    float next = 0.2f;
    for (float& value : image->f32())
        value = next += 0.01f;
    return image;
}

Light keptLight(Id id, const glm::vec3& position) {
    Light light;
    light.id = id;
    light.type = LightType::Sphere;
    light.position = position;
    light.radius = 0.1f;
    light.intensity = 20.0f;
    return light;
}

// A unit cube without one of its walls: a glowing ceiling, two lights, and the sky outside.
TraceInputs openRoom() {
    static const TraceInputs kRoom = [] { // whose meshes are the same ones each time
        std::vector<Wall> walls = unitCube(0.5f);
        walls[0].emission = 0.3f;
        walls.pop_back();
        TraceInputs inputs = sceneOf(walls);
        inputs.lights = {keptLight(101, {0.3f, 0.6f, 0.4f}), keptLight(102, {0.7f, 0.3f, 0.6f})};
        inputs.lights[1].color = {1.0f, 0.5f, 0.2f};
        inputs.environments = {{skyImage(), 30.0f, glm::vec3(0.5f)}};
        return inputs;
    }();
    return kRoom;
}
constexpr std::size_t kRoomSources = 4;

RadiositySettings coarseSettings() {
    RadiositySettings settings;
    settings.maxArea = 0.07; // 16 elements of each wall: dozens of scenes are solved
    settings.solve.residual = 1e-6;
    settings.lightSamples = 16;
    settings.factors.resolution = 64;
    return settings;
}

bool sameRows(const FactorMatrix& a, const FactorMatrix& b) {
    bool same = a.size() == b.size();
    for (std::uint32_t row = 0; same && row < a.size(); ++row)
        same = std::ranges::equal(a.row(row), b.row(row), [](const auto& x, const auto& y) {
            return x.element == y.element && x.factor == y.factor;
        });
    return same;
}

std::string contentOf(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

// Bit by bit.
void expectSameLight(const LiveRadiosity& a, const LiveRadiosity& b) {
    ASSERT_EQ(a.elements().size(), b.elements().size());
    EXPECT_EQ(hashElements(a.elements()), hashElements(b.elements()));
    ASSERT_EQ(a.sources.size(), b.sources.size());
    for (std::size_t s = 0; s < a.sources.size(); ++s) {
        SCOPED_TRACE(s);
        EXPECT_EQ(a.sources[s].kind, b.sources[s].kind);
        EXPECT_EQ(a.sources[s].direct, b.sources[s].direct);
        EXPECT_EQ(a.sources[s].bounced, b.sources[s].bounced);
        EXPECT_EQ(a.sources[s].residual, b.sources[s].residual);
        EXPECT_EQ(a.sources[s].sweeps, b.sources[s].sweeps);
    }
    EXPECT_EQ(a.solution.irradiance, b.solution.irradiance);
    EXPECT_EQ(a.solution.radiosity, b.solution.radiosity);
    EXPECT_EQ(a.residual, b.residual);
    EXPECT_EQ(a.sweeps, b.sweeps);
}

class SolutionCacheTest : public ::testing::Test {
  protected:
    LiveRadiosityPtr follow(const TraceInputs& inputs, const RadiositySettings& settings,
                            const SolutionCache* from, bool factors = false,
                            const LiveRadiosityPtr& before = nullptr,
                            const LiveRadiosityObserver& observer = {}) const {
        const auto live = followRadiosity(inputs, settings, before, {}, observer,
                                          {.cache = from, .factors = factors});
        EXPECT_TRUE(live) << live.error().text();
        EXPECT_TRUE((*live)->solved);
        return *live;
    }
    LiveRadiosityPtr solve(const TraceInputs& inputs, const RadiositySettings& settings) const {
        return follow(inputs, settings, nullptr, true);
    }
    // What opens a document does: looks, solves what is not there, keeps it.
    LiveRadiosityPtr open(const TraceInputs& inputs, const RadiositySettings& settings) const {
        LiveRadiosityPtr live = follow(inputs, settings, &cache);
        EXPECT_TRUE(keepRadiosity(*live, cache).ok());
        return live;
    }
    [[nodiscard]] std::vector<fs::path> files() const {
        std::vector<fs::path> result;
        std::error_code none;
        for (const auto& entry : fs::directory_iterator(folder.path() / "kept", none))
            result.push_back(entry.path());
        return result;
    }

    TemporaryFolder folder;
    SolutionCache cache{folder.path() / "kept"};
};

TEST_F(SolutionCacheTest, WhatWasSolvedIsFoundBitByBit) {
    const LiveRadiosityPtr solved = solve(openRoom(), coarseSettings());
    ASSERT_EQ(solved->sources.size(), kRoomSources);
    EXPECT_EQ(solved->foundSources(), 0u);
    const LiveRadiosityPtr first = open(openRoom(), coarseSettings());
    EXPECT_EQ(first->foundSources(), 0u);
    expectSameLight(*first, *solved);
    EXPECT_EQ(files().size(), kRoomSources);

    bool told = false;
    const LiveRadiosityPtr found = follow(openRoom(), coarseSettings(), &cache, false, nullptr,
                                          [&](const LiveRadiosityPtr&) { told = true; });
    EXPECT_FALSE(told) << "there is nothing to wait for";
    EXPECT_EQ(found->foundSources(), kRoomSources);
    EXPECT_EQ(found->factors, nullptr) << "nobody asked for them";
    EXPECT_FALSE(found->hasFactors());
    expectSameLight(*found, *solved);
    const ShownRadiosityPtr shown = shownRadiosity(*found, found->solution, {}, 3u);
    EXPECT_EQ(shown->irradiance, shownRadiosity(*solved, solved->solution)->irradiance);
}

TEST_F(SolutionCacheTest, FormFactorsFollowAfterTheLightIsShown) {
    const LiveRadiosityPtr solved = solve(openRoom(), coarseSettings());
    open(openRoom(), coarseSettings());
    std::vector<LiveRadiosityPtr> told;
    const LiveRadiosityPtr found =
        follow(openRoom(), coarseSettings(), &cache, true, nullptr,
               [&](const LiveRadiosityPtr& picture) { told.push_back(picture); });
    ASSERT_EQ(told.size(), 1u);
    EXPECT_TRUE(told[0]->solved);
    EXPECT_EQ(told[0]->factors, nullptr);
    expectSameLight(*told[0], *solved);
    ASSERT_TRUE(found->hasFactors());
    EXPECT_TRUE(sameRows(found->factors->matrix, solved->factors->matrix));
    expectSameLight(*found, *solved);

    // In two calls, as the editor has it; and nothing is computed twice.
    const LiveRadiosityPtr shown = follow(openRoom(), coarseSettings(), &cache);
    const LiveRadiosityPtr later = follow(shown->inputs, coarseSettings(), nullptr, true, shown);
    EXPECT_EQ(later->shape, shown->shape);
    EXPECT_EQ(later->foundSources(), kRoomSources);
    expectSameLight(*later, *solved);
    ASSERT_TRUE(later->hasFactors());
    EXPECT_EQ(follow(shown->inputs, coarseSettings(), nullptr, true, later)->factors,
              later->factors);
}

TEST_F(SolutionCacheTest, AnEditOfWhatWasFoundIsSolved) {
    open(openRoom(), coarseSettings());
    const LiveRadiosityPtr found = follow(openRoom(), coarseSettings(), &cache);
    TraceInputs moved = found->inputs;
    moved.lights[0].position.x = 0.5f;
    const LiveRadiosityPtr after = follow(moved, coarseSettings(), &cache, false, found);
    EXPECT_NE(after->factors, nullptr) << "without them it could not be solved";
    expectSameLight(*after, *solve(moved, coarseSettings()));
    // Undone: from before, or from the cache.
    const LiveRadiosityPtr undone = follow(found->inputs, coarseSettings(), &cache, false, after);
    EXPECT_EQ(undone->foundSources(), kRoomSources);
    expectSameLight(*undone, *found);
    // Geometry too, whose elements are made anew.
    TraceInputs other = found->inputs;
    other.meshes[1].transform[3].y -= 0.2f;
    const LiveRadiosityPtr elsewhere = follow(other, coarseSettings(), &cache, false, found);
    EXPECT_EQ(elsewhere->foundSources(), 0u);
    const LiveRadiosityPtr back = follow(found->inputs, coarseSettings(), &cache, false, elsewhere);
    EXPECT_EQ(back->foundSources(), kRoomSources);
    expectSameLight(*back, *found);
}

struct Edited {
    const char* what;
    std::size_t found; // sources
    std::function<void(TraceInputs&, RadiositySettings&)> edit;
};

TEST_F(SolutionCacheTest, EachChangeFindsWhatStillHolds) {
    open(openRoom(), coarseSettings());
    const std::size_t kept = files().size();
    using In = TraceInputs;
    using Set = RadiositySettings;
    const std::vector<Edited> edits{
        {"gain, tint, intensity", 4,
         [](In& in, Set&) {
             in.lights[0].gainEv = 1.5f;
             in.lights[0].tint = {1.0f, 0.4f, 0.3f};
             in.lights[1].intensity = 3.0f;
             in.lights[1].usesTemperature = true;
         }},
        {"scale of the sky", 4,
         [](In& in, Set&) {
             in.environments[0].scale = {1, 2, 3};
         }},
        {"names, ids of meshes and materials", 4,
         [](In& in, Set&) {
             in.lights[0].name = "other";
             for (TraceMesh& mesh : in.meshes)
                 mesh.id += 40;
             for (Material& material : in.materials)
                 material.id += 70;
         }},
        {"limits", 4,
         [](In&, Set& set) {
             set.maxElements = 5'000;
             set.solve.maxBytes = 0;
         }},
        {"what only links have", 4, [](In&, Set& set) { set.hierarchy.pairs = 3; }},
        {"muted light", 3, [](In& in, Set&) { in.lights.erase(in.lights.begin()); }},
        {"muted sky", 3, [](In& in, Set&) { in.environments.clear(); }},
        {"one more light", 4,
         [](In& in, Set&) {
             in.lights.push_back(keptLight(103, {0.5f, 0.5f, 0.5f}));
         }},
        {"moved light", 3, [](In& in, Set&) { in.lights[0].position.x = 0.6f; }},
        {"larger light", 3, [](In& in, Set&) { in.lights[1].radius = 0.2f; }},
        {"another light of the same kind", 3, [](In& in, Set&) { in.lights[0].id = 104; }},
        {"rotated sky", 3,
         [](In& in, Set&) { in.environments[0].orientation.rotationDeg = 31.0f; }},
        {"another sky", 3,
         [](In& in, Set&) {
             auto image = std::make_shared<Image>(*in.environments[0].image);
             image->f32()[5] += 0.1f;
             in.environments[0].image = std::move(image);
         }},
        {"two skies", 3, [](In& in, Set&) { in.environments.push_back(in.environments[0]); }},
        {"glow", 3, [](In& in, Set&) { in.materials[0].emissive *= 3.0f; }},
        {"colour", 0,
         [](In& in, Set&) {
             in.materials[2].baseColor = {0.9f, 0.1f, 0.1f};
         }},
        {"moved mesh", 0, [](In& in, Set&) { in.meshes[1].transform[3].y -= 0.1f; }},
        {"sides", 0, [](In& in, Set&) { in.materials[1].doubleSided = true; }},
        {"what rays pass through", 0,
         [](In& in, Set&) {
             in.materials[1].alphaMode = AlphaMode::Blend;
             in.materials[1].opacity = 0.5f;
         }},
        {"element area", 0, [](In&, Set& set) { set.maxArea = 0.02; }},
        {"adaptive", 0, [](In&, Set& set) { set.adaptive = 0.5; }},
        {"rays", 0, [](In&, Set& set) { set.factors.resolution = 32; }},
        {"seed", 0, [](In&, Set& set) { set.factors.seed = 1; }},
        {"method", 0, [](In&, Set& set) { set.factors.method = FactorMethod::Hemicube; }},
        {"centre", 0, [](In&, Set& set) { set.factors.centreOnly = true; }},
        {"stands", 0, [](In&, Set& set) { set.factors.stands = 1; }},
        {"solver", 0, [](In&, Set& set) { set.solve.solver = Solver::Jacobi; }},
        {"residual", 0, [](In&, Set& set) { set.solve.residual = 1e-5; }},
        {"rays to lights", 0, [](In&, Set& set) { set.lightSamples = 32; }},
        {"glow is shot", 0, [](In&, Set& set) { set.classic = true; }},
    };
    for (const Edited& edited : edits) {
        SCOPED_TRACE(edited.what);
        TraceInputs inputs = openRoom();
        RadiositySettings settings = coarseSettings();
        edited.edit(inputs, settings);
        const LiveRadiosityPtr live = follow(inputs, settings, &cache);
        EXPECT_EQ(live->foundSources(), edited.found);
        expectSameLight(*live, *solve(inputs, settings));
    }
    EXPECT_EQ(files().size(), kept) << "who only looks writes nothing";
}

TEST_F(SolutionCacheTest, WhatIsThereIsNotWrittenAgain) {
    open(openRoom(), coarseSettings());
    std::map<fs::path, fs::file_time_type> times;
    for (const fs::path& file : files()) {
        fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(1));
        times[file] = fs::last_write_time(file);
    }
    ASSERT_TRUE(keepRadiosity(*solve(openRoom(), coarseSettings()), cache).ok());
    ASSERT_EQ(files().size(), times.size());
    for (const fs::path& file : files())
        EXPECT_EQ(fs::last_write_time(file), times.at(file)) << file;
    // Of a light that is moved only its own.
    TraceInputs moved = openRoom();
    moved.lights[1].position.y = 0.4f;
    open(moved, coarseSettings());
    EXPECT_EQ(files().size(), times.size() + 1);
}

TEST_F(SolutionCacheTest, DamagedFilesAreSolvedAnew) {
    const LiveRadiosityPtr solved = open(openRoom(), coarseSettings());
    const std::vector<fs::path> kept = files();
    ASSERT_EQ(kept.size(), kRoomSources);
    const std::string whole = contentOf(kept[0]);
    std::vector<std::string> damages{"",
                                     "x",
                                     whole.substr(0, 20),
                                     whole.substr(0, whole.size() / 2),
                                     whole.substr(0, whole.size() - 1),
                                     whole + "x",
                                     std::string(whole.size(), '\0')};
    for (const std::size_t at : {std::size_t{0}, whole.size() / 2, whole.size() - 1}) {
        damages.push_back(whole);
        damages.back()[at] ^= 4;
    }
    for (const std::string& damage : damages) {
        SCOPED_TRACE(damage.size());
        std::ofstream(kept[0], std::ios::binary) << damage;
        const LiveRadiosityPtr live = follow(openRoom(), coarseSettings(), &cache);
        EXPECT_EQ(live->foundSources(), kRoomSources - 1);
        EXPECT_FALSE(fs::exists(kept[0])) << "it is removed";
        expectSameLight(*live, *solved);
    }
    // Whole files whose values make no sense.
    const SolutionKeys keys(*solved);
    const Hash key = keys.of(solved->sources[1]);
    const KeptSolution good{solved->sources[1].direct, solved->sources[1].bounced,
                            solved->sources[1].residual, solved->sources[1].sweeps};
    std::vector<KeptSolution> wrong(6, good);
    wrong[0].direct.pop_back();
    wrong[0].bounced.pop_back();
    wrong[1].direct[3].y = std::numeric_limits<double>::quiet_NaN();
    wrong[2].bounced[0].x = std::numeric_limits<double>::infinity();
    wrong[3].direct[1].z = -1.0;
    wrong[4].residual = std::numeric_limits<double>::quiet_NaN();
    wrong[5].sweeps = -1;
    for (const KeptSolution& solution : wrong) {
        ASSERT_TRUE(cache.store(key, solution).ok());
        EXPECT_FALSE(cache.find(key, good.direct.size()));
        EXPECT_FALSE(cache.has(key));
        ASSERT_TRUE(cache.store(key, solution).ok());
        expectSameLight(*follow(openRoom(), coarseSettings(), &cache), *solved);
    }
    ASSERT_TRUE(cache.store(key, good).ok());
    EXPECT_EQ(cache.find(key, good.direct.size()), good);
}

TEST_F(SolutionCacheTest, AFolderThatCannotBeWrittenLeavesTheSolution) {
    std::ofstream(folder.path() / "kept") << "no folder";
    const LiveRadiosityPtr live = follow(openRoom(), coarseSettings(), &cache);
    const Result<void> stored = keepRadiosity(*live, cache);
    ASSERT_FALSE(stored.ok());
    EXPECT_EQ(stored.error().kind, ErrorKind::CannotCreate) << stored.error().text();
    EXPECT_THAT(stored.error().text(), ::testing::HasSubstr("kept"));
    expectSameLight(*live, *solve(openRoom(), coarseSettings()));
}

RadiositySettings adaptiveSettings() {
    RadiositySettings settings = coarseSettings();
    settings.adaptive = 0.4;
    return settings;
}

TEST_F(SolutionCacheTest, AnAdaptiveDivisionIsFoundWithoutSolving) {
    const LiveRadiosityPtr solved = solve(openRoom(), adaptiveSettings());
    EXPECT_GT(solved->elements().size(), solve(openRoom(), coarseSettings())->elements().size());
    const LiveRadiosityPtr first = open(openRoom(), adaptiveSettings());
    expectSameLight(*first, *solved);
    EXPECT_EQ(files().size(), kRoomSources + 1);
    ASSERT_TRUE(first->shape->division);
    EXPECT_FALSE(first->shape->division->kept.rounds.empty());
    const LiveRadiosityPtr found = follow(openRoom(), adaptiveSettings(), &cache);
    EXPECT_EQ(found->foundSources(), kRoomSources);
    expectSameLight(*found, *solved);
    // Light has shaped it: another gain divides otherwise, and finds nothing.
    TraceInputs louder = openRoom();
    louder.lights[0].gainEv = 3.0f;
    EXPECT_NE(divisionKey(louder, adaptiveSettings()), divisionKey(openRoom(), adaptiveSettings()));
    expectSameLight(*follow(louder, adaptiveSettings(), &cache),
                    *solve(louder, adaptiveSettings()));
    // In one session elements stay, and what is kept of them is not mistaken for the edit's own.
    const LiveRadiosityPtr edited = follow(louder, adaptiveSettings(), &cache, false, first);
    EXPECT_EQ(edited->shape, first->shape);
    ASSERT_TRUE(keepRadiosity(*edited, cache).ok());
    expectSameLight(*follow(louder, adaptiveSettings(), &cache),
                    *solve(louder, adaptiveSettings()));
}

TEST_F(SolutionCacheTest, SoIsOneThatWasMadeWhileLightWasShot) {
    RadiositySettings settings = adaptiveSettings();
    settings.solve.solver = Solver::Progressive;
    settings.solve.residual = 1e-3;
    settings.dynamic = true;
    const LiveRadiosityPtr solved = open(openRoom(), settings);
    EXPECT_FALSE(solved->shape->division->kept.rounds.empty());
    const LiveRadiosityPtr found = follow(openRoom(), settings, &cache);
    EXPECT_EQ(found->foundSources(), kRoomSources);
    expectSameLight(*found, *solved);
    expectSameLight(*found, *solve(openRoom(), settings));
    RadiositySettings other = settings;
    other.dynamic = false;
    EXPECT_EQ(follow(openRoom(), other, &cache)->foundSources(), 0u);
    other = settings;
    other.divideBy = DivisionRule::L2;
    EXPECT_EQ(follow(openRoom(), other, &cache)->foundSources(), 0u);
}

TEST_F(SolutionCacheTest, ADivisionOfOtherElementsIsMadeAnew) {
    const LiveRadiosityPtr solved = open(openRoom(), adaptiveSettings());
    const Hash key = solved->shape->division->key;
    const KeptDivision good = solved->shape->division->kept;
    EXPECT_EQ(cache.findDivision(key), good);
    std::vector<KeptDivision> wrong(5, good);
    wrong[0].rounds[0].back() = 1'000'000;
    wrong[1].rounds[0] = {3, 2};
    wrong[2].rounds[0] = {3, 3};
    wrong[3].rounds.pop_back();
    wrong[4].elements.low ^= 1;
    for (const KeptDivision& division : wrong) {
        ASSERT_TRUE(cache.store(key, division).ok());
        const LiveRadiosityPtr live = follow(openRoom(), adaptiveSettings(), &cache);
        EXPECT_FALSE(cache.has(key));
        expectSameLight(*live, *solved);
    }
    ASSERT_TRUE(keepRadiosity(*solved, cache).ok());
    const std::string whole = contentOf(cache.file(key));
    for (const std::size_t size : {std::size_t{0}, std::size_t{30}, whole.size() - 1}) {
        std::ofstream(cache.file(key), std::ios::binary) << whole.substr(0, size);
        EXPECT_FALSE(cache.findDivision(key)) << size;
        EXPECT_FALSE(cache.has(key)) << size;
    }
    // One that another program had room for: here it is refused, as it would be without.
    ASSERT_TRUE(keepRadiosity(*solved, cache).ok());
    RadiositySettings few = adaptiveSettings();
    few.maxElements = solved->elements().size() - 1;
    const auto refused =
        followRadiosity(openRoom(), few, nullptr, {}, {}, {.cache = &cache, .factors = false});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().kind, ErrorKind::Usage);
    EXPECT_TRUE(cache.has(key)) << "others have a use for it";
}

// Links are as large as form factors, and are not kept; to look at them light is gathered again.
TEST_F(SolutionCacheTest, LinksOfTheHierarchicalSolverAreFoundAnew) {
    RadiositySettings settings = coarseSettings();
    settings.solve.solver = Solver::Hierarchical;
    settings.solve.residual = 1e-5;
    const LiveRadiosityPtr solved = open(openRoom(), settings);
    EXPECT_TRUE(solved->hasFactors());
    const LiveRadiosityPtr found = follow(openRoom(), settings, &cache);
    EXPECT_EQ(found->foundSources(), kRoomSources);
    expectSameLight(*found, *solved);
    EXPECT_FALSE(found->hasFactors());
    EXPECT_TRUE(linksOf(*found, 3).links.empty());
    const LiveRadiosityPtr later = follow(openRoom(), settings, &cache, true);
    EXPECT_TRUE(later->hasFactors());
    expectSameLight(*later, *solved);
    EXPECT_EQ(linksOf(*later, 3).links.size(), linksOf(*solved, 3).links.size());
    EXPECT_EQ(factorsOverLinks(*later, 3), factorsOverLinks(*solved, 3));
    settings.hierarchy.linkError *= 2.0;
    EXPECT_EQ(follow(openRoom(), settings, &cache)->foundSources(), 0u);
    // A source that sends nothing has none, and is none to wait for.
    TraceInputs dark = openRoom();
    dark.lights[0].position = {0.5f, 0.5f, -5.0f}; // behind a wall that has only a front
    const LiveRadiosityPtr black = open(dark, settings);
    EXPECT_TRUE(follow(dark, settings, &cache, true)->hasFactors());
}

TEST_F(SolutionCacheTest, ManyLightsAndPatchesAreFoundToo) {
    TraceInputs inputs = openRoom();
    inputs.lights.clear();
    for (Id i = 0; i < 18; ++i)
        inputs.lights.push_back(
            keptLight(200 + i, {0.2f + 0.03f * static_cast<float>(i), 0.5f, 0.5f}));
    RadiositySettings settings = coarseSettings();
    settings.solve.solver = Solver::Progressive;
    settings.solve.residual = 1e-3;
    settings.patchArea = 0.1;
    const LiveRadiosityPtr solved = open(inputs, settings);
    ASSERT_EQ(solved->sources.size(), 18u) << "glow, sky, fifteen lights, the rest";
    const LiveRadiosityPtr found = follow(inputs, settings, &cache);
    EXPECT_EQ(found->foundSources(), 18u);
    expectSameLight(*found, *solved);
    settings.patchArea = 0.3;
    EXPECT_EQ(follow(inputs, settings, &cache)->foundSources(), 0u);
    // The rest is solved as it is, with its powers.
    settings.patchArea = 0.1;
    inputs.lights[17].gainEv = 1.0f;
    const LiveRadiosityPtr louder = follow(inputs, settings, &cache);
    EXPECT_EQ(louder->foundSources(), 17u);
    expectSameLight(*louder, *solve(inputs, settings));
}

TEST_F(SolutionCacheTest, ASceneWithoutLightIsKeptWithoutAFile) {
    TraceInputs inputs = openRoom();
    inputs.lights.clear();
    inputs.environments.clear();
    for (Material& material : inputs.materials)
        material.emissive = glm::vec3(0.0f);
    EXPECT_TRUE(open(inputs, coarseSettings())->sources.empty());
    EXPECT_TRUE(files().empty());
}

} // namespace
} // namespace patina::test
