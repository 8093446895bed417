// Pictures of transfer bakes against pictures traced by brute force, lit by the same first bands
// of an environment. Small ones: prt-reference measures the same with more of everything
// (docs/maths/transfer-truth.md).
#include "core/bake/Bake.h"
#include "core/bake/TransferRefinement.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/bake/domain/BakeRequest.h"
#include "core/library/Library.h"
#include "core/light/OrientedEnvironment.h"
#include "core/math/SphericalHarmonics.h"
#include "core/scene/Scene.h"
#include "core/worker/WorkerClient.h"
#include "tests/reference/PathReference.h"
#include "tests/reference/TransferPicture.h"

#include <gtest/gtest.h>

using namespace patina;
using namespace patina::reference;

namespace {

constexpr int kSide = 32;

// Finer where shadows begin, as patina refine does it.
void refine(Document& document) {
    RefinementSettings settings;
    settings.bake.order = 3;
    settings.bake.samples = 128;
    settings.rounds = 3;
    const BakeInputs inputs = bakeInputs(document);
    const RefinedMeshes refined = *refineForTransfer(inputs, settings, {});
    for (std::size_t i = 0; i < inputs.meshes.size(); ++i)
        for (MeshInstance& mesh : document.meshes)
            if (mesh.id == inputs.meshes[i].id)
                mesh.mesh = refined.meshes[i];
}

// A scene, looked at and baked with kOrders bands, and the truth of it.
struct Compared {
    Compared(const std::string& name, float yawDeg, const std::string& sky, float rotationDeg,
             const PrtSettings& settings, int paths, bool refined = false) {
        WorkerClient worker; // built-in things need none: it never starts
        Result<OpenedScene> opened = openScene(worker, name);
        EXPECT_TRUE(opened.ok());
        if (refined)
            refine(opened->document);
        scene.emplace(*ReferenceScene::create(opened->document));
        Camera camera = opened->document.view.camera;
        camera.yawDeg = yawDeg;
        places = scene->look(frameBounds(camera, opened->document.bounds(), 1.0f), kSide, kSide);
        const auto image = std::make_shared<const Image>(
            orientEnvironment(**library::environment(sky), rotationDeg, 0.0f));
        coefficients = projectLatLong(*image, kOrders);
        BakeRequest request;
        request.prt = settings;
        request.prt.order = kOrders;
        request.prt.transfer = TransferKind::Interreflected;
        TileSink nobody;
        artifact = *bake(request, scene->inputs(), nobody, {});
        const ReferenceLight light(image);
        PathSettings pathSettings;
        pathSettings.paths = paths;
        pathSettings.bounces = settings.bounces;
        truth = tracePaths(*scene, places, {&light, 1}, pathSettings);
    }

    // Of the picture at `order` bands from the truth under `light` (0: the whole environment).
    [[nodiscard]] Distance at(int order, Transport transport, int light) const {
        return distance(places,
                        transferPicture(*scene, places, artifact, coefficients, order,
                                        transport == Transport::Interreflected),
                        truth.mean(0, transport, light), truth.halfDifference(0, transport, light));
    }

    std::optional<ReferenceScene> scene;
    std::vector<std::optional<Place>> places;
    std::vector<glm::vec3> coefficients;
    BakeArtifact artifact;
    PathPictures truth;
};

PrtSettings settings(int samples, int bounces, int bounceSamples) {
    PrtSettings settings;
    settings.samples = samples;
    settings.bounces = bounces;
    settings.bounceSamples = bounceSamples;
    return settings;
}

// The picture is that of the same bands of light, and meets the whole environment the better the
// more there are.
void expectTrue(const Compared& compared, Transport transport, double most) {
    double before = 1.0;
    for (int order = 2; order <= kOrders; ++order) {
        const Distance same = compared.at(order, transport, order);
        EXPECT_LE(same.relative(), most) << order << " bands";
        EXPECT_LE(std::abs(same.bias), 0.005 * same.mean) << order << " bands";
        const double whole = compared.at(order, transport, 0).relative();
        EXPECT_LT(whole, before) << order << " bands";
        EXPECT_GT(whole, same.relative()) << order << " bands";
        before = whole;
    }
}

} // namespace

// Most of what is left are few bounce rays, and triangles that are still coarse.
TEST(TransferTruth, CornellBox) {
    const Compared box("builtin:cornell-box", 0.0f, "studio", 90.0f, settings(1024, 2, 128), 512,
                       true);
    expectTrue(box, Transport::Shadowed, 0.013);
    expectTrue(box, Transport::Interreflected, 0.027);
    EXPECT_LT(box.at(kOrders, Transport::Interreflected, 0).relative(), 0.16);
    // Bounces are no trifle there.
    const Distance without =
        distance(box.places,
                 transferPicture(*box.scene, box.places, box.artifact, box.coefficients, 3, false),
                 box.truth.mean(0, Transport::Interreflected, 3),
                 box.truth.halfDifference(0, Transport::Interreflected, 3));
    EXPECT_GT(without.relative(), 0.2);
}

TEST(TransferTruth, ShaderBall) {
    const Compared ball("builtin:shader-ball", 30.0f, "sunset", 0.0f, settings(128, 1, 32), 256);
    expectTrue(ball, Transport::Shadowed, 0.013);
    expectTrue(ball, Transport::Interreflected, 0.013);
    EXPECT_LT(ball.at(3, Transport::Interreflected, 3).relative(), 0.009);
    EXPECT_LT(ball.at(kOrders, Transport::Interreflected, 0).relative(), 0.05);
}
