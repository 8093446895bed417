// Light that is put into a COLLADA document, and nothing else.
#include "tests/core/collada/Documents.h"
#include "tests/support/TemporaryFolder.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <limits>
#include <map>
#include <pugixml.hpp>
#include <set>
#include <sstream>

using namespace patina;
using namespace patina::test;
using std::chrono::sys_seconds;

namespace {

// 2026-11-27, 12:34:56.
constexpr sys_seconds kNow{std::chrono::sys_days{std::chrono::year{2026} / 11 / 27} +
                           std::chrono::hours{12} + std::chrono::minutes{34} +
                           std::chrono::seconds{56}};

pugi::xml_document treeOf(const std::string& text) {
    pugi::xml_document tree;
    EXPECT_TRUE(tree.load_buffer(text.data(), text.size(), pugi::parse_full));
    return tree;
}

// Every node by a path that says which it is: elements by id or by number among their like.
std::map<std::string, std::string> nodesOf(const pugi::xml_node& node, const std::string& path) {
    std::map<std::string, std::string> result;
    std::map<std::string, int> known;
    for (const pugi::xml_node& child : node.children()) {
        std::string name = child.name();
        std::string value = child.value();
        if (child.type() != pugi::node_element)
            name = fmt::format("({}) {}", static_cast<int>(child.type()), name);
        else if (child.attribute("id"))
            name += fmt::format("#{}", child.attribute("id").value());
        name += fmt::format("[{}]", known[name]++);
        for (const pugi::xml_attribute& attribute : child.attributes())
            value += fmt::format(" {}={}", attribute.name(), attribute.value());
        result[path + "/" + name] = value;
        result.merge(nodesOf(child, path + "/" + name));
    }
    return result;
}

// "+ path" of what is new (its inner nodes left out), "- path" of what is gone, "~ path: value" of
// what has changed.
std::vector<std::string> differences(const std::string& before, const std::string& after) {
    const auto old = nodesOf(treeOf(before), ""), now = nodesOf(treeOf(after), "");
    std::vector<std::string> result;
    const auto within = [&](const std::string& path, const auto& other) {
        return !other.contains(path.substr(0, path.rfind('/'))) && path.rfind('/') != 0;
    };
    for (const auto& [path, value] : now)
        if (!old.contains(path) && !within(path, old))
            result.push_back("+ " + path);
        else if (old.contains(path) && old.at(path) != value)
            result.push_back("~ " + path + ":" + value);
    for (const auto& [path, value] : old)
        if (!now.contains(path) && !within(path, now))
            result.push_back("- " + path);
    return result;
}

std::string withoutBlankText(const std::string& text) {
    pugi::xml_document tree;
    tree.load_buffer(text.data(), text.size(), pugi::parse_full & ~pugi::parse_ws_pcdata);
    std::ostringstream out;
    tree.save(out, "", pugi::format_raw);
    return out.str();
}

std::vector<std::string> light(ColladaDocument& document,
                               const std::vector<std::size_t>& instances) {
    std::vector<ColladaLitMesh> meshes;
    for (const std::size_t instance : instances)
        meshes.push_back(litMesh(document, instance));
    Result<std::vector<std::string>> notices = document.light(meshes, kNow);
    if (!notices)
        throw std::runtime_error(notices.error().text());
    return *notices;
}

const pugi::xml_node geometryOf(const pugi::xml_document& tree, const char* id) {
    return tree.child("COLLADA").child("library_geometries").find_child_by_attribute("id", id);
}

} // namespace

