// What has to be renewed after an edit, bit by bit: neither too little nor too much.

#include "core/document/Dirty.h"
#include "core/edit/Edit.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "tests/core/document/RandomDocument.h"

#include <functional>
#include <gmock/gmock.h>
#include <utility>

using namespace patina;
using testing::ElementsAre;
using testing::IsEmpty;

namespace {

MeshPtr triangle() {
    static const MeshPtr kTriangle = [] {
        Mesh mesh;
        mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}};
        mesh.indices = {0, 1, 2};
        return std::make_shared<const Mesh>(std::move(mesh));
    }();
    return kTriangle;
}

// Meshes 1 and 2 in the materials 3 and 4, the light 5.
Document scene() {
    Document document;
    for (const Id id : {Id{1}, Id{2}}) {
        MeshInstance& mesh = document.meshes.emplace_back();
        mesh.id = id;
        mesh.material = id + 2;
        mesh.mesh = triangle();
    }
    document.materials.emplace_back().id = 3;
    document.materials.emplace_back().id = 4;
    document.lights.emplace_back().id = 5;
    document.nextId = 6;
    return document;
}

// The bits by name; materials as they are listed.
std::vector<std::string> bits(const Dirty& d) {
    std::vector<std::string> names;
    for (const auto& [on, name] : {std::pair(d.model, "model"),
                                   {d.lights, "lights"},
                                   {d.environment, "environment"},
                                   {d.view, "view"},
                                   {d.bakes, "bakes"},
                                   {d.instances, "instances"},
                                   {d.casters, "casters"},
                                   {d.places, "places"},
                                   {d.materialSet, "materialSet"}})
        if (on)
            names.emplace_back(name);
    for (const Id id : d.materials)
        names.push_back("material " + std::to_string(id));
    return names;
}

std::vector<std::string> after(const std::function<void(Document&)>& edit) {
    const Document before = scene();
    Document changed = before;
    edit(changed);
    const Dirty dirty = dirtyBetween(before, changed);
    EXPECT_EQ(dirty.any(), !bits(dirty).empty());
    return bits(dirty);
}

} // namespace

TEST(Dirty, NamesSourcesAndTheCameraAreInNoPicture) {
    EXPECT_THAT(after([](Document& d) {
                    d.view.camera.yawDeg += 10.0f;
                    d.materials[0].name = d.meshes[0].name = "Renamed";
                    d.meshes[0].source = "/elsewhere.obj";
                    ++d.nextId;
                }),
                IsEmpty());
}

TEST(Dirty, EachPartHasItsBit) {
    EXPECT_THAT(after([](Document& d) { d.model.f90 = 0.5f; }), ElementsAre("model"));
    EXPECT_THAT(after([](Document& d) { d.lights[0].intensity = 9.0f; }), ElementsAre("lights"));
    EXPECT_THAT(after([](Document& d) { d.lights.clear(); }), ElementsAre("lights"));
    EXPECT_THAT(after([](Document& d) { d.mix.fade = 0.3f; }), ElementsAre("environment"));
    EXPECT_THAT(after([](Document& d) { d.view.exposureEv = 1.0f; }), ElementsAre("view"));
    EXPECT_THAT(after([](Document& d) { d.bakes = {std::make_shared<const BakeArtifact>()}; }),
                ElementsAre("bakes"));
}

TEST(Dirty, OnlyTheMaterialThatChangedIsNamed) {
    EXPECT_THAT(after([](Document& d) { d.materials[1].metallic = 1.0f; }),
                ElementsAre("material 4"));
    EXPECT_THAT(after([](Document& d) {
                    d.materials[0].baseColorMap.image = std::make_shared<const Image>();
                }),
                ElementsAre("material 3"));
    EXPECT_THAT(after([](Document& d) { d.materials[0].doubleSided = true; }),
                ElementsAre("places", "material 3"));
    EXPECT_THAT(after([](Document& d) { d.materials.emplace_back().id = 9; }),
                ElementsAre("materialSet", "material 9"));
    EXPECT_THAT(after([](Document& d) { d.materials.pop_back(); }), ElementsAre("materialSet"))
        << "its mesh shows the default material, which casts alike";
}

