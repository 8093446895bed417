#include "core/edit/Edit.h"
#include "core/light/Light.h"
#include "core/material/Material.h"

#include "core/bake/Bake.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/document/Dirty.h"
#include "core/light/Lights.h"
#include "tests/core/document/RandomDocument.h"

#include <cmath>
#include <gtest/gtest.h>
#include <set>

using namespace patina;

namespace {

std::set<Id> allIds(const Document& document) {
    std::set<Id> ids;
    std::size_t count = 0;
    const auto collect = [&](const auto& elements) {
        for (const auto& element : elements) {
            ids.insert(element.id);
            ++count;
        }
    };
    collect(document.materials);
    collect(document.lights);
    collect(document.meshes);
    collect(document.environment().softboxes);
    EXPECT_EQ(ids.size(), count) << "ids are not unique";
    return ids;
}

BakeArtifactPtr bake(BakeKind kind, int samples) {
    BakeArtifact artifact;
    artifact.kind = kind;
    artifact.samplesDone = samples;
    return std::make_shared<const BakeArtifact>(artifact);
}

} // namespace

TEST(Edit, RandomEditsKeepThePromisesOfADocument) {
    for (std::uint32_t seed = 1; seed <= 60; ++seed) {
        RandomDocument random(seed);
        Document document = random.make();
        for (int step = 0; step < 60; ++step) {
            const auto pick = [&](const auto& elements) {
                return elements.empty() ? Id{0} : elements[random.below(elements.size())].id;
            };
            const Id material = pick(document.materials), light = pick(document.lights),
                     mesh = pick(document.meshes), softbox = pick(document.environment().softboxes);
            switch (random.below(11)) {
            case 0:
                addMaterial(document, {});
                break;
            case 1:
                addLight(document, {});
                break;
            case 2:
                if (material != 0)
                    duplicateMaterial(document, material);
                break;
            case 3:
                EXPECT_EQ(removeMaterial(document, material), material != 0);
                break;
            case 4:
                EXPECT_EQ(removeLight(document, light), light != 0);
                break;
            case 5:
                EXPECT_EQ(removeMesh(document, mesh), mesh != 0);
                break;
            case 6:
                EXPECT_NE(addSoftbox(document, {}), 0u);
                break;
            case 7:
                EXPECT_EQ(softbox != 0 && duplicateSoftbox(document, softbox) != 0, softbox != 0);
                break;
            case 8:
                EXPECT_EQ(removeSoftbox(document, softbox), softbox != 0);
                break;
            default: {
                const ParameterInfo& info = parameters()[random.below(parameters().size())];
                const Target target{info.scope, info.scope == Scope::Material  ? material
                                                : info.scope == Scope::Light   ? light
                                                : info.scope == Scope::Mesh    ? mesh
                                                : info.scope == Scope::Softbox ? softbox
                                                                               : 0};
                const bool exists = targetExists(document, target);
                const Document before = document;
                const ParameterValue value = random.value(info, document);
                const Result<Change> change = applyParameter(document, info, target, value);
                ASSERT_EQ(change.ok(), exists) << "seed " << seed;
                if (!exists)
                    break;
                EXPECT_EQ(change->target, target);
                // What a change does not say it affects is as it was.
                if (!touches(change->affects, Affects::Picture | Affects::Geometry |
                                                  Affects::EnvironmentMap | Affects::Structure)) {
                    EXPECT_FALSE(dirtyBetween(before, document).any())
                        << info.id << " seed " << seed;
                }
                if (!touches(change->affects, Affects::Bakes | Affects::Geometry)) {
                    EXPECT_EQ(hashBakeInputs(bakeInputs(document)),
                              hashBakeInputs(bakeInputs(before)))
                        << info.id << " seed " << seed;
                }
                // Said twice, it is said once.
                Document twice = document;
                ASSERT_TRUE(applyParameter(twice, info, target, value).ok());
                EXPECT_EQ(twice, document) << info.id << " seed " << seed;
                // Counts: the table takes the nearest whole number.
                const bool whole =
                    info.id == "view.bounces" || info.id == "view.radiosityRays" ||
                    info.id == "view.radiosityCells" || info.id == "view.radiosityPairs" ||
                    info.id == "view.radiosityTexels" || info.id == "environment.removedSources";
                EXPECT_EQ(info.get(document, target.id),
                          whole ? ParameterValue(std::round(std::get<float>(value))) : value)
                    << info.id << " seed " << seed;
            }
            }
            for (const Id id : allIds(document))
                ASSERT_LT(id, document.nextId) << "seed " << seed;
            for (const MeshInstance& instance : document.meshes)
                ASSERT_TRUE(instance.material == 0 || document.material(instance.material))
                    << "seed " << seed;
        }
    }
}

