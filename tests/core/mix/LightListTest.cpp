// What gives light in a document, by name.
#include "core/mix/LightList.h"

#include "core/image/Image.h"
#include "core/light/Light.h"
#include "core/material/Material.h"

#include <gtest/gtest.h>
#include <memory>

namespace patina {
namespace {

// An environment, a lamp and a mesh whose material glows.
Document litDocument() {
    Document document;
    document.environment().image =
        std::make_shared<const Image>(Image(2, 1, 3, PixelType::F32, ColorEncoding::Linear));
    Light lamp;
    lamp.id = document.takeId();
    lamp.name = "Key";
    document.lights.push_back(lamp);
    Material glowing;
    glowing.id = document.takeId();
    glowing.emissive = glm::vec3(1.0f);
    document.materials.push_back(glowing);
    MeshInstance panel;
    panel.id = document.takeId();
    panel.name = "Panel";
    panel.material = glowing.id;
    document.meshes.push_back(panel);
    return document;
}

TEST(LightList, NamesWhatTakesPart) {
    Document document = litDocument();
    EXPECT_EQ(lightNames(document), (std::vector<LightName>{{LightKind::Environment, "Studio"},
                                                            {LightKind::Light, "Key"},
                                                            {LightKind::Glow, "Panel"}}));
    EXPECT_EQ(lightNamesText(lightNames(document)),
              "environment Studio, light Key, glowing mesh Panel");
    EXPECT_TRUE(hasLightOfItsOwn(document));

    document.environment().enabled = false;
    document.meshes[0].visible = false;
    EXPECT_EQ(lightNamesText(lightNames(document)), "light Key");
    document.lights[0].enabled = false;
    EXPECT_EQ(lightNamesText(lightNames(document)), "nothing");
    EXPECT_FALSE(hasLightOfItsOwn(document));
    document.meshes[0].visible = true;
    document.materials[0].emissiveStrength = 0.0f;
    EXPECT_FALSE(hasLightOfItsOwn(document));
}

TEST(LightList, OfManyTellsTheFirst) {
    Document document = litDocument();
    for (int i = 0; i < 9; ++i)
        document.lights.push_back(document.lights[0]);
    EXPECT_EQ(
        lightNamesText(lightNames(document)),
        "environment Studio, light Key, light Key, light Key, light Key, light Key, and 6 more");
}

} // namespace
} // namespace patina