TEST(ColladaLight, NothingElseIsChanged) {
    for (const char* version : {"1.4.1", "1.5.0"}) {
        SCOPED_TRACE(version);
        const std::string text = roomDocument(version);
        ColladaDocument document = parsed(text);
        const std::vector<std::string> notices = light(document, {6, 0, 1, 3, 4});
        ASSERT_EQ(notices.size(), 3u);
        EXPECT_THAT(notices[0], ::testing::HasSubstr("\"Person\" (Square) is deformed"));
        EXPECT_THAT(notices[1], ::testing::HasSubstr("Chair"));
        const std::string scene =
            "/COLLADA[0]/library_visual_scenes[0]/visual_scene#Scene[0]/node#";
        const std::string asset = "/COLLADA[0]/asset[0]/";
        const std::string geometry = "+ /COLLADA[0]/library_geometries[0]/geometry#Square-";
        const std::string nodes = "+ /COLLADA[0]/library_nodes[0]/node#Chair-";
        EXPECT_THAT(
            differences(withoutBlankText(text), withoutBlankText(document.text())),
            ::testing::UnorderedElementsAre(
                "+ " + asset + "contributor[0]",
                "~ " + asset + "modified[0]/(3) [0]:2026-11-27T12:34:56Z", geometry + "lit[0]",
                geometry + "unlit[0]", geometry + "lit-2[0]", geometry + "unlit-2[0]",
                geometry + "lit-3[0]", geometry + "unlit-3[0]", nodes + "2[0]", nodes + "3[0]",
                "~ " + scene + "Left[0]/instance_node[0]: url=#Chair-2",
                "~ " + scene + "Right[0]/instance_node[0]: url=#Chair-3",
                "~ " + scene + "Alone[0]/instance_geometry[0]: sid=g url=#Square-lit-3 name=alone",
                "+ " + scene + "Alone[0]/instance_geometry[1]"))
            << document.text();
        const auto tree = treeOf(document.text());
        EXPECT_STREQ(tree.child("COLLADA").attribute("version").value(), version);
    }
}

TEST(ColladaLight, WhatIsLitReadsBackAsItWas) {
    for (const char* version : {"1.4.1", "1.5.0"}) {
        const ColladaDocument before = parsed(roomDocument(version));
        ColladaDocument lit = parsed(roomDocument(version));
        light(lit, {0, 1, 3, 4});
        const ColladaDocument after = parsed(lit.text());
        // As many primitives at the same places: by path, material and shape.
        ASSERT_EQ(after.instances().size(), before.instances().size());
        for (std::size_t i = 0; i < before.instances().size(); ++i) {
            const ColladaInstance& old = before.instances()[i];
            const Mesh a = meshOf(before, i).mesh;
            const auto same = std::ranges::count_if(after.instances(), [&](const auto& now) {
                const auto index = static_cast<std::size_t>(&now - after.instances().data());
                const Mesh b = meshOf(after, index).mesh;
                if (now.path != old.path || now.material != old.material ||
                    a.positions.size() != b.positions.size() || a.indices != b.indices ||
                    a.uvs != b.uvs)
                    return false;
                for (std::size_t v = 0; v < a.positions.size(); ++v)
                    if (!near(a.positions[v], b.positions[v]) || !near(a.normals[v], b.normals[v]))
                        return false;
                return true;
            });
            EXPECT_EQ(same, 1) << old.path << " " << old.primitive;
        }
    }
}

