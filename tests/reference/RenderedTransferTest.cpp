// What the renderer shows of a transfer bake against the sum of the same numbers on the CPU: light,
// rotation, bounces, interpolation, albedo, and nothing that reflections take away
// (docs/maths/transfer-truth.md).
#include "core/bake/Bake.h"
#include "core/bake/domain/BakeRequest.h"
#include "core/document/ViewChoices.h"
#include "core/library/Library.h"
#include "core/light/OrientedEnvironment.h"
#include "core/material/Material.h"
#include "core/scene/Scene.h"
#include "core/worker/WorkerClient.h"
#include "tests/reference/ReferenceLight.h"
#include "tests/reference/TransferPicture.h"
#include "tests/render/RenderTest.h"

namespace patina::render {
namespace {

using namespace reference;

constexpr int kSide = 64;
constexpr float kTurnedDeg = 75.0f; // some way into the box

class RenderedTransfer : public RenderTest {
  protected:
    void SetUp() override {
        RenderTest::SetUp();
        WorkerClient worker; // built-in things need none: it never starts
        Result<OpenedScene> opened = openScene(worker, "builtin:cornell-box");
        ASSERT_TRUE(opened.ok());
        m_document = std::move(opened->document);
        for (Material& material : m_document.materials)
            material.emissive = glm::vec3(0.0f);
        m_document.environment().image = *library::environment("studio");
        m_document.environment().enabled = true; // a room brings none
        m_document.view.exposureMode = ExposureMode::Fixed;
        m_document.environment().rotationDeg = kTurnedDeg;
        m_document.view.background = BackgroundMode::Off;
        Camera& camera = m_document.view.camera;
        camera.yawDeg = 8.0f;
        camera.pitchDeg = 3.0f;
        camera = frameBounds(camera, m_document.bounds(), 1.0f);
        m_document.view.reflectionMix = 0.0f;
        setIblOf(m_document);
        m_scene.emplace(*ReferenceScene::create(m_document));
        m_places = m_scene->look(camera, kSide, kSide);
        const Image turned = orientEnvironment(*m_document.environment().image, kTurnedDeg, 0.0f);
        const ReferenceLight light(std::make_shared<const Image>(turned));
        for (const glm::dvec3& c : light.coefficients())
            m_light.emplace_back(c);
    }

    void bakeScene(BakeKind kind, int order, TransferKind transfer) {
        BakeRequest request;
        request.kind = kind;
        request.prt.order = order;
        request.prt.samples = 64;
        request.prt.transfer = transfer;
        request.prt.bounces = 2;
        request.prt.bounceSamples = 32;
        request.prt.size = 128;
        TileSink nobody;
        Result<BakeArtifact> baked = bake(request, m_scene->inputs(), nobody, {});
        ASSERT_TRUE(baked.ok()) << baked.error().text();
        m_document.bakes = {std::make_shared<const BakeArtifact>(*std::move(baked))};
    }

    // Shows `lighting`; how far the picture is from the CPU's, as a share of its mean.
    void expectSame(LightingMode lighting, double most) {
        m_document.view.lighting = lighting;
        FrameSettings settings;
        settings.samples = 1; // at the centres of pixels, as the CPU looks
        const Image drawn = draw(m_document, kSide, settings);
        const BakeArtifact& artifact = *m_document.bakes[0];
        std::vector<glm::dvec3> expected = transferPicture(
            *m_scene, m_places, artifact, m_light, artifact.order, lighting == LightingMode::Prt);
        std::vector<glm::dvec3> found;
        std::vector<std::optional<Place>> both = m_places;
        int apart = 0; // one of the two sees a surface
        for (std::size_t p = 0; p < both.size(); ++p) {
            const glm::vec4 seen = pixel(drawn, int(p) % kSide, int(p) / kSide);
            found.emplace_back(seen);
            expected[p] = glm::max(expected[p], glm::dvec3(0.0)); // as light is shown
            if (both[p].has_value() != (seen.w > 0.0f)) {
                ++apart;
                both[p].reset();
            }
        }
        EXPECT_LE(apart, 4);
        const Distance off =
            distance(both, found, expected, std::vector<glm::dvec3>(both.size(), glm::dvec3(0.0)));
        EXPECT_GT(off.mean, 0.01);
        EXPECT_LE(off.relative(), most);
        EXPECT_LE(std::abs(off.bias), 0.001 * off.mean);
        printf("order %d, %s: %.3f %% of the mean, bias %.3f %%\n", artifact.order,
               lighting == LightingMode::Prt ? "interreflected" : "shadowed", 100 * off.relative(),
               100 * off.bias / off.mean);
    }

    Document m_document;
    std::optional<ReferenceScene> m_scene;
    std::vector<std::optional<Place>> m_places;
    std::vector<glm::vec3> m_light;
};

TEST_F(RenderedTransfer, PerVertex) {
    for (const int order : {3, 6}) {
        bakeScene(BakeKind::PrtVertex, order, TransferKind::Interreflected);
        expectSame(LightingMode::Shadowed, 0.002);
        expectSame(LightingMode::Prt, 0.002);
    }
}

TEST_F(RenderedTransfer, PerTexel) {
    bakeScene(BakeKind::PrtTexel, 4, TransferKind::Interreflected);
    expectSame(LightingMode::Shadowed, 0.002);
    expectSame(LightingMode::Prt, 0.002);
}

} // namespace
} // namespace patina::render