TEST(Edit, ARefusedEditChangesNothing) {
    Document document = RandomDocument(3).make();
    addMaterial(document, {});
    MeshInstance& mesh = document.meshes.emplace_back();
    mesh.id = document.takeId();
    const Document before = document;
    const ParameterInfo& metallic = *findParameter("material.metallic");
    const Id light = document.lights.empty() ? 0 : document.lights[0].id;
    EXPECT_FALSE(applyParameter(document, metallic, {Scope::Material, 999'999}, 1.0f).ok());
    EXPECT_FALSE(applyParameter(document, metallic, {Scope::Light, light}, 1.0f).ok());
    EXPECT_FALSE(applyParameter(document, *findParameter("mesh.material"),
                                {Scope::Mesh, document.meshes.back().id}, 999'999)
                     .ok());
    EXPECT_TRUE(document == before);
}

TEST(Edit, NamesStayUnique) {
    Document document;
    Light sun;
    sun.name = "Sun";
    const Id first = addLight(document, sun), second = addLight(document, sun);
    EXPECT_NE(first, second);
    EXPECT_EQ(document.light(second)->name, "Sun 2");
    const Id third = duplicateLight(document, second);
    EXPECT_EQ(document.light(third)->name, "Sun 3");
    EXPECT_EQ(document.lights[2].id, third); // directly below its original
    const Id fourth = duplicateLight(document, first);
    EXPECT_EQ(document.light(fourth)->name, "Sun 4");
    EXPECT_EQ(document.lights[1].id, fourth);
    EXPECT_EQ(uniqueLightName(document, "Moon"), "Moon");
    EXPECT_EQ(uniqueMaterialName(document, "2001"), "2001");
}

TEST(Edit, SoftboxesAreNamedDuplicatedAndLimited) {
    Document document;
    Softbox key;
    key.name = "Key";
    key.widthDeg = 77.0f;
    const Id first = addSoftbox(document, key), second = duplicateSoftbox(document, first);
    EXPECT_EQ(document.softbox(second)->name, "Key 2");
    EXPECT_EQ(document.softbox(second)->widthDeg, 77.0f);
    EXPECT_EQ(document.environment().softboxes[1].id, second);
    EXPECT_TRUE(removeSoftbox(document, first));
    EXPECT_FALSE(removeSoftbox(document, first));
    while (document.environment().softboxes.size() < kMaxSoftboxes)
        ASSERT_NE(addSoftbox(document, {}), 0u);
    EXPECT_EQ(addSoftbox(document, {}), 0u);
    EXPECT_EQ(duplicateSoftbox(document, second), 0u);
    EXPECT_EQ(document.environment().softboxes.size(), kMaxSoftboxes);
}

TEST(Edit, MeshesOfARemovedMaterialTakeAnother) {
    Document document;
    const Id a = addMaterial(document, {}), b = addMaterial(document, {});
    MeshInstance& mesh = document.meshes.emplace_back();
    mesh.id = document.takeId();
    mesh.material = b;
    EXPECT_TRUE(removeMaterial(document, b));
    EXPECT_EQ(document.meshes[0].material, a);
    EXPECT_TRUE(removeMaterial(document, a));
    ASSERT_EQ(document.materials.size(), 1u);
    EXPECT_EQ(document.meshes[0].material, document.materials[0].id);
    EXPECT_GT(document.materials[0].id, b);
    EXPECT_FALSE(removeMaterial(document, a));
}

// Set by a panel or by --set: what the light does to the middle of the scene stays.
TEST(Edit, ALightThatBecomesAnotherTypeIsConverted) {
    Document document;
    const Id id = addLight(document, {});
    const ParameterInfo& type = *findParameter("light.type");
    const Target target{Scope::Light, id};
    const Light before = *document.light(id);
    for (const ParameterEdit& edit :
         editsFor(document, type, target, static_cast<int>(LightType::Point)))
        ASSERT_TRUE(applyParameter(document, *edit.info, target, edit.value));
    EXPECT_EQ(*document.light(id), convertedLight(before, LightType::Point, document.bounds()));
    EXPECT_NE(document.light(id)->intensity, before.intensity);
    // Any other number comes alone, in its range.
    const auto edits = editsFor(document, *findParameter("light.elevationDeg"), target, 1e6f);
    ASSERT_EQ(edits.size(), 1u);
    EXPECT_EQ(edits[0].value, ParameterValue(90.0f));
}

TEST(Edit, TheFirstMapSetsItsNumberToNeutral) {
    Document document;
    const Id id = addMaterial(document, {});
    const Target target{Scope::Material, id};
    MapSlot slot;
    slot.source = "/metal.png";
    const ParameterInfo& map = *findParameter("material.metallic.map");
    const auto apply = [&](const std::vector<ParameterEdit>& edits) {
        for (const ParameterEdit& edit : edits)
            EXPECT_TRUE(applyParameter(document, *edit.info, target, edit.value).ok());
    };
    apply(editsForMap(document, map, target, slot));
    EXPECT_EQ(document.material(id)->metallic, 1.0f);
    EXPECT_EQ(document.material(id)->metallicMap.source, "/metal.png");
    // Another map in its place, or none, leaves the number as the artist set it.
    document.material(id)->metallic = 0.5f;
    slot.source = "/other.png";
    apply(editsForMap(document, map, target, slot));
    apply(editsForMap(document, map, target, {}));
    EXPECT_EQ(document.material(id)->metallic, 0.5f);
    EXPECT_FALSE(document.material(id)->metallicMap.assigned());
    apply(editsForMap(document, *findParameter("material.baseColor.map"), target, slot));
    EXPECT_EQ(document.material(id)->baseColor, glm::vec3(1.0f));
    const ParameterInfo& environment = *findParameter("environment.image");
    EXPECT_EQ(editsForMap(document, environment, {Scope::Environment, 0}, slot).size(), 1u);
}

TEST(Edit, ALookComesWithoutItsNameAndId) {
    Document document;
    Material body;
    body.name = "Body";
    const Id id = addMaterial(document, body);
    Material gold;
    gold.id = 77;
    gold.name = "Gold";
    gold.metallic = 1.0f;
    replaceLook(document, id, gold);
    EXPECT_EQ(document.material(id)->name, "Body");
    EXPECT_EQ(document.material(id)->metallic, 1.0f);
}

TEST(Edit, OneBakeOfEachKind) {
    Document document;
    attachBake(document, bake(BakeKind::AoTexel, 1));
    attachBake(document, bake(BakeKind::PrtVertex, 2));
    attachBake(document, bake(BakeKind::AoTexel, 3));
    ASSERT_EQ(document.bakes.size(), 2u);
    EXPECT_EQ(findBake(document, BakeKind::AoTexel)->samplesDone, 3);
    EXPECT_EQ(findBake(document, BakeKind::AoVertex), nullptr);
    EXPECT_TRUE(removeBake(document, BakeKind::AoTexel));
    EXPECT_FALSE(removeBake(document, BakeKind::AoTexel));
    EXPECT_EQ(document.bakes.size(), 1u);
}
