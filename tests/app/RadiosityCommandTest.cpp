// patina bake radiosity and patina certificate: what is written, told and refused.
#include "CommandsFixture.h"

#include <filesystem>

using namespace patina;
using namespace patina::test;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

TEST_F(Commands, RadiosityIsSolvedAndWrittenWhereverItIsAskedFor) {
    const auto bake = [&](const std::string& output, std::vector<std::string> more,
                          const char* area = "0.02") {
        std::vector<std::string> arguments{
            "bake", "radiosity", "builtin:cornell-reference", "-o",
            output, "--set",     "environment.enabled=false", "--subdivide",
            area,   "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runPatina(arguments);
    };
    const Outcome outcome = bake(m_folder / "a.glb", {"--threads", "2"}, "0.005");
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const nlohmann::json json = outcome.json();
    EXPECT_EQ(json["command"], "bake radiosity");
    EXPECT_EQ(json["converged"], true);
    EXPECT_LE(json["residual"].get<double>(), 1e-3);
    EXPECT_GT(json["counts"]["elements"].get<int>(), 400);
    EXPECT_LT(json["formFactors"]["closure"].get<double>(), 1e-6);
    EXPECT_GT(json["exposure"].get<double>(), 0.0);
    ASSERT_EQ(bake(m_folder / "b.glb", {"--threads", "1"}, "0.005").status, 0);
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
                       {"--form-factors", method, "--resolution", "8", "--exposure", "none"})
                      .status,
                  0);
    const Outcome ten =
        bake(m_folder / "ten.ply", {"--solver", "progressive", "--classic", "--iterations", "10"});
    EXPECT_EQ(ten.json()["iterations"], 10);
    EXPECT_EQ(ten.json()["converged"], false);
    ASSERT_EQ(bake(m_folder / "step.png",
                   {"--solver", "progressive", "--classic", "--iterations", "5", "--output-every",
                    "2", "--size", "8x8"},
                   "0.005")
                  .status,
              0);
    std::vector<std::string> steps = m_folder.files();
    std::erase_if(steps, [](const std::string& file) { return !file.starts_with("step"); });
    EXPECT_THAT(steps, ElementsAre("step-000002.png", "step-000004.png", "step.png"));
    EXPECT_THAT(readBytes(m_folder / "ten.ply"), HasSubstr("property float radiance_r"));
    // Exactly so many shots, however many rows of form factors are found side by side.
    ASSERT_EQ(bake(m_folder / "every.ply", {"--solver", "progressive", "--classic", "--iterations",
                                            "50", "--output-every", "20"})
                  .status,
              0);
    std::vector<std::string> every = m_folder.files();
    std::erase_if(every, [](const std::string& file) { return !file.starts_with("every"); });
    EXPECT_THAT(every, ElementsAre("every-000020.ply", "every-000040.ply", "every.ply"));
    EXPECT_EQ(bake(m_folder / "x.ply", {"--shots-per-step", "4"}).status, 2) << "gathering";
    EXPECT_EQ(bake(m_folder / "x.ply",
                   {"--solver", "progressive", "--shots-per-step", "8", "--output-every", "20"})
                  .status,
              2);

    const Outcome adaptive = bake(m_folder / "d.ply", {"--resolution", "64"}, "adaptive:0.3");
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
    const Outcome dark = runPatina({"bake", "radiosity", "builtin:plane", "-o", m_folder / "x.ply",
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

// Without --environment a scene with light of its own is lit by that alone; what lights it is told.
TEST_F(Commands, RadiosityHasNoHiddenEnvironment) {
    const auto bake = [&](const std::string& scene, std::vector<std::string> more) {
        std::vector<std::string> arguments{
            "bake",         "radiosity", scene,         "-o",  m_folder / "a.ply",
            "--resolution", "16",        "--subdivide", "0.1", "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = runPatina(arguments);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return outcome.json();
    };
    const std::string room = "builtin:cornell-reference";
    const nlohmann::json lamp = {{{"kind", "glow"}, {"name", "Light"}}};
    const nlohmann::json own = bake(room, {}), none = bake(room, {"--environment", "none"}),
                         studio = bake(room, {"--environment", "builtin:studio"});
    EXPECT_EQ(own["lights"], lamp);
    EXPECT_EQ(none["lights"], lamp);
    EXPECT_EQ(own["meanRadiosity"], none["meanRadiosity"]);
    ASSERT_EQ(studio["lights"].size(), 2u);
    EXPECT_EQ(studio["lights"][0]["kind"], "environment");
    EXPECT_GT(studio["meanRadiosity"].get<double>(), 3.0 * own["meanRadiosity"].get<double>());
    // Given as a parameter it is named, too.
    EXPECT_EQ(bake(room, {"--set", "environment.enabled=true"})["lights"], studio["lights"]);
    // A model without any light has the studio.
    const nlohmann::json plane = bake("builtin:plane", {});
    ASSERT_EQ(plane["lights"].size(), 1u);
    EXPECT_EQ(plane["lights"][0]["kind"], "environment");
    EXPECT_EQ(runPatina({"bake", "radiosity", room, "-o", m_folder / "x.ply", "--environment",
                         "none", "--environment-layout", "lat-long"})
                  .status,
              2);
}

TEST_F(Commands, RadiositySaysHowFarOffItMayBe) {
    const auto bake = [&](std::vector<std::string> more, const char* area = "0.02") {
        std::vector<std::string> arguments{"bake",
                                           "radiosity",
                                           "builtin:cornell-reference",
                                           "-o",
                                           m_folder / "a.ply",
                                           "--set",
                                           "environment.enabled=false",
                                           "--subdivide",
                                           area};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runPatina(arguments);
    };
    const nlohmann::json
        few = bake({"--json", "--resolution", "64"}, "0.05").json(),
        many = bake({"--json", "--resolution", "2048", "--estimate-discretisation"}, "0.05").json();
    EXPECT_EQ(few["errorBound"]["confidence"], 0.999);
    EXPECT_EQ(few["errorBound"]["of"], "bounces") << "direct light has noise of its own";
    EXPECT_EQ(many["errorBound"]["useful"], true);
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
    const std::vector<std::string> shot{"--solver", "progressive",  "--subdivide",
                                        "0.01",     "--resolution", "64"};
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
                                     "0.1",
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
    EXPECT_EQ(cast.json()["settings"]["device"], "cpu") << "auto: this OpenGL is no faster";
    EXPECT_EQ(cast.json().count("openGl"), 0u);
    // One stands for an element unless it is asked for more.
    EXPECT_EQ(cast.json()["settings"]["stands"], 1);
    const Outcome several = bake("several.ply", {"--stands", "3", "--json"});
    EXPECT_EQ(several.json()["settings"]["stands"], 3);
    EXPECT_GT(several.json()["counts"]["factors"].get<int>(),
              cast.json()["counts"]["factors"].get<int>());
    EXPECT_EQ(bake("x.ply", {"--stands", "3", "--classic"}).status, 2);
    EXPECT_EQ(bake("x.ply", {"--stands", "3", "--form-factors", "raycast"}).status, 2);
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
