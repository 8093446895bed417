// How bakes behave as jobs: passes, stop, cancel, determinism, errors.
#include "core/bake/domain/BakeHash.h"
#include "core/job/Parallel.h"
#include "tests/core/bake/BakeTestScene.h"

#include <gtest/gtest.h>
#include <limits>

using namespace patina;
using namespace patina::test;

namespace {

BakeInputs smallScene() {
    return sceneOf({planeMesh(4.0, 24), sphereMesh(1.0, 32, 16, {0, 1, 0})});
}

ErrorKind kindOf(const Result<BakeArtifact>& result) {
    EXPECT_FALSE(result.ok());
    if (!result.ok()) {
        EXPECT_FALSE(result.error().message.empty());
        return result.error().kind;
    }
    return ErrorKind::Internal;
}

} // namespace

TEST(BakeJob, PassesDoubleAndTheSinkSeesTheFinalValues) {
    const BakeInputs inputs = smallScene();
    Recorder recorder;
    PrtSettings settings;
    settings.samples = 200; // rounded up
    settings.fitted = false;
    const JobControl control;
    const Result<BakeArtifact> artifact =
        bakePrtVertex(inputs, settings, recorder, control.context());
    ASSERT_TRUE(artifact.ok());
    EXPECT_EQ(recorder.m_passes, (std::vector<int>{32, 64, 128, 256}));
    EXPECT_EQ(artifact->samplesDone, 256);
    EXPECT_EQ(artifact->settings.at("samples"), "256");
    EXPECT_EQ(artifact->inputs, hashBakeInputs(inputs));
    for (const VertexBake& bake : artifact->vertices)
        EXPECT_EQ(recorder.m_vertices.at(bake.mesh), bake.values);
    const JobProgress progress = control.progress();
    EXPECT_EQ(progress.fraction, 1.0);
    EXPECT_EQ(progress.workUnit, "rays");
    const std::size_t vertices =
        inputs.meshes[0].mesh->vertexCount() + inputs.meshes[1].mesh->vertexCount();
    EXPECT_EQ(progress.workDone, 256.0 * double(vertices));
}

TEST(BakeJob, FewSamplesAreOnePass) {
    Recorder recorder;
    AoSettings settings;
    settings.samples = 5;
    const Result<BakeArtifact> artifact = bakeAoVertex(smallScene(), settings, recorder, {});
    ASSERT_TRUE(artifact.ok());
    EXPECT_EQ(recorder.m_passes, std::vector<int>{8});
}

TEST(BakeJob, ResultsDoNotDependOnThreads) {
    const BakeInputs inputs = smallScene();
    const auto bakeWith = [&](int threads) {
        const ThreadLimit limit(threads);
        return prtOf(inputs, 4, 64);
    };
    const BakeArtifact one = bakeWith(1);
    ASSERT_EQ(one.vertices.size(), 2u);
    EXPECT_EQ(bakeWith(2), one);
    EXPECT_EQ(bakeWith(5), one);
}

TEST(BakeJob, TheSeedChangesTheNoiseOnly) {
    const BakeInputs inputs = smallScene();
    TileSink sink;
    AoSettings settings;
    settings.samples = 256;
    const Result<BakeArtifact> a = bakeAoVertex(inputs, settings, sink, {});
    settings.seed = 1;
    const Result<BakeArtifact> b = bakeAoVertex(inputs, settings, sink, {});
    ASSERT_TRUE(a.ok() && b.ok());
    EXPECT_NE(a->vertices, b->vertices);
    for (std::size_t v = 0; v < a->vertices[0].values.size(); ++v)
        EXPECT_NEAR(a->vertices[0].values[v], b->vertices[0].values[v], 0.06f);
}

// What a stop leaves has the rays of the last complete pass, or of the pass in flight, element by
// element.
TEST(BakeJob, StopKeepsWhatThereIs) {
    const BakeInputs inputs = smallScene();
    const BakeArtifact expected128 = aoOf(inputs, 128), expected64 = aoOf(inputs, 64),
                       expected32 = aoOf(inputs, 32);
    AoSettings settings;
    settings.samples = 65536;
    for (const bool inTheMiddle : {false, true}) {
        JobControl control;
        Recorder recorder;
        if (inTheMiddle)
            recorder.onTile = [&](std::size_t passesDone) {
                if (passesDone == 2)
                    control.stop();
            };
        else
            recorder.onPass = [&](int samples) {
                if (samples == 64)
                    control.stop();
            };
        const Result<BakeArtifact> artifact =
            bakeAoVertex(inputs, settings, recorder, control.context());
        ASSERT_TRUE(artifact.ok());
        EXPECT_EQ(artifact->samplesDone, 64);
        EXPECT_EQ(recorder.m_passes, (std::vector<int>{32, 64}));
        std::size_t ahead = 0, all = 0;
        for (std::size_t m = 0; m < 2; ++m)
            for (std::size_t v = 0; v < artifact->vertices[m].values.size(); ++v, ++all) {
                const float value = artifact->vertices[m].values[v];
                if (value != expected64.vertices[m].values[v]) {
                    EXPECT_EQ(value, expected128.vertices[m].values[v]);
                    ++ahead;
                }
            }
        EXPECT_EQ(ahead > 0, inTheMiddle);
        EXPECT_LT(ahead, all / 2);
    }
    JobControl early; // before the first ray: the first pass is finished
    early.stop();
    TileSink sink;
    const Result<BakeArtifact> artifact = bakeAoVertex(inputs, settings, sink, early.context());
    ASSERT_TRUE(artifact.ok());
    EXPECT_EQ(artifact->samplesDone, 32);
    EXPECT_EQ(artifact->vertices, expected32.vertices);
}

