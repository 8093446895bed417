// `patina environment`, and what the other commands make of a layout.
#include "CommandRunner.h"

#include <gmock/gmock.h>

using namespace patina::test;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(EnvironmentCommand, WritesEveryLayoutAndInfoTellsIt) {
    const TemporaryFolder folder;
    const struct {
        const char *name, *inJson;
        int width, height;
    } cases[] = {{"lat-long", "latLong", 64, 32},
                 {"angular-map", "angularMap", 64, 64},
                 {"horizontal-cross", "horizontalCross", 256, 192},
                 {"vertical-cross", "verticalCross", 192, 256},
                 {"horizontal-strip", "horizontalStrip", 384, 64},
                 {"vertical-strip", "verticalStrip", 64, 384}};
    // Computed once: drawing a built-in sky takes longer than all the rest.
    const std::string sky = folder / "sunset.exr";
    const Outcome drawn =
        runPatina({"environment", "builtin:sunset", "-o", sky, "--size", "256", "--quiet"});
    ASSERT_EQ(drawn.status, 0) << drawn.err;
    for (const auto& c : cases)
        for (const char* ending : {".exr", ".hdr"}) {
            const std::string file = folder / (std::string(c.name) + ending);
            const Outcome made = runPatina(
                {"environment", sky, "-o", file, "--layout", c.name, "--size", "64", "--json"});
            ASSERT_EQ(made.status, 0) << made.err << made.out;
            EXPECT_EQ(made.json()["command"], "environment");
            EXPECT_EQ(made.json()["width"], c.width);
            EXPECT_EQ(made.json()["height"], c.height);
            const Outcome info = runPatina({"info", file, "--json"});
            ASSERT_EQ(info.status, 0) << info.err;
            EXPECT_EQ(info.json()["kind"], "environment");
            EXPECT_EQ(info.json()["layout"], c.inJson);
            EXPECT_EQ(info.json()["width"], c.width);
        }
}

TEST(EnvironmentCommand, SixFacesAndOpenExrsConventionCanBeReadBack) {
    const TemporaryFolder folder;
    const Outcome six = runPatina({"environment", "builtin:studio", "-o", folder / "room.hdr",
                                   "--layout", "six-faces", "--size", "32", "--quiet"});
    ASSERT_EQ(six.status, 0) << six.err;
    EXPECT_THAT(folder.files(), ElementsAre("room_nx.hdr", "room_ny.hdr", "room_nz.hdr",
                                            "room_px.hdr", "room_py.hdr", "room_pz.hdr"));
    const Outcome info = runPatina({"info", folder / "room_px.hdr", "--json"});
    EXPECT_EQ(info.json()["layout"], "sixFaces");
    const Outcome exr = runPatina({"environment", folder / "room_px.hdr", "-o", folder / "room.exr",
                                   "--openexr-envmap", "--size", "64", "--quiet"});
    ASSERT_EQ(exr.status, 0) << exr.err;
    const Outcome attribute = runPatina({"info", folder / "room.exr", "--json"});
    EXPECT_EQ(attribute.json()["attributes"]["envmap"], "latlong");
    EXPECT_EQ(attribute.json()["openExrConvention"], true);
}

// The studio's sum of one band is even, and that of three goes below zero.
TEST(EnvironmentCommand, WritesWhatBandsHold) {
    const TemporaryFolder folder;
    const auto made = [&](const std::string& name, std::vector<std::string> more) {
        more.insert(more.begin(), {"environment", "builtin:studio", "-o", folder / name, "--size",
                                   "64", "--json"});
        return runPatina(more);
    };
    ASSERT_EQ(made("one.exr", {"--bands", "1"}).status, 0);
    ASSERT_EQ(made("three.exr", {"--bands", "3"}).status, 0);
    const Outcome stratified =
        made("classical.exr", {"--bands", "3", "--method", "stratified", "--samples", "39700"});
    ASSERT_EQ(stratified.status, 0) << stratified.err << stratified.out;
    EXPECT_EQ(stratified.json()["settings"]["bands"], 3);
    EXPECT_EQ(stratified.json()["settings"]["samples"], 40000);
    const auto rmse = [&](const std::string& a, const std::string& b) {
        const Outcome compared = runPatina({"compare", folder / a, folder / b, "--json"});
        EXPECT_EQ(compared.status, 0) << compared.err << compared.out;
        return compared.json()["rmse"].get<double>();
    };
    const double bands = rmse("three.exr", "one.exr");
    EXPECT_GT(bands, 0.05);
    EXPECT_GT(rmse("classical.exr", "three.exr"), 0.0);
    EXPECT_LT(rmse("classical.exr", "three.exr"), 0.05 * bands);
    EXPECT_EQ(made("x.exr", {"--bands", "9"}).status, 2);
    EXPECT_EQ(made("x.exr", {"--method", "stratified"}).status, 2);
    EXPECT_EQ(made("x.exr", {"--bands", "3", "--samples", "9"}).status, 2);
}