TEST(ColladaLight, VerticesHaveColoursAndRadiosity) {
    ColladaDocument document = parsed(squareDocument(kSquareAsQuad, "<scale>-1 2 1</scale>"));
    light(document, {0});
    const auto tree = treeOf(document.text());
    const pugi::xml_node geometry = geometryOf(tree, "Square-lit");
    EXPECT_STREQ(geometry.attribute("name").value(), "Square-mesh");
    const pugi::xml_node mesh = geometry.child("mesh");
    const auto source = [&](const char* id) {
        return std::string(mesh.find_child_by_attribute("id", id).child_value("float_array"));
    };
    // Mirrored back: the square's own corners, fronts turned over in the world only.
    EXPECT_EQ(source("Square-lit-positions"), "0 0 0 1 0 0 1 1 0 0 1 0");
    EXPECT_EQ(source("Square-lit-colors"),
              "0 0.5 0.25 1 0.25 0.5 0.25 1 0.5 0.5 0.25 1 0.75 0.5 0.25 1");
    const pugi::xml_node triangles = mesh.child("triangles");
    EXPECT_STREQ(triangles.attribute("material").value(), "sym");
    EXPECT_STREQ(triangles.child_value("p"), "0 1 2 0 2 3");
    const pugi::xml_node color = triangles.find_child_by_attribute("semantic", "COLOR");
    EXPECT_STREQ(color.attribute("source").value(), "#Square-lit-colors");
    EXPECT_STREQ(color.attribute("set").value(), "0");
    const pugi::xml_node technique = geometry.child("extra").child("technique");
    EXPECT_STREQ(technique.attribute("profile").value(), "Patina");
    EXPECT_STREQ(technique.child("radiosity").attribute("count").value(), "4");
    EXPECT_STREQ(technique.child_value("radiosity"),
                 "0 3.5 0.125 2.5 3.5 0.125 5 3.5 0.125 7.5 3.5 0.125");
    EXPECT_THAT(
        tree.child("COLLADA").child("asset").child("contributor").child_value("authoring_tool"),
        ::testing::MatchesRegex("Patina [0-9.]+"));
}

TEST(ColladaLight, BytesDoNotDependOnTheOrder) {
    ColladaDocument a = parsed(roomDocument()), b = parsed(roomDocument());
    light(a, {0, 1, 3, 4});
    light(b, {4, 3, 1, 0});
    EXPECT_EQ(a.text(), b.text());
    EXPECT_EQ(parsed(a.text()).text(), a.text());
}

TEST(ColladaLight, ASecondLightReplacesTheFirst) {
    ColladaDocument document = parsed(squareDocument(kSquareAsQuad));
    light(document, {0});
    const std::string once = document.text();
    EXPECT_EQ(document.instances()[0].geometryId, "Square-lit");
    light(document, {0});
    const auto ids = differences(once, document.text());
    const auto tree = treeOf(document.text());
    std::vector<std::string> geometries;
    for (const pugi::xml_node& geometry :
         tree.child("COLLADA").child("library_geometries").children("geometry"))
        geometries.emplace_back(geometry.attribute("id").value());
    EXPECT_THAT(geometries, ::testing::ElementsAre("Square", "Square-lit-lit"));
    int contributors = 0, extras = 0;
    for ([[maybe_unused]] const auto& c :
         tree.child("COLLADA").child("asset").children("contributor"))
        ++contributors;
    for ([[maybe_unused]] const auto& e : geometryOf(tree, "Square-lit-lit").children("extra"))
        ++extras;
    EXPECT_EQ(contributors, 1);
    EXPECT_EQ(extras, 1);
}

// A node that only one place shows stays where it is.
TEST(ColladaLight, ANodeThatIsShownOnceIsNotCopied) {
    const std::string text = documentOf(
        "<library_geometries>" + squareGeometry(kSquareAsQuad) +
            "</library_geometries><library_nodes><node id=\"A\"><instance_node url=\"#B\"/></node>"
            "<node id=\"B\"><instance_geometry url=\"#Square\"/></node></library_nodes>",
        "<node><instance_node url=\"#A\"/></node>");
    ColladaDocument document = parsed(text);
    EXPECT_TRUE(light(document, {0}).empty());
    EXPECT_EQ(treeOf(document.text())
                  .child("COLLADA")
                  .child("library_nodes")
                  .find_child_by_attribute("id", "B")
                  .child("instance_geometry")
                  .attribute("url")
                  .value(),
              std::string("#Square-lit"));
}

