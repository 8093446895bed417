// Snapshots as KHR_materials_variants, checked against the extension's specification: root
// "variants" with names, on primitives "mappings" of a material and of variants, each of which is
// in one mapping at most (github.com/KhronosGroup/glTF, extensions/2.0/Khronos).
#include "core/export/Variants.h"
#include "ExportScene.h"
#include "core/document/Snapshot.h"
#include "core/edit/Edit.h"
#include "core/edit/EditSession.h"
#include "core/edit/Looks.h"
#include "core/light/Light.h"

#include <gmock/gmock.h>
#include <set>

namespace patina::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kVariants = "KHR_materials_variants";

class Variants : public testing::Test {
  protected:
    Variants() {
        Document document;
        red = addMaterial(document, "Red").id;
        document.materials.back().baseColor = {0.9f, 0.1f, 0.1f};
        blue = addMaterial(document, "Blue").id;
        document.materials.back().baseColor = {0.1f, 0.1f, 0.9f};
        const MeshPtr mesh = squareMesh();
        a = addSquare(document, red, mesh).id;
        b = addSquare(document, red, mesh).id;
        c = addSquare(document, blue, mesh).id;
        session.replace(document);
    }
    void set(Id material, const char* name, const ParameterValue& value) {
        session.setParameter(parameter(name), {Scope::Material, material}, value);
    }
    ReadGltf exported(const ExportSettings& settings = glbSettings()) const {
        return write(session.document(), settings);
    }

    // What a reader shows of an instance under a variant, as the extension says.
    static const Json& shown(const Json& gltf, std::size_t node, std::size_t variant) {
        const Json& primitive =
            gltf["meshes"][gltf["nodes"][node]["mesh"].get<std::size_t>()]["primitives"][0];
        std::size_t material = primitive["material"];
        if (primitive.contains("extensions") && primitive["extensions"].contains(kVariants))
            for (const Json& mapping : primitive["extensions"][kVariants]["mappings"])
                for (const Json& one : mapping["variants"])
                    if (one.get<std::size_t>() == variant)
                        material = mapping["material"];
        return gltf["materials"][material];
    }

    static void expectValid(const Json& gltf) {
        ASSERT_THAT(gltf["extensionsUsed"], Contains(kVariants));
        EXPECT_FALSE(gltf.contains("extensionsRequired")) << "programs that do not know it open it";
        const Json& variants = gltf["extensions"][kVariants]["variants"];
        ASSERT_FALSE(variants.empty());
        std::set<std::string> names;
        for (const Json& variant : variants)
            EXPECT_TRUE(names.insert(variant.at("name").get<std::string>()).second);
        for (const Json& mesh : gltf["meshes"])
            for (const Json& primitive : mesh["primitives"]) {
                if (!primitive.contains("extensions"))
                    continue;
                const Json& mappings = primitive["extensions"][kVariants]["mappings"];
                ASSERT_FALSE(mappings.empty());
                std::set<std::size_t> mapped;
                for (const Json& mapping : mappings) {
                    EXPECT_LT(mapping.at("material").get<std::size_t>(), gltf["materials"].size());
                    ASSERT_FALSE(mapping.at("variants").empty());
                    for (const Json& variant : mapping["variants"]) {
                        EXPECT_LT(variant.get<std::size_t>(), variants.size());
                        EXPECT_TRUE(mapped.insert(variant.get<std::size_t>()).second)
                            << "in one mapping at most";
                    }
                }
            }
    }

    EditSession session;
    Id red = 0, blue = 0, a = 0, b = 0, c = 0;
};

TEST_F(Variants, WithoutSnapshotsNothingIsWritten) {
    EXPECT_FALSE(hasMaterialVariants(session.document()));
    const Json without = exported().json;
    session.keepSnapshot("Same", nullptr);
    session.setParameter(parameter("view.exposureEv"), {Scope::View, 0}, 1.0f);
    session.addLight(LightType::Point);
    set(red, "material.name", std::string("Crimson"));
    EXPECT_FALSE(hasMaterialVariants(session.document())) << "no material differs";
    EXPECT_FALSE(exported().json.contains("extensions") &&
                 exported().json["extensions"].contains(kVariants));
    EXPECT_FALSE(without.contains("extensions"));
}

