// Every row of the table: does it keep its promises, and does it reach the member it names?
#include "core/document/Document.h"
#include "core/document/ViewChoices.h"
#include "core/edit/Parameters.h"
#include "core/light/Light.h"
#include "core/material/MaterialInputs.h"
#include "tests/core/document/RandomDocument.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>
#include <map>
#include <memory>
#include <set>

using namespace patina;

namespace {

// A document with two elements of each kind, so that a write to the wrong one is seen.
constexpr Id kOtherReference = 7;

Document twoOfEach() {
    Document document;
    for (int i = 0; i < 2; ++i) {
        document.materials.emplace_back().id = document.takeId();
        document.lights.emplace_back().id = document.takeId();
        document.meshes.emplace_back().id = document.takeId();
        document.environment().softboxes.emplace_back().id = document.takeId();
    }
    document.environments.emplace_back().id = kOtherReference;
    return document;
}

Id firstOf(const Document& document, Scope scope) {
    switch (scope) {
    case Scope::Material:
        return document.materials[0].id;
    case Scope::Light:
        return document.lights[0].id;
    case Scope::Mesh:
        return document.meshes[0].id;
    case Scope::Softbox:
        return document.environments[0].softboxes[0].id;
    default:
        return 0;
    }
}

Id secondOf(const Document& document, Scope scope) {
    switch (scope) {
    case Scope::Material:
        return document.materials[1].id;
    case Scope::Light:
        return document.lights[1].id;
    case Scope::Mesh:
        return document.meshes[1].id;
    case Scope::Softbox:
        return document.environments[0].softboxes[1].id;
    case Scope::Environment:
        return document.environments[1].id;
    default:
        return 0;
    }
}

// A value in range that differs from the default.
ParameterValue otherValue(const ParameterInfo& info) {
    switch (info.type) {
    case ParameterType::Bool:
        return !std::get<bool>(info.defaultValue());
    case ParameterType::Float:
        return info.decimals == 0 ? std::floor(info.hardMin + 0.37f * (info.hardMax - info.hardMin))
                                  : info.hardMin + 0.37f * (info.hardMax - info.hardMin);
    case ParameterType::Color:
        return glm::vec3(0.125f, 0.25f, 0.625f);
    case ParameterType::Vector:
        return glm::vec3(-1.5f, 2.25f, 100.0f);
    case ParameterType::Choice:
        return (std::get<int>(info.defaultValue()) + 1) % static_cast<int>(info.choices.size());
    case ParameterType::Text:
        return std::string("Grün [1].x");
    case ParameterType::Map: {
        MapSlot slot;
        slot.source = "/somewhere/else.png";
        slot.image = std::make_shared<Image>();
        slot.problem = "none";
        return slot;
    }
    case ParameterType::Reference:
        return static_cast<int>(kOtherReference);
    }
    return false;
}

} // namespace

TEST(ParameterTable, IdsAndAliasesAreUniqueAndBeginWithTheirScope) {
    std::set<std::string_view> names;
    for (const ParameterInfo& info : parameters()) {
        EXPECT_TRUE(names.insert(info.id).second) << info.id;
        EXPECT_TRUE(info.id.starts_with(std::string(scopeName(info.scope)) + ".")) << info.id;
        EXPECT_EQ(findParameter(info.id), &info);
        if (info.alias.empty())
            continue;
        EXPECT_TRUE(names.insert(info.alias).second) << info.alias;
        EXPECT_EQ(findParameter(info.alias), &info);
    }
    EXPECT_EQ(findParameter("material.nothing"), nullptr);
    EXPECT_EQ(findParameter(""), nullptr);
}

TEST(ParameterTable, LabelsAreUniqueWithinAScopeAndHelpIsASentence) {
    std::set<std::pair<Scope, std::string_view>> labels;
    for (const ParameterInfo& info : parameters()) {
        EXPECT_FALSE(info.group.empty()) << info.id;
        EXPECT_TRUE(labels.insert({info.scope, info.label}).second) << info.id;
        EXPECT_GT(info.help.size(), 20u) << info.id;
        EXPECT_TRUE(info.help.ends_with('.')) << info.id;
        EXPECT_NE(info.affects, Affects::Nothing) << info.id;
    }
}