// Through two levels, and where a node of the scene itself is shown a second time: each place that
// is not lit still shows the original.
TEST(ColladaLight, OtherPlacesShowWhatTheyShowed) {
    const std::string libraries =
        "<library_geometries>" + squareGeometry(kSquareAsQuad) +
        "</library_geometries><library_nodes><node id=\"B\"><instance_geometry url=\"#Square\"/>"
        "</node><node id=\"A\"><node id=\"A1\"><instance_node url=\"#B\"/></node>"
        "<node id=\"A2\"><translate>0 1 0</translate><instance_node url=\"#B\"/></node></node>"
        "<node id=\"C\"><instance_geometry url=\"#Square\"/></node></library_nodes>";
    const std::string nodes =
        "<node id=\"P\"><instance_node url=\"#A\"/></node>"
        "<node id=\"Q\"><translate>5 0 0</translate><instance_node url=\"#A\"/></node>"
        "<node id=\"R\"><instance_geometry url=\"#Square\"/><instance_node url=\"#C\"/></node>"
        "<node id=\"S\"><translate>9 0 0</translate><instance_node url=\"#R\"/></node>";
    const std::string text = documentOf(libraries, nodes);
    const std::size_t count = parsed(text).instances().size();
    ASSERT_EQ(count, 8u);
    // Every choice of lit instances: exactly those show a lit geometry, each its own.
    for (unsigned int chosen = 1; chosen < 1u << count; ++chosen) {
        ColladaDocument document = parsed(text);
        std::vector<std::size_t> lit;
        for (std::size_t i = 0; i < count; ++i)
            if ((chosen >> i & 1u) != 0)
                lit.push_back(i);
        light(document, lit);
        const ColladaDocument after = parsed(document.text());
        ASSERT_EQ(after.instances().size(), count) << chosen;
        std::set<std::string> own;
        for (std::size_t i = 0; i < count; ++i) {
            const ColladaInstance& instance = after.instances()[i];
            EXPECT_EQ(instance.geometryId != "Square", (chosen >> i & 1u) != 0)
                << chosen << ": " << instance.path << " shows " << instance.geometryId;
            if (instance.geometryId != "Square") {
                EXPECT_TRUE(own.insert(instance.geometryId).second) << chosen;
            }
            EXPECT_TRUE(
                near(meshOf(after, i).mesh.positions[2], meshOf(parsed(text), i).mesh.positions[2]))
                << chosen;
        }
    }
}

TEST(ColladaLight, WrongMeshesLeaveTheDocumentAsItWas) {
    ColladaDocument document = parsed(roomDocument());
    const ColladaLitMesh good = litMesh(document, 0);
    std::vector<std::pair<ColladaLitMesh, const char*>> wrong(9, {good, ""});
    wrong[0].first.instance = 99;
    wrong[0].second = "no instance 99";
    wrong[1].first.colors.pop_back();
    wrong[1].second = "3 colours";
    wrong[2].first.colors[0].r = 1.5f;
    wrong[2].second = "0 to 1";
    wrong[3].first.radiosity[0].g = -1.0f;
    wrong[3].second = "negative";
    wrong[4].first.mesh.positions[1].x = std::numeric_limits<float>::quiet_NaN();
    wrong[4].second = "not finite";
    wrong[5].first.mesh.indices[2] = 4;
    wrong[5].second = "beyond its 4";
    wrong[6].first.mesh.indices.clear();
    wrong[6].second = "no triangles";
    wrong[7].first.mesh.uvs.clear();
    wrong[7].second = "no texture coordinates";
    wrong[8].first.radiosity[0].b = std::numeric_limits<float>::infinity();
    wrong[8].second = "not finite";
    for (const auto& [lit, message] : wrong) {
        const auto result = document.light(std::vector{good, lit}, kNow);
        ASSERT_FALSE(result.ok()) << message;
        EXPECT_EQ(result.error().kind, ErrorKind::Usage);
        if (lit.instance != 0) {
            EXPECT_THAT(result.error().message, ::testing::HasSubstr(message));
        }
        const auto alone = document.light(std::vector{lit}, kNow);
        ASSERT_FALSE(alone.ok()) << message;
        EXPECT_THAT(alone.error().message, ::testing::HasSubstr(message));
    }
    EXPECT_THAT(document.light(std::vector{good, good}, kNow).error().message,
                ::testing::HasSubstr("lit twice"));
    EXPECT_EQ(document.text(), roomDocument());
}

