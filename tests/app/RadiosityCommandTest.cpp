// patina bake radiosity and patina certificate: what is written, told and refused.
#include "CommandsFixture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>

using namespace patina;
using namespace patina::test;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

namespace {

// A floor, a wall and a lamp that share one quad, Z up and in centimetres, with what Patina does
// not know.
constexpr const char* kColladaRoom = R"(<?xml version="1.0" encoding="utf-8"?>
<!-- kept -->
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><contributor><authoring_tool>by hand</authoring_tool></contributor><created>2020-01-01T00:00:00Z</created><modified>2020-01-01T00:00:00Z</modified><unit name="centimeter" meter="0.01"/><up_axis>Z_UP</up_axis></asset>
  <library_cameras><camera id="cam" name="Cam"><optics><technique_common><perspective><xfov>45</xfov><znear>1</znear><zfar>1000</zfar></perspective></technique_common></optics><extra><technique profile="OTHER"><foo>bar</foo></technique></extra></camera></library_cameras>
  <library_effects>
    <effect id="white-fx"><profile_COMMON><technique sid="common"><lambert><diffuse><color>0.8 0.8 0.8 1</color></diffuse></lambert></technique></profile_COMMON></effect>
    <effect id="lamp-fx"><profile_COMMON><technique sid="common"><lambert><emission><color>1 0.9 0.8 1</color></emission><diffuse><color>0.5 0.5 0.5 1</color></diffuse></lambert></technique></profile_COMMON></effect>
  </library_effects>
  <library_materials><material id="white"><instance_effect url="#white-fx"/></material><material id="lamp"><instance_effect url="#lamp-fx"/></material></library_materials>
  <library_geometries><geometry id="quad"><mesh>
    <source id="p"><float_array id="pa" count="12">-100 -100 0 100 -100 0 100 100 0 -100 100 0</float_array><technique_common><accessor source="#pa" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    <polylist count="1" material="m"><input semantic="VERTEX" source="#v" offset="0"/><vcount>4</vcount><p>0 1 2 3</p></polylist>
  </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="s">
    <node name="Floor"><instance_geometry url="#quad"><bind_material><technique_common><instance_material symbol="m" target="#white"/></technique_common></bind_material></instance_geometry></node>
    <node name="Wall"><translate>0 100 100</translate><rotate>1 0 0 90</rotate><instance_geometry url="#quad"><bind_material><technique_common><instance_material symbol="m" target="#white"/></technique_common></bind_material></instance_geometry></node>
    <node name="Lamp"><translate>0 0 180</translate><rotate>1 0 0 180</rotate><scale>0.3 0.3 0.3</scale><instance_geometry url="#quad"><bind_material><technique_common><instance_material symbol="m" target="#lamp"/></technique_common></bind_material></instance_geometry></node>
    <node name="CamNode"><translate>0 -400 100</translate><instance_camera url="#cam"/></node>
  </visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#s"/></scene>
</COLLADA>
)";

} // namespace

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

