// Walls of cells and what they compare.
#include "core/cells/WallAxes.h"
#include "core/document/ViewChoices.h"
#include "core/edit/Edit.h"
#include "core/light/Light.h"
#include "core/material/Material.h"

#include <gmock/gmock.h>

namespace patina {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

WallAxis axisOf(std::size_t count, const char* parameter = "view.exposureEv") {
    WallAxis axis{"Axis", {}};
    for (std::size_t i = 0; i < count; ++i) {
        WallEntry entry{std::to_string(i), {}};
        entry.cell.own.push_back(
            {{Scope::View, 0}, findParameter(parameter), 0.1f * static_cast<float>(i + 1)});
        axis.entries.push_back(std::move(entry));
    }
    return axis;
}

std::vector<std::string> captions(const WallAxis& axis) {
    std::vector<std::string> result;
    for (const WallEntry& entry : axis.entries)
        result.push_back(entry.caption);
    return result;
}

std::vector<float> numbers(const WallAxis& axis) {
    std::vector<float> result;
    for (const WallEntry& entry : axis.entries)
        result.push_back(std::get<float>(entry.cell.own.front().value));
    return result;
}

Document scene() {
    Document document;
    for (const char* name : {"Body", "Base"}) {
        Material material;
        material.name = name;
        MeshInstance mesh;
        mesh.id = document.takeId();
        mesh.name = name;
        mesh.material = addMaterial(document, material);
        document.meshes.push_back(mesh);
    }
    return document;
}

TEST(Wall, OneAxisWrapsIntoRowsAsFullAsEachOther) {
    for (const auto& [count, width, height] : {std::tuple(1u, 1u, 1u),
                                               {3u, 3u, 1u},
                                               {6u, 6u, 1u},
                                               {7u, 4u, 2u},
                                               {8u, 4u, 2u},
                                               {12u, 6u, 2u},
                                               {13u, 5u, 3u},
                                               {48u, 6u, 8u},
                                               {49u, 7u, 7u},
                                               {64u, 8u, 8u}}) {
        const Result<Wall> wall = makeWall({axisOf(count)});
        ASSERT_TRUE(wall.ok()) << count << ": " << wall.error().message;
        EXPECT_EQ(wall->width, width) << count;
        EXPECT_EQ(wall->height, height) << count;
        const std::vector<WallCell> cells = cellsOf(*wall);
        ASSERT_EQ(cells.size(), count);
        for (std::size_t i = 0; i < count; ++i)
            EXPECT_EQ(cells[i].row * width + cells[i].column, i);
    }
    const Result<Wall> narrow = makeWall({axisOf(7)}, 2);
    ASSERT_TRUE(narrow.ok());
    EXPECT_EQ(narrow->width, 2u);
    EXPECT_EQ(narrow->height, 4u);
    EXPECT_EQ(makeWall({axisOf(3)}, 8)->width, 3u) << "no empty columns";
}

TEST(Wall, TwoAxesAreColumnsAndRows) {
    const Result<Wall> wall = makeWall({axisOf(3), axisOf(2, "view.reflectionMix")});
    ASSERT_TRUE(wall.ok());
    const std::vector<WallCell> cells = cellsOf(*wall);
    ASSERT_EQ(cells.size(), 6u);
    EXPECT_EQ(cells[4].column, 1u);
    EXPECT_EQ(cells[4].row, 1u);
    EXPECT_THAT(cells[4].captions, ElementsAre("1", "1"));
    const Result<Document> shown = documentOf({}, cells[5].cell);
    EXPECT_FLOAT_EQ(shown->view.exposureEv, 0.3f);
    EXPECT_FLOAT_EQ(shown->view.reflectionMix, 0.2f);
}

TEST(Wall, WhatDoesNotFitIsRefused) {
    const auto message = [](std::vector<WallAxis> axes, std::size_t width = 0) {
        const Result<Wall> wall = makeWall(std::move(axes), width);
        EXPECT_FALSE(wall.ok());
        return wall.ok() ? std::string() : wall.error().message;
    };
    EXPECT_THAT(message({}), HasSubstr("choose what the columns or rows compare"));
    EXPECT_THAT(message({axisOf(2), axisOf(2), axisOf(2)}), HasSubstr("not 3"));
    EXPECT_THAT(message({axisOf(0)}), HasSubstr("nothing to show"));
    EXPECT_THAT(message({axisOf(9), axisOf(2, "view.reflectionMix")}), HasSubstr("9 × 2"));
    EXPECT_THAT(message({axisOf(2), axisOf(9, "view.reflectionMix")}), HasSubstr("2 × 9"));
    EXPECT_THAT(message({axisOf(65)}), HasSubstr("8 × 8"));
    EXPECT_THAT(message({axisOf(20)}, 2), HasSubstr("2 × 10"));
    EXPECT_THAT(message({axisOf(2), axisOf(3)}), HasSubstr("view.exposureEv"))
        << "both would set it";
}

TEST(Wall, CaptionsThatAreSharedAreNumbered) {
    WallAxis axis = axisOf(3);
    for (WallEntry& entry : axis.entries)
        entry.caption = "studio";
    EXPECT_THAT(captions(makeWall({axis})->columns),
                ElementsAre("studio", "studio (2)", "studio (3)"));
}

TEST(WallAxes, AWedgeHasBothItsEnds) {
    const Document document = scene();
    const Result<Wedge> wedge = parseWedge("material.perceptualRoughness=0:1:5");
    ASSERT_TRUE(wedge.ok());
    const Result<WallAxis> axis = wedgeAxis(document, *wedge);
    ASSERT_TRUE(axis.ok());
    EXPECT_EQ(axis->title, "Roughness of all materials");
    EXPECT_THAT(numbers(*axis), ElementsAre(0.0f, 0.25f, 0.5f, 0.75f, 1.0f));
    EXPECT_THAT(captions(*axis), ElementsAre("0.00", "0.25", "0.50", "0.75", "1.00"));
    EXPECT_EQ(axis->entries[0].cell.own.size(), 2u) << "of both materials";

    const auto texts = [&](const char* text) {
        return captions(*wedgeAxis(document, *parseWedge(text)));
    };
    EXPECT_THAT(texts("material.metallic=0:1:4"), ElementsAre("0.00", "0.33", "0.67", "1.00"));
    EXPECT_THAT(texts("environment.rotationDeg=0:90:3"), ElementsAre("0°", "45°", "90°"));
    EXPECT_THAT(texts("view.exposureEv=1:-1:3"), ElementsAre("1 EV", "0 EV", "-1 EV"));
    EXPECT_THAT(texts("view.exposureEv=0:0.001:3"),
                ElementsAre("0.0000 EV", "0.0005 EV", "0.0010 EV"));
    const Result<WallAxis> named =
        wedgeAxis(document, *parseWedge("material[Body].metallic=0:1:2"));
    ASSERT_TRUE(named.ok());
    EXPECT_EQ(named->title, "Metallic of Body");
    EXPECT_EQ(named->entries[0].cell.own.size(), 1u);
    // The ends are what was typed, bit for bit.
    const Result<WallAxis> odd = wedgeAxis(document, *parseWedge("material.metallic=0.1:0.7:7"));
    EXPECT_EQ(numbers(*odd).front(), 0.1f);
    EXPECT_EQ(numbers(*odd).back(), 0.7f);
    // Angles go round.
    EXPECT_TRUE(wedgeAxis(document, *parseWedge("environment.rotationDeg=0:720:8")).ok());
}

TEST(WallAxes, WrongWedgesAreRefused) {
    for (const char* text :
         {"", "=0:1:2", "view.exposureEv", "view.exposureEv=", "view.exposureEv=0:1",
          "view.exposureEv=0:1:2:3", "view.exposureEv=a:1:2", "view.exposureEv=0:1:2.5",
          "view.exposureEv=0:1:1", "view.exposureEv=0:1:65", "view.exposureEv=1:1:3",
          "view.exposureEv=0:1:-2", "view.exposureEv=nan:1:2", "view.exposureEv=0:inf:2",
          "view.exposureEv=0:1:3 ", "view.exposureEv=::"})
        EXPECT_FALSE(parseWedge(text).ok()) << text;
    // A name may hold what wedges are written with.
    EXPECT_EQ(parseWedge("light[a=1:2].intensity=0:1:2")->parameter, "light[a=1:2].intensity");

    const Document document = scene();
    const auto message = [&](const char* text) {
        const Result<WallAxis> axis = wedgeAxis(document, *parseWedge(text));
        EXPECT_FALSE(axis.ok()) << text;
        return axis.ok() ? std::string() : axis.error().message;
    };
    EXPECT_THAT(message("material.roughnes=0:1:2"), HasSubstr("did you mean"));
    EXPECT_THAT(message("material[Nobody].metallic=0:1:2"), HasSubstr("Body"));
    EXPECT_THAT(message("material.metallic=0:2:3"), HasSubstr("from 0 to 1"));
    EXPECT_THAT(message("material.metallic=-0.5:1:3"), HasSubstr("-0.5"));
    EXPECT_THAT(message("material.baseColor=0:1:3"), HasSubstr("a wedge is of numbers"));
    EXPECT_THAT(message("view.toneMap=0:1:2"), HasSubstr("a wedge is of numbers"));
    EXPECT_THAT(message("material.doubleSided=0:1:2"), HasSubstr("a wedge is of numbers"));
    EXPECT_THAT(message("light.intensity=0:1:2"), HasSubstr("the scene has no light"));
}

TEST(WallAxes, MaterialsComeFromTheSceneOrTheLibrary) {
    Document document = scene();
    const std::size_t before = document.materials.size();
    const Result<Id> body = materialNamed(document, "Body"), gold = materialNamed(document, "gold");
    ASSERT_TRUE(body.ok() && gold.ok());
    EXPECT_EQ(document.material(*body)->name, "Body");
    EXPECT_EQ(document.materials.size(), before + 1);
    EXPECT_EQ(document.material(*gold)->metallic, 1.0f);
    EXPECT_TRUE(materialNamed(document, "builtin:wood").ok());
    const Result<Id> none = materialNamed(document, "marzipan");
    ASSERT_FALSE(none.ok());
    EXPECT_THAT(none.error().message, HasSubstr("\"marzipan\""));
    EXPECT_THAT(none.error().message, HasSubstr("\"Body\""));
    EXPECT_THAT(none.error().message, HasSubstr("brushed-steel"));
    EXPECT_FALSE(materialNamed(document, "builtin:Body").ok());

    document.meshes[1].visible = false;
    const std::vector<Id> ids{*body, *gold}, hidden{document.meshes[1].id};
    const WallAxis axis = materialAxis(document, ids);
    ASSERT_EQ(axis.entries[1].cell.own.size(), 1u) << "visible meshes";
    EXPECT_EQ(documentOf(document, axis.entries[1].cell)->meshes[0].material, *gold);
    const WallAxis named = materialAxis(document, ids, hidden);
    EXPECT_EQ(documentOf(document, named.entries[1].cell)->meshes[1].material, *gold);
    EXPECT_EQ(documentOf(document, named.entries[1].cell)->meshes[0].material,
              document.meshes[0].material);
}

TEST(WallAxes, ChoicesAreNamedAsInFilesAndShownAsInPanels) {
    const Document document = scene();
    const std::vector<std::string> two{"cosine", "shIrradiance"}, wrong{"ibl", "sunny"};
    const Result<WallAxis> axis = choiceAxis(document, "view.lighting", two);
    ASSERT_TRUE(axis.ok());
    EXPECT_EQ(axis->title, "Lighting");
    EXPECT_EQ(documentOf(document, axis->entries[0].cell)->view.lighting, LightingMode::Cosine);
    EXPECT_EQ(axis->entries[0].caption,
              findParameter("view.lighting")->choiceLabels[static_cast<int>(LightingMode::Cosine)]);
    const Result<WallAxis> none = choiceAxis(document, "view.lighting", wrong);
    ASSERT_FALSE(none.ok());
    EXPECT_THAT(none.error().message, HasSubstr("cosine"));
    EXPECT_FALSE(choiceAxis(document, "view.exposureEv", two).ok());
}

TEST(WallAxes, EnvironmentsHaveTheirTitles) {
    Document document = scene();
    Environment sky;
    sky.source = "/pictures/evening.hdr";
    const std::vector<Id> ids{document.mix.first, addEnvironment(document, sky)};
    const WallAxis axis = environmentAxis(document, ids);
    EXPECT_THAT(captions(axis), ElementsAre("Studio", "evening"));
    EXPECT_EQ(axis.entries[1].cell.environment, ids[1]);
}

} // namespace
} // namespace patina
