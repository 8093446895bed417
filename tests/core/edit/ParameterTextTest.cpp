#include "core/document/Document.h"
#include "core/edit/Parameters.h"
#include "core/material/Material.h"

#include <cmath>
#include <cstring>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <random>

using namespace patina;
using testing::HasSubstr;

namespace {

const ParameterInfo& info(const char* name) {
    return *findParameter(name);
}

template <class T>
T parsed(const char* name, const std::string& text) {
    Result<ParameterValue> value = parseParameterValue(info(name), text);
    EXPECT_TRUE(value.ok()) << name << "=" << text << ": "
                            << (value.ok() ? "" : value.error().text());
    return value.ok() ? std::get<T>(*value) : T{};
}

void expectRefused(const char* name, const std::string& text, const std::string& expected) {
    const Result<ParameterValue> value = parseParameterValue(info(name), text);
    ASSERT_FALSE(value.ok()) << name << "=" << text;
    EXPECT_EQ(value.error().kind, ErrorKind::Usage);
    EXPECT_THAT(value.error().message, HasSubstr(name));
    EXPECT_THAT(value.error().message, HasSubstr(expected));
}

ParameterValue randomValue(const ParameterInfo& parameter, std::mt19937& random) {
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    const auto number = [&] {
        return std::clamp(parameter.hardMin +
                              unit(random) * (parameter.hardMax - parameter.hardMin),
                          parameter.hardMin, parameter.hardMax);
    };
    switch (parameter.type) {
    case ParameterType::Bool:
        return unit(random) < 0.5f;
    case ParameterType::Float:
        return number();
    case ParameterType::Color:
    case ParameterType::Vector:
        return glm::vec3(number(), number(), number());
    case ParameterType::Choice:
        return static_cast<int>(random() % parameter.choices.size());
    case ParameterType::Text:
        return std::string("  näme [") + std::to_string(random()) + "] ";
    case ParameterType::Map: {
        MapSlot slot;
        slot.source = "/a folder/" + std::to_string(random()) + ".png";
        slot.channel = parameter.mapChannel;
        return slot;
    }
    case ParameterType::Reference:
        return static_cast<int>(random() % 1000);
    }
    return false;
}

} // namespace

TEST(ParameterText, FormattedValuesParseBackExactly) {
    const std::uint32_t seed = 20240;
    std::mt19937 random(seed);
    for (const ParameterInfo& parameter : parameters()) {
        for (int i = 0; i < 200; ++i) {
            const ParameterValue value = randomValue(parameter, random);
            const std::string text = formatParameterValue(parameter, value);
            const Result<ParameterValue> back = parseParameterValue(parameter, text);
            ASSERT_TRUE(back.ok()) << parameter.id << "=" << text << " seed " << seed;
            ASSERT_EQ(*back, value) << parameter.id << "=" << text << " seed " << seed;
        }
        EXPECT_EQ(*parseParameterValue(parameter,
                                       formatParameterValue(parameter, parameter.defaultValue())),
                  [&] {
                      ParameterValue value = parameter.defaultValue();
                      if (auto* slot = std::get_if<MapSlot>(&value))
                          slot->channel = parameter.mapChannel;
                      return value;
                  }())
            << parameter.id;
    }
}

TEST(ParameterText, NumbersAreAsShortAsTheyCanBe) {
    EXPECT_EQ(formatParameterValue(info("material.metallic"), 0.1f), "0.1");
    EXPECT_EQ(formatParameterValue(info("material.baseColor"), glm::vec3(0.8f, 0.0f, 1.0f)),
              "0.8,0,1");
    EXPECT_EQ(formatParameterValue(info("material.doubleSided"), true), "true");
    EXPECT_EQ(formatParameterValue(info("view.toneMap"), 1), "reinhard");
}

TEST(ParameterText, ParsesEveryForm) {
    EXPECT_EQ(parsed<float>("material.metallic", " 0.3 "), 0.3f);
    EXPECT_EQ(parsed<float>("material.metallic", "+1"), 1.0f);
    EXPECT_EQ(parsed<float>("light.intensity", "1e3"), 1000.0f);
    EXPECT_EQ(parsed<glm::vec3>("material.baseColor", "0.8, 0.2,0.1"), glm::vec3(0.8f, 0.2f, 0.1f));
    EXPECT_EQ(parsed<glm::vec3>("material.baseColor", "0.5"), glm::vec3(0.5f));
    EXPECT_EQ(parsed<glm::vec3>("light.position", "-1,2e1,.5"), glm::vec3(-1.0f, 20.0f, 0.5f));
    EXPECT_TRUE(parsed<bool>("material.doubleSided", "True"));
    EXPECT_FALSE(parsed<bool>("material.doubleSided", "off"));
    EXPECT_EQ(parsed<int>("view.toneMap", "REINHARD"), 1);
    EXPECT_EQ(parsed<int>("material.normalConvention", "openGl"), 0);
    EXPECT_EQ(parsed<std::string>("material.name", " as it is "), " as it is ");
    EXPECT_EQ(parsed<MapSlot>("material.baseColor.map", "builtin:wood/baseColor").source,
              "builtin:wood/baseColor");
    EXPECT_FALSE(parsed<MapSlot>("material.baseColor.map", "").assigned());
    EXPECT_TRUE(parsed<MapSlot>("material.baseColor.map", "a/../b.png").source.ends_with("/b.png"));
    EXPECT_TRUE(parsed<MapSlot>("material.baseColor.map", "b.png").source.starts_with("/"));
}