TEST_F(Variants, EachSnapshotIsAVariantOfItsMaterials) {
    session.keepSnapshot("Red", nullptr);
    set(red, "material.baseColor", glm::vec3(0.0f, 1.0f, 0.0f));
    session.keepSnapshot("Green", nullptr);
    session.assignMaterial(b, blue);
    session.keepSnapshot("Mixed \"b\"", nullptr);
    set(red, "material.baseColor", glm::vec3(1.0f));
    ASSERT_TRUE(hasMaterialVariants(session.document()));
    const Json gltf = exported().json;
    expectValid(gltf);
    const Json& variants = gltf["extensions"][kVariants]["variants"];
    ASSERT_EQ(variants.size(), 3u);
    EXPECT_EQ(variants[1]["name"], "Green");

    // Under each variant a reader shows the very materials of the document restored to it.
    for (std::size_t variant = 0; variant < variants.size(); ++variant) {
        Document restored =
            withLook(session.document(), *session.document().snapshots[variant].look);
        restored.snapshots.clear();
        const Json expected = write(restored).json;
        for (std::size_t node = 0; node < 3; ++node) {
            SCOPED_TRACE(testing::Message() << "variant " << variant << " node " << node);
            const std::size_t mesh = expected["nodes"][node]["mesh"];
            Json material =
                expected["materials"]
                        [expected["meshes"][mesh]["primitives"][0]["material"].get<std::size_t>()];
            Json found = shown(gltf, node, variant);
            material.erase("name");
            found.erase("name"); // unique in the file
            EXPECT_EQ(found, material);
        }
    }
    // c is blue in all of them.
    const std::size_t mesh = gltf["nodes"][2]["mesh"];
    EXPECT_FALSE(gltf["meshes"][mesh]["primitives"][0].contains("extensions"));
    EXPECT_EQ(gltf["materials"].size(), 4u) << "white and blue, red and green: each once";
    EXPECT_EQ(gltf["accessors"].size(), exported().json["accessors"].size());
}

TEST_F(Variants, TexturesOfSnapshotsComeAlong) {
    MapSlot bumps = map(codes(1, 1, 3, {128, 128, 255}));
    set(red, "material.normal.map", bumps);
    session.keepSnapshot("Bumps", nullptr);
    set(red, "material.normal.map", MapSlot{});
    const ReadGltf gltf = exported();
    expectValid(gltf.json);
    EXPECT_TRUE(shown(gltf.json, 0, 0).contains("normalTexture"));
    EXPECT_TRUE(gltf.json["meshes"][0]["primitives"][0]["attributes"].contains("TANGENT"))
        << "which the variant's normal map wants";
    EXPECT_EQ(gltf.json["textures"].size(), 1u);
}

TEST_F(Variants, WhatIsGoneOrNewIsAsInTheDocument) {
    session.keepSnapshot("Before", nullptr);
    session.removeMaterial(red); // a and b get blue
    Id later = 0;
    session.editStructure("Add", [&](Document& document) { later = addSquare(document, blue).id; });
    session.setParameter(parameter("mesh.material"), {Scope::Mesh, c}, 0);
    session.keepSnapshot("Bare", nullptr);
    session.assignMaterial(c, blue);
    const Json gltf = exported().json;
    expectValid(gltf);
    EXPECT_EQ(shown(gltf, 0, 0)["name"], "Red") << "removed since";
    const MeshInstance& added = *session.document().mesh(later);
    EXPECT_THAT(variantsOf(session.document(), added), ElementsAre(nullptr, nullptr));
    EXPECT_EQ(shown(gltf, 2, 1)["name"], "Material") << "the default one";
}

TEST_F(Variants, CanBeLeftOutAndAreSaidInThePlan) {
    session.keepSnapshot("Before", nullptr);
    set(red, "material.metallic", 1.0f);
    ExportSettings settings = glbSettings();
    EXPECT_THAT(planExport(session.document(), settings).files[0].contents, HasSubstr("1 variant"));
    settings.includeVariants = false;
    EXPECT_THAT(planExport(session.document(), settings).files[0].contents,
                Not(HasSubstr("variant")));
    const Json gltf = exported(settings).json;
    EXPECT_FALSE(gltf.contains("extensions"));
    EXPECT_EQ(gltf["materials"].size(), 2u);
    // What differs is hidden, and not exported.
    session.setMeshVisible(a, false);
    session.setMeshVisible(b, false);
    EXPECT_FALSE(exported().json.contains("extensions"));
}

} // namespace
} // namespace patina::test
