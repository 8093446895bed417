#include "render/WarmUp.h"
#include "core/document/ViewChoices.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "tests/render/TransferScenes.h"

#include <algorithm>

using namespace patina;
using namespace patina::render;

namespace {

constexpr FrameKind kPicture{SurfaceOutput::Picture, LightingMode::Ibl};

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
    const auto programs = surfacePrograms(document, kPicture);
    EXPECT_EQ(programs.size(), 2u);
    Document other = document;
    other.materials[0].baseColor = {1, 0, 0};
    other.view.camera.yawDeg += 10.0f;
    other.environment().exposureEv = 1.0f;
    EXPECT_EQ(surfacePrograms(other, kPicture), programs);
    other.meshes[2].visible = false;
    EXPECT_EQ(surfacePrograms(other, kPicture).size(), 1u);
}

TEST(SurfacePrograms, DifferByWhatDriversCompileFor) {
    const Document document = twoMaterials();
    const auto programs = surfacePrograms(document, kPicture);
    const auto differs = [&](const char* what, auto edit, FrameKind frame) {
        SCOPED_TRACE(what);
        Document other = document;
        edit(other);
        const auto now = surfacePrograms(other, frame);
        for (const auto& [program, mesh] : surfacePrograms(document, frame))
            EXPECT_FALSE(now.contains(program));
    };
    const auto light = [](LightType type) {
        return [type](Document& d) { d.lights.push_back(bulb(d, type)); };
    };
    const FrameKind picture = kPicture, view{SurfaceOutput::OneView, LightingMode::Ibl};
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

// Transfer for one of two meshes that share a material: in classical light one program draws both.
Document halfBaked() {
    Document document = twoMaterials();
    Document baked = document;
    baked.meshes.resize(1);
    document.bakes = {openBake(baked, 3, 0.5f)};
    return document;
}

TEST(FrameKinds, AreThoseOfTheViewsOnBothSides) {
    Document document = makeScene(makeSphere(8));
    ViewSettings view;
    using Kinds = std::vector<FrameKind>;
    EXPECT_EQ(frameKinds(view, document), Kinds{kPicture});
    view.shown.kind = shading::kViewUnshadowedLight;
    const FrameKind unshadowed{SurfaceOutput::Picture, LightingMode::Unshadowed};
    EXPECT_EQ(frameKinds(view, document), Kinds{unshadowed});
    view.split.emplace().other.kind = shading::kViewNoV;
    EXPECT_EQ(frameKinds(view, document),
              (Kinds{unshadowed, {SurfaceOutput::OneView, LightingMode::Ibl}}));
    view.split->other.kind = shading::kViewUnshadowedLight;
    EXPECT_EQ(frameKinds(view, document), Kinds{unshadowed}) << "once for both";
    view.terms[1] = false;
    view.split.reset();
    EXPECT_EQ(frameKinds(view, document),
              (Kinds{{SurfaceOutput::OneView, LightingMode::Unshadowed}}));
    document.view.lighting = LightingMode::Cosine;
    EXPECT_EQ(frameKinds({}, document), (Kinds{{SurfaceOutput::Picture, LightingMode::Cosine}}));
    view = {};
    view.lighting = LightingMode::Ibl; // held while the document's is compiled
    EXPECT_EQ(frameKinds(view, document), Kinds{kPicture});
    EXPECT_EQ(sheetKind(shading::kViewShadowedLight, document),
              (FrameKind{SurfaceOutput::EightViews, LightingMode::Shadowed}));
    EXPECT_EQ(sheetKind(shading::kViewNoV, document),
              (FrameKind{SurfaceOutput::EightViews, LightingMode::Cosine}));
}

TEST(FrameKinds, LightNeedsProgramsOfItsOwn) {
    const Document document = halfBaked();
    const auto programs = [&](LightingMode lighting) {
        return surfacePrograms(document, {SurfaceOutput::Picture, lighting});
    };
    EXPECT_EQ(programs(LightingMode::Ibl).size(), 2u);
    EXPECT_EQ(programs(LightingMode::Shadowed).size(), 3u);
    for (const auto& [program, mesh] : programs(LightingMode::Ibl))
        EXPECT_FALSE(programs(LightingMode::Unshadowed).contains(program));
    const auto all = allFrameKinds(document);
    for (const LightingMode lighting :
         {LightingMode::Cosine, LightingMode::ShIrradiance, LightingMode::Unshadowed,
          LightingMode::Shadowed, LightingMode::Prt})
        for (const SurfaceOutput output : {SurfaceOutput::Picture, SurfaceOutput::EightViews})
            EXPECT_EQ(std::count(all.begin(), all.end(), FrameKind{output, lighting}), 1);
    const auto unbaked = allFrameKinds(twoMaterials());
    for (const FrameKind& frame : unbaked)
        EXPECT_LT(frame.lighting, LightingMode::Shadowed) << "there is no such view";
    EXPECT_EQ(warmUpScene(document).meshes.size(), 3u);
}

// Two lights, two maps of one image, occlusion baked for one of three meshes.
Document mapped() {
    Document document = twoMaterials();
    document.lights = {bulb(document, LightType::Spot), bulb(document, LightType::Rectangle)};
    BakeArtifact ao;
    ao.kind = BakeKind::AoVertex;
    const MeshInstance& baked = document.meshes[2];
    ao.vertices.push_back({baked.id, 1, std::vector<float>(baked.mesh->vertexCount(), 0.5f)});
    document.bakes.push_back(std::make_shared<const BakeArtifact>(ao));
    return document;
}

TEST(WarmUpScene, CostsNextToNothing) {
    const Document scene = warmUpScene(mapped());
    EXPECT_EQ(scene.meshes.size(), 2u);
    EXPECT_EQ(scene.triangleCount(), 4u);
    const Material& packed = scene.materials.back();
    EXPECT_EQ(packed.metallicMap.image, packed.perceptualRoughnessMap.image);
    EXPECT_EQ(packed.metallicMap.image->width(), 4);
    EXPECT_EQ(packed.metallicMap.image->height(), 3);
}

class WarmUpTest : public RenderTest {};

// What is drawn later needs no program that has not been drawn with: whatever is predicted of it.
TEST_F(WarmUpTest, CoversMapsLightsAndBakedOcclusion) {
    const Document document = mapped();
    auto warmUp = WarmUp::create(context(), document);
    ASSERT_TRUE(warmUp.ok()) << warmUp.error().text();
    ASSERT_TRUE(warmUp->draw(kPicture, JobContext()).ok());
    const std::vector<ProgramKey> known = warmUp->renderer().programs();
    FrameSettings frame;
    frame.samples = 1;
    draw(document, 16, frame);
    std::size_t surfaces = 0;
    for (const ProgramKey& key : sceneRenderer().programs()) {
        EXPECT_NE(std::find(known.begin(), known.end(), key), known.end())
            << ::testing::PrintToString(key.files) << ::testing::PrintToString(key.defines);
        surfaces += key.files.back() == "surface.frag" ? 1 : 0;
    }
    EXPECT_GE(surfaces, 2u) << "with the maps and without";
}

// What the viewport does later, with a renderer of its own, needs nothing that is not there
// already.
TEST_F(WarmUpTest, CoversEveryWayToLight) {
    Document document = halfBaked();
    document.meshes.pop_back();
    document.lights = {bulb(document, LightType::Point)};
    auto warmUp = WarmUp::create(context(), document);
    ASSERT_TRUE(warmUp.ok()) << warmUp.error().text();
    for (const FrameKind& frame : allFrameKinds(document))
        ASSERT_TRUE(warmUp->draw(frame, JobContext()).ok());
    const std::vector<ProgramKey> known = warmUp->renderer().programs();

    FrameSettings frame;
    frame.samples = 1;
    for (const ViewInfo& info : views()) {
        const bool light = info.group == ViewGroup::Lighting;
        if (!light && info.kind != shading::kViewFinal && info.kind != shading::kViewNoV)
            continue;
        ASSERT_EQ(whyEmpty(info.kind, document), "");
        SCOPED_TRACE(info.id);
        frame.view.shown.kind = info.kind;
        draw(document, 16, frame);
        ViewSheet sheet{{info.kind}};
        sheet.width = sheet.height = 8;
        EXPECT_TRUE(SheetRenderer(sceneRenderer()).draw(frame, sheet, renderer()).ok());
        EXPECT_TRUE(renderer().inspect(8, 8).ok());
    }
    std::size_t lit = 0;
    for (const ProgramKey& key : sceneRenderer().programs()) {
        EXPECT_NE(std::find(known.begin(), known.end(), key), known.end())
            << ::testing::PrintToString(key.files) << ::testing::PrintToString(key.defines);
        lit += key.files.front() == "relight.comp" ? 1 : 0;
    }
    EXPECT_GE(lit, 3u) << "transfer was lit";

    // Nor does the light of lights that were not there yet.
    document.lights = {bulb(document, LightType::Sphere), bulb(document, LightType::Rectangle)};
    for (const ViewKind kind : {shading::kViewUnshadowedLight, shading::kViewShadowedLight,
                                shading::kViewInterreflectedLight}) {
        frame.view.shown.kind = kind;
        draw(document, 16, frame);
    }
    std::size_t near = 0;
    for (const ProgramKey& key : sceneRenderer().programs()) {
        if (key.files.size() > 1)
            continue;
        EXPECT_NE(std::find(known.begin(), known.end(), key), known.end())
            << ::testing::PrintToString(key.files) << ::testing::PrintToString(key.defines);
        near += key.files.front() == "nearlight.comp" ? 1 : 0;
    }
    EXPECT_EQ(near, 9u) << "points, spheres and rectangles, each in three ways";
}

TEST_F(WarmUpTest, StopsWhenItIsCancelled) {
    auto warmUp = WarmUp::create(context(), twoMaterials());
    ASSERT_TRUE(warmUp.ok());
    JobControl control;
    control.cancel();
    for (const FrameKind& frame : allFrameKinds(twoMaterials())) {
        const auto done = warmUp->draw(frame, control.context());
        ASSERT_FALSE(done.ok());
        EXPECT_EQ(done.error().kind, ErrorKind::Cancelled);
    }
}

} // namespace
