// patina rank: planted environments are found, broken ones listed.
#include "CommandsFixture.h"
#include "core/light/LatLongGrid.h"

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <functional>

using namespace patina;
using namespace patina::test;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

namespace fs = std::filesystem;

namespace {

class Ranks : public Commands {
  protected:
    Outcome rank(const std::string& scene, const std::vector<std::string>& more,
                 const RunOptions& options = {}) {
        std::vector<std::string> arguments{"rank", scene, "-o", m_folder / "rank.json", "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runPatina(arguments, options);
    }
    nlohmann::json ranking() { return nlohmann::json::parse(readBytes(m_folder / "rank.json")); }
    static nlohmann::json environmentNamed(const nlohmann::json& json, const std::string& name) {
        for (const nlohmann::json& environment : json["environments"])
            if (environment["name"] == name)
                return environment;
        ADD_FAILURE() << "no environment " << name;
        return {};
    }
    std::string environment(const std::string& name,
                            const std::function<glm::dvec3(const glm::dvec3&)>& radiance) {
        const LatLongGrid grid(64);
        Image image(128, 64, 3, PixelType::F32, ColorEncoding::Linear);
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 128; ++x)
                for (int c = 0; c < 3; ++c)
                    image.f32()[static_cast<std::size_t>(3 * (y * 128 + x) + c)] =
                        static_cast<float>(radiance(grid.direction(x, y))[c]);
        fs::create_directory(m_folder.path() / "light");
        const std::string file = m_folder / ("light/" + name);
        EXPECT_TRUE(saveImage(m_worker, image, file).ok());
        return file;
    }
};

} // namespace

TEST_F(Ranks, WhatIsPlantedInAFolderIsRankedFirstFlaggedAndRecognised) {
    const auto sky = [](double turn) {
        return [turn](const glm::dvec3& d) {
            const double along = std::cos(turn) * d.z + std::sin(turn) * d.x;
            return glm::dvec3(0.5 + 0.3 * d.y + 0.15 * along, 0.5 + 0.25 * d.y,
                              0.55 + 0.1 * along * along * along);
        };
    };
    environment("even.exr", sky(0.0));
    environment("other.exr", [](const glm::dvec3& d) { return glm::dvec3(0.5 + 0.2 * d.x * d.y); });
    environment("turned.exr", sky(1.0)); // as even.exr, rotated by a radian
    environment("half.exr", [](const glm::dvec3& d) { return glm::dvec3(d.x > 0.0 ? 1.0 : 0.0); });
    environment("bright.exr",
                [](const glm::dvec3& d) { return glm::dvec3(d.y > 0.5 ? 60.0 : 2.0); });
    fs::copy_file(m_folder / "light/other.exr", m_folder / "light/zcopy.exr");
    writeBytes(m_folder / "light/broken.hdr", "no picture");
    writeBytes(m_folder / "light/notes.txt", "not looked at");
    fs::create_symlink(m_folder / "gone.exr", m_folder / "light/vanished.exr");

    const std::vector<std::string> shared{
        "--environments", m_folder / "light", "--unshadowed", "--size",
        "64x64",          "--rotations",      "12",           "--tone-map",
        "clamp"};
    const auto by = [&](const char* score) {
        std::vector<std::string> arguments = shared;
        arguments.insert(arguments.end(), {"--by", score});
        const Outcome outcome = rank("builtin:sphere", arguments);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return outcome.json();
    };
    const nlohmann::json clipping = by("clipping");
    EXPECT_EQ(clipping["worst"][0]["environment"], "bright");
    EXPECT_THAT(clipping["worst"][0]["flags"], Contains("clips"));
    EXPECT_GT(clipping["worst"][0]["clipped"]["highlights"], 0.5);
    EXPECT_THAT(environmentNamed(clipping, "bright")["flags"], ElementsAre("clips"));
    EXPECT_EQ(environmentNamed(clipping, "bright")["clippingRotations"], 12);

    // What the other environments do not lack: of those that do not clip.
    const nlohmann::json half = environmentNamed(clipping, "half");
    EXPECT_THAT(half["flags"], Contains("blackFromOneSide"));
    EXPECT_NEAR(half["darkestSide"]["azimuthDeg"].get<double>(), -90.0, 2.0);
    const nlohmann::json ranked = ranking()["ranking"];
    const auto first = std::ranges::find_if(
        ranked, [](const nlohmann::json& light) { return light["environment"] != "bright"; });
    EXPECT_EQ((*first)["environment"], "half");
    EXPECT_THAT((*first)["flags"], Contains("blackFromOneSide"));
    EXPECT_GT((*first)["clipped"]["shadows"], 0.0);

    const nlohmann::json turned = environmentNamed(clipping, "turned");
    EXPECT_THAT(turned["flags"], ElementsAre("duplicate"));
    EXPECT_EQ(turned["sameAs"]["name"], "even");
    EXPECT_NEAR(turned["sameAs"]["rotationDeg"].get<double>(), 57.3, 0.5);
    EXPECT_EQ(turned["sameAs"]["exactly"], false);
    EXPECT_EQ(environmentNamed(clipping, "zcopy")["sameAs"]["exactly"], true);
    for (const char* name : {"even", "other"})
        EXPECT_THAT(environmentNamed(clipping, name)["flags"], IsEmpty());

    ASSERT_EQ(clipping["broken"].size(), 2u) << clipping["broken"].dump();
    EXPECT_EQ(clipping["broken"][0]["file"], m_folder / "light/broken.hdr");
    EXPECT_EQ(clipping["broken"][1]["file"], m_folder / "light/vanished.exr");
    for (const nlohmann::json& broken : clipping["broken"])
        EXPECT_FALSE(broken["problem"].get<std::string>().empty());
    EXPECT_EQ(clipping["counts"]["lights"], 72);
    EXPECT_EQ(clipping["transfer"]["source"], "unshadowed");

    const nlohmann::json difference = by("difference");
    EXPECT_EQ(difference["worst"][0]["environment"], "half");
    EXPECT_THAT(difference["worst"][0]["flags"], Contains("blackFromOneSide"));
    // Another light's look is the reference: from it, its own is no distance at all.
    std::vector<std::string> arguments = shared;
    arguments.insert(arguments.end(), {"--reference", "even.exr@60"});
    EXPECT_EQ(rank("builtin:sphere", arguments).status, 0);
    const nlohmann::json all = ranking();
    EXPECT_EQ(all["reference"]["environment"], "even");
    EXPECT_EQ(all["ranking"].size(), 72u);
    const nlohmann::json last = all["ranking"].back();
    EXPECT_EQ(last["environment"], "even");
    EXPECT_EQ(last["rotationDeg"], 60.0);
    EXPECT_EQ(last["score"], 0.0);
}

