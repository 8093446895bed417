// patina bake radiosity of COLLADA documents: light goes where it came from, one of several visual
// scenes is lit, leaks and seams are listed.
#include "ColladaRoom.h"
#include "CommandsFixture.h"

using namespace patina;
using namespace patina::test;
using testing::HasSubstr;

TEST_F(Commands, RadiosityIsPutIntoTheColladaDocumentThatItCameFrom) {
    writeBytes(m_folder / "room.dae", kColladaRoom);
    const auto bake = [&](const std::string& scene, const std::string& output) {
        return runPatina({"bake", "radiosity", scene, "-o", output, "--set",
                          "environment.enabled=false", "--subdivide", "0.1"});
    };
    const Outcome lit = bake(m_folder / "room.dae", m_folder / "lit.dae");
    ASSERT_EQ(lit.status, 0) << lit.err;
    const std::string text = readBytes(m_folder / "lit.dae");
    for (const char* kept :
         {"<!-- kept -->", "<foo>bar</foo>", "<up_axis>Z_UP</up_axis>", "name=\"centimeter\"",
          "<authoring_tool>by hand</authoring_tool>", "<instance_camera url=\"#cam\""})
        EXPECT_THAT(text, HasSubstr(kept));
    EXPECT_THAT(text, HasSubstr("<authoring_tool>Patina"));
    EXPECT_THAT(text, HasSubstr("semantic=\"COLOR\""));
    // It opens again, each instance with a mesh of its own where it was.
    const nlohmann::json before = runPatina({"info", m_folder / "room.dae", "--json"}).json(),
                         after = runPatina({"info", m_folder / "lit.dae", "--json"}).json();
    EXPECT_EQ(before["counts"]["triangles"], 6);
    EXPECT_GT(after["counts"]["triangles"], 150);
    EXPECT_EQ(after["counts"]["meshes"], 3);
    for (const char* end : {"min", "max"})
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(before["bounds"][end][c].get<double>(),
                        after["bounds"][end][c].get<double>(), 1e-6);

    // Scenes from elsewhere get a document of their own.
    ASSERT_EQ(bake("builtin:cornell-reference", m_folder / "new.dae").status, 0);
    EXPECT_THAT(readBytes(m_folder / "new.dae"), HasSubstr("semantic=\"COLOR\""));
    // Whoever shows its colours does not light them once more, and it is no scene any more.
    EXPECT_THAT(readBytes(m_folder / "new.dae"),
                testing::AllOf(HasSubstr("<constant>"), testing::Not(HasSubstr("<lambert>"))));
    const Outcome again = bake(m_folder / "new.dae", m_folder / "again.dae");
    EXPECT_EQ(again.status, 2);
    EXPECT_THAT(again.err, HasSubstr("its surfaces show baked light already"));
    EXPECT_EQ(runPatina({"info", m_folder / "new.dae", "--json"}).json()["counts"]["meshes"], 6);
}

