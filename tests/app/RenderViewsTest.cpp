// `patina render --view …`.
#include "CommandRunner.h"
#include "core/document/Views.h"
#include "core/image/ImageIO.h"
#include "core/worker/WorkerClient.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>

using namespace patina::test;
using namespace patina;
using testing::HasSubstr;
using testing::Not;

namespace {

const ImagePart* findPart(const LoadedImage& file, std::string_view name) {
    const auto found = std::find_if(file.parts.begin(), file.parts.end(),
                                    [&](const ImagePart& part) { return part.name == name; });
    return found == file.parts.end() ? nullptr : &*found;
}

// A sample by its channel's name: files sort their channels.
float at(const Image& image, int x, int y, const std::string& channel) {
    const auto& names = image.channelNames();
    const auto found = std::find(names.begin(), names.end(), channel);
    EXPECT_NE(found, names.end()) << channel;
    return image.sample(x, y, static_cast<int>(found - names.begin()));
}

} // namespace

TEST(RenderViews, ListsEveryView) {
    const Outcome outcome = runPatina({"render", "--list-views"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    for (const ViewInfo& info : views())
        EXPECT_THAT(outcome.out, HasSubstr(std::string("\n  ") + std::string(info.id) + " "));
    for (int group = 0; group < kViewGroupCount; ++group)
        EXPECT_THAT(outcome.out,
                    HasSubstr(std::string(viewGroupLabel(static_cast<ViewGroup>(group))) + "\n"));
}

TEST(RenderViews, WritesAPartForEachAndTheyAddUp) {
    const TemporaryFolder folder;
    const std::string file = folder / "all.exr";
    const Outcome outcome =
        runPatina({"render", "builtin:cornell-box", "--environment", "builtin:sunset", "--set",
                   "material.metallic=0.3", "--set", "material.emissive=0.1,0.2,0.3", "--size",
                   "24x24", "--view", "all", "-o", file, "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    WorkerClient worker;
    ImageLoadOptions options;
    options.allParts = true;
    options.sanitize = false;
    const auto loaded = loadImage(worker, file, options);
    ASSERT_TRUE(loaded.ok()) << loaded.error().text();
    EXPECT_EQ(findPart(*loaded, "clipped"), nullptr);
    const ImagePart* depth = findPart(*loaded, "depth");
    ASSERT_NE(depth, nullptr);
    EXPECT_EQ(depth->attributes.at("patina:units"), "m");
    EXPECT_GT(at(depth->image, 12, 12, "Z"), 1.0f);
    const ImagePart* normal = findPart(*loaded, "shadingNormal");
    ASSERT_NE(normal, nullptr);
    float length2 = 0.0f;
    for (const char* axis : {"X", "Y", "Z"})
        length2 += std::pow(at(normal->image, 12, 12, axis), 2.0f);
    EXPECT_NEAR(length2, 1.0f, 1e-4f);
    const ImagePart* metallic = findPart(*loaded, "metallic");
    ASSERT_NE(metallic, nullptr);
    EXPECT_NEAR(at(metallic->image, 12, 12, "Y"), 0.3f, 1e-6f);

    const ImagePart* final = findPart(*loaded, "final");
    ASSERT_NE(final, nullptr);
    int surfaces = 0;
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 24; ++x) {
            if (at(metallic->image, x, y, "A") == 0.0f)
                continue;
            ++surfaces;
            for (const char* channel : {"R", "G", "B"}) {
                float sum = 0.0f;
                for (const ViewKind term : kTermViews)
                    sum += at(findPart(*loaded, viewInfo(term).id)->image, x, y, channel);
                const float whole = at(final->image, x, y, channel);
                ASSERT_NEAR(sum, whole, 1e-5f * std::max(1.0f, whole));
            }
        }
    EXPECT_GT(surfaces, 100);
}

TEST(RenderViews, ShowsOneViewAndTellsItsRange) {
    const TemporaryFolder folder;
    const auto render = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments{"render", "builtin:cornell-box", "--size", "32x32",
                                           "-o",     folder / "a.png",      "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runPatina(arguments);
    };
    const Outcome depth = render({"--view", "depth"});
    ASSERT_EQ(depth.status, 0) << depth.err;
    EXPECT_EQ(depth.json()["settings"]["view"], "depth");
    EXPECT_LT(depth.json()["viewRange"][0], depth.json()["viewRange"][1]);
    EXPECT_EQ(render({"--view", "depth", "--view-range", "1,9"}).json()["viewRange"],
              nlohmann::json({1.0, 9.0}));
    // White and black: what is in the middle is metal or not.
    WorkerClient worker;
    ASSERT_EQ(render({"--view", "metallic", "--set", "material.metallic=1"}).status, 0);
    EXPECT_GT(loadImage(worker, folder / "a.png")->image().sample(16, 16, 0), 0.99f);
    ASSERT_EQ(render({"--view", "metallic", "--set", "material.metallic=0"}).status, 0);
    EXPECT_LT(loadImage(worker, folder / "a.png")->image().sample(16, 16, 0), 0.01f);
}

TEST(RenderViews, ContactSheetHasEveryViewOnce) {
    const TemporaryFolder folder;
    const Outcome outcome = runPatina({"render", "builtin:sphere", "--size", "48x32", "--samples",
                                       "1", "--view", "all", "-o", folder / "s.png", "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    WorkerClient worker;
    const auto sheet = loadImage(worker, folder / "s.png");
    ASSERT_TRUE(sheet.ok());
    // Six columns, and rows enough for every group.
    EXPECT_EQ(sheet->image().width(), 2 * 16 + 6 * 48 + 5 * 12);
    EXPECT_GT(sheet->image().height(), 8 * (32 + 42));
}

TEST(RenderViews, RefusesWhatDoesNotExist) {
    const TemporaryFolder folder;
    const auto render = [&](std::vector<std::string> more, const char* name = "a.png") {
        std::vector<std::string> arguments{"render", "builtin:sphere", "--size", "16x16",
                                           "-o",     folder / name};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = runPatina(arguments);
        EXPECT_EQ(outcome.status, 2) << outcome.out;
        return outcome.err;
    };
    EXPECT_THAT(render({"--view", "rougness"}), HasSubstr("perceptualRoughness"));
    EXPECT_THAT(render({"--view", "nov", "--view-mode", "contribution"}),
                HasSubstr("no contribution"));
    EXPECT_THAT(render({"--view", "clipped"}, "a.exr"), HasSubstr("no numbers"));
    EXPECT_THAT(render({"--view", "depth", "--view-range", "3"}), HasSubstr("MIN,MAX"));
    EXPECT_THAT(render({"--view", "depth", "--view-range", "3,1"}), HasSubstr("MIN,MAX"));
    EXPECT_THAT(render({"--view", "d", "--view-light", "Sun"}), HasSubstr("no light"));
    EXPECT_TRUE(folder.files().empty());
}
