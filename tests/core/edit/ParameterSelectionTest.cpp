#include "core/document/Document.h"
#include "core/edit/Edit.h"
#include "core/edit/Parameters.h"
#include "core/light/Light.h"
#include "core/material/Material.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace patina;
using testing::HasSubstr;

namespace {

Document scene() {
    Document document;
    for (const char* name : {"Body", "Glass", "Body", "odd].[name].x"}) {
        Material& material = document.materials.emplace_back();
        material.id = document.takeId();
        material.name = name;
    }
    Light& sun = document.lights.emplace_back();
    sun.id = document.takeId();
    sun.name = "Sun";
    return document;
}

std::vector<Target> targets(const Document& document, const std::string& name) {
    Result<ParameterSelection> selection = selectParameter(document, name);
    EXPECT_TRUE(selection.ok()) << name << ": " << (selection.ok() ? "" : selection.error().text());
    return selection.ok() ? selection->targets : std::vector<Target>{};
}

std::string refusal(const Document& document, const std::string& name) {
    const Result<ParameterSelection> selection = selectParameter(document, name);
    EXPECT_FALSE(selection.ok()) << name;
    if (selection.ok())
        return {};
    EXPECT_EQ(selection.error().kind, ErrorKind::Usage) << name;
    return selection.error().message;
}

} // namespace

TEST(ParameterSelection, ANameAloneMeansEveryElement) {
    const Document document = scene();
    EXPECT_EQ(targets(document, "material.metallic"), (std::vector<Target>{{Scope::Material, 2},
                                                                           {Scope::Material, 3},
                                                                           {Scope::Material, 4},
                                                                           {Scope::Material, 5}}));
    EXPECT_EQ(targets(document, "light.intensity"), (std::vector<Target>{{Scope::Light, 6}}));
    EXPECT_EQ(targets(document, "view.toneMap"), (std::vector<Target>{{Scope::View, 0}}));
    EXPECT_EQ(targets(document, "environment.rotationDeg"),
              (std::vector<Target>{{Scope::Environment, 0}}));
}

TEST(ParameterSelection, BracketsChooseByName) {
    const Document document = scene();
    EXPECT_EQ(targets(document, "material[Body].metallic"),
              (std::vector<Target>{{Scope::Material, 2}, {Scope::Material, 4}}));
    EXPECT_EQ(targets(document, "material[Glass].baseColor.map"),
              (std::vector<Target>{{Scope::Material, 3}}));
    EXPECT_EQ(targets(document, "material[odd].[name].x].opacity"),
              (std::vector<Target>{{Scope::Material, 5}}));
    EXPECT_EQ(targets(document, "light[Sun].intensity"), (std::vector<Target>{{Scope::Light, 6}}));
    EXPECT_EQ(selectParameter(document, "material[Body].roughness")->info,
              findParameter("material.perceptualRoughness"));
}

// Of environments a name alone means the one that lights the scene.
TEST(ParameterSelection, EnvironmentsAreFoundByTitleAndByTheirPlaceInTheMix) {
    Document document = scene();
    const Id first = document.mix.first;
    EXPECT_THAT(refusal(document, "environment.secondTint"), HasSubstr("environment.second"));
    Environment night;
    night.source = "builtin:night";
    const Id second = document.mix.second = addEnvironment(document, night);
    EXPECT_EQ(targets(document, "environment.tint"),
              (std::vector<Target>{{Scope::Environment, 0}}));
    EXPECT_EQ(targets(document, "environment.secondTint"),
              (std::vector<Target>{{Scope::Environment, second}}));
    EXPECT_EQ(targets(document, "environment[Night].skySunScale"),
              (std::vector<Target>{{Scope::Environment, second}}));
    document.environments[1].name = "Evening";
    EXPECT_EQ(targets(document, "environment[Evening].rotationDeg"),
              (std::vector<Target>{{Scope::Environment, second}}));
    EXPECT_EQ(targets(document, "environment[Studio].rotationDeg"),
              (std::vector<Target>{{Scope::Environment, first}}));
    EXPECT_THAT(refusal(document, "environment[Night].tint"), HasSubstr("Evening"));
    EXPECT_THAT(refusal(document, "environment[Evening].fade"), HasSubstr("without brackets"));
    EXPECT_THAT(refusal(document, "environment.secondFade"), HasSubstr("no parameter"));
}

TEST(ParameterSelection, UnknownNamesSuggestTheNearest) {
    const Document document = scene();
    EXPECT_THAT(refusal(document, "material.metalic"), HasSubstr("material.metallic"));
    EXPECT_THAT(refusal(document, "metallic"), HasSubstr("material.metallic"));
    EXPECT_THAT(refusal(document, "view.tonemap"), HasSubstr("view.toneMap"));
    EXPECT_THAT(refusal(document, "material[Boby].metallic"), HasSubstr("Body"));
    EXPECT_THAT(refusal(document, "light[sun].intensity"), HasSubstr("Sun"));
    EXPECT_THAT(refusal(document, "mesh.visible"), HasSubstr("no mesh"));
    EXPECT_THAT(refusal(document, "view[x].toneMap"), HasSubstr("view.toneMap"));
}

TEST(ParameterSelection, OddNamesAreRefusedCleanly) {
    const Document document = scene();
    for (const std::string& name :
         {std::string(), std::string("["), std::string("]."), std::string("].["),
          std::string("material[Body]"), std::string("material[Body.metallic"),
          std::string("material[].metallic"), std::string(100'000, 'x'),
          std::string("material\0.metallic", 18), std::string("\xff\xfe")})
        EXPECT_FALSE(refusal(document, name).empty());
}