// The names that scripts rely on, whatever else changes.
TEST(ParameterTable, HoldsTheFixedNames) {
    for (const char* name : {"material.baseColor",
                             "material.baseColor.map",
                             "material.metallic",
                             "material.metallic.map",
                             "material.perceptualRoughness",
                             "material.perceptualRoughness.map",
                             "material.normalStrength",
                             "material.normalStrength.map",
                             "material.normal.map",
                             "material.occlusionStrength",
                             "material.occlusionStrength.map",
                             "material.occlusion.map",
                             "material.roughness.map",
                             "material.emissive",
                             "material.emissive.map",
                             "environment.image",
                             "environment.kind",
                             "environment.skySunAzimuthDeg",
                             "environment.softboxAmbient",
                             "environment.rotationDeg",
                             "environment.exposureEv",
                             "environment.first",
                             "environment.second",
                             "environment.fade",
                             "light.gainEv",
                             "view.exposureEv",
                             "view.toneMap",
                             "view.fovDeg",
                             "view.lighting",
                             "softbox.widthDeg",
                             "light.intensity",
                             "light.color",
                             "light.position",
                             "mesh.visible",
                             "mesh.material",
                             "mesh.position",
                             "mesh.rotationDeg",
                             "mesh.scale"})
        EXPECT_NE(findParameter(name), nullptr) << name;
}

TEST(ParameterTable, RangesAreOrderedAndHoldTheDefault) {
    for (const ParameterInfo& info : parameters()) {
        EXPECT_LE(info.hardMin, info.softMin) << info.id;
        EXPECT_LT(info.softMin, info.softMax) << info.id;
        EXPECT_LE(info.softMax, info.hardMax) << info.id;
        EXPECT_GE(info.decimals, 0) << info.id;
        EXPECT_EQ(clampToRange(info, info.defaultValue()), info.defaultValue()) << info.id;
    }
}

TEST(ParameterTable, ChoicesHaveNamesAndLabels) {
    for (const ParameterInfo& info : parameters()) {
        EXPECT_EQ(info.choices.empty(), info.type != ParameterType::Choice) << info.id;
        EXPECT_EQ(info.choices.size(), info.choiceLabels.size()) << info.id;
        EXPECT_NE(info.choices.size(), 1u) << info.id;
    }
}

TEST(ParameterTable, SetReachesOneElementAndGetReadsItBack) {
    for (const ParameterInfo& info : parameters()) {
        const Document before = twoOfEach();
        Document after = before;
        const Id id = secondOf(before, info.scope);
        const ParameterValue value = clampToRange(info, otherValue(info));
        ASSERT_NE(info.get(before, id), value) << info.id;
        info.set(after, id, value);
        EXPECT_EQ(info.get(after, id), value) << info.id;
        EXPECT_FALSE(after == before) << info.id;

        // No other parameter of any element has moved, nor this one of the other element.
        if (id != 0 && !info.ofScene) {
            EXPECT_EQ(info.get(after, firstOf(after, info.scope)),
                      info.get(before, firstOf(before, info.scope)))
                << info.id;
        }
        for (const ParameterInfo& other : parameters()) {
            if (&other == &info)
                continue;
            EXPECT_EQ(other.get(after, secondOf(after, other.scope)),
                      other.get(before, secondOf(before, other.scope)))
                << info.id << " changed " << other.id;
        }
        info.set(after, id, info.get(before, id));
        EXPECT_TRUE(after == before) << info.id;
    }
}