TEST(BakeJob, CancelAnywhereReturnsCancelled) {
    const BakeInputs inputs = smallScene();
    for (int tilesBefore : {0, 1, 5, 40}) {
        for (const bool texel : {false, true}) {
            JobControl control;
            if (tilesBefore == 0)
                control.cancel();
            Recorder recorder;
            std::atomic<int> tiles = 0;
            recorder.onTile = [&](std::size_t) {
                if (++tiles == tilesBefore)
                    control.cancel();
            };
            AoSettings settings;
            settings.samples = 65536;
            settings.size = 64;
            const Result<BakeArtifact> result =
                texel ? bakeAoTexel(inputs, settings, recorder, control.context())
                      : bakeAoVertex(inputs, settings, recorder, control.context());
            EXPECT_EQ(kindOf(result), ErrorKind::Cancelled);
        }
    }
}

TEST(BakeJob, SenselessSettingsAreUsageErrors) {
    const BakeInputs inputs = smallScene();
    TileSink sink;
    for (const int samples : {0, -5, 65537, std::numeric_limits<int>::max()}) {
        AoSettings ao;
        ao.samples = samples;
        PrtSettings prt;
        prt.samples = samples;
        EXPECT_EQ(kindOf(bakeAoVertex(inputs, ao, sink, {})), ErrorKind::Usage);
        EXPECT_EQ(kindOf(bakeAoTexel(inputs, ao, sink, {})), ErrorKind::Usage);
        EXPECT_EQ(kindOf(bakePrtVertex(inputs, prt, sink, {})), ErrorKind::Usage);
    }
    for (const float distance :
         {-1.0f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        AoSettings ao;
        ao.maxDistance = distance;
        EXPECT_EQ(kindOf(bakeAoVertex(inputs, ao, sink, {})), ErrorKind::Usage);
    }
    for (const int order : {0, -1, 9}) {
        PrtSettings prt;
        prt.order = order;
        EXPECT_EQ(kindOf(bakePrtVertex(inputs, prt, sink, {})), ErrorKind::Usage);
    }
    for (const int size : {0, -1, 8193}) {
        AoSettings ao;
        ao.size = size;
        EXPECT_EQ(kindOf(bakeAoTexel(inputs, ao, sink, {})), ErrorKind::Usage);
    }
}

TEST(BakeJob, BrokenScenesAreInputErrors) {
    TileSink sink;
    const auto expectBroken = [&](const BakeInputs& inputs) {
        EXPECT_EQ(kindOf(bakeAoVertex(inputs, {}, sink, {})), ErrorKind::InputBroken);
        EXPECT_EQ(kindOf(bakeAoTexel(inputs, {}, sink, {})), ErrorKind::InputBroken);
        EXPECT_EQ(kindOf(bakePrtVertex(inputs, {}, sink, {})), ErrorKind::InputBroken);
    };
    expectBroken({});
    expectBroken(sceneOf({Mesh{}}));
    expectBroken({{BakeMesh{}}}); // no mesh at all
    const float nan = std::numeric_limits<float>::quiet_NaN();
    expectBroken(sceneOf({cubeMesh()}, glm::mat4(nan)));
    expectBroken(sceneOf({cubeMesh()}, glm::mat4(std::numeric_limits<float>::infinity())));
    for (const int fault : {0, 1, 2}) {
        Mesh mesh = sanitized(cubeMesh());
        if (fault == 0)
            mesh.positions[3].y = nan;
        else if (fault == 1)
            mesh.indices[5] = 1'000'000;
        else
            mesh.normals.pop_back();
        BakeInputs inputs = sceneOf({cubeMesh()});
        inputs.meshes[0].mesh = std::make_shared<const Mesh>(mesh);
        expectBroken(inputs);
    }
    // A collapsed transform has no area and no normals, but nothing breaks.
    EXPECT_EQ(aoOf(sceneOf({cubeMesh()}, glm::mat4(0.0f)), 32).vertices.size(), 1u);
}

TEST(BakeJob, TheHashFollowsGeometryNotIds) {
    const BakeInputs inputs = smallScene();
    const Hash hash = hashBakeInputs(inputs);
    BakeInputs other = inputs;
    for (BakeMesh& mesh : other.meshes) {
        mesh.id += 100;
        mesh.material += 7;
        mesh.doubleSided = true;
    }
    EXPECT_EQ(hashBakeInputs(other), hash);
    other = inputs;
    other.meshes[1].transform[3][0] = 1e-6f;
    EXPECT_NE(hashBakeInputs(other), hash);
    other = inputs;
    other.meshes[1].material = 2; // no longer shares a texture
    EXPECT_NE(hashBakeInputs(other), hash);
    other = inputs;
    std::swap(other.meshes[0], other.meshes[1]);
    EXPECT_NE(hashBakeInputs(other), hash);
    other = inputs;
    other.meshes.pop_back();
    EXPECT_NE(hashBakeInputs(other), hash);
}
