// patina ladder on built-in scenes.
#include "CommandsFixture.h"

#include <cmath>
#include <filesystem>
#include <fstream>

using namespace patina;
using namespace patina::test;
using testing::HasSubstr;

namespace {

class Ladder : public Commands {
  protected:
    Outcome ladder(const std::vector<std::string>& more, const std::string& name = "ladder.json") {
        std::vector<std::string> arguments{"ladder", "builtin:sphere", "-o", m_folder / name,
                                           "--json", "--order",        "3",  "--rays",
                                           "16"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runPatina(arguments);
    }
    static std::vector<std::string> plain() { // without maps, dull
        std::vector<std::string> sets;
        for (const char* set :
             {"material.baseColor.map=", "material.metallic.map=", "material.normal.map=",
              "material.perceptualRoughness.map=", "material.occlusion.map=", "material.metallic=0",
              "material.perceptualRoughness=1"})
            sets.insert(sets.end(), {"--set", set});
        return sets;
    }
    static const nlohmann::json& rung(const nlohmann::json& json, const std::string& name) {
        for (const nlohmann::json& one : json["rungs"])
            if (one["name"] == name)
                return one;
        ADD_FAILURE() << "no rung " << name;
        return json;
    }
};

// A ball under even light: nothing is hidden and nothing bounces, so that all of them are right,
// but the one that has a single light.
TEST_F(Ladder, UnderEvenLightOnlyTheSingleLightIsWrong) {
    std::vector<std::string> arguments = plain();
    arguments.insert(arguments.end(), {"--environment", "builtin:white", "--size", "64x48",
                                       "--samples", "64", "--background", "blurred"});
    const Outcome outcome = ladder(arguments);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    std::ifstream file(m_folder / "ladder.json");
    const nlohmann::json json = nlohmann::json::parse(file);
    EXPECT_EQ(json["rungs"], nlohmann::json::parse(outcome.out)["rungs"]);
    ASSERT_EQ(json["rungs"].size(), 9u);
    EXPECT_EQ(json["reference"]["samples"], 64);
    EXPECT_LT(json["reference"]["noisePercent"], 5.0);
    for (const char* name :
         {"sh", "ibl", "ao", "unshadowed", "shadowed", "prt", "radiosity", "lightMap"}) {
        const nlohmann::json& error = rung(json, name)["error"];
        EXPECT_LT(std::abs(error["biasEv"].get<double>()), 0.02) << name;
        EXPECT_LT(error["relative"].get<double>(), 0.05) << name;
        EXPECT_LT(error["flip"].get<double>(), 0.03) << name;
        EXPECT_GT(rung(json, name)["milliseconds"].get<double>(), 0.0) << name;
    }
    EXPECT_GT(rung(json, "cosine")["error"]["flip"].get<double>(), 0.05);
    EXPECT_LT(rung(json, "cosine")["error"]["biasEv"].get<double>(), -0.1);
    EXPECT_GT(rung(json, "ao")["bakeSeconds"].get<double>(), 0.0) << "it has no occlusion map";
    EXPECT_EQ(rung(json, "ibl")["bakeSeconds"].get<double>(), 0.0);
    ASSERT_EQ(rung(json, "ibl")["error"]["materials"].size(), 1u);
}

// A ball in a sky with a sun: what is wrong is not what it hides.
TEST_F(Ladder, BlameSaysWhichShortcutMakesTheError) {
    std::vector<std::string> arguments = plain();
    const std::string pictures = m_folder / "blame.exr";
    arguments.insert(arguments.end(), {"--environment", "builtin:sunset", "--size", "48x36",
                                       "--samples", "64", "--blame-pictures", pictures});
    const Outcome outcome = ladder(arguments);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const nlohmann::json json = nlohmann::json::parse(outcome.out);
    for (const char* name : {"ibl", "ao"}) {
        const nlohmann::json& blame = rung(json, name)["blame"];
        ASSERT_EQ(blame["causes"].size(), 8u) << name;
        double sum = 0.0;
        for (const nlohmann::json& cause : blame["causes"])
            sum += cause["share"].get<double>();
        EXPECT_NEAR(sum, 1.0, 1e-6) << name;
        EXPECT_EQ(blame["materials"].size(), 1u);
        EXPECT_TRUE(blame["remedy"].is_string());
    }
    EXPECT_FALSE(rung(json, "sh").contains("blame")) << "image-based light alone is taken apart";
    EXPECT_FALSE(rung(json, "prt").contains("blame"));
    ImageLoadOptions signedParts;
    signedParts.allParts = true;
    signedParts.sanitize = false;
    const Result<LoadedImage> loaded = loadImage(m_worker, pictures, signedParts);
    ASSERT_TRUE(loaded.ok()) << loaded.error().text();
    const std::vector<ImagePart>& parts = loaded->parts;
    ASSERT_EQ(parts.size(), 10u);
    EXPECT_EQ(parts[0].name, "traced");
    EXPECT_EQ(parts[1].name, "drawn");
    EXPECT_EQ(parts[2].name, "occlusion");
    for (std::size_t i = 0; i < parts[0].image.f32().size(); ++i) {
        float sum = 0.0f;
        for (std::size_t part = 1; part < parts.size(); ++part)
            sum += parts[part].image.f32()[i];
        const float traced = parts[0].image.f32()[i];
        EXPECT_NEAR(sum, traced, 1e-3f * (1.0f + traced)) << i;
    }
    EXPECT_EQ(ladder({"--blame-pictures", m_folder / "blame.png"}).status, 2);
    EXPECT_EQ(ladder({"--blame", "--set", "view.reflectionMix=0.3"}).status, 2);
}

TEST_F(Ladder, ASheetShowsThem) {
    const Outcome outcome = ladder({"--size", "48x32", "--samples", "4"}, "ladder.png");
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const Image sheet = load(m_folder / "ladder.png");
    EXPECT_GT(sheet.width(), 8 * 48);
    EXPECT_GT(sheet.height(), 3 * 32);
}

TEST_F(Ladder, WhatCannotBeComparedIsRefused) {
    EXPECT_EQ(ladder({}, "ladder.exr").status, 2);
    EXPECT_EQ(ladder({}, "no-folder/ladder.json").status, 73);
    EXPECT_EQ(ladder({"--samples", "1"}).status, 2) << "says nothing of its noise";
    const Outcome missing = runPatina({"ladder", "missing.glb", "-o", m_folder / "l.json"});
    EXPECT_EQ(missing.status, 66);
    EXPECT_THAT(missing.err, HasSubstr("missing.glb"));
    EXPECT_FALSE(std::filesystem::exists(m_folder / "l.json"));
}

} // namespace
