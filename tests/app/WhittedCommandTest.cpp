// patina render --renderer whitted.
#include "CommandsFixture.h"

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

using namespace patina;
using namespace patina::test;
using testing::ElementsAre;
using testing::HasSubstr;

namespace {

class WhittedCommand : public Commands {
  protected:
    [[nodiscard]] Outcome trace(const std::string& output, std::vector<std::string> more) const {
        std::vector<std::string> all{
            "render", "builtin:cornell-box", "--renderer", "whitted", "--size", "40x30"};
        if (!output.empty())
            all.insert(all.end(), {"-o", m_folder / output});
        all.insert(all.end(), more.begin(), more.end());
        return runPatina(all);
    }
    std::vector<ImagePart> parts(const std::string& name) {
        ImageLoadOptions options;
        options.allParts = true;
        options.sanitize = false;
        Result<LoadedImage> loaded = loadImage(m_worker, m_folder / name, options);
        EXPECT_TRUE(loaded.ok());
        return loaded ? loaded->parts : std::vector<ImagePart>();
    }
};

glm::vec3 vectorOf(const nlohmann::json& json) {
    return {json[0].get<float>(), json[1].get<float>(), json[2].get<float>()};
}

TEST_F(WhittedCommand, TheTreeOfAPixelAddsUpToThePicture) {
    const Outcome outcome = trace(
        "a.exr", {"--json", "--ray-tree", "17,13", "--set", "material.perceptualRoughness=0.05"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const nlohmann::json json = outcome.json();
    EXPECT_EQ(json["settings"]["renderer"], "whitted");
    EXPECT_EQ(json["settings"]["whitted"]["model"], "patina");
    EXPECT_EQ(json["settings"]["whitted"]["maxDepth"], 8);
    EXPECT_GT(json["rays"], 40 * 30);
    const nlohmann::json& tree = json["rayTree"];
    EXPECT_THAT(tree["pixel"], ElementsAre(17, 13));
    const std::vector<ImagePart> pictures = parts("a.exr");
    ASSERT_EQ(pictures.size(), 1u);
    const Image& picture = pictures[0].image;

    // As docs/maths/whitted.md says.
    glm::dvec3 pixel(0.0), sample(0.0);
    double share = 0.0;
    bool reflects = false, shadow = false;
    for (const nlohmann::json& node : tree["nodes"]) {
        if (node["kind"] == "camera") {
            pixel += share * glm::dvec3(glm::vec3(sample));
            sample = glm::dvec3(0.0);
            share = node["share"];
        } else {
            EXPECT_LT(node["parent"], node["id"]);
        }
        reflects = reflects || (node["kind"] == "reflected" && node["cast"] == true);
        shadow = shadow || (node["kind"] == "shadow" && !node.contains("light") &&
                            node.value("emissiveMesh", "") == "Light" && node["end"] == "lit");
        sample += glm::dvec3(vectorOf(node["contribution"]));
    }
    pixel += share * glm::dvec3(glm::vec3(sample));
    EXPECT_TRUE(reflects);
    EXPECT_TRUE(shadow);
    for (int c = 0; c < 3; ++c) {
        EXPECT_EQ(static_cast<float>(pixel[c]), picture.sample(17, 13, c));
        EXPECT_EQ(tree["radiance"][static_cast<std::size_t>(c)].get<float>(),
                  picture.sample(17, 13, c));
    }

    // The tree needs no picture.
    const Outcome alone =
        trace("", {"--json", "--ray-tree", "17,13", "--set", "material.perceptualRoughness=0.05"});
    ASSERT_EQ(alone.status, 0) << alone.err;
    EXPECT_EQ(alone.json()["rayTree"], tree);
}

TEST_F(WhittedCommand, CountsArePartsOfTheFile) {
    const Outcome outcome = trace("counts.exr", {"--aov", "all", "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    ASSERT_EQ(trace("plain.exr", {}).status, 0);
    const std::vector<ImagePart> all = parts("counts.exr"), plain = parts("plain.exr");
    std::vector<std::string> names;
    for (const ImagePart& part : all)
        names.push_back(part.name);
    ASSERT_THAT(names, ElementsAre("beauty", "rays", "rayDepth", "boxTests", "triangleTests",
                                   "triangleTestsWithout"));
    EXPECT_TRUE(std::ranges::equal(all[0].image.f32(), plain[0].image.f32()));
    const nlohmann::json json = outcome.json();
    const auto triangles = json["counts"]["triangles"].get<float>();
    EXPECT_EQ(json["hierarchy"]["triangles"], json["counts"]["triangles"]);
    float most = 0.0f;
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 40; ++x) {
            const float rays = all[1].image.sample(x, y, 0);
            EXPECT_GE(rays, 4.0f);
            EXPECT_EQ(all[5].image.sample(x, y, 0), rays * triangles);
            EXPECT_LT(all[4].image.sample(x, y, 0), 0.05f * rays * triangles);
            most = std::max(most, all[3].image.sample(x, y, 0));
        }
    EXPECT_GT(most, 100.0f);
}

TEST_F(WhittedCommand, ThreadsAndPartsEndInTheSameBytes) {
    const std::vector<std::string> random{"--soft-shadows", "--gloss", "--samples", "5"};
    for (const bool stochastic : {false, true}) {
        const std::vector<std::string> more = stochastic ? random : std::vector<std::string>();
        const auto with = [&](std::vector<std::string> options) {
            options.insert(options.end(), more.begin(), more.end());
            return options;
        };
        ASSERT_EQ(trace("whole.exr", with({"--threads", "1"})).status, 0);
        ASSERT_EQ(trace("threads.exr", with({"--threads", "7"})).status, 0);
        EXPECT_EQ(readBytes(m_folder / "whole.exr"), readBytes(m_folder / "threads.exr"));
        std::vector<std::string> merge{"merge"};
        for (const char* part : {"1", "2", "3"}) {
            const std::string name = std::string("part") + part;
            ASSERT_EQ(trace(name, with({"--shard", std::string(part) + "/3"})).status, 0);
            merge.push_back(m_folder / name);
        }
        merge.insert(merge.end(), {"-o", m_folder / "merged.exr"});
        ASSERT_EQ(runPatina(merge).status, 0);
        EXPECT_EQ(readBytes(m_folder / "whole.exr"), readBytes(m_folder / "merged.exr"));
    }
    EXPECT_THAT(readBytes(m_folder / "merged.exr"), HasSubstr("whitted"));
}

TEST_F(WhittedCommand, UsageErrorsSayWhatGoesTogether) {
    for (const auto& [more, says] : std::vector<std::pair<std::vector<std::string>, std::string>>{
             {{"--samples", "4"}, "--soft-shadows"},
             {{"--noise", "1"}, "--soft-shadows"},
             {{"--gloss", "--contrast", "0.5"}, "--contrast"},
             {{"--max-bounces", "33"}, "at most 32"},
             {{"--whitted-model", "1981"}, "--whitted-model"},
             {{"--min-contribution", "0"}, "--min-contribution"},
             {{"--subdivisions", "5"}, "--subdivisions"},
             {{"--aov", "albedo"}, "rayDepth"},
             {{"--aov", "rays", "--shard", "1/2"}, "--shard"},
             {{"--ray-tree", "40,3"}, "39,29"},
             {{"--view", "albedo"}, "--view"}}) {
        const Outcome outcome = trace("no.exr", more);
        EXPECT_EQ(outcome.status, 2) << more.front();
        EXPECT_THAT(outcome.err, HasSubstr(says));
    }
    const Outcome path = runPatina({"render", "builtin:cornell-box", "--renderer", "path",
                                    "--gloss", "-o", m_folder / "no.exr"});
    EXPECT_EQ(path.status, 2);
    EXPECT_THAT(path.err, HasSubstr("--gloss is for --renderer whitted"));
}

} // namespace