TEST_F(Ranks, CountsWhatARenderedPictureShows) {
    ASSERT_EQ(runPatina({"bake", "prt", "builtin:shader-ball", "-o", m_folder / "t.exr", "--order",
                         "3", "--samples", "32"})
                  .status,
              0);
    const std::vector<std::string> look{
        "--bake", m_folder / "t.exr", "--size", "96x96", "--exposure", "-6", "--tone-map", "clamp"};
    std::vector<std::string> arguments{"--environments", "builtin:studio",  "--rotations", "4",
                                       "--sensitivity",  m_folder / "s.exr"};
    arguments.insert(arguments.end(), look.begin(), look.end());
    const Outcome outcome = rank("builtin:shader-ball", arguments);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.json()["transfer"]["source"], "file");
    const double metal = outcome.json()["counts"]["pixelsWithoutDiffuseLight"],
                 pixels = outcome.json()["counts"]["pixels"];
    for (const nlohmann::json& light : ranking()["ranking"]) {
        std::vector<std::string> single{"render",
                                        "builtin:shader-ball",
                                        "-o",
                                        m_folder / "p.png",
                                        "--environment",
                                        "builtin:studio",
                                        "--lighting",
                                        "prt",
                                        "--samples",
                                        "1",
                                        "--background",
                                        "transparent",
                                        "--set",
                                        "view.reflectionMix=0",
                                        "--set",
                                        "environment.rotationDeg=" +
                                            std::to_string(light["rotationDeg"].get<double>())};
        single.insert(single.end(), look.begin(), look.end());
        ASSERT_EQ(runPatina(single).status, 0);
        const Image picture = load(m_folder / "p.png");
        double covered = 0, black = 0;
        for (std::size_t i = 0; i < picture.u8().size(); i += 4) {
            const auto pixel = picture.u8().subspan(i, 4);
            covered += pixel[3] > 127 ? 1 : 0;
            black += pixel[3] > 127 && std::max({pixel[0], pixel[1], pixel[2]}) == 0 ? 1 : 0;
        }
        EXPECT_NEAR(covered, pixels + metal, 0.01 * covered) << "at the outline";
        EXPECT_NEAR((black - metal) / pixels, light["clipped"]["shadows"].get<double>(), 0.01);
    }
    const Image sensitivity = load(m_folder / "s.exr");
    EXPECT_EQ(sensitivity.channels(), 1);
    EXPECT_EQ(sensitivity.width(), 96);
    EXPECT_GT(*std::ranges::max_element(sensitivity.f32()), 0.0f);
    EXPECT_EQ(sensitivity.f32()[0], 0.0f);
}

