#include "core/bake/domain/BakeOptions.h"
#include "core/bake/domain/BakePresets.h"

#include <gtest/gtest.h>
#include <set>

using namespace patina;

namespace {

// Every setting away from its default.
BakeRequest unusual(BakeKind kind) {
    BakeRequest request;
    request.kind = kind;
    request.ao = {512, 0.25f, 2048, 7};
    request.prt = {
        5,      512,   4294967295u, TransferKind::Interreflected, 4, 128, SampleMethod::Stratified,
        0.001f, false, 2048};
    return request;
}

TEST(BakeOptions, ATextGivesTheRequestBack) {
    for (const BakeKind kind :
         {BakeKind::AoTexel, BakeKind::AoVertex, BakeKind::PrtVertex, BakeKind::PrtTexel}) {
        const BakeRequest request = unusual(kind);
        const auto text = settingsText(request);
        const BakeRequest back = requestFromText(kind, text);
        EXPECT_EQ(settingsText(back), text);
        for (const BakeOption& option : bakeOptions())
            if (option.applies(request) && option.shapesResult) {
                EXPECT_EQ(option.get(back), option.get(request)) << option.name;
                BakeRequest plain;
                plain.kind = kind;
                EXPECT_NE(option.get(plain), option.get(request)) << option.name;
            }
    }
}

TEST(BakeOptions, TextsAreThoseOfTheFiles) {
    const std::map<std::string, std::string> transfer{{"transfer", "interreflected"},
                                                      {"order", "5"},
                                                      {"samples", "512"},
                                                      {"tolerance", "0.001"},
                                                      {"bounces", "4"},
                                                      {"bounceSamples", "128"},
                                                      {"fitted", "false"},
                                                      {"method", "stratified"},
                                                      {"seed", "4294967295"}};
    EXPECT_EQ(settingsText(unusual(BakeKind::PrtVertex)), transfer);
    const std::map<std::string, std::string> occlusion{
        {"samples", "512"}, {"size", "2048"}, {"maxDistance", "0.25"}, {"seed", "7"}};
    EXPECT_EQ(settingsText(unusual(BakeKind::AoTexel)), occlusion);
}

TEST(BakeOptions, WhatDoesNotApplyIsNotSaid) {
    BakeRequest request = unusual(BakeKind::PrtVertex);
    request.prt.transfer = TransferKind::Unshadowed;
    const std::map<std::string, std::string> unshadowed{{"transfer", "unshadowed"}, {"order", "5"}};
    EXPECT_EQ(settingsText(request), unshadowed);
    EXPECT_FALSE(settingsText(unusual(BakeKind::AoVertex)).contains("size"));
}

TEST(BakeOptions, DamagedTextsKeepTheDefaults) {
    const auto standard = settingsText(BakeRequest{});
    const BakeRequest read = requestFromText(BakeKind::PrtVertex, {{"order", "9"},
                                                                   {"samples", "12.5"},
                                                                   {"tolerance", "nan"},
                                                                   {"transfer", "magic"},
                                                                   {"fitted", "yes"},
                                                                   {"seed", "-1"},
                                                                   {"bounces", "3 "},
                                                                   {"unknown", "1"}});
    EXPECT_EQ(settingsText(read), standard);
    EXPECT_EQ(read.prt.bounces, 3);
}

TEST(BakeOptions, EachIsNamedAndExplained) {
    std::set<std::string> names;
    for (const BakeOption& option : bakeOptions()) {
        EXPECT_TRUE(names.insert(option.name).second) << option.name;
        EXPECT_GT(std::string(option.help).size(), 20u) << option.name;
        EXPECT_FALSE(std::string(option.label).empty()) << option.name;
        EXPECT_EQ(findBakeOption(option.name), &option);
        for (const int step : option.steps)
            EXPECT_TRUE(step >= option.min && step <= option.max) << option.name;
        EXPECT_EQ(option.type == BakeOption::Type::Choice, !option.choices.empty());
    }
    EXPECT_EQ(findBakeOption("bands"), nullptr);
}

TEST(BakePresets, SetRaysAndSidesAndNothingElse) {
    for (const BakeKind kind :
         {BakeKind::AoTexel, BakeKind::AoVertex, BakeKind::PrtVertex, BakeKind::PrtTexel}) {
        const BakeRequest request = unusual(kind);
        EXPECT_EQ(presetOf(request), nullptr);
        for (const BakePreset& preset : bakePresets()) {
            const BakeRequest chosen = withPreset(request, preset);
            EXPECT_EQ(presetOf(chosen), &preset);
            EXPECT_EQ(findBakePreset(preset.name), &preset);
            for (const BakeOption& option : bakeOptions()) {
                const std::string name = option.name;
                if (name != "samples" && name != "size" && name != "bounceSamples") {
                    EXPECT_EQ(option.get(chosen), option.get(request)) << name;
                }
            }
        }
    }
    EXPECT_EQ(findBakePreset("best"), nullptr);
}

TEST(BakePresets, TheMiddleOneIsWhatRequestsBeginWith) {
    for (const BakeKind kind :
         {BakeKind::AoTexel, BakeKind::AoVertex, BakeKind::PrtVertex, BakeKind::PrtTexel}) {
        BakeRequest request{kind, {}, {}};
        request.prt.transfer = TransferKind::Interreflected;
        EXPECT_EQ(presetOf(request), &bakePresets()[1]);
    }
}

} // namespace