TEST_F(Commands, OneOfSeveralVisualScenesIsReadAndLit) {
    // The attic, first in the file, has boards high up and a lamp over them.
    const auto quad = [](const std::string& where, const std::string& material) {
        return "<node>" + where +
               "<instance_geometry url=\"#quad\"><bind_material><technique_common>"
               "<instance_material symbol=\"m\" target=\"#" +
               material + "\"/></technique_common></bind_material></instance_geometry></node>";
    };
    std::string text = kColladaRoom;
    text.insert(text.find("<visual_scene id=\"s\">"),
                "<visual_scene id=\"a\" name=\"Attic/50%\">" +
                    quad("<translate>0 0 900</translate>", "white") +
                    quad("<translate>0 0 990</translate><rotate>1 0 0 180</rotate>", "lamp") +
                    "</visual_scene>");
    const std::string file = m_folder / "house.dae";
    writeBytes(file, text);
    const auto info = [&](const std::string& scene, std::vector<std::string> more) {
        std::vector<std::string> arguments{"info", scene, "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runPatina(arguments);
    };
    const Outcome whole = info(file, {});
    ASSERT_EQ(whole.status, 0) << whole.err;
    EXPECT_EQ(whole.json()["counts"]["meshes"], 3);
    EXPECT_EQ(whole.json()["visualScenes"][0]["taken"], "s");
    EXPECT_EQ(whole.json()["visualScenes"][0]["all"], nlohmann::json({"Attic/50%", "s"}));
    EXPECT_THAT(whole.err, HasSubstr("of 2 visual scenes \"s\" is shown, not \"Attic/50%\""));
    EXPECT_THAT(whole.err, HasSubstr("--visual-scene"));
    for (const char* name : {"Attic/50%", "a"}) { // its name, its id
        const Outcome attic = info(file, {"--visual-scene", name});
        ASSERT_EQ(attic.status, 0) << attic.err;
        EXPECT_EQ(attic.json()["counts"]["meshes"], 2);
        EXPECT_NEAR(attic.json()["bounds"]["min"][1].get<double>(), 9.0, 1e-5);
        EXPECT_EQ(attic.json()["visualScenes"][0]["taken"], "Attic/50%");
    }
    const Outcome unknown = info(file, {"--visual-scene", "Cellar"});
    EXPECT_EQ(unknown.status, 2);
    EXPECT_THAT(unknown.err,
                HasSubstr("no visual scene \"Cellar\"; it has \"Attic/50%\" and \"s\""));
    EXPECT_THAT(unknown.err, HasSubstr("house.dae"));
    EXPECT_EQ(info("builtin:sphere", {"--visual-scene", "s"}).status, 2);
    // Without a <scene> it is the first one.
    std::string unnamed = text;
    const std::string named = "<scene><instance_visual_scene url=\"#s\"/></scene>";
    unnamed.erase(unnamed.find(named), named.size());
    writeBytes(m_folder / "unnamed.dae", unnamed);
    EXPECT_EQ(info(m_folder / "unnamed.dae", {}).json()["counts"]["meshes"], 2);
    EXPECT_EQ(info(m_folder / "unnamed.dae", {"--visual-scene", "s"}).json()["counts"]["meshes"],
              3);

    // Light goes into the chosen scene; the other one is written as it was.
    const Outcome lit = runPatina({"bake", "radiosity", file, "-o", m_folder / "lit.dae", "--set",
                                   "environment.enabled=false", "--subdivide", "0.1",
                                   "--visual-scene", "Attic/50%"});
    ASSERT_EQ(lit.status, 0) << lit.err;
    EXPECT_GT(info(m_folder / "lit.dae", {"--visual-scene", "Attic/50%"})
                  .json()["counts"]["triangles"]
                  .get<int>(),
              10);
    EXPECT_EQ(info(m_folder / "lit.dae", {"--visual-scene", "s"}).json()["counts"]["triangles"], 6);
    EXPECT_EQ(info(m_folder / "lit.dae", {}).json()["counts"]["triangles"], 6);
}

TEST_F(Commands, RadiosityListsLeaksAndSeams) {
    // A floor of two meshes side by side; a lamp between a wall that ends above it and one that
    // stands on it.
    const auto quad = [](const char* name, const char* where, const char* material) {
        return std::string("<node name=\"") + name + "\">" + where +
               "<instance_geometry url=\"#quad\"><bind_material><technique_common>"
               "<instance_material symbol=\"m\" target=\"#" +
               material + "\"/></technique_common></bind_material></instance_geometry></node>";
    };
    std::string text = kColladaRoom;
    const std::size_t first = text.find("<node name=\"Floor\">"),
                      last = text.find("<node name=\"CamNode\">");
    text.replace(
        first, last - first,
        quad("Floor", "", "white") + quad("Beside", "<translate>200 0 0</translate>", "white") +
            quad("End", "<translate>0 100 100</translate><rotate>1 0 0 90</rotate>", "white") +
            quad("Wall", "<translate>0 0 102</translate><rotate>1 0 0 90</rotate>", "white") +
            quad("Lamp",
                 "<translate>80 50 60</translate><rotate>1 0 0 180</rotate>"
                 "<scale>0.3 0.3 0.3</scale>",
                 "lamp"));
    writeBytes(m_folder / "leaky.dae", text);
    const Outcome outcome =
        runPatina({"bake", "radiosity", m_folder / "leaky.dae", "-o", m_folder / "out.glb", "--set",
                   "environment.enabled=false", "--subdivide", "0.04", "--find-leaks", "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const nlohmann::json json = outcome.json();
    ASSERT_GT(json["leaks"]["count"].get<int>(), 0);
    bool wall = false;
    for (const nlohmann::json& leak : json["leaks"]["list"])
        if (leak["kind"] == "gap" && leak["mesh"].get<std::string>().find("Wall") == 0) {
            EXPECT_NEAR(leak["width"].get<double>(), 0.02, 1e-4);
            EXPECT_GT(leak["power"].get<double>(), 0.0);
            wall = true;
        }
    EXPECT_TRUE(wall);
    ASSERT_GT(json["seams"]["count"].get<int>(), 0);
    for (const nlohmann::json& seam : json["seams"]["list"]) {
        EXPECT_NE(seam["mesh"], seam["otherMesh"]);
        EXPECT_NEAR(seam["position"][0].get<double>(), 1.0, 1e-3);
    }
    // In words, and only where it is asked for.
    const Outcome plain =
        runPatina({"bake", "radiosity", m_folder / "leaky.dae", "-o", m_folder / "out.glb", "--set",
                   "environment.enabled=false", "--subdivide", "0.04", "--json"});
    EXPECT_FALSE(plain.json().contains("leaks"));
}