TEST_F(Commands, RadiosityIsSolvedAndWrittenWhereverItIsAskedFor) {
    const auto bake = [&](const std::string& output, std::vector<std::string> more,
                          const char* area = "0.005") {
        std::vector<std::string> arguments{
            "bake", "radiosity", "builtin:cornell-reference", "-o",
            output, "--set",     "environment.enabled=false", "--subdivide",
            area,   "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runPatina(arguments);
    };
    const Outcome outcome = bake(m_folder / "a.glb", {"--threads", "2"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const nlohmann::json json = outcome.json();
    EXPECT_EQ(json["command"], "bake radiosity");
    EXPECT_EQ(json["converged"], true);
    EXPECT_LE(json["residual"].get<double>(), 1e-3);
    EXPECT_GT(json["counts"]["elements"].get<int>(), 400);
    EXPECT_LT(json["formFactors"]["closure"].get<double>(), 1e-6);
    EXPECT_GT(json["exposure"].get<double>(), 0.0);
    ASSERT_EQ(bake(m_folder / "b.glb", {"--threads", "1"}).status, 0);
    EXPECT_EQ(readBytes(m_folder / "a.glb"), readBytes(m_folder / "b.glb"));
    // Any program's file is a model here, too.
    EXPECT_GT(runPatina({"info", m_folder / "a.glb", "--json"}).json()["counts"]["triangles"], 800);

    // Every solver and method; partly solved.
    for (const char* solver : {"progressive", "southwell", "overshooting", "jacobi", "direct"}) {
        const Outcome solved = bake(m_folder / "s.ply", {"--solver", solver, "--resolution", "64"});
        ASSERT_EQ(solved.status, 0) << solved.err;
        EXPECT_EQ(solved.json()["converged"], true) << solver;
    }
    for (const char* method : {"hemicube", "paraboloid", "analytic"})
        EXPECT_EQ(bake(m_folder / "m.ply",
                       {"--form-factors", method, "--resolution", "8", "--exposure", "none"},
                       "0.02")
                      .status,
                  0);
    const Outcome ten =
        bake(m_folder / "ten.ply", {"--solver", "progressive", "--classic", "--iterations", "10"});
    EXPECT_EQ(ten.json()["iterations"], 10);
    EXPECT_EQ(ten.json()["converged"], false);
    ASSERT_EQ(bake(m_folder / "step.png", {"--solver", "progressive", "--classic", "--iterations",
                                           "5", "--output-every", "2", "--size", "8x8"})
                  .status,
              0);
    std::vector<std::string> steps = m_folder.files();
    std::erase_if(steps, [](const std::string& file) { return !file.starts_with("step"); });
    EXPECT_THAT(steps, ElementsAre("step-000002.png", "step-000004.png", "step.png"));
    EXPECT_THAT(readBytes(m_folder / "ten.ply"), HasSubstr("property float radiance_r"));

    const Outcome adaptive = bake(m_folder / "d.ply", {}, "adaptive:0.3");
    ASSERT_EQ(adaptive.status, 0) << adaptive.err;
    EXPECT_GT(adaptive.json()["counts"]["elements"].get<int>(), 1100) << "more than the first ones";
    EXPECT_EQ(bake(m_folder / "x.ply", {}, "adaptive:").status, 2);
    EXPECT_EQ(bake(m_folder / "x.ply", {}, "-1").status, 2);

    // Pictures of it: as displayed, and the light itself.
    for (const char* look : {"smooth", "elements", "gathered"})
        ASSERT_EQ(bake(m_folder / (std::string(look) + ".png"),
                       {"--look", look, "--size", "24x16", "--camera", "0,0"})
                      .status,
                  0);
    EXPECT_NE(readBytes(m_folder / "smooth.png"), readBytes(m_folder / "elements.png"));
    EXPECT_EQ(load(m_folder / "smooth.png").width(), 24);
    ASSERT_EQ(bake(m_folder / "p.exr", {"--size", "24x16"}).status, 0);
    EXPECT_EQ(load(m_folder / "p.exr").type(), PixelType::F32);
    EXPECT_EQ(bake(m_folder / "x.ply", {"--look", "smooth"}).status, 2);

    EXPECT_EQ(bake(m_folder / "x.obj", {}).status, 2);
    EXPECT_EQ(bake(m_folder / "x.ply", {"--exposure", "-1"}).status, 2);
    EXPECT_EQ(bake(m_folder / "x.ply", {"--form-factors", "hemicube", "--resolution", "7"}).status,
              2);
    EXPECT_EQ(
        bake(m_folder / "x.ply", {"--form-factors", "paraboloid", "--resolution", "1"}).status, 2);
    const Outcome fine = bake(m_folder / "x.ply", {}, "1e-9");
    EXPECT_NE(fine.status, 0);
    EXPECT_THAT(fine.err + fine.out, HasSubstr("divide it less finely"));
    const Outcome dark = runPatina({"bake", "radiosity", "builtin:sphere", "-o", m_folder / "x.ply",
                                    "--set", "environment.enabled=false"});
    EXPECT_EQ(dark.status, 65);
    EXPECT_THAT(dark.err, HasSubstr("Nothing in the scene gives light"));
    EXPECT_THAT(m_folder.files(), Not(testing::Contains("x.ply")));
}

// Elements this coarse cannot be right: the table is there all the same, and the status says so.
TEST_F(Commands, CertificateFailsWhereAnEstimatorIsOff) {
    const Outcome outcome = runPatina({"certificate", "--samples", "1024", "--edge", "0.4",
                                       "--rays", "256", "--hemicube", "8", "--paraboloid", "16",
                                       "--analytic", "2", "-o", m_folder / "c.json"});
    EXPECT_EQ(outcome.status, 1);
    for (const char* text :
         {"empty box, floor_centre", "with blocks, tall_block_top", "path tracer",
          "hemicube, direct", "paraboloid, gathering", "analytic, progressive", "FAILS", "holds"})
        EXPECT_THAT(outcome.out, HasSubstr(text));
    EXPECT_THAT(outcome.err, HasSubstr("times what is allowed, 2 %"));
    const nlohmann::json file = nlohmann::json::parse(readBytes(m_folder / "c.json"));
    EXPECT_EQ(file["holds"], false);
    EXPECT_EQ(file["settings"]["rays"], 256);
    EXPECT_EQ(file["reference"].size(), 22u);
    EXPECT_EQ(file["reference"][0]["irradiance"].size(), 6u);
    ASSERT_EQ(file["estimators"].size(), 13u);
    for (const nlohmann::json& estimator : file["estimators"]) {
        EXPECT_EQ(estimator["irradiance"].size(), 22u);
        const double value = estimator["irradiance"][3][2],
                     truth = file["reference"][3]["irradiance"][2];
        EXPECT_NEAR(estimator["deviation"][3][2].get<double>(), value / truth - 1.0, 1e-12);
    }
    EXPECT_EQ(file["estimators"][0]["standardError"].size(), 22u);
}

// The same as solving again with the other exposure, but for what rounding leaves of COLLADA's
// text.
TEST_F(Commands, RadiosityIsExposedAnewWithoutSolving) {
    const auto bake = [&](const std::string& output, const char* exposure,
                          const char* scene = "builtin:cornell-reference") {
        return runPatina({"bake", "radiosity", scene, "-o", output, "--environment",
                          "builtin:white", "--subdivide", "0.05", "--exposure", exposure,
                          "--json"});
    };
    const auto reexpose = [&](const std::string& solved, const std::string& output,
                              const char* exposure) {
        return runPatina({"bake", "radiosity", "--reexpose", solved, "-o", output, "--exposure",
                          exposure, "--json"});
    };
    const auto file = [&](const char* name, const std::string& kind) {
        return m_folder / (name + kind);
    };
    for (const std::string kind : {".glb", ".ply", ".gltf", ".dae"}) {
        SCOPED_TRACE(kind);
        ASSERT_EQ(bake(file("a", kind), "5").status, 0);
        ASSERT_EQ(bake(file("b", kind), "2").status, 0);
        const Outcome again = reexpose(file("a", kind), file("c", kind), "2");
        ASSERT_EQ(again.status, 0) << again.err;
        EXPECT_EQ(again.json()["exposure"], 2.0);
        if (kind == ".gltf") {
            EXPECT_NE(readBytes(file("a", ".bin")), readBytes(file("b", ".bin")));
            EXPECT_EQ(readBytes(file("c", ".bin")), readBytes(file("b", ".bin")));
        } else if (kind == ".dae") {
            std::istringstream wanted(readBytes(file("b", kind))),
                found(readBytes(file("c", kind)));
            std::size_t numbers = 0;
            for (std::string a, b; wanted >> a;) {
                ASSERT_TRUE(found >> b);
                char* end = nullptr;
                const double x = std::strtod(a.c_str(), &end);
                if (end == a.c_str())
                    continue; // a word, or a date
                ++numbers;
                ASSERT_NEAR(x, std::strtod(b.c_str(), nullptr), 2e-6 * std::max(1.0, std::abs(x)))
                    << a << " " << b;
            }
            EXPECT_GT(numbers, 1000u);
        } else {
            EXPECT_NE(readBytes(file("a", kind)), readBytes(file("b", kind)));
            EXPECT_EQ(readBytes(file("c", kind)), readBytes(file("b", kind)));
        }
        // Found again from what the file holds.
        const double automatic = bake(file("b", kind), "auto").json()["exposure"];
        const Outcome found = reexpose(file("a", kind), file("c", kind), "auto");
        EXPECT_NEAR(found.json()["exposure"].get<double>() / automatic, 1.0, 0.15);
    }

    // Below a texture colours show the light of a white surface, which is kept, too.
    ASSERT_EQ(bake(file("a", ".glb"), "5", "builtin:plane").status, 0);
    ASSERT_EQ(bake(file("b", ".glb"), "none", "builtin:plane").status, 0);
    EXPECT_THAT(readBytes(file("a", ".glb")), HasSubstr("_WHITE_RADIANCE"));
    ASSERT_EQ(reexpose(file("a", ".glb"), file("c", ".glb"), "none").status, 0);
    EXPECT_EQ(readBytes(file("c", ".glb")), readBytes(file("b", ".glb")));

    // What is no solved file, or none any more.
    for (const std::string kind : {".glb", ".gltf"}) {
        ASSERT_EQ(runPatina({"export", "builtin:plane", "-o", file("plain", kind)}).status, 0);
        const Outcome none = reexpose(file("plain", kind), file("x", kind), "2");
        EXPECT_EQ(none.status, 65);
        EXPECT_THAT(none.err, HasSubstr("holds no light"));
        EXPECT_THAT(none.err, HasSubstr("plain" + kind));
    }
    for (const std::string kind : {".glb", ".ply", ".dae"}) {
        const std::string whole = readBytes(file("a", kind));
        for (const std::size_t length : {whole.size() / 2, whole.size() / 20, std::size_t{3}}) {
            writeBytes(m_folder.path() / ("cut" + kind), whole.substr(0, length));
            const Outcome cut = reexpose(file("cut", kind), file("x", kind), "2");
            EXPECT_EQ(cut.status, 65) << kind << " " << length << " " << cut.err;
            EXPECT_THAT(cut.err, HasSubstr("cut" + kind));
        }
        EXPECT_FALSE(std::filesystem::exists(file("x", kind)));
    }
    const std::string solved = readBytes(file("a", ".ply"));
    const std::size_t faces = solved.find("element face "), end = solved.find("end_header\n");
    const std::string endless =
        solved.substr(0, faces) + "element face 999999999999999999\n" + solved.substr(end);
    for (const std::string& hostile :
         {std::string("ply\nformat binary_little_endian 1.0\nend_header\n"),
          std::string("ply\nformat binary_little_endian 1.0\nelement vertex 9\nend_header\n"),
          std::string("ply\nformat binary_little_endian 1.0\nproperty list\nend_header\n"),
          solved.substr(0, faces) +
              "element face 99999999\nproperty list uchar uint "
              "vertex_indices\n" +
              solved.substr(end)}) {
        writeBytes(m_folder.path() / "hostile.ply", hostile);
        EXPECT_EQ(reexpose(file("hostile", ".ply"), file("x", ".ply"), "2").status, 65);
    }
    writeBytes(m_folder.path() / "endless.ply", endless); // faces of nothing: none
    EXPECT_EQ(reexpose(file("endless", ".ply"), file("y", ".ply"), "2").status, 0);
    EXPECT_EQ(reexpose(file("a", ".glb"), file("x", ".ply"), "2").status, 2);
    EXPECT_EQ(reexpose(file("missing", ".glb"), file("x", ".glb"), "2").status, 66);
    EXPECT_EQ(reexpose(file("a", ".glb"), file("x", ".glb"), "-2").status, 2);
    const Outcome both = runPatina({"bake", "radiosity", "--reexpose", file("a", ".glb"), "-o",
                                    file("x", ".glb"), "--solver", "jacobi"});
    EXPECT_EQ(both.status, 2);
    EXPECT_THAT(both.err, HasSubstr("--solver"));
    const Outcome neither = runPatina({"bake", "radiosity", "-o", file("x", ".glb")});
    EXPECT_EQ(neither.status, 2);
    EXPECT_THAT(neither.err, HasSubstr("--reexpose"));
}

TEST_F(Commands, RadiosityIsWrittenPerTexel) {
    const auto bake = [&](const std::string& scene, const std::string& output,
                          std::vector<std::string> more) {
        std::vector<std::string> arguments{"bake",
                                           "radiosity",
                                           scene,
                                           "-o",
                                           output,
                                           "--set",
                                           "environment.enabled=false",
                                           "--subdivide",
                                           "0.05",
                                           "--target",
                                           "texel",
                                           "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runPatina(arguments);
    };
    const std::string cornell = "builtin:cornell-reference";
    const Outcome outcome = bake(cornell, m_folder / "a.glb", {"--size", "128"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.json()["lightMap"]["size"], 128);
    EXPECT_GT(outcome.json()["lightMap"]["texels"], 128 * 128 / 4);
    EXPECT_EQ(load(m_folder / "a_light-map.exr").width(), 128);

    // The file, as glTF has it.
    const std::string file = readBytes(m_folder / "a.glb");
    std::uint32_t length = 0;
    std::memcpy(&length, file.data() + 12, 4);
    const nlohmann::json gltf = nlohmann::json::parse(file.substr(20, length));
    EXPECT_EQ(gltf["extras"]["patinaLightMap"]["radiance"], "a_light-map.exr");
    EXPECT_EQ(gltf["extras"]["patinaLightMap"]["exposure"], outcome.json()["exposure"]);
    ASSERT_EQ(gltf["textures"].size(), 1u) << "one of all materials";
    for (const nlohmann::json& material : gltf["materials"]) {
        EXPECT_EQ(material["emissiveTexture"]["index"], 0);
        EXPECT_EQ(material["emissiveTexture"]["texCoord"], 1);
        EXPECT_EQ(material["pbrMetallicRoughness"]["baseColorFactor"][0], 0.0);
        EXPECT_EQ(material["extensions"]["KHR_materials_specular"]["specularFactor"], 0.0);
        EXPECT_FALSE(material["extensions"].contains("KHR_materials_unlit"));
    }
    for (const nlohmann::json& mesh : gltf["meshes"]) {
        const nlohmann::json& attributes = mesh["primitives"][0]["attributes"];
        EXPECT_TRUE(attributes.contains("TEXCOORD_0"));
        EXPECT_TRUE(attributes.contains("TEXCOORD_1"));
        EXPECT_FALSE(attributes.contains("COLOR_0"));
    }

    // Meshes stay as they are, and open here with the light map where it belongs.
    const auto triangles = [&](const std::string& scene) {
        return runPatina({"info", scene, "--json"}).json()["counts"]["triangles"].get<int>();
    };
    EXPECT_EQ(triangles(m_folder / "a.glb"), triangles(cornell));
    ASSERT_EQ(bake(cornell, m_folder / "picture.exr", {"--size", "128"}).status, 0);
    EXPECT_EQ(readBytes(m_folder / "picture.exr"), readBytes(m_folder / "a_light-map.exr"));

    // As COLLADA: new, and into the document that it came from.
    ASSERT_EQ(bake(cornell, m_folder / "new.dae", {"--size", "128"}).status, 0);
    EXPECT_EQ(triangles(m_folder / "new.dae"), triangles(cornell));
    EXPECT_EQ(readBytes(m_folder / "new_light-map.exr"), readBytes(m_folder / "a_light-map.exr"));
    EXPECT_EQ(load(m_folder / "new_light-map.png").width(), 128);
    writeBytes(m_folder / "room.dae", kColladaRoom);
    const Outcome room =
        bake(m_folder / "room.dae", m_folder / "lit.dae", {"--size", "64", "--look", "gathered"});
    ASSERT_EQ(room.status, 0) << room.err;
    const std::string text = readBytes(m_folder / "lit.dae");
    EXPECT_THAT(text, HasSubstr("<!-- kept -->"));
    EXPECT_THAT(text, HasSubstr("<init_from>lit_light-map.png</init_from>"));
    EXPECT_EQ(triangles(m_folder / "lit.dae"), 6);
    const Outcome again = bake(m_folder / "lit.dae", m_folder / "twice.dae", {"--size", "64"});
    EXPECT_EQ(again.status, 2);
    EXPECT_THAT(again.err, HasSubstr("light map already"));

    // The same bytes for any number of threads.
    for (const char* threads : {"1", "7"}) {
        ASSERT_EQ(bake(cornell, m_folder / "b.gltf", {"--size", "64", "--threads", threads}).status,
                  0);
        for (const char* part : {"b.gltf", "b.bin", "b_light-map.png", "b_light-map.exr"}) {
            const std::string bytes = readBytes(m_folder / part);
            EXPECT_FALSE(bytes.empty()) << part;
            if (threads == std::string("1"))
                writeBytes(m_folder / (std::string("one-") + part), bytes);
            else
                EXPECT_TRUE(bytes == readBytes(m_folder / (std::string("one-") + part))) << part;
        }
    }

    // All files or none: where one of them cannot be, the others are not left.
    std::filesystem::create_directory(m_folder.path() / "c_light-map.exr");
    EXPECT_NE(bake(cornell, m_folder / "c.dae", {"--size", "64"}).status, 0);
    EXPECT_FALSE(std::filesystem::exists(m_folder / "c.dae"));
    EXPECT_FALSE(std::filesystem::exists(m_folder / "c_light-map.png"));

    const auto refused = [&](const std::string& output, std::vector<std::string> more,
                             const char* reason) {
        const Outcome wrong = bake(cornell, output, std::move(more));
        EXPECT_EQ(wrong.status, 2);
        EXPECT_THAT(wrong.err, HasSubstr(reason));
        EXPECT_FALSE(std::filesystem::exists(output));
    };
    for (const char* size : {"0", "-3", "4097", "64x64", "1.5", "nan", "big"})
        refused(m_folder / "x.glb", {"--size", size}, "from 1 to 4096");
    refused(m_folder / "x.glb", {"--size", "2"}, "use --size ");
    refused(m_folder / "x.ply", {}, "PLY has no textures");
    refused(m_folder / "x.png", {"--camera", "0,0"}, "--camera is for pictures");
}

TEST_F(Commands, RadiositySaysHowFarOffItMayBe) {
    const auto bake = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments{"bake",
                                           "radiosity",
                                           "builtin:cornell-reference",
                                           "-o",
                                           m_folder / "a.ply",
                                           "--set",
                                           "environment.enabled=false",
                                           "--subdivide",
                                           "0.02"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runPatina(arguments);
    };
    const nlohmann::json few = bake({"--json"}).json(),
                         many =
                             bake({"--json", "--resolution", "16384", "--estimate-discretisation"})
                                 .json();
    EXPECT_EQ(few["errorBound"]["confidence"], 0.999);
    EXPECT_NEAR(few["errorBound"]["total"].get<double>(),
                few["errorBound"]["solving"].get<double>() +
                    few["errorBound"]["sampling"].get<double>(),
                1e-12);
    EXPECT_GT(few["errorBound"]["sampling"].get<double>(),
              5.0 * many["errorBound"]["sampling"].get<double>());
    EXPECT_EQ(few.count("discretisationEstimate"), 0u);
    EXPECT_EQ(many["discretisationEstimate"]["elements"].get<int>(),
              4 * many["counts"]["elements"].get<int>());
    EXPECT_GT(many["discretisationEstimate"]["rms"].get<double>(), 0.0);
    const nlohmann::json cubes =
        bake({"--json", "--form-factors", "hemicube", "--resolution", "8"}).json();
    EXPECT_TRUE(cubes["errorBound"]["total"].is_null());
    EXPECT_GT(cubes["errorBound"]["solving"].get<double>(), 0.0);
    EXPECT_THAT(bake({}).out, HasSubstr("of the mean radiosity (99.9 % confidence)"));

    const nlohmann::json linked = bake({"--json", "--solver", "hierarchical"}).json();
    EXPECT_EQ(linked["settings"]["solver"], "hierarchical");
    EXPECT_GT(linked["links"]["last"].get<int>(), 1000);
    EXPECT_EQ(bake({"--solver", "hierarchical", "--form-factors", "analytic"}).status, 2);
}

TEST_F(Commands, RadiosityOfPatchesHasARowOfFormFactorsForEach) {
    const auto bake = [&](const std::string& output, std::vector<std::string> more) {
        std::vector<std::string> arguments{
            "bake",   "radiosity", "builtin:cornell-reference", "-o", m_folder / output,
            "--json", "--set",     "environment.enabled=false"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runPatina(arguments);
    };
    const std::vector<std::string> shot{"--solver", "progressive", "--subdivide", "0.01"};
    const nlohmann::json alone = bake("a.ply", shot).json();
    std::vector<std::string> ofPatches = shot;
    ofPatches.insert(ofPatches.end(), {"--patches", "0.04"});
    const nlohmann::json patches = bake("b.ply", ofPatches).json();
    EXPECT_EQ(alone["settings"]["patches"], 0.0);
    EXPECT_EQ(alone["counts"].count("patches"), 0u);
    EXPECT_EQ(patches["settings"]["patches"], 0.04);
    EXPECT_GE(patches["counts"]["elements"], 4 * patches["counts"]["patches"].get<int>());
    EXPECT_LE(patches["counts"]["factorRows"], patches["counts"]["patches"]);
    EXPECT_LT(patches["counts"]["factors"], alone["counts"]["factors"]);
    EXPECT_LT(patches["factorBytes"], alone["factorBytes"]);
    const nlohmann::json& energy = patches["energy"];
    EXPECT_NEAR(energy["absorbed"].get<double>() + energy["escaped"].get<double>() +
                    energy["unshot"].get<double>(),
                energy["emitted"].get<double>(), 1e-6 * energy["emitted"].get<double>());

    // In parts it is the same bytes.
    for (const char* part : {"1/2", "2/2"}) {
        std::vector<std::string> arguments = ofPatches;
        arguments.insert(arguments.end(), {"--shard", part});
        ASSERT_EQ(bake(std::string("part") + part[0], arguments).status, 0);
    }
    const Outcome merged =
        runPatina({"merge", m_folder / "part1", m_folder / "part2", "-o", m_folder / "merged.ply"});
    ASSERT_EQ(merged.status, 0) << merged.err;
    EXPECT_EQ(readBytes(m_folder / "merged.ply"), readBytes(m_folder / "b.ply"));

    const auto refusal = [&](std::vector<std::string> more) {
        const Outcome outcome = bake("c.ply", std::move(more));
        EXPECT_EQ(outcome.status, 2) << outcome.err;
        return outcome.err + outcome.out;
    };
    for (const char* solver : {"gathering", "jacobi", "direct", "hierarchical"})
        EXPECT_THAT(refusal({"--patches", "0.1", "--solver", solver}),
                    testing::AllOf(HasSubstr("overshooting"), HasSubstr(solver)));
    EXPECT_THAT(refusal({"--patches", "0.01", "--subdivide", "0.02", "--solver", "southwell"}),
                HasSubstr("smaller"));
    EXPECT_THAT(refusal({"--patches", "1e-6", "--solver", "southwell"}), HasSubstr("smaller"));
}

TEST_F(Commands, RadiosityDrawsHemicubesWhereItIsAskedTo) {
    const auto bake = [&](const char* output, std::vector<std::string> more,
                          const RunOptions& options = {}) {
        std::vector<std::string> all{"bake",
                                     "radiosity",
                                     "builtin:cornell-reference",
                                     "-o",
                                     m_folder / output,
                                     "--subdivide",
                                     "0.02",
                                     "--set",
                                     "environment.enabled=false",
                                     "--form-factors",
                                     "hemicube",
                                     "--resolution",
                                     "32",
                                     "--exposure",
                                     "3"};
        all.insert(all.end(), more.begin(), more.end());
        return runPatina(all, options);
    };
    const Outcome drawn = bake("gpu.ply", {"--device", "gpu", "--json"});
    ASSERT_EQ(drawn.status, 0) << drawn.err;
    EXPECT_EQ(drawn.json()["settings"]["device"], "gpu");
    const std::string renderer = drawn.json()["openGl"]["renderer"];
    EXPECT_FALSE(renderer.empty());
    const Outcome cast = bake("cpu.ply", {"--json"});
    EXPECT_EQ(cast.json()["settings"]["device"], "cpu");
    EXPECT_EQ(cast.json().count("openGl"), 0u);
    // The same equation, but for cells whose middle an edge runs through.
    EXPECT_NEAR(drawn.json()["formFactors"]["escaped"].get<double>(),
                cast.json()["formFactors"]["escaped"].get<double>(), 1e-3);
    EXPECT_THAT(bake("gpu.ply", {"--device", "gpu"}).out, HasSubstr("by hemicube on " + renderer));
    EXPECT_THAT(bake("cpu.ply", {}).out, HasSubstr("by hemicube on the CPU"));

    // Parts say so, and the whole needs no OpenGL any more.
    RunOptions noOpenGl;
    noOpenGl.environment = {{"__EGL_VENDOR_LIBRARY_FILENAMES", "/nowhere/egl.json"}};
    std::vector<std::string> merge{"merge", "-o", m_folder / "merged.ply", "--json"};
    for (const char* part : {"1/2", "2/2"}) {
        merge.push_back(m_folder / (std::string("part") + part[0]));
        ASSERT_EQ(
            bake((std::string("part") + part[0]).c_str(), {"--device", "gpu", "--shard", part})
                .status,
            0);
    }
    const Outcome merged = runPatina(merge, noOpenGl);
    ASSERT_EQ(merged.status, 0) << merged.err;
    EXPECT_EQ(merged.json()["settings"]["device"], "gpu");
    EXPECT_EQ(readBytes(m_folder / "merged.ply"), readBytes(m_folder / "gpu.ply"));

    // Without OpenGL nothing else steps in.
    const Outcome none = bake("none.ply", {"--device", "gpu"}, noOpenGl);
    EXPECT_EQ(none.status, 69);
    EXPECT_THAT(none.err, HasSubstr("No OpenGL 4.5"));
    EXPECT_THAT(none.err, HasSubstr("--device gpu"));
    EXPECT_FALSE(std::filesystem::exists(m_folder / "none.ply"));
    EXPECT_EQ(bake("x.ply", {"--device", "gpu", "--form-factors", "raycast"}).status, 2);
    EXPECT_EQ(bake("x.ply", {"--device", "tpu"}).status, 2);
}
