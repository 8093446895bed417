// The engine under the bakes: parts and resumed work are the whole, sampling methods, the error
// that passes tell, and passes to a tolerance.
#include "core/bake/domain/BakePoints.h"
#include "core/bake/transfer/Refinement.h"
#include "core/bake/transfer/TransferMeaning.h"
#include "core/bake/transfer/VisibilityTiles.h"
#include "core/job/Parallel.h"
#include "core/math/Sampling.h"
#include "core/math/SphericalHarmonics.h"
#include "tests/core/bake/BakeTestScene.h"

#include <cstdio>
#include <gtest/gtest.h>
#include <numeric>
#include <set>

using namespace patina;
using namespace patina::test;

namespace {

// A sphere over a floor, ready to trace.
struct Ready {
    explicit Ready(std::vector<Mesh> meshes)
        : geometry(std::move(*makeBakeGeometry(sceneOf(std::move(meshes)), {})))
        , scene(std::move(*RayScene::build(geometry, {})))
        , points(vertexPoints(geometry, {}))
        , ranges(vertexRanges(geometry, 64)) {}

    [[nodiscard]] PassState trace(const PassSettings& settings, const PassCallbacks& callbacks = {},
                                  PassState state = {}, const JobContext& job = {}) const {
        Result<PassState> done =
            runPasses(scene, points, ranges, settings, callbacks, job, std::move(state));
        return done ? std::move(*done) : PassState{};
    }

    BakeGeometry geometry;
    RayScene scene;
    std::vector<BakePoint> points;
    std::vector<PointRange> ranges;
};

Ready sphereOverFloor() {
    return Ready({planeMesh(4.0, 24), sphereMesh(1.0, 32, 16, {0, 1.2, 0})});
}

PassSettings transferSettings(int samples, int order = 5) {
    PassSettings settings;
    settings.samples = samples;
    settings.shOrder = order;
    return settings;
}

double rmse(const PassState& a, const PassState& b) {
    double squares = 0.0;
    for (std::size_t i = 0; i < a.values.size(); ++i)
        squares += std::pow(double(a.values[i]) - b.values[i], 2.0);
    return std::sqrt(squares / double(a.values.size()));
}

double rmsError(const PassState& state) {
    double squares = 0.0;
    for (const float error : state.error)
        squares += double(error) * error;
    return std::sqrt(squares / double(state.error.size()));
}

double meanRays(const PassState& state) {
    double rays = 0.0;
    for (const std::uint8_t passes : state.passes)
        rays += double(16u << passes);
    return rays / double(state.passes.size());
}

} // namespace

TEST(Passes, ShardsTogetherAreTheWhole) {
    const Ready ready = sphereOverFloor();
    for (const int cluster : {1, 32}) {
        PassSettings settings = transferSettings(64, 3);
        settings.cluster = cluster;
        const PassState whole = ready.trace(settings);
        for (const int count : {2, 3, 8}) {
            PassState joined;
            for (int index = 0; index < count; ++index) {
                settings.shard = {index, count};
                const ThreadLimit limit(index + 1);
                const PassState part = ready.trace(settings);
                EXPECT_EQ(part.samplesDone, 64);
                if (index == 0)
                    joined = part;
                for (std::size_t r = 0; r < ready.ranges.size(); ++r)
                    for (std::size_t p = ready.ranges[r].first;
                         p < ready.ranges[r].first + ready.ranges[r].count; ++p) {
                        EXPECT_EQ(part.passes[p], settings.shard.holds(r) ? 2 : 0);
                        if (!settings.shard.holds(r))
                            continue;
                        std::copy_n(part.values.begin() + std::ptrdiff_t(9 * p), 9,
                                    joined.values.begin() + std::ptrdiff_t(9 * p));
                        joined.hiddenSky[p] = part.hiddenSky[p];
                        joined.error[p] = part.error[p];
                        joined.passes[p] = joined.wanted[p] = part.passes[p];
                    }
            }
            EXPECT_EQ(joined, whole) << count << " shards, cluster " << cluster;
            settings.shard = {};
        }
    }
}

