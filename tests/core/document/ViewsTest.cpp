#include "core/document/Views.h"
#include "core/bake/domain/BakeArtifact.h"
#include "core/document/Document.h"
#include "core/edit/ViewReasons.h"
#include "core/light/Light.h"
#include "core/material/Material.h"

#include <gtest/gtest.h>
#include <set>

using namespace patina;

namespace {

TEST(Views, EachHasANameOfItsOwnAndSaysWhatItIs) {
    std::set<std::string_view> ids, labels;
    for (const ViewInfo& info : views()) {
        EXPECT_TRUE(ids.insert(info.id).second) << info.id;
        EXPECT_TRUE(labels.insert(info.label).second) << info.label;
        EXPECT_FALSE(info.help.empty()) << info.id;
        EXPECT_LT(info.rangeMin, info.rangeMax) << info.id;
        EXPECT_TRUE(!info.logarithmic || info.rangeMin > 0.0f) << info.id;
        EXPECT_EQ(findView(info.id), &info);
    }
    EXPECT_EQ(views().size(), std::size_t{shading::kViewCount});
    EXPECT_EQ(findView("nothing"), nullptr);
}

TEST(Views, SaysWhyAViewIsEmpty) {
    Document document;
    EXPECT_FALSE(whyEmpty(shading::kViewDirectDiffuse, document).empty());
    EXPECT_FALSE(whyEmpty(shading::kViewShadow, document).empty());
    EXPECT_FALSE(whyEmpty(shading::kViewEmissive, document).empty());
    EXPECT_FALSE(whyEmpty(shading::kViewNormalMap, document).empty());
    EXPECT_TRUE(whyEmpty(shading::kViewFinal, document).empty());

    Light sun;
    sun.id = document.takeId();
    sun.type = LightType::Directional;
    sun.castsShadow = false;
    document.lights.push_back(sun);
    EXPECT_TRUE(whyEmpty(shading::kViewDirectDiffuse, document).empty());
    EXPECT_FALSE(whyEmpty(shading::kViewShadow, document).empty());
    document.lights[0].castsShadow = true;
    EXPECT_TRUE(whyEmpty(shading::kViewShadow, document).empty());
}

// One triangle with a material, in the grey sky that stands in for an image.
Document triangleInGreySky() {
    Document document;
    Material material;
    material.id = document.takeId();
    auto mesh = std::make_shared<Mesh>();
    mesh->positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh->normals.assign(3, {0, 0, 1});
    mesh->indices = {0, 1, 2};
    MeshInstance instance;
    instance.id = document.takeId();
    instance.mesh = mesh;
    instance.material = material.id;
    document.materials = {material};
    document.meshes = {instance};
    return document;
}

BakeArtifactPtr bakeOf(Id mesh, std::size_t vertices, int stride, TransferKind transfer) {
    auto bake = std::make_shared<BakeArtifact>();
    bake->kind = BakeKind::PrtVertex;
    bake->transfer = transfer;
    VertexBake element;
    element.mesh = mesh;
    element.stride = stride;
    element.values.assign(vertices * static_cast<std::size_t>(stride), 0.5f);
    element.sky.assign(vertices, 0.5f);
    element.error.assign(vertices, 0.01f);
    bake->vertices = {element};
    return bake;
}

std::set<std::string> inapplicable(const Document& document, Id light = 0) {
    std::set<std::string> ids;
    for (const ViewInfo& info : views())
        if (!whyEmpty(info.kind, document, light).empty())
            ids.insert(std::string(info.id));
    return ids;
}

using Ids = std::set<std::string>;

const Ids kOfLights{"direct",        "directDiffuse", "directSpecular", "shadow",
                    "lightArriving", "lightDiffuse",  "lightSpecular"};
const Ids kOfBakes{"bentNormal", "skyVisibility", "bakeError", "shadowed", "interreflected"};
const Ids kOfEnvironments{"irradiance",  "diffuseIbl", "ambient",     "prefiltered",
                          "specularIbl", "cosine",     "shIrradiance"};
const Ids kOfCoordinates{"uvChecker", "texelDensity", "tangent", "bitangent"};
const Ids kOfMaterials{"emissive", "normalMap", "transmission", "through"};

Ids sum(std::initializer_list<Ids> sets) {
    Ids all;
    for (const Ids& set : sets)
        all.insert(set.begin(), set.end());
    return all;
}

TEST(Views, ApplyOnlyWhereTheSceneHasWhatTheyNeed) {
    Document document = triangleInGreySky();
    const Ids rest = sum({kOfCoordinates, kOfMaterials});
    EXPECT_EQ(inapplicable(document), sum({rest, kOfLights, kOfBakes}));

    // No environment: switched off, or black.
    document.environment().enabled = false;
    EXPECT_EQ(inapplicable(document),
              sum({rest, kOfLights, kOfBakes, kOfEnvironments, {"unshadowed"}}));
    document.environment().enabled = true;
    document.environment().tint = glm::vec3(0.0f);
    EXPECT_EQ(inapplicable(document),
              sum({rest, kOfLights, kOfBakes, kOfEnvironments, {"unshadowed"}}));
    document.environment().tint = glm::vec3(1.0f);

    // An area light has no single direction, and casts no shadow.
    Light panel, sun;
    panel.id = document.takeId();
    panel.type = LightType::Rectangle;
    sun.id = document.takeId();
    sun.type = LightType::Directional;
    document.lights = {panel};
    EXPECT_EQ(inapplicable(document), sum({rest, kOfBakes, {"lightArriving", "shadow"}}));
    document.lights = {panel, sun};
    EXPECT_EQ(inapplicable(document), sum({rest, kOfBakes}));
    EXPECT_EQ(inapplicable(document, panel.id), sum({rest, kOfBakes, {"lightArriving", "shadow"}}))
        << "of the chosen light";
    EXPECT_EQ(inapplicable(document, sun.id), sum({rest, kOfBakes}));
    document.lights.clear();

    // Maps and coordinates.
    auto mesh = std::make_shared<Mesh>(*document.meshes[0].mesh);
    mesh->uvs.assign(3, {0, 0});
    document.meshes[0].mesh = mesh;
    document.materials[0].emissive = {1, 1, 1};
    document.materials[0].transmission = 1.0f;
    document.materials[0].normalMap.image =
        std::make_shared<const Image>(1, 1, 3, PixelType::U8, ColorEncoding::Data);
    EXPECT_EQ(inapplicable(document), sum({kOfLights, kOfBakes}));

    // Bakes: of this mesh, with as many values as it has vertices; with bounces.
    const Id id = document.meshes[0].id;
    document.bakes = {bakeOf(id, 3, 4, TransferKind::Shadowed)};
    EXPECT_EQ(inapplicable(document), sum({kOfLights, {"interreflected"}}));
    document.bakes = {bakeOf(id, 3, 4, TransferKind::Interreflected)};
    EXPECT_EQ(inapplicable(document), kOfLights);
    document.bakes = {bakeOf(id, 3, 1, TransferKind::Interreflected)};
    EXPECT_EQ(inapplicable(document), sum({kOfLights, {"bentNormal"}})) << "one band";
    document.bakes = {bakeOf(id, 4, 4, TransferKind::Interreflected)};
    EXPECT_EQ(inapplicable(document), sum({kOfLights, kOfBakes})) << "another mesh's";
    document.bakes = {bakeOf(id + 99, 3, 4, TransferKind::Interreflected)};
    EXPECT_EQ(inapplicable(document), sum({kOfLights, kOfBakes})) << "another mesh's";
    EXPECT_EQ(viewRemedy(shading::kViewShadowedLight, document), ViewRemedy::BakeTransfer);
}

TEST(Views, SayWhatWouldMakeThemApply) {
    Document document = triangleInGreySky();
    EXPECT_EQ(viewRemedy(shading::kViewFinal, document), ViewRemedy::None);
    EXPECT_EQ(viewRemedy(shading::kViewNormalMap, document), ViewRemedy::None);
    EXPECT_EQ(viewRemedy(shading::kViewDirect, document), ViewRemedy::AddLight);
    EXPECT_EQ(viewRemedy(shading::kViewBentNormal, document), ViewRemedy::BakeTransfer);
    EXPECT_EQ(viewRemedy(shading::kViewInterreflectedLight, document), ViewRemedy::BakeBounces);
    document.bakes = {bakeOf(document.meshes[0].id, 3, 4, TransferKind::Shadowed)};
    EXPECT_EQ(viewRemedy(shading::kViewBentNormal, document), ViewRemedy::None);
    EXPECT_EQ(viewRemedy(shading::kViewInterreflectedLight, document), ViewRemedy::BakeBounces);
}

} // namespace
