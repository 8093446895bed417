#include "core/edit/MapNames.h"

#include "core/material/MaterialInputs.h"

#include <gtest/gtest.h>
#include <sstream>

namespace patina {
namespace {

std::string map(std::string_view fileName) {
    const ParameterInfo* info = mapForFileName(fileName);
    return info ? std::string(info->label) : std::string();
}

TEST(MapNames, PlainWordsNameTheMap) {
    for (const char* name :
         {"monkey_color.png", "color.png", "T_Brick_BaseColor.tga", "wood-base-color-2k.jpg",
          "Rust_Albedo.png", "fabric_diff_4k.jpg", "/some/normal/folder/Wood_Col.png"})
        EXPECT_EQ(map(name), "Base colour map") << name;
    for (const char* name : {"metallic.png", "HelmetMetalness.png", "iron_metal.png"})
        EXPECT_EQ(map(name), "Metallic map") << name;
    for (const char* name : {"roughness.png", "rusty_metal_roughness_1k.png", "Wall_Rough.exr"})
        EXPECT_EQ(map(name), "Roughness map") << name;
    for (const char* name : {"normal.png", "brick_nor_gl_2k.exr", "T_Wall_NRM.png",
                             "Wood_NormalGL.png", "rough_wood_normal.jpg"})
        EXPECT_EQ(map(name), "Normal map") << name;
    for (const char* name :
         {"ao.png", "Brick_AmbientOcclusion.png", "wall_ambient_occlusion.png", "T_Brick_AO.tga"})
        EXPECT_EQ(map(name), "Occlusion map") << name;
    for (const char* name : {"emissive.png", "lamp_Emission.png", "sign_glow.png"})
        EXPECT_EQ(map(name), "Emission map") << name;
}

TEST(MapNames, EveryWordOfTheInputsNamesItsMap) {
    for (const MaterialInputInfo& input : kMaterialInputs)
        for (const std::string_view words : {input.fileWords, input.weakFileWords}) {
            std::istringstream rest{std::string(words)};
            for (std::string word; rest >> word;)
                EXPECT_EQ(map("T_" + word + "_2k.png"), input.parameters.mapLabel) << word;
        }
}

TEST(MapNames, OtherWordsAndPackedFilesNameNone) {
    for (const char* name :
         {"photo.png", "colorful.png", "abnormal.png", "IMG_0001.jpg", "helmet_ORM.png", "",
          "occlusionRoughnessMetallic.png", "Metallic-Roughness.png", "normal/photo.png", ".png"})
        EXPECT_EQ(map(name), "") << name;
}

} // namespace
} // namespace patina