// States kept at many moments, each gone on from, end in the same bits; also with a tolerance,
// whose decisions then rest on what was kept.
TEST(Passes, AnyStateThatWasKeptLeadsToTheSameEnd) {
    const Ready ready = sphereOverFloor();
    for (const float tolerance : {0.0f, 0.002f}) {
        for (const int cluster : {1, 16}) {
            PassSettings settings = transferSettings(512, 3);
            settings.tolerance = tolerance;
            settings.cluster = cluster;
            std::vector<PassState> kept;
            PassCallbacks callbacks;
            callbacks.checkpointSeconds = 0.0;
            std::size_t calls = 0;
            callbacks.checkpoint = [&](const PassState& state) {
                if (++calls % 17 == 1)
                    kept.push_back(state);
            };
            const PassState end = ready.trace(settings, callbacks);
            EXPECT_GE(kept.size(), 4u);
            for (const PassState& state : kept) {
                const ThreadLimit limit(1);
                EXPECT_EQ(ready.trace(settings, {}, state), end);
            }
        }
    }
}

// A state may be kept when all points have had a pass and nobody has said so yet.
TEST(Passes, AStateKeptAtTheEndOfAPassLeadsToTheSameEnd) {
    const Ready ready = sphereOverFloor();
    for (const float tolerance : {0.0f, 0.002f}) {
        PassSettings settings = transferSettings(256, 2);
        settings.tolerance = tolerance;
        std::vector<PassState> kept;
        PassState latest;
        PassCallbacks callbacks;
        callbacks.checkpointSeconds = 0.0;
        callbacks.checkpoint = [&](const PassState& state) { latest = state; };
        callbacks.passDone = [&](int) { kept.push_back(latest); };
        const ThreadLimit limit(1); // so that no range is passed over
        const PassState end = ready.trace(settings, callbacks);
        ASSERT_GE(kept.size(), 3u);
        EXPECT_EQ(kept[1].passes, std::vector<std::uint8_t>(kept[1].passes.size(), 2));
        for (const PassState& state : kept)
            EXPECT_EQ(ready.trace(settings, {}, state), end) << tolerance;
    }
}

// HIGH hierarchies (many rays per triangle) and clusters included.
TEST(Passes, AnyNumberOfThreadsGivesTheSameBits) {
    const Ready ready({planeMesh(4.0, 12), sphereMesh(1.0, 16, 8, {0, 1.2, 0})});
    PassSettings settings = transferSettings(256, 8);
    settings.cluster = 8;
    const auto with = [&](int threads) {
        const ThreadLimit limit(threads);
        const RayScene scene = std::move(*RayScene::build(ready.geometry, {}, 0, 1e9));
        return std::move(*runPasses(scene, ready.points, ready.ranges, settings, {}, {}));
    };
    const PassState one = with(1);
    EXPECT_EQ(with(2), one);
    EXPECT_EQ(with(7), one);
}

// Neighbours that share directions cost none of a point's own accuracy.
TEST(Passes, ClustersAreAsGoodAsSinglePoints) {
    const Ready ready = sphereOverFloor();
    PassSettings settings = transferSettings(8192, 3);
    settings.seed = 9;
    const PassState reference = ready.trace(settings);
    settings = transferSettings(128, 3);
    settings.cluster = 1;
    const double single = rmse(ready.trace(settings), reference);
    settings.cluster = 32;
    EXPECT_LT(rmse(ready.trace(settings), reference), 1.2 * single);
}