TEST(ParameterTable, RowsReachTheMembersTheyName) {
    Document document = twoOfEach();
    const Id material = document.materials[1].id, light = document.lights[1].id,
             mesh = document.meshes[1].id;
    const auto set = [&](const char* name, Id id, const ParameterValue& value) {
        const ParameterInfo* info = findParameter(name);
        ASSERT_NE(info, nullptr) << name;
        info->set(document, id, value);
    };
    set("material.perceptualRoughness", material, 0.25f);
    set("material.metallic", material, 0.75f);
    set("material.normalConvention", material, 1);
    set("material.alphaMode", material, 1);
    set("view.fovDeg", 0, 50.0f);
    set("view.exposureEv", 0, 1.0f);
    set("view.toneMap", 0, 0);
    set("environment.exposureEv", 0, -2.0f);
    set("environment.background", 0, 2);
    set("light.type", light, 0);
    set("light.elevationDeg", light, 10.0f);
    set("mesh.material", mesh, static_cast<int>(material));
    MapSlot slot;
    slot.source = "/sky.hdr";
    set("environment.image", 0, slot);

    EXPECT_EQ(document.materials[1].perceptualRoughness, 0.25f);
    EXPECT_EQ(document.materials[1].metallic, 0.75f);
    EXPECT_EQ(document.materials[1].normalConvention, NormalConvention::DirectX);
    EXPECT_EQ(document.materials[1].alphaMode, AlphaMode::Mask);
    EXPECT_EQ(document.view.camera.fovDeg, 50.0f);
    EXPECT_EQ(document.view.exposureEv, 1.0f);
    EXPECT_EQ(document.view.toneMap, ToneMap::Clamp);
    EXPECT_EQ(document.environment().exposureEv, -2.0f);
    EXPECT_EQ(document.view.background, BackgroundMode::Color);
    EXPECT_EQ(document.lights[1].type, LightType::Point);
    EXPECT_EQ(document.lights[1].elevationDeg, 10.0f);
    EXPECT_EQ(document.meshes[1].material, material);
    EXPECT_EQ(document.environment().source, "/sky.hdr");
}

// OpenColorIO's views are offered where there is a configuration, by file or by environment.
TEST(ParameterTable, ChoicesCanBeUnavailable) {
    const ParameterInfo& toneMap = *findParameter("view.toneMap");
    constexpr int kOpenColorIo = static_cast<int>(ToneMap::OpenColorIo);
    ::unsetenv("OCIO");
    Document document;
    for (int choice = 0; choice < kOpenColorIo; ++choice)
        EXPECT_EQ(whyUnavailable(toneMap, document, choice), "");
    const std::string why = whyUnavailable(toneMap, document, kOpenColorIo);
    EXPECT_NE(why.find("view.ocioConfig"), std::string::npos) << why;
    EXPECT_NE(why.find("OCIO"), std::string::npos) << why;
    document.view.ocioConfig = "/studio/config.ocio";
    EXPECT_EQ(whyUnavailable(toneMap, document, kOpenColorIo), "");
    document.view.ocioConfig.clear();
    ::setenv("OCIO", "/site/config.ocio", 1);
    EXPECT_EQ(whyUnavailable(toneMap, document, kOpenColorIo), "");
    ::unsetenv("OCIO");
    // Rows that say nothing offer everything.
    EXPECT_EQ(whyUnavailable(*findParameter("view.exposureMode"), document, 1), "");
}

// A condition that never holds, or always does, would hide a row for ever, or be none.
TEST(ParameterTable, ConditionsHoldInSomeDocumentsAndSayWhyNotInOthers) {
    std::map<const Condition*, std::array<int, 2>> met; // not, yes
    RandomDocument random(5);
    for (int i = 0; i < 300; ++i) {
        Document document = random.make();
        if (i % 2 == 0) {
            auto bake = std::make_shared<BakeArtifact>();
            bake->kind = BakeKind::PrtVertex;
            bake->transfer = TransferKind::Interreflected;
            document.bakes = {bake};
            document.view.radiosityAdaptive = 0.0f; // which is hardly ever drawn
        }
        for (const ParameterInfo& info : parameters())
            for (const Id id : RandomDocument::idsOf(document, info.scope)) {
                const auto holds = [&](const Condition* condition) {
                    const bool now = condition == nullptr || condition->holds(document, id);
                    if (condition != nullptr)
                        ++met[condition][now ? 1 : 0];
                    return now;
                };
                const bool applies = holds(info.applies), works = holds(info.works);
                EXPECT_EQ(whyIdle(info, document, id).empty(), applies && works) << info.id;
            }
    }
    EXPECT_GE(met.size(), 20u);
    for (const auto& [condition, counts] : met) {
        EXPECT_GT(counts[0], 0) << condition->otherwise << ": always holds";
        EXPECT_GT(counts[1], 0) << condition->otherwise << ": never holds";
        EXPECT_FALSE(condition->otherwise.empty() || condition->otherwise.ends_with('.'));
    }
}