TEST(ColladaLight, FlatInstancesAreLeftAlone) {
    ColladaDocument document = parsed(squareDocument(kSquareAsQuad, "<scale>1 1 0</scale>"));
    const auto notices = light(document, {0});
    ASSERT_EQ(notices.size(), 1u);
    EXPECT_THAT(notices[0], ::testing::HasSubstr("flattened"));
    EXPECT_EQ(document.instances()[0].geometryId, "Square");
}

TEST(ColladaLight, FilesAreWrittenWhole) {
    const TemporaryFolder folder;
    ColladaDocument document = parsed(roomDocument());
    light(document, {0});
    ASSERT_TRUE(document.write(folder / "lit.dae").ok());
    EXPECT_EQ(*readTextFile(folder / "lit.dae", 1u << 24), document.text());
    EXPECT_EQ(document.write(folder / "none/lit.dae").error().kind, ErrorKind::CannotCreate);
    EXPECT_EQ(folder.files(), std::vector<std::string>{"lit.dae"});
}

namespace {

// In the light map by the place in a plane.
ColladaLitMesh mappedMesh(const ColladaDocument& document, std::size_t instance) {
    ColladaLitMesh lit = litMesh(document, instance);
    lit.colors.clear();
    lit.radiosity.clear();
    for (std::size_t i = 0; i < lit.mesh.positions.size(); ++i)
        lit.lightMapUvs.emplace_back(0.25f + 0.5f * static_cast<float>(i) /
                                                 static_cast<float>(lit.mesh.positions.size()),
                                     0.125f);
    return lit;
}

const ColladaLightMap kMap{"room light.png", "room light.exr"};

} // namespace

TEST(ColladaLight, ALightMapHasCoordinatesAndMaterialsOfItsOwn) {
    for (const char* version : {"1.4.1", "1.5.0"}) {
        SCOPED_TRACE(version);
        ColladaDocument document = parsed(roomDocument(version));
        const std::size_t instances = document.instances().size();
        const ColladaMaterial before =
            document.materials()[static_cast<std::size_t>(document.instances()[0].material)];
        const Mesh mesh = meshOf(document, 0).mesh;
        const auto notices = document.light(std::vector{mappedMesh(document, 0)}, kNow, &kMap);
        ASSERT_TRUE(notices.ok()) << notices.error().text();
        const ColladaDocument again = parsed(document.text());
        EXPECT_EQ(again.instances().size(), instances);
        EXPECT_TRUE(again.showsLightMap());
        std::size_t lit = 0;
        for (std::size_t i = 0; i < instances; ++i) {
            const ColladaInstance& instance = again.instances()[i];
            if (instance.material < 0)
                continue;
            const ColladaMaterial& material =
                again.materials()[static_cast<std::size_t>(instance.material)];
            if (material.emissionTexture != "room light.png")
                continue;
            ++lit;
            EXPECT_EQ(material.name, before.name);
            EXPECT_EQ(material.diffuse, glm::vec3(0.0f));
            EXPECT_TRUE(material.diffuseTexture.empty());
            EXPECT_EQ(material.opacity, before.opacity);
            EXPECT_EQ(material.doubleSided, before.doubleSided);
            EXPECT_EQ(meshOf(again, i).mesh.indices.size(), mesh.indices.size());
        }
        EXPECT_EQ(lit, 1u) << "others keep their materials";

        pugi::xml_document tree;
        tree.load_string(document.text().c_str());
        const pugi::xml_node primitive =
            geometryOf(tree, (document.instances()[0].geometryId).c_str())
                .child("mesh")
                .child("triangles");
        int sets = 0, colors = 0;
        for (const pugi::xml_node& input : primitive.children("input")) {
            const std::string semantic = input.attribute("semantic").value();
            sets += semantic == "TEXCOORD" ? 1 : 0;
            colors += semantic == "COLOR" ? 1 : 0;
        }
        EXPECT_EQ(sets, 2);
        EXPECT_EQ(colors, 0);
        EXPECT_THAT(document.text(), ::testing::HasSubstr("room%20light.exr</light_map>"));

        // What glows with a light map would light itself.
        const auto twice = document.light(std::vector{mappedMesh(document, 0)}, kNow, &kMap);
        ASSERT_FALSE(twice.ok());
        EXPECT_EQ(twice.error().kind, ErrorKind::Usage);
        EXPECT_THAT(twice.error().message, ::testing::HasSubstr("light map already"));
        EXPECT_TRUE(document.litGeometries()->empty());
    }
}