// Scrambled nets against the classical methods at equal rays, and what passes believe of their
// error. benchmarks/bench_bake has the same on the shader ball.
TEST(Passes, NetsBeatJitterAndJitterBeatsChance) {
    const Ready ready({planeMesh(4.0, 12), sphereMesh(1.0, 16, 8, {0, 1.2, 0})});
    PassSettings settings = transferSettings(16384);
    settings.seed = 9;
    const PassState reference = ready.trace(settings);
    const auto with = [&](SampleMethod method) {
        PassSettings s = transferSettings(1024);
        s.method = method;
        return ready.trace(s);
    };
    const PassState qmc = with(SampleMethod::Qmc), random = with(SampleMethod::Random);
    const double ofQmc = rmse(qmc, reference), ofRandom = rmse(random, reference);
    const double ofStratified = rmse(with(SampleMethod::Stratified), reference);
    EXPECT_LT(ofQmc, 0.85 * ofStratified);
    EXPECT_LT(ofQmc, 0.15 * ofRandom);
    EXPECT_LT(ofStratified, 0.4 * ofRandom);
    EXPECT_NEAR(rmsError(qmc) / ofQmc, 1.0, 0.3);
    EXPECT_NEAR(rmsError(random) / ofRandom, 1.0, 0.15);
}

TEST(Passes, AFirstPassAloneTellsItsErrorToo) {
    const Ready ready = sphereOverFloor();
    const PassState few = ready.trace(transferSettings(32, 3));
    PassSettings settings = transferSettings(4096, 3);
    settings.seed = 9;
    EXPECT_NEAR(rmsError(few) / rmse(few, ready.trace(settings)), 1.0, 0.35);
}

TEST(Passes, ATolerancePutsRaysWhereTheErrorIs) {
    // Much of the floor is open, some of it in the half-shadow of the sphere.
    const Ready ready = sphereOverFloor();
    PassSettings settings = transferSettings(8192, 4);
    settings.seed = 9;
    const PassState reference = ready.trace(settings);
    settings = transferSettings(4096, 4);
    settings.tolerance = 0.001f;
    std::vector<int> samplesDone;
    PassCallbacks callbacks;
    callbacks.passDone = [&](int samples) { samplesDone.push_back(samples); };
    const JobControl control;
    const PassState done = ready.trace(settings, callbacks, {}, control.context());
    EXPECT_LE(rmsError(done), 0.001);
    EXPECT_LT(rmse(done, reference), 0.0013);
    const auto [least, most] = std::minmax_element(done.passes.begin(), done.passes.end());
    EXPECT_LT(*least, *most);
    EXPECT_EQ(done.samplesDone, 16 << *least);
    EXPECT_TRUE(std::is_sorted(samplesDone.begin(), samplesDone.end()));
    // As good a result with a fixed count needs more rays.
    PassSettings fixed = transferSettings(64, 4);
    double rays = 64.0, error = rmse(ready.trace(fixed), reference), before = error;
    while (error > rmse(done, reference)) {
        fixed.samples *= 2;
        before = error;
        error = rmse(ready.trace(fixed), reference);
        rays = fixed.samples;
    }
    const double equal =
        rays * std::exp2(-std::log(rmse(done, reference) / error) / std::log(before / error));
    const double traced = control.progress().workDone / double(ready.points.size());
    EXPECT_LT(traced, 0.85 * equal);
    EXPECT_LT(traced, meanRays(done)); // what neighbours agree about is taken from them
    // A tolerance that is met at once ends after the two passes that tell so.
    settings.tolerance = 0.5f;
    EXPECT_EQ(ready.trace(settings).samplesDone, 64);
}

// The stated error is an estimate, no bound: what of the surface is within how much of it, with a
// fixed count and to a tolerance (docs/maths/baking.md).
TEST(Passes, TheStatedErrorIsAnEstimateOfKnownCoverage) {
    const Ready ready = sphereOverFloor();
    PassSettings settings = transferSettings(16384, 4);
    settings.seed = 9;
    const PassState reference = ready.trace(settings);
    for (const float tolerance : {0.0f, 0.005f}) {
        settings = transferSettings(tolerance > 0.0f ? 4096 : 128, 4);
        settings.tolerance = tolerance;
        const PassState done = ready.trace(settings);
        double once = 0.0, thrice = 0.0;
        for (std::size_t p = 0; p < ready.points.size(); ++p) {
            double squares = 0.0;
            for (std::size_t i = 16 * p; i < 16 * p + 16; ++i)
                squares += std::pow(double(done.values[i]) - reference.values[i], 2.0);
            const double error = std::sqrt(squares / 16.0);
            // Of the reference itself, too: a hundredth of the tolerance.
            once += error <= done.error[p] + 5e-5 ? 1.0 : 0.0;
            thrice += error <= 3.0 * done.error[p] + 5e-5 ? 1.0 : 0.0;
        }
        once /= double(ready.points.size());
        thrice /= double(ready.points.size());
        const double ratio = rmse(done, reference) / rmsError(done);
        std::printf("[ figures  ] tolerance %g: true / stated RMS %.2f, within once %.0f %%, "
                    "within three times %.1f %%\n",
                    double(tolerance), ratio, 100.0 * once, 100.0 * thrice);
        EXPECT_LT(ratio, 1.4) << tolerance;
        EXPECT_GT(once, 0.5) << tolerance;
        EXPECT_GT(thrice, 0.85) << tolerance;
    }
}