// What only a bake knows is offered where there is one.
TEST(ParameterTable, LightingByTransferNeedsABake) {
    const ParameterInfo& lighting = *findParameter("view.lighting");
    const auto why = [&](const Document& document, LightingMode mode) {
        return whyUnavailable(lighting, document, static_cast<int>(mode));
    };
    Document document;
    for (const LightingMode mode : {LightingMode::Ibl, LightingMode::Cosine,
                                    LightingMode::ShIrradiance, LightingMode::Unshadowed})
        EXPECT_EQ(why(document, mode), "");
    for (const LightingMode mode : {LightingMode::Shadowed, LightingMode::Prt})
        EXPECT_NE(why(document, mode).find("radiance transfer bake"), std::string::npos);
    auto bake = std::make_shared<BakeArtifact>();
    bake->kind = BakeKind::PrtVertex;
    document.bakes.push_back(bake);
    for (const LightingMode mode : {LightingMode::Shadowed, LightingMode::Prt})
        EXPECT_EQ(why(document, mode), "");
}

// A count keeps whole numbers, whatever is typed.
TEST(ParameterTable, CountsAreWhole) {
    const ParameterInfo& bounces = *findParameter("view.bounces");
    Document document;
    bounces.set(document, 0, 2.6f);
    EXPECT_EQ(document.view.bounces, 3);
    EXPECT_EQ(bounces.get(document, 0), ParameterValue(3.0f));
}

TEST(ParameterTable, MapsBelongToTheirNumbersAndCarryTheColourPolicy) {
    const auto mapFor = [](const char* id) { return mapOf(*findParameter(id)); };
    EXPECT_EQ(mapFor("material.baseColor"), findParameter("material.baseColor.map"));
    EXPECT_EQ(mapFor("material.normalStrength"), findParameter("material.normal.map"));
    EXPECT_EQ(mapFor("material.opacity"), nullptr);
    for (const ParameterInfo& info : parameters()) {
        if (info.type != ParameterType::Map)
            continue;
        const bool isColor = info.id == "material.baseColor.map" ||
                             info.id == "material.emissive.map" || info.id == "environment.image";
        EXPECT_EQ(info.mapEncoding, isColor ? ColorEncoding::Srgb : ColorEncoding::Data) << info.id;
        EXPECT_TRUE(touches(info.affects, Affects::Picture)) << info.id;
    }
    EXPECT_EQ(mapFor("material.metallic")->mapChannel, MapChannel::R);
    EXPECT_EQ(mapFor("material.normalStrength")->mapChannel, MapChannel::Rgb);
}

TEST(ParameterTable, HasAValueAndAMapForEachInputOfTheMaterial) {
    Document document = twoOfEach();
    const Id id = document.materials[0].id;
    Material& material = document.materials[0];
    MapSlot picture;
    picture.source = "/picture.png";
    std::set<const ParameterInfo*> rows;
    for (const MaterialInputInfo& input : kMaterialInputs) {
        const ParameterInfo* value = findParameter(input.parameters.value());
        const ParameterInfo* map = findParameter(input.parameters.map);
        ASSERT_TRUE(value && map) << input.id;
        rows.insert(map);
        EXPECT_EQ(mapOf(*value), map);
        map->set(document, id, picture);
        EXPECT_EQ(material.*input.map, picture) << input.id;
        if (input.color != nullptr) {
            value->set(document, id, glm::vec3(0.25f));
            EXPECT_EQ(material.*input.color, glm::vec3(0.25f)) << input.id;
        } else {
            value->set(document, id, 0.25f);
            EXPECT_EQ(material.*input.number, 0.25f) << input.id;
        }
    }
    for (const ParameterInfo& info : parameters()) {
        const bool map = info.scope == Scope::Material && info.type == ParameterType::Map;
        EXPECT_EQ(rows.contains(&info), map) << info.id;
    }
}
