// What "Compare with saved" lists.

#include "core/edit/DocumentDifference.h"
#include "core/edit/Edit.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/scene/Scene.h"

#include <gmock/gmock.h>

namespace patina {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(DocumentDifference, EqualDocumentsHaveNone) {
    const Document document = startDocument();
    EXPECT_THAT(differences(document, document), IsEmpty());
}

TEST(DocumentDifference, NamesElementValueAndBothNumbers) {
    const Document before = startDocument();
    Document after = before;
    after.materials.front().name = "Gold";
    after.materials.front().perceptualRoughness = 0.25f;
    after.environment().rotationDeg = 30.0f;
    const std::string material = "Material Gold";
    EXPECT_THAT(
        differences(before, after),
        ElementsAre(
            DocumentDifference{material, "Name", before.materials.front().name, "Gold"},
            ::testing::AllOf(
                ::testing::Field(&DocumentDifference::element, material),
                ::testing::Field(&DocumentDifference::value, ::testing::HasSubstr("oughness")),
                ::testing::Field(&DocumentDifference::after, "0.25")),
            ::testing::AllOf(::testing::Field(&DocumentDifference::element, "Environment Studio"),
                             ::testing::Field(&DocumentDifference::before, "0"),
                             ::testing::Field(&DocumentDifference::after, "30"))));
}

TEST(DocumentDifference, ElementsThatOnlyOneHasAreOneLineEach) {
    Document before = startDocument();
    Document after = before;
    Light light;
    light.name = "Key";
    addLight(after, light);
    const Id gone = addMaterial(before, Material{});
    const std::string name = "Material " + before.material(gone)->name;
    EXPECT_THAT(differences(before, after),
                ElementsAre(DocumentDifference{name, "", "", "removed"},
                            DocumentDifference{"Light Key", "", "", "added"}));
}

} // namespace
} // namespace patina