// Neighbours that have nothing in common are not taken for one another: grass stands before the
// floor, and what the rim of a tile sees says nothing about the points in between.
TEST(Passes, NeighboursThatDifferAreTracedOneByOne) {
    Mesh blades;
    for (std::uint32_t i = 0; i < 500; ++i) {
        const glm::vec2 u = 7.6f * (sobolOwen2D(i, 5) - 0.5f);
        const float angle = 2.4f * float(i);
        const glm::vec3 along(0.06f * std::cos(angle), 0.0f, 0.06f * std::sin(angle));
        const glm::vec3 root(u.x, 0.02f, u.y), up(0.0f, 0.5f, 0.0f);
        for (const glm::vec3& corner :
             {root - along, root + along, root + along + up, root - along + up})
            blades.positions.push_back(corner);
        for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u})
            blades.indices.push_back(4 * i + corner);
    }
    const Ready ready({planeMesh(4.0, 40), std::move(blades)});
    PassSettings settings = transferSettings(4096, 3);
    settings.seed = 9;
    const PassState reference = ready.trace(settings);
    settings = transferSettings(512, 3);
    const double exact = rmse(ready.trace(settings), reference);
    settings.tolerance = 1e-6f; // not to be met: all of 512
    EXPECT_LT(rmse(ready.trace(settings), reference), 1.15 * exact);
}

TEST(VisibilityTiles, HoldEveryPointOnceAndLookOneWay) {
    const Ready ready({planeMesh(4.0, 13), sphereMesh(1.0, 32, 16, {0, 1.2, 0})});
    const VisibilityTiles tiles(ready.points, 3);
    std::vector<int> times(ready.points.size());
    std::vector<std::uint8_t> isRim;
    std::set<std::uint32_t> seeds;
    for (std::size_t t = 0; t < tiles.count(); ++t) {
        const std::span<const std::uint32_t> tile = tiles.points(t);
        ASSERT_FALSE(tile.empty());
        EXPECT_LE(tile.size(), VisibilityTiles::kMaxPoints);
        seeds.insert(tiles.seedOf(tile.front()));
        for (const std::uint32_t p : tile) {
            ++times[p];
            EXPECT_EQ(tiles.seedOf(p), tiles.seedOf(tile.front()));
            EXPECT_GT(glm::dot(ready.points[p].normal, ready.points[tile.front()].normal), -0.35f);
        }
        // Nothing lies outside the rim along any of its sixteen directions.
        findRim(ready.points, tile, isRim);
        const auto rim = std::count(isRim.begin(), isRim.end(), 1);
        EXPECT_GE(rim, std::min<std::ptrdiff_t>(3, std::ptrdiff_t(tile.size())));
        EXPECT_LE(rim, 16);
    }
    EXPECT_EQ(times, std::vector<int>(ready.points.size(), 1));
    EXPECT_EQ(seeds.size(), tiles.count());
    // A square of points: the corners and what else is farthest out, never the middle.
    std::vector<BakePoint> square;
    std::vector<std::uint32_t> all;
    for (std::uint32_t i = 0; i < 25; ++i) {
        square.push_back({{0.01f * float(i % 5), 0.0f, 0.01f * float(i / 5)}, {0, 1, 0}});
        all.push_back(i);
    }
    findRim(square, all, isRim);
    for (const std::size_t corner : {0u, 4u, 20u, 24u})
        EXPECT_EQ(isRim[corner], 1) << corner;
    for (const std::size_t inside : {6u, 7u, 8u, 11u, 12u, 13u, 16u, 17u, 18u})
        EXPECT_EQ(isRim[inside], 0) << inside;
}