TEST(Dirty, ShadowsFollowShapesAndHoles) {
    EXPECT_THAT(after([](Document& d) {
                    d.meshes[0].placement.setPosition({1, 0, 0});
                }),
                ElementsAre("instances", "casters", "places"));
    EXPECT_THAT(after([](Document& d) { d.meshes[0].visible = false; }),
                ElementsAre("instances", "casters", "places"));
    EXPECT_THAT(after([](Document& d) { d.meshes.pop_back(); }),
                ElementsAre("instances", "casters", "places"));
    EXPECT_THAT(after([](Document& d) { d.meshes[0].material = 4; }),
                ElementsAre("instances", "places"))
        << "both are opaque";
    const auto cutOut = [](Document& d) { d.materials[0].alphaMode = AlphaMode::Mask; };
    EXPECT_THAT(after(cutOut), ElementsAre("casters", "material 3"));
    EXPECT_THAT(after([&](Document& d) {
                    cutOut(d);
                    d.meshes[0].material = 4; // nobody shows it
                }),
                ElementsAre("instances", "places", "material 3"));

    // What is opaque again has no holes: its shadow is another.
    Document holes = scene();
    cutOut(holes);
    EXPECT_THAT(bits(dirtyBetween(holes, scene())), ElementsAre("casters", "material 3"));
    Document larger = holes;
    larger.materials[0].opacity = 0.2f;
    EXPECT_THAT(bits(dirtyBetween(holes, larger)), ElementsAre("casters", "material 3"));
    Document gone = holes;
    gone.materials.erase(gone.materials.begin());
    EXPECT_THAT(bits(dirtyBetween(holes, gone)), ElementsAre("casters", "materialSet"));
}

TEST(Dirty, EnvironmentsThatLightNothingAreNotAskedFor) {
    Document before = scene();
    Environment& other = before.environments.emplace_back();
    other.id = before.takeId();
    Document after = before;
    after.environments.back().rotationDeg = 30.0f;
    after.environments.back().name = "Night";
    EXPECT_FALSE(dirtyBetween(before, after).any());
    after.mix.second = after.environments.back().id;
    EXPECT_THAT(bits(dirtyBetween(before, after)), ElementsAre("environment"));
    Document turned = after;
    turned.environments.back().rotationDeg = 60.0f;
    EXPECT_THAT(bits(dirtyBetween(after, turned)), ElementsAre("environment"));
    turned = after;
    turned.environments.back().name = "Evening";
    std::ranges::reverse(turned.environments);
    EXPECT_FALSE(dirtyBetween(after, turned).any());
}

// A parameter that no bit stands for would be edited without a picture of it.
TEST(Dirty, EveryParameterOfPicturesHasABit) {
    RandomDocument random(3);
    for (const ParameterInfo& info : parameters()) {
        const Document before = [&] {
            Document document = scene();
            document.environment().softboxes.emplace_back().id = document.takeId();
            document.environments.emplace_back().id = document.takeId();
            return document;
        }();
        const Id id = info.scope == Scope::Material  ? 3
                      : info.scope == Scope::Mesh    ? 1
                      : info.scope == Scope::Light   ? 5
                      : info.scope == Scope::Softbox ? before.environment().softboxes.front().id
                                                     : 0;
        Document changed = before;
        for (int i = 0; i < 100 && info.get(changed, id) == info.get(before, id); ++i)
            (void)applyParameter(changed, info, {info.scope, id}, random.value(info, before));
        const bool isInPictures = info.id != "material.name" && info.id != "mesh.name" &&
                                  info.id != "environment.name" && info.id != "view.fovDeg" &&
                                  info.id != "view.depthOfField" && info.id != "view.fStop" &&
                                  info.id != "view.focusDistance";
        EXPECT_EQ(dirtyBetween(before, changed).any(), isInPictures) << info.id;
    }
}
