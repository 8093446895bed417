// The project's text: nothing is lost, nothing is believed.
#include "core/document/ViewChoices.h"
#include "core/edit/Edit.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/scene/DocumentIO.h"
#include "tests/core/document/RandomDocument.h"
#include "tests/support/SecondEnvironment.h"

#include <chrono>
#include <fstream>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

using namespace patina;
using testing::HasSubstr;
using testing::Not;

namespace {

const std::filesystem::path kProject = "/home/artist/project/chair.patina";

// A small document with one of everything, and its text.
Document small() {
    Document document;
    Material& material = document.materials.emplace_back();
    material.id = document.takeId();
    material.name = "Body";
    material.baseColorMap.source = "/home/artist/project/maps/body.png";
    document.lights.emplace_back().id = document.takeId();
    MeshInstance& mesh = document.meshes.emplace_back();
    mesh.id = document.takeId();
    mesh.source = "/home/artist/models/chair.obj";
    mesh.material = material.id;
    return document;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from << " in\n" << text;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

void expectBroken(const std::string& json, const std::string& part) {
    const Result<Document> document = documentFromJson(json, kProject);
    ASSERT_FALSE(document.ok()) << part;
    EXPECT_EQ(document.error().kind, ErrorKind::InputBroken);
    EXPECT_EQ(document.error().file, kProject);
    EXPECT_THAT(document.error().text(), HasSubstr(part));
    EXPECT_LT(document.error().text().size(), 1000u);
}

std::string mutated(std::string text, RandomDocument& random) {
    // Every second mutant only has other digits, and so reaches the checks behind the parser.
    if (random.below(2) == 0) {
        for (std::size_t count = 1 + random.below(8); count > 0; --count)
            if (const std::size_t at = text.find_first_of("0123456789", random.below(text.size()));
                at != std::string::npos)
                text[at] = static_cast<char>('0' + random.below(10));
        return text;
    }
    for (std::size_t count = 1 + random.below(4); count > 0 && !text.empty(); --count) {
        const std::size_t at = random.below(text.size());
        const std::size_t length = 1 + random.below(40);
        switch (random.below(6)) {
        case 0:
            text[at] = static_cast<char>(random.below(256));
            break;
        case 1:
            text.erase(at, length);
            break;
        case 2:
            text.insert(at, text.substr(random.below(text.size()), length));
            break;
        case 3:
            text.resize(at);
            break;
        case 4: {
            const char* pieces[] = {"[",
                                    "{",
                                    "}",
                                    "]",
                                    "\"",
                                    "-1",
                                    "1e39",
                                    "1e-50",
                                    "null",
                                    "0",
                                    "\"\"",
                                    "[[[[[",
                                    "999999999999999999999"};
            text.insert(at, pieces[random.below(std::size(pieces))]);
            break;
        }
        default:
            text[at] = static_cast<char>(text[at] ^ (1 << random.below(8)));
        }
    }
    return text;
}

} // namespace

TEST(ProjectJson, ReadsBackWhatItWrites) {
    for (std::uint32_t seed = 1; seed <= 300; ++seed) {
        const Document document = RandomDocument(seed).make();
        const std::string json = documentToJson(document, kProject);
        const Result<Document> back = documentFromJson(json, kProject);
        ASSERT_TRUE(back.ok()) << "seed " << seed << ": " << back.error().text();
        EXPECT_TRUE(*back == document) << "seed " << seed << "\n" << json;
        EXPECT_EQ(documentToJson(*back, kProject), json) << "seed " << seed;
    }
}

TEST(ProjectJson, AMovedProjectFindsItsFilesBesideIt) {
    const std::string json = documentToJson(small(), kProject);
    EXPECT_THAT(json, HasSubstr("\"maps/body.png\""));
    EXPECT_THAT(json, HasSubstr("\"../models/chair.obj\""));
    EXPECT_THAT(json, Not(HasSubstr("/home")));
    const Result<Document> moved = documentFromJson(json, "/mnt/usb/p/chair.patina");
    ASSERT_TRUE(moved.ok());
    EXPECT_EQ(moved->materials[0].baseColorMap.source, "/mnt/usb/p/maps/body.png");
    EXPECT_EQ(moved->meshes[0].source, "/mnt/usb/models/chair.obj");
}

TEST(ProjectJson, IsReadable) {
    const std::string json = documentToJson(small(), kProject);
    EXPECT_TRUE(json.starts_with("{\n  \"format\": \"patina\",\n  \"version\": 1,\n")) << json;
    EXPECT_THAT(json, HasSubstr("\n      \"baseColor\": [0.8, 0.8, 0.8],\n"));
    EXPECT_THAT(json, HasSubstr("\"perceptualRoughness\": 0.5"));
    EXPECT_THAT(json, HasSubstr("\"metallic.map\": null"));
    EXPECT_THAT(json, HasSubstr("\"normalConvention\": \"openGl\""));
}

TEST(ProjectJson, ValuesOutOfRangeAreSavedSoThatTheProjectOpensAgain) {
    Document document = small();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    document.materials[0].metallic = nan;
    document.materials[0].baseColor = {-1.0f, 2.0f, std::numeric_limits<float>::infinity()};
    document.materials[0].name = "broken \xff";
    document.materials[0].baseColorMap.uvScale = {nan, 2.0f};
    document.meshes[0].placement.setPosition({0.0f, nan, 0.0f});
    document.view.camera.distance = nan;
    const Result<Document> back = documentFromJson(documentToJson(document, kProject), kProject);
    ASSERT_TRUE(back.ok()) << back.error().text();
    EXPECT_EQ(back->materials[0].metallic, 0.0f);
    EXPECT_EQ(back->materials[0].baseColor, glm::vec3(0.0f, 1.0f, 1.0f));
    EXPECT_EQ(back->materials[0].baseColorMap.uvScale, glm::vec2(1.0f, 2.0f));
    EXPECT_EQ(back->meshes[0].placement.matrix(), glm::mat4(1.0f));
}

TEST(ProjectJson, AnAbsentParameterKeepsItsDefault) {
    const std::string json = replaced(documentToJson(small(), kProject), "\"metallic\": 0.0,", "");
    const Result<Document> document = documentFromJson(json, kProject);
    ASSERT_TRUE(document.ok()) << document.error().text();
    EXPECT_TRUE(*document == small());
}

TEST(ProjectJson, NamesTheKeyThatIsWrong) {
    const std::string json = documentToJson(small(), kProject);
    const auto change = [&](const std::string& from, const std::string& to) {
        return replaced(json, from, to);
    };
    expectBroken(change("\"metallic\": 0.0", "\"metallic\": \"x\""), "materials[0].metallic");
    expectBroken(change("\"metallic\": 0.0", "\"metallic\": 1.5"), "a number from 0 to 1");
    expectBroken(change("\"metallic\": 0.0", "\"metallic\": null"), "materials[0].metallic");
    expectBroken(change("\"metallic\": 0.0", "\"metallic\": -1e30"), "materials[0].metallic");
    expectBroken(change("[0.8, 0.8, 0.8]", "[0.8, 0.8]"), "materials[0].baseColor");
    expectBroken(change("[0.8, 0.8, 0.8]", "[0.8, true, 0.8]"), "materials[0].baseColor[1]");
    expectBroken(change("\"openGl\"", "\"vulkan\""), "openGl, directX");
    expectBroken(change("\"openGl\"", "7"), "materials[0].normalConvention");
    expectBroken(change("\"doubleSided\": false", "\"doubleSided\": 0"), "true or false");
    expectBroken(change("\"maps/body.png\"", "\"a\\u0000b\""), "materials[0].baseColor.map.source");
    expectBroken(change("\"maps/body.png\"", "\"a%00b\""), "materials[0].baseColor.map.source");
    expectBroken(change("\"channel\": \"rgb\"", "\"channel\": \"x\""), "baseColor.map.channel");
    expectBroken(change("\"uvScale\": [1.0, 1.0]", "\"uvScale\": 1"), "baseColor.map.uvScale");
    expectBroken(change("\"id\": 2", "\"id\": 0"), "materials[0].id");
    expectBroken(change("\"id\": 2", "\"id\": 2.5"), "materials[0].id");
    expectBroken(change("\"id\": 2", "\"id\": 18446744073709551615"), "materials[0].id");
    expectBroken(change("\"id\": 2", "\"id\": -1"), "materials[0].id");
    expectBroken(change("\"id\": 3", "\"id\": 2"), "lights[0].id");
    expectBroken(change("\"id\": 1", "\"id\": 0"), "environment.id");
    expectBroken(change("\"first\": 1", "\"first\": 2"), "environment.first");
    expectBroken(change("\"second\": 0", "\"second\": 1"), "environment.second");
    expectBroken(change("\"second\": 0", "\"second\": 2"), "environment.second");
    expectBroken(change("\"nextId\": 5", "\"nextId\": 4"), "nextId");
    expectBroken(change("\"nextId\": 5", "\"nextId\": 4294967295"), "nextId");
    expectBroken(change("\"material\": 2", "\"material\": 3"), "meshes[0].material");
    expectBroken(change("\"material\": 2", "\"material\": -7"), "meshes[0].material");
    expectBroken(change("\"sourceIndex\": 0", "\"sourceIndex\": 1e3"), "meshes[0].sourceIndex");
    expectBroken(change("\"transform\": [1.0,", "\"transform\": ["), "meshes[0].transform");
    expectBroken(change("\"distance\": 4.0", "\"distance\": 0"), "view.camera");
    expectBroken(change("\"materials\": [", "\"materials\": [7, "), "materials[0]");
    expectBroken(change("\"lights\": [", "\"lamps\": ["), "lights is missing");
    expectBroken(change("\"bakes\": []", "\"bakes\": [{\"kind\": \"x\", \"file\": \"y\"}]"),
                 "bakes[0].kind");
    expectBroken(change("\"bakes\": []", "\"bakes\": {}"), "bakes");
    expectBroken(change("\"version\": 1", "\"version\": 2"), "newer");
    expectBroken(change("\"version\": 1", "\"version\": \"1\""), "version");
    expectBroken(change("\"format\": \"patina\"", "\"format\": \"glTF\""), "format");
}

// Written by the last build in which a scene had one environment and the picture of a second.
TEST(ProjectJson, ProjectsOfBeforeThereWereSeveralEnvironmentsOpen) {
    std::ifstream file(PATINA_SOURCE_DIR
                       "/tests/core/scene/data/before-several-environments.patina");
    const std::string json(std::istreambuf_iterator<char>(file), {});
    const Result<Document> read = documentFromJson(json, kProject);
    ASSERT_TRUE(read.ok()) << read.error().text();
    EXPECT_TRUE(read->unknownKeys == UnknownKeys()) << "all of it is known";
    ASSERT_EQ(read->environments.size(), 2u);
    const Environment& first = read->environment();
    EXPECT_EQ(first.source, "/home/artist/skies/harbour.hdr");
    EXPECT_EQ(first.rotationDeg, 30.0f);
    EXPECT_EQ(first.exposureEv, 1.0f);
    EXPECT_EQ(first.tint, glm::vec3(1.0f, 0.5f, 0.25f));
    EXPECT_FALSE(first.solo);
    ASSERT_EQ(first.softboxes.size(), 1u);
    EXPECT_EQ(first.softboxes[0].name, "Key");
    const Environment* second = read->secondEnvironment();
    ASSERT_NE(second, nullptr);
    EXPECT_EQ(second->source, "builtin:night");
    EXPECT_EQ(second->rotationDeg, 75.0f);
    EXPECT_EQ(second->exposureEv, -1.0f);
    EXPECT_EQ(second->tint, glm::vec3(0.2f, 0.4f, 0.8f));
    EXPECT_TRUE(second->solo);
    EXPECT_EQ(read->mix.fade, 0.375f);
    EXPECT_EQ(read->view.background, BackgroundMode::Color);
    EXPECT_EQ(read->view.backgroundBlur, 0.25f);
    EXPECT_EQ(read->view.backgroundColor, glm::vec3(0.1f, 0.2f, 0.3f));
    std::set<Id> ids;
    for (const Environment& environment : read->environments)
        EXPECT_TRUE(ids.insert(environment.id).second);
    for (const Light& light : read->lights)
        EXPECT_TRUE(ids.insert(light.id).second);
    // Saved by this build it is read again as it is.
    const Result<Document> again = documentFromJson(documentToJson(*read, kProject), kProject);
    ASSERT_TRUE(again.ok()) << again.error().text();
    EXPECT_TRUE(*again == *read);
}

TEST(ProjectJson, EnvironmentsKeepTheirOrderAndTheirPlaceInTheMix) {
    Document document = small();
    for (const char* name : {"A", "B", "C"}) {
        Environment environment;
        environment.name = name;
        environment.rotationDeg = static_cast<float>(name[0]);
        environment.softboxes.resize(2);
        addEnvironment(document, environment);
    }
    for (const std::size_t first : {0u, 2u, 3u})
        for (const std::size_t second : {0u, 1u, 3u}) {
            document.mix.first = document.environments[first].id;
            document.mix.second = second == first ? 0 : document.environments[second].id;
            const Result<Document> read =
                documentFromJson(documentToJson(document, kProject), kProject);
            ASSERT_TRUE(read.ok()) << read.error().text();
            EXPECT_TRUE(*read == document) << first << ' ' << second;
        }
    // More than there can be, and one without an id.
    std::string json = documentToJson(document, kProject);
    const std::size_t at = json.find("\"environments\": [") + 17;
    std::string many;
    for (int i = 0; i < 64; ++i)
        many += "{},";
    expectBroken(json.substr(0, at) + many + json.substr(at), "67 elements");
    expectBroken(json.substr(0, at) + "{}," + json.substr(at), "environments[0].id");
}

// Of a newer project nothing is lost that this version does not know.
TEST(ProjectJson, UnknownKeysAreKept) {
    using Json = nlohmann::ordered_json;
    Document document = small();
    document.environment().softboxes.emplace_back().id = 8;
    document.nextId = 9;
    test::addSecond(document, "/second.hdr", nullptr);
    const Json plain = Json::parse(documentToJson(document, kProject));
    Json newer = plain;
    // A key of its own in every object, however deep.
    int objects = 0;
    const std::function<void(Json&)> extend = [&](Json& json) {
        for (auto& value : json)
            if (value.is_structured())
                extend(value);
        if (!json.is_object())
            return;
        ++objects;
        json["clearcoat"] = 0.12345678901234567;
        json["layers \n\u00e4"] = {{"mask", {1, 2.5, objects}}, {"none", nullptr}};
    };
    extend(newer);
    EXPECT_GE(objects, 9);
    const Result<Document> opened = documentFromJson(newer.dump(), kProject);
    ASSERT_TRUE(opened.ok()) << opened.error().text();
    Document known = *opened;
    known.unknownKeys = {};
    EXPECT_EQ(documentToJson(known, kProject), documentToJson(document, kProject));
    EXPECT_EQ(Json::parse(documentToJson(*opened, kProject)), newer);
    // Once more: nothing is added up.
    const Result<Document> again = documentFromJson(documentToJson(*opened, kProject), kProject);
    ASSERT_TRUE(again.ok());
    EXPECT_EQ(documentToJson(*again, kProject), documentToJson(*opened, kProject));

    // They go with their element, and stay with the others.
    Document edited = *opened;
    const Json light = Json::parse(documentToJson(edited, kProject))["lights"][0];
    EXPECT_TRUE(light.contains("clearcoat"));
    edited.lights.clear();
    edited.materials[0].baseColorMap = {};
    edited.materials[0].metallic = 0.5f;
    const Json saved = Json::parse(documentToJson(edited, kProject));
    EXPECT_TRUE(saved["lights"].empty());
    EXPECT_TRUE(saved["materials"][0]["baseColor.map"].is_null());
    EXPECT_EQ(saved["materials"][0]["clearcoat"], newer["materials"][0]["clearcoat"]);
    EXPECT_EQ(saved["clearcoat"], newer["clearcoat"]);
}

// Whose time would be quadratic would take hours.
TEST(ProjectJson, AMillionUnknownKeysTakeLinearTime) {
    constexpr int kKeys = 1'000'000;
    std::string text = documentToJson(small(), kProject), keys;
    for (int i = 0; i < kKeys; ++i)
        keys += "\"k" + std::to_string(i) + "\":0,";
    text.insert(text.find('{') + 1, keys);
    const Result<Document> opened = documentFromJson(text, kProject);
    ASSERT_TRUE(opened.ok()) << opened.error().text();
    const UnknownKeys::Entries* kept = opened->unknownKeys.of("");
    ASSERT_NE(kept, nullptr);
    EXPECT_EQ(kept->size(), static_cast<std::size_t>(kKeys));
    EXPECT_GT(documentToJson(*opened, kProject).size(), keys.size());
}

TEST(ProjectJson, RefusesWhatIsNoProject) {
    for (const std::string& text :
         {std::string(), std::string("{}"), std::string("[]"), std::string("null"),
          std::string("7"), std::string("\"patina\""), std::string("{\"format\": 3}"),
          std::string("\xff\xd8\xff\xe0 JFIF"), std::string(1000, '\0'),
          std::string("{\"format\": \"patina\", \"version\": 1}"),
          std::string("{\"format\": \"patina\", \"version\": 1e999}")}) {
        const Result<Document> document = documentFromJson(text, kProject);
        ASSERT_FALSE(document.ok()) << text;
        EXPECT_EQ(document.error().kind, ErrorKind::InputBroken);
    }
}

TEST(ProjectJson, HostileSizesAreRefusedBeforeTheyAreParsed) {
    expectBroken(std::string(100'000, '['), "nested more than 64");
    expectBroken("{\"a\":" + std::string(65, '['), "nested more than 64");
    expectBroken(std::string(9'000'000, ','), "values");
    // Many keys in one object, and more materials than there ever are.
    std::string keys = "{\"format\": \"patina\"";
    for (int i = 0; i < 100'000; ++i)
        keys += ",\"k" + std::to_string(i) + "\":0";
    expectBroken(keys + "}", "version");
    std::string materials = "\"materials\": [0";
    for (int i = 0; i < 1'000'000; ++i)
        materials += ",0";
    expectBroken(replaced(documentToJson(small(), kProject), "\"materials\": [", materials + ","),
                 "more than");
}

TEST(ProjectJson, ManyMaterialsTakeLinearTime) {
    Document document;
    for (int i = 0; i < 10'000; ++i)
        document.materials.emplace_back().id = document.takeId();
    const Result<Document> back = documentFromJson(documentToJson(document, kProject), kProject);
    ASSERT_TRUE(back.ok());
    EXPECT_EQ(back->materials.size(), document.materials.size());
}

TEST(ProjectJson, MutantsNeverCrashAndWhatOpensSavesAgain) {
    std::size_t opened = 0, refused = 0;
    for (std::uint32_t seed = 1; seed <= 2000; ++seed) {
        RandomDocument random(seed);
        const std::string text = mutated(documentToJson(random.make(), kProject), random);
        const Result<Document> document = documentFromJson(text, kProject);
        if (!document.ok()) {
            ASSERT_EQ(document.error().kind, ErrorKind::InputBroken) << "seed " << seed;
            ASSERT_FALSE(document.error().message.empty()) << "seed " << seed;
            ++refused;
            continue;
        }
        ++opened;
        const Result<Document> again =
            documentFromJson(documentToJson(*document, kProject), kProject);
        ASSERT_TRUE(again.ok()) << "seed " << seed << ": " << again.error().text();
        ASSERT_TRUE(*again == *document) << "seed " << seed;
    }
    // The mutants are of both sorts.
    EXPECT_GT(opened, 200u);
    EXPECT_GT(refused, 200u);
}