TEST_F(Ranks, BakesQuicklyWhereThereIsNoBakeAndSaysSo) {
    std::vector<std::string> arguments{"rank",
                                       "builtin:sphere",
                                       "-o",
                                       m_folder / "r.json",
                                       "--environments",
                                       "builtin:studio",
                                       "builtin:sunset",
                                       "--size",
                                       "32x32",
                                       "--rotations",
                                       "3"};
    const Outcome people = runPatina(arguments);
    ASSERT_EQ(people.status, 0) << people.err;
    EXPECT_THAT(people.out, HasSubstr("a quick bake, 5 bands, 256 rays per vertex"));
    EXPECT_THAT(people.out, HasSubstr("Worst of 6 lights by difference"));
    EXPECT_THAT(people.err, HasSubstr("ranking of 6 lights"));
    const std::string first = readBytes(m_folder / "r.json");
    arguments.insert(arguments.end(), {"--threads", "1"});
    ASSERT_EQ(runPatina(arguments).status, 0);
    const nlohmann::json one = nlohmann::json::parse(readBytes(m_folder / "r.json")),
                         all = nlohmann::json::parse(first);
    EXPECT_EQ(one["ranking"], all["ranking"]) << "does not depend on the number of threads";
    EXPECT_EQ(all["transfer"]["source"], "quick");
}

TEST_F(Ranks, RefusesWhatItCannotRank) {
    fs::create_directory(m_folder.path() / "empty");
    writeBytes(m_folder / "broken.hdr", "no picture");
    const auto check = [&](const std::vector<std::string>& arguments, int status,
                           const char* hint) {
        std::vector<std::string> all{"--size", "16x16", "--rotations", "2", "--unshadowed"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        const Outcome outcome = rank("builtin:sphere", all);
        EXPECT_EQ(outcome.status, status) << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr(hint));
        EXPECT_FALSE(fs::exists(m_folder / "rank.json"));
    };
    check({"--environments", m_folder / "empty"}, 2, "no .hdr, .exr or .pfm");
    check({"--environments", m_folder / "none.hdr"}, 66, "none.hdr");
    check({"--environments", "builtin:studio", m_folder / "broken.hdr"}, 65, "--skip-broken");
    check({"--environments", m_folder / "broken.hdr", "--skip-broken"}, 65, "none of the");
    check({"--environments", "builtin:studio", "--set", "material.baseColor=0,0,0"}, 65,
          "metal or black");
    const Outcome skipped = rank(
        "builtin:sphere", {"--size", "16x16", "--rotations", "2", "--unshadowed", "--skip-broken",
                           "--environments", "builtin:studio", m_folder / "broken.hdr"});
    EXPECT_EQ(skipped.status, 0);
    EXPECT_EQ(skipped.json()["broken"].size(), 1u);
}

TEST_F(Ranks, AnInterruptLeavesNothing) {
    RunOptions interrupt;
    interrupt.signal = SIGINT;
    interrupt.signalWhen = "pictures";
    const Outcome outcome = rank("builtin:sphere",
                                 {"--environments", "builtin:studio", "builtin:night", "--size",
                                  "512x512", "--rotations", "720", "--unshadowed"},
                                 interrupt);
    EXPECT_EQ(outcome.status, 130) << outcome.err;
    EXPECT_THAT(m_folder.files(), Not(Contains("rank.json")));
}
