#include "render/WarmUp.h"
#include "tests/render/RenderTest.h"

#include <algorithm>

using namespace patina;
using namespace patina::render;

namespace {

// Two spheres of one material and one of another, which has two maps of one image.
Document twoMaterials() {
    Document document = makeScene(makeSphere(16));
    MeshInstance mesh = document.meshes[0];
    mesh.id = document.takeId();
    document.meshes.push_back(mesh);
    Material packed;
    packed.id = document.takeId();
    const ImagePtr image = makeImage(64, 48, 3, PixelType::U8, ColorEncoding::Data,
                                     [](int, int, int) { return 0.5f; });
    packed.metallicMap.image = packed.perceptualRoughnessMap.image = image;
    document.materials.push_back(packed);
    mesh.id = document.takeId();
    mesh.material = packed.id;
    document.meshes.push_back(mesh);
    return document;
}

Light bulb(Document& document, LightType type) {
    Light light;
    light.id = document.takeId();
    light.type = type;
    light.castsShadow = false;
    return light;
}

TEST(SurfacePrograms, AreTheSameForWhatIsDrawnTheSame) {
    const Document document = twoMaterials();
    const auto programs = surfacePrograms(document, SurfaceOutput::Picture);
    EXPECT_EQ(programs.size(), 2u);
    Document other = document;
    other.materials[0].baseColor = {1, 0, 0};
    other.view.camera.yawDeg += 10.0f;
    other.environment.exposureEv = 1.0f;
    EXPECT_EQ(surfacePrograms(other, SurfaceOutput::Picture), programs);
    other.meshes[2].visible = false;
    EXPECT_EQ(surfacePrograms(other, SurfaceOutput::Picture).size(), 1u);
}

TEST(SurfacePrograms, DifferByWhatDriversCompileFor) {
    const Document document = twoMaterials();
    const auto programs = surfacePrograms(document, SurfaceOutput::Picture);
    const auto differs = [&](const char* what, auto edit, SurfaceOutput output) {
        SCOPED_TRACE(what);
        Document other = document;
        edit(other);
        const auto now = surfacePrograms(other, output);
        for (const auto& [program, mesh] : surfacePrograms(document, output))
            EXPECT_FALSE(now.contains(program));
    };
    const auto light = [](LightType type) {
        return [type](Document& d) { d.lights.push_back(bulb(d, type)); };
    };
    const auto picture = SurfaceOutput::Picture, view = SurfaceOutput::OneView;
    differs("a light", light(LightType::Point), picture);
    differs("an area light", light(LightType::Rectangle), view);
    differs(
        "the model", [](Document& d) { d.model.distribution = Distribution::Beckmann; }, picture);
    differs(
        "a shadow",
        [](Document& d) {
            d.lights.push_back(bulb(d, LightType::Directional));
            d.lights.back().castsShadow = true;
        },
        view);
    for (const auto& [program, mesh] : surfacePrograms(document, view))
        EXPECT_FALSE(programs.contains(program)) << "a view is not the picture";

    // A second light is unrolled into the picture's program, and no more than a number to a view.
    Document one = document, two = document;
    one.lights = {bulb(one, LightType::Point)};
    two.lights = {bulb(two, LightType::Point), bulb(two, LightType::Point)};
    EXPECT_NE(surfacePrograms(one, picture), surfacePrograms(two, picture));
    EXPECT_EQ(surfacePrograms(one, view), surfacePrograms(two, view));

    Document sharper = document;
    sharper.materials[1].metallicMap.image = sharper.materials[1].perceptualRoughnessMap.image =
        makeImage(64, 64, 3, PixelType::U8, ColorEncoding::Data, [](int, int, int) { return 0.f; });
    EXPECT_NE(surfacePrograms(sharper, picture), programs) << "a side that is a power of two";
}

TEST(WarmUpScene, NeedsTheSameProgramsAtNextToNoCost) {
    Document document = twoMaterials();
    document.lights = {bulb(document, LightType::Spot), bulb(document, LightType::Rectangle)};
    BakeArtifact ao;
    ao.kind = BakeKind::AoVertex;
    const MeshInstance& baked = document.meshes[2];
    ao.vertices.push_back({baked.id, 1, std::vector<float>(baked.mesh->vertexCount(), 0.5f)});
    document.bakes.push_back(std::make_shared<const BakeArtifact>(ao));
    const Document scene = warmUpScene(document);
    for (const SurfaceOutput output : {SurfaceOutput::Picture, SurfaceOutput::OneView,
                                       SurfaceOutput::EightViews, SurfaceOutput::Inspection})
        EXPECT_EQ(surfacePrograms(scene, output), surfacePrograms(document, output));
    EXPECT_EQ(scene.meshes.size(), 2u);
    EXPECT_EQ(scene.triangleCount(), 4u);
    const Material& packed = scene.materials.back();
    EXPECT_EQ(packed.metallicMap.image, packed.perceptualRoughnessMap.image);
    EXPECT_EQ(packed.metallicMap.image->width(), 4);
    EXPECT_EQ(packed.metallicMap.image->height(), 3);
}

class WarmUpTest : public RenderTest {};

TEST_F(WarmUpTest, DrawsEveryKindOfFrame) {
    Document document = twoMaterials();
    document.lights = {bulb(document, LightType::Point)};
    auto warmUp = WarmUp::create(context(), document);
    ASSERT_TRUE(warmUp.ok()) << warmUp.error().text();
    for (const SurfaceOutput output : {SurfaceOutput::Picture, SurfaceOutput::EightViews,
                                       SurfaceOutput::Inspection, SurfaceOutput::OneView}) {
        const auto done = warmUp->draw(output, JobContext());
        EXPECT_TRUE(done.ok()) << done.error().text();
    }
}

TEST_F(WarmUpTest, StopsWhenItIsCancelled) {
    auto warmUp = WarmUp::create(context(), twoMaterials());
    ASSERT_TRUE(warmUp.ok());
    JobControl control;
    control.cancel();
    for (const SurfaceOutput output : {SurfaceOutput::Picture, SurfaceOutput::OneView}) {
        const auto done = warmUp->draw(output, control.context());
        ASSERT_FALSE(done.ok());
        EXPECT_EQ(done.error().kind, ErrorKind::Cancelled);
    }
}

} // namespace