// IEC 61966-2-1: #80 = 128/255 → ((128/255 + 0.055) / 1.055)^2.4 = 0.2158605
TEST(ParameterText, HexadecimalColoursAreSrgb) {
    const glm::vec3 color = parsed<glm::vec3>("material.baseColor", "#FF8000");
    EXPECT_EQ(color.r, 1.0f);
    EXPECT_NEAR(color.g, 0.2158605f, 1e-6f);
    EXPECT_EQ(color.b, 0.0f);
    // The straight part of the curve: 10/255/12.92
    EXPECT_NEAR(parsed<glm::vec3>("material.baseColor", "#0a0a0a").r, 0.00303527f, 1e-7f);
}

TEST(ParameterText, RefusesWhatIsNoValueAndSaysWhatIsExpected) {
    for (const char* text : {"", "x", "nan", "inf", "-inf", "1.5", "-0.1", "1e99", "0,5", "0.5 0.5",
                             "0x1", "--1", "1f", "\xff\xfe"})
        expectRefused("material.metallic", text, "a number from 0 to 1");
    for (const char* text : {"", "1,2", "1,1,1,1", "0.1,nan,0", "0,0,2", "#12345", "#12345g",
                             "#+12345", "red", ",,", "0.1,0.2,"})
        expectRefused("material.baseColor", text, "#rrggbb");
    expectRefused("light.position", "#ffffff", "three comma-separated numbers");
    expectRefused("light.position", "1", "three comma-separated numbers");
    expectRefused("view.toneMap", "filmic", "clamp, reinhard");
    expectRefused("view.toneMap", "1", "clamp, reinhard");
    expectRefused("material.doubleSided", "maybe", "true or false");
    expectRefused("mesh.material", "-1", "material");
    expectRefused("mesh.material", "99999999999", "material");
    expectRefused("environment.rotationDeg", "north", "an angle in degrees");
}

TEST(ParameterText, AReferenceIsGivenByNameOrNumber) {
    Document document;
    Material& material = document.materials.emplace_back();
    material.id = 5;
    material.name = "Gold";
    const ParameterInfo& reference = info("mesh.material");
    EXPECT_EQ(std::get<int>(*parseParameterValue(reference, "Gold", document)), 5);
    EXPECT_EQ(std::get<int>(*parseParameterValue(reference, "5", document)), 5);
    EXPECT_EQ(std::get<int>(*parseParameterValue(reference, "0", document)), 0);
    EXPECT_FALSE(parseParameterValue(reference, "6", document).ok());
    EXPECT_FALSE(parseParameterValue(reference, "Silver", document).ok());
    EXPECT_EQ(std::get<float>(*parseParameterValue(info("light.intensity"), "2", document)), 2.0f);
}

TEST(ParameterRange, NumbersAreClampedAndNanBecomesTheDefault) {
    const float inf = std::numeric_limits<float>::infinity();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto clamped = [](const char* name, float value) {
        return std::get<float>(clampToRange(info(name), value));
    };
    EXPECT_EQ(clamped("material.metallic", 2.0f), 1.0f);
    EXPECT_EQ(clamped("material.metallic", -inf), 0.0f);
    EXPECT_EQ(clamped("material.perceptualRoughness", nan), 0.5f);
    EXPECT_EQ(clamped("light.intensity", inf), 1e6f);
    EXPECT_EQ(clamped("view.fovDeg", 0.0f), 1.0f);
    EXPECT_EQ(
        std::get<glm::vec3>(clampToRange(info("material.baseColor"), glm::vec3(nan, 7.0f, -1.0f))),
        glm::vec3(0.8f, 1.0f, 0.0f));
    const ParameterInfo& choice = info("view.toneMap");
    EXPECT_EQ(std::get<int>(clampToRange(choice, 1000)),
              static_cast<int>(choice.choiceLabels.size()) - 1);
    EXPECT_EQ(std::get<int>(clampToRange(info("view.toneMap"), -3)), 0);
    EXPECT_EQ(std::get<std::string>(clampToRange(info("light.name"), std::string("a\xff"))),
              "a\xef\xbf\xbd");
}

TEST(ParameterRange, AnglesWrapAround) {
    const auto wrapped = [](float value) {
        return std::get<float>(clampToRange(info("environment.rotationDeg"), value));
    };
    EXPECT_EQ(wrapped(90.0f), 90.0f);
    EXPECT_EQ(wrapped(180.0f), 180.0f);
    EXPECT_EQ(wrapped(-180.0f), -180.0f);
    EXPECT_EQ(wrapped(190.0f), -170.0f);
    EXPECT_EQ(wrapped(-190.0f), 170.0f);
    EXPECT_EQ(wrapped(725.0f), 5.0f);
    EXPECT_EQ(parsed<float>("environment.rotationDeg", "270"), -90.0f);
    for (const float value : {1e30f, -1e30f, std::numeric_limits<float>::infinity()}) {
        EXPECT_GE(wrapped(value), -180.0f);
        EXPECT_LE(wrapped(value), 180.0f);
    }
}
