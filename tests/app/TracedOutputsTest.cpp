// patina render --aov and --error-against.
#include "CommandsFixture.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

using namespace patina;
using namespace patina::test;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

namespace {

class TracedOutputs : public Commands {
  protected:
    [[nodiscard]] Outcome render(const std::string& output, std::vector<std::string> more,
                                 const char* scene = "builtin:cornell-box",
                                 const char* size = "48x36") const {
        if (size != nullptr)
            more.insert(more.begin(), {"--size", size});
        if (std::ranges::count(more, "--renderer") == 0) // a room would be solved for it
            more.insert(more.begin(), {"--lighting", "ibl"});
        more.insert(more.begin(), {"render", scene, "-o", m_folder / output});
        return runPatina(more);
    }
    [[nodiscard]] Outcome trace(const std::string& output, std::vector<std::string> more) const {
        more.insert(more.end(), {"--renderer", "path"});
        return render(output, std::move(more));
    }
    [[nodiscard]] std::string bytes(const std::string& name) const {
        return readBytes(m_folder / name);
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

float channel(const ImagePart& part, int x, int y, const char* name) {
    const std::vector<std::string>& names = part.image.channelNames();
    const auto found = std::ranges::find(names, name);
    EXPECT_NE(found, names.end()) << part.name << " has no channel " << name;
    return part.image.sample(x, y, static_cast<int>(found - names.begin()));
}

TEST_F(TracedOutputs, ArePartsOfOneFile) {
    ASSERT_EQ(trace("plain.exr", {"--samples", "9"}).status, 0);
    const Outcome outcome = trace("all.exr", {"--samples", "9", "--aov", "all"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const std::vector<ImagePart> all = parts("all.exr");
    std::vector<std::string> names;
    for (const ImagePart& part : all)
        names.push_back(part.name);
    EXPECT_THAT(names,
                ElementsAre("beauty", "background", "emission", "directDiffuse", "directSpecular",
                            "indirectDiffuse", "indirectSpecular", "albedo", "normal", "position",
                            "depth", "coverage", "samples", "standardError"));
    ASSERT_EQ(all.size(), 14u);
    EXPECT_EQ(all[0].image.f32().size(), load(m_folder / "plain.exr").f32().size());
    EXPECT_TRUE(std::ranges::equal(all[0].image.f32(), load(m_folder / "plain.exr").f32()))
        << "the picture is the one without outputs";
    for (int y = 0; y < 36; y += 5)
        for (int x = 0; x < 48; x += 5) {
            for (const char* c : {"R", "G", "B"}) {
                float sum = 0.0f;
                for (std::size_t i = 1; i <= 6; ++i)
                    sum += channel(all[i], x, y, c);
                const float beauty = channel(all[0], x, y, c);
                EXPECT_NEAR(sum, beauty, 1e-6f + 3e-6f * beauty);
            }
            EXPECT_EQ(channel(all[12], x, y, "Y"), 9.0f);
        }
    EXPECT_GT(channel(all[10], 24, 18, "Z"), 0.1f);
    EXPECT_EQ(all[10].attributes.at("patina:units"), "m");
    EXPECT_GT(channel(all[13], 24, 18, "Y"), 0.0f);

    // Shards, and a list.
    for (const char* k : {"1", "2"})
        ASSERT_EQ(
            trace(k, {"--samples", "9", "--aov", "all", "--shard", std::string(k) + "/2"}).status,
            0);
    const Outcome merged =
        runPatina({"merge", m_folder / "2", m_folder / "1", "-o", m_folder / "merged.exr"});
    ASSERT_EQ(merged.status, 0) << merged.err;
    EXPECT_EQ(bytes("merged.exr"), bytes("all.exr"));
    ASSERT_EQ(trace("some.exr", {"--samples", "2", "--aov", "depth,standardError"}).status, 0);
    EXPECT_EQ(parts("some.exr").size(), 3u);
    ASSERT_EQ(trace("3", {"--samples", "9", "--shard", "2/2"}).status, 0);
    const Outcome other =
        runPatina({"merge", m_folder / "1", m_folder / "3", "-o", m_folder / "no.exr"});
    EXPECT_EQ(other.status, 65);
    EXPECT_THAT(other.err, HasSubstr("aov"));

    for (const auto& [output, more, said] :
         std::vector<std::tuple<const char*, std::vector<std::string>, const char*>>{
             {"no.png", {"--renderer", "path", "--aov", "all"}, ".exr"},
             {"no.exr", {"--renderer", "path", "--aov", "Z"}, "not \"Z\""},
             {"no.exr", {"--renderer", "path", "--aov", ""}, "outputs are"},
             {"no.exr", {"--aov", "all"}, "--aov is for --renderer path"},
             {"no.exr",
              {"--renderer", "path", "--aov", "all", "--size", "8192x4096"},
              "a file holds at most 2"}}) {
        const bool sized = std::ranges::count(more, "--size") > 0;
        const Outcome refused =
            sized ? render(output, more, "builtin:cornell-box", nullptr) : render(output, more);
        EXPECT_EQ(refused.status, 2) << refused.err;
        EXPECT_THAT(refused.err, HasSubstr(said));
        EXPECT_FALSE(std::filesystem::exists(m_folder / output));
    }
}

TEST_F(TracedOutputs, GoOnFromACheckpoint) {
    const std::vector<std::string> options{"--samples", "60", "--aov", "all", "--threads", "1"};
    ASSERT_EQ(trace("whole.exr", options).status, 0);
    std::vector<std::string> more{
        "render", "builtin:cornell-box", "--size",       "48x36", "--renderer", "path",
        "-o",     m_folder / "a.exr",    "--checkpoint", "1h"};
    more.insert(more.end(), options.begin(), options.end());
    RunOptions interrupt;
    interrupt.signal = 2; // SIGINT
    interrupt.signalWhen = "%";
    ASSERT_EQ(runPatina(more, interrupt).status, 75);
    more.insert(more.end(), "--resume");
    const Outcome resumed = runPatina(more);
    ASSERT_EQ(resumed.status, 0) << resumed.err;
    EXPECT_EQ(bytes("a.exr"), bytes("whole.exr"));
}

TEST_F(TracedOutputs, ErrorAgainstAReference) {
    ASSERT_EQ(trace("reference.exr", {"--samples", "128", "--seed", "1", "--aov", "depth"}).status,
              0);
    const std::string reference = m_folder / "reference.exr";
    double before = 1e9;
    for (const char* samples : {"2", "64"}) {
        const Outcome outcome =
            trace("a.exr", {"--samples", samples, "--error-against", reference, "--json"});
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        const nlohmann::json error = outcome.json()["errorAgainst"];
        // The numbers of patina compare.
        const nlohmann::json compared =
            runPatina({"compare", m_folder / "a.exr", reference, "--json"}).json();
        for (const char* name : {"rmse", "relmse", "psnr", "max", "flip"})
            EXPECT_NEAR(error[name].get<double>(), compared[name].get<double>(),
                        1e-9 + 1e-6 * compared[name].get<double>())
                << name;
        EXPECT_LT(error["rmse"].get<double>(), 0.6 * before) << samples;
        before = error["rmse"];
        EXPECT_LT(std::abs(error["biasEv"].get<double>()), 0.3);
    }
    // Of itself; as text; displayed.
    const Outcome same =
        trace("a.png", {"--samples", "128", "--seed", "1", "--error-against", reference});
    ASSERT_EQ(same.status, 0) << same.err;
    EXPECT_THAT(same.out, AllOf(HasSubstr("Error against"), HasSubstr("infinite (identical)"),
                                HasSubstr("+0.0000 EV")));
    // The viewport's picture, which has no light off other surfaces: too dark.
    const Outcome raster = render("raster.exr", {"--error-against", reference, "--json"});
    ASSERT_EQ(raster.status, 0) << raster.err;
    EXPECT_GT(raster.json()["errorAgainst"]["flip"], 0.01);
    const Outcome exposed =
        render("raster.png", {"--exposure", "2", "--error-against", reference, "--json"});
    ASSERT_EQ(exposed.status, 0) << exposed.err;
    EXPECT_EQ(exposed.json()["errorAgainst"], raster.json()["errorAgainst"])
        << "light is compared before it is exposed";
    // It may be the reference, too.
    EXPECT_EQ(render("again.png", {"--error-against", m_folder / "raster.exr"}).status, 0);
}

TEST_F(TracedOutputs, RefusesAReferenceOfAnotherPicture) {
    ASSERT_EQ(trace("reference.exr", {"--samples", "1"}).status, 0);
    const std::string reference = m_folder / "reference.exr";
    const auto refuses = [&](std::vector<std::string> more, int status, const auto& said,
                             const char* scene = "builtin:cornell-box",
                             const char* size = "48x36") {
        more.insert(more.end(), {"--renderer", "path", "--samples", "1"});
        if (std::ranges::count(more, "--error-against") == 0)
            more.insert(more.end(), {"--error-against", reference});
        const Outcome outcome = render("no.exr", more, scene, size);
        EXPECT_EQ(outcome.status, status) << outcome.err;
        EXPECT_THAT(outcome.err, said);
        EXPECT_FALSE(std::filesystem::exists(m_folder / "no.exr"));
    };
    refuses({}, 65, HasSubstr("48 × 36 pixels, the picture 48 × 37"), "builtin:cornell-box",
            "48x37");
    refuses({}, 65, HasSubstr("the geometry of its scene"), "builtin:sphere");
    refuses({"--set", "material.metallic=1"}, 65, HasSubstr("the materials"));
    refuses({"--environment", "builtin:white"}, 65, HasSubstr("the environment of its scene"));
    refuses({"--camera", "40,5"}, 65, AllOf(HasSubstr("the camera ("), HasSubstr("40,5,")));
    refuses({"--fov", "50"}, 65, HasSubstr("the camera ("));
    refuses({"--background", "1,0,0"}, 65, HasSubstr("the background (visible there, 1,0,0 here)"));
    refuses({"--shard", "1/2"}, 2, HasSubstr("--error-against is for whole pictures"));
    refuses({"--error-against", m_folder / "nowhere.exr"}, 66, HasSubstr("nowhere.exr"));
    ASSERT_EQ(trace("shown.png", {"--samples", "1"}).status, 0);
    refuses({"--error-against", m_folder / "shown.png"}, 65, HasSubstr("linear colour"));
    EXPECT_EQ(render("no.exr", {"--view", "albedo", "--error-against", reference}).status, 2);
    EXPECT_EQ(render("no.png", {"--turntable", "3", "--error-against", reference}).status, 2);
    // A file that says nothing is believed.
    Image grey(48, 36, 3, PixelType::F32, ColorEncoding::Linear);
    std::ranges::fill(grey.f32(), 0.5f);
    ASSERT_TRUE(saveImage(m_worker, grey, m_folder / "grey.exr").ok());
    EXPECT_EQ(trace("yes.exr", {"--samples", "1", "--error-against", m_folder / "grey.exr"}).status,
              0);
}

} // namespace