TEST(Passes, UnshadowedIsTheClampedCosineWithoutARay) {
    const Ready ready = sphereOverFloor();
    PassSettings settings = transferSettings(64, 8);
    settings.unshadowed = true;
    const JobControl control;
    const Result<PassState> opened =
        openPasses(ready.points, ready.ranges, settings, {}, control.context());
    ASSERT_TRUE(opened);
    const PassState& done = *opened;
    EXPECT_EQ(done.samplesDone, 64);
    EXPECT_EQ(control.progress().workDone, 0.0);
    EXPECT_EQ(rmsError(done), 0.0);
    for (std::size_t p = 0; p < ready.points.size(); p += 37) {
        std::vector<double> basis(64);
        evaluateSh(8, glm::dvec3(ready.points[p].normal), basis);
        for (int l = 0; l < 8; ++l)
            for (int i = l * l; i < (l + 1) * (l + 1); ++i)
                EXPECT_NEAR(done.values[64 * p + std::size_t(i)],
                            cosineConvolution(l) * basis[std::size_t(i)] / kPi, 1e-6);
    }
}

TEST(Refinement, PrefersLargeErrorsOnFewRays) {
    // Below the tolerance nothing is wanted.
    std::vector<PointError> points(10, {0.01f, 64});
    EXPECT_EQ(pointsToRefine(points, 0.0101f, 4096), std::vector<std::uint8_t>(10, 0));
    // All alike: all of them.
    EXPECT_EQ(pointsToRefine(points, 0.005f, 4096), std::vector<std::uint8_t>(10, 1));
    // Unless they may not.
    EXPECT_EQ(pointsToRefine(points, 0.005f, 64), std::vector<std::uint8_t>(10, 0));
    // Just over: at least some step is made.
    EXPECT_EQ(pointsToRefine(points, 0.0099f, 4096), std::vector<std::uint8_t>(10, 1));
    // The bad ones only; points without error never.
    points[3] = points[7] = {0.1f, 64};
    points[5] = {0.0f, 64};
    std::vector<std::uint8_t> expected(10, 0);
    expected[3] = expected[7] = 1;
    EXPECT_EQ(pointsToRefine(points, 0.04f, 4096), expected);
    // The same error on more rays is harder to reduce.
    points.assign(10, {0.01f, 64});
    points[2].rays = 4096;
    expected.assign(10, 1);
    expected[2] = 0;
    EXPECT_EQ(pointsToRefine(points, 0.009f, 65536), expected);
}

TEST(TransferMeaning, VisibilityAndBentNormalOfAQuarterSphere) {
    // Transfer of a floor that faces +z with all of x < 0 blocked, divided by pi; cosine-weighted
    // mean direction (2, 0, pi) / sqrt(4 + pi²), visibility 1/2.
    const std::vector<float> t = {0.443113462726f / float(kPi), 0.0f, 0.511663353973f / float(kPi),
                                  -0.325735007935f / float(kPi)};
    EXPECT_NEAR(ambientVisibility(t), 0.5f, 1e-6f);
    const glm::vec3 bent = bentNormal(t, {0, 0, 1});
    EXPECT_NEAR(bent.x, 0.537029272146f, 1e-6f);
    EXPECT_NEAR(bent.y, 0.0f, 1e-6f);
    EXPECT_NEAR(bent.z, 0.843563608069f, 1e-6f);
    EXPECT_EQ(bentNormal(std::vector<float>(4, 0.0f), {0, 1, 0}), glm::vec3(0, 1, 0));
    EXPECT_EQ(bentNormal(std::vector<float>(1, 0.3f), {0, 1, 0}), glm::vec3(0, 1, 0));
}