TEST(ColladaLight, APlaceBesideTheLightMapIsRefused) {
    ColladaDocument document = parsed(roomDocument());
    const std::string before = document.text();
    ColladaLitMesh beside = mappedMesh(document, 0), few = beside, vertices = litMesh(document, 0);
    beside.lightMapUvs[0].x = 1.5f;
    few.lightMapUvs.pop_back();
    for (const ColladaLitMesh& wrong : {beside, few, vertices}) {
        const auto result = document.light(std::vector{wrong}, kNow, &kMap);
        ASSERT_FALSE(result.ok());
        EXPECT_EQ(result.error().kind, ErrorKind::Usage);
    }
    EXPECT_FALSE(document.light(std::vector{mappedMesh(document, 0)}, kNow).ok()) << "no map";
    EXPECT_EQ(document.text(), before);
}

// A surface that has no material gets one.
TEST(ColladaLight, ALightMapNeedsNoMaterial) {
    ColladaDocument document =
        parsed(squareDocument("<triangles count=\"2\">" + kSquareInputs +
                              "<p>0 0 0 1 0 1 2 0 2 0 0 0 2 0 2 3 0 3</p></triangles>"));
    ASSERT_TRUE(document.light(std::vector{mappedMesh(document, 0)}, kNow, &kMap).ok());
    const ColladaDocument again = parsed(document.text());
    ASSERT_EQ(again.materials().size(), 1u);
    EXPECT_EQ(again.materials()[0].emissionTexture, "room light.png");
    EXPECT_EQ(again.instances()[0].material, 0);
}

TEST(ColladaLight, OtherFilesOfALightMapChangeNamesAlone) {
    const ColladaLightMap other{"hall & more.png", "hall.exr"};
    for (const char* version : {"1.4.1", "1.5.0"}) {
        SCOPED_TRACE(version);
        const auto lit = [&](const ColladaLightMap& map) {
            ColladaDocument document = parsed(roomDocument(version));
            EXPECT_TRUE(document.light(std::vector{mappedMesh(document, 0)}, kNow, &map).ok());
            return document.text();
        };
        ColladaDocument document = parsed(lit(kMap));
        const Result<ColladaLightMap> names = document.lightMap();
        ASSERT_TRUE(names.ok()) << names.error().text();
        EXPECT_EQ(names->picture, kMap.picture);
        EXPECT_EQ(names->radiance, kMap.radiance);
        ASSERT_TRUE(document.renameLightMap(kMap).ok());
        EXPECT_EQ(document.text(), lit(kMap));
        ASSERT_TRUE(document.renameLightMap(other).ok());
        EXPECT_EQ(document.text(), lit(other));
        EXPECT_EQ(parsed(document.text()).lightMap()->picture, other.picture);

        // A program has taken the picture away.
        std::string dark = lit(kMap);
        const std::size_t begin = dark.find("<texture texture=\"light-map-sampler\""),
                          end = dark.find("/>", begin) + 2;
        ASSERT_NE(begin, std::string::npos);
        dark.replace(begin, end - begin, "<color>0 0 0 1</color>");
        ColladaDocument changed = parsed(dark);
        for (const Error& error :
             {changed.lightMap().error(), changed.renameLightMap(other).error()}) {
            EXPECT_EQ(error.kind, ErrorKind::InputBroken);
            EXPECT_THAT(error.message, ::testing::HasSubstr("another program"));
        }
        EXPECT_EQ(changed.text(), dark);
    }
}