TEST(EnvironmentCommand, WrongUsageIsRefusedBeforeAnythingIsRead) {
    const TemporaryFolder folder;
    const auto status = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {"environment", "builtin:studio", "--quiet"});
        return runPatina(arguments).status;
    };
    EXPECT_EQ(status({"-o", folder / "x.png"}), 2);
    EXPECT_EQ(status({"-o", folder / "x.exr", "--layout", "sphere"}), 2);
    EXPECT_EQ(status({"-o", folder / "x.exr", "--layout", "automatic"}), 2);
    EXPECT_EQ(status({"-o", folder / "x.hdr", "--openexr-envmap"}), 2);
    EXPECT_EQ(status({"-o", folder / "x.exr", "--size", "0"}), 2);
    EXPECT_EQ(status({"-o", folder / "none/x.exr"}), 73);
    EXPECT_EQ(runPatina({"environment", folder / "gone.hdr", "-o", folder / "x.exr"}).status, 66);
    writeBytes(folder / "short.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n\x02\x02");
    const Outcome broken =
        runPatina({"environment", folder / "short.hdr", "-o", folder / "x.exr", "--json"});
    EXPECT_EQ(broken.status, 65);
    EXPECT_THAT(broken.json()["error"]["message"], HasSubstr("cut short"));
    EXPECT_THAT(folder.files(), ElementsAre("short.hdr"));
}

TEST(EnvironmentCommand, ALayoutThatIsSetIsTakenByRender) {
    const TemporaryFolder folder;
    ASSERT_EQ(runPatina({"environment", "builtin:sunset", "-o", folder / "ball.exr", "--layout",
                         "mirror-ball", "--size", "128", "--quiet"})
                  .status,
              0);
    const auto render = [&](const char* name, std::vector<std::string> extra) {
        std::vector<std::string> arguments = {"render",      "builtin:sphere", "-o",
                                              folder / name, "--size",         "48x48"};
        arguments.insert(arguments.end(), extra.begin(), extra.end());
        return runPatina(arguments);
    };
    const Outcome guessed = render("angular.png", {"--environment", folder / "ball.exr"});
    ASSERT_EQ(guessed.status, 0) << guessed.err;
    EXPECT_THAT(guessed.err, HasSubstr("mirror ball"));
    ASSERT_EQ(render("ball.png",
                     {"--environment", folder / "ball.exr", "--environment-layout", "mirror-ball"})
                  .status,
              0);
    // --set reads the file anew, whatever the order.
    ASSERT_EQ(render("set.png", {"--set", "environment.layout=mirrorBall", "--set",
                                 "environment.image=" + (folder / "ball.exr")})
                  .status,
              0);
    ASSERT_EQ(render("original.png", {"--environment", "builtin:sunset"}).status, 0);
    const auto rmse = [&](const char* a, const char* b) {
        return runPatina({"compare", folder / a, folder / b, "--json"})
            .json()["rmse"]
            .get<double>();
    };
    EXPECT_LT(rmse("ball.png", "original.png"), 0.02);
    EXPECT_EQ(rmse("ball.png", "set.png"), 0.0);
    EXPECT_GT(rmse("angular.png", "original.png"), 2.0 * rmse("ball.png", "original.png"));
    EXPECT_EQ(render("x.png", {"--environment-layout", "sphere"}).status, 2);
}

// With a light for each the scene is as bright as before.
TEST(EnvironmentCommand, BrightSourcesAreTakenOutAndListed) {
    const TemporaryFolder folder;
    const std::string sky = folder / "sky.exr", rest = folder / "rest.exr";
    ASSERT_EQ(runPatina({"environment", "builtin:clear-sky", "-o", sky, "--size", "512", "--quiet"})
                  .status,
              0);
    const Outcome made = runPatina({"environment", sky, "--extract", "1", "-o", rest, "--json"});
    ASSERT_EQ(made.status, 0) << made.err;
    ASSERT_EQ(made.json()["sources"].size(), 1u);
    const auto source = made.json()["sources"][0];
    EXPECT_TRUE(source["standsOut"].get<bool>());
    EXPECT_GT(source["elevationDeg"].get<double>(), 5.0);
    EXPECT_GT(source["shareOfLight"].get<double>(), 0.1);
    const Outcome again =
        runPatina({"environment", rest, "--extract", "1", "-o", folder / "x.exr", "--json"});
    ASSERT_EQ(again.status, 0) << again.err;
    EXPECT_LT(again.json()["sources"][0]["shareOfLight"].get<double>(),
              0.1 * source["shareOfLight"].get<double>());
    const Outcome both =
        runPatina({"environment", sky, "--extract", "1", "--bands", "3", "-o", folder / "y.exr"});
    EXPECT_EQ(both.status, 2);
    EXPECT_THAT(folder.files(), ElementsAre("rest.exr", "sky.exr", "x.exr"));
}
