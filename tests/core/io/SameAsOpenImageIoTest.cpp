// The worker for images reads PNG, JPEG and OpenEXR itself: as OpenImageIO does, bit for bit, or
// not at all.
#include "core/worker/WorkerClient.h"
#include "core/worker/WorkerProtocol.h"
#include "tests/core/io/CommonImageFiles.h"
#include "tests/support/TemporaryFolder.h"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

namespace patina {
namespace {

using nlohmann::json;

class SameAsOpenImageIo : public testing::Test {
  protected:
    // One request to a worker: its answer, or its error.
    Result<WorkerClient::Reply> ask(WorkerKind kind, const test::SampleFile& file, json how) {
        how["op"] = "decodeImage";
        how["format"] = file.format;
        return s_client->request(kind, how.dump(), std::span(file.bytes), file.name);
    }
    static std::vector<json> requests() {
        return {{{"allParts", true}}, {{"colorOnly", true}, {"maxSide", 7}}, {{"inspect", true}}};
    }
    // Whether the worker for images has read it; what it has read is what OpenImageIO reads.
    bool isReadAlike(const test::SampleFile& file, const json& how) {
        const auto common = ask(WorkerKind::Image, file, how);
        if (!common.ok()) {
            EXPECT_THAT(common.error().message, testing::HasSubstr("MiB of memory")) << file.name;
            return false;
        }
        if (common->header == protocol::kHandOn)
            return false;
        const auto theirs = ask(WorkerKind::OpenImageIo, file, how);
        if (!theirs.ok()) {
            ADD_FAILURE() << file.name
                          << ": only OpenImageIO refuses it: " << theirs.error().text();
            return true;
        }
        EXPECT_EQ(common->header, theirs->header) << file.name << " " << how;
        const auto ours = common->payload.bytes(), reference = theirs->payload.bytes();
        EXPECT_TRUE(std::equal(ours.begin(), ours.end(), reference.begin(), reference.end()))
            << file.name << " " << how;
        return true;
    }
    // Neither has what was asked for, or both give the same.
    void expectRead(const test::SampleFile& file, const json& how) {
        EXPECT_TRUE(isReadAlike(file, how) || !ask(WorkerKind::OpenImageIo, file, how).ok())
            << file.name << " " << how;
    }
    void check(const test::SampleFiles& files) {
        EXPECT_FALSE(files.read.empty());
        const std::vector<json> how = requests();
        for (std::size_t i = 0; i < files.read.size(); ++i) {
            expectRead(files.read[i], how[0]);
            expectRead(files.read[i], how[1 + i % 2]);
        }
        for (const test::SampleFile& file : files.handedOn)
            EXPECT_FALSE(isReadAlike(file, {{"inspect", true}})) << file.name;
        for (const test::SampleFile& file : files.handedOn) // some are for their attributes only
            isReadAlike(file, {{"allParts", true}});
    }
    // Files with some bytes changed or the end missing: never read otherwise than by OpenImageIO.
    void checkDamaged(const test::SampleFiles& whole, unsigned int seed) {
        std::minstd_rand random(seed);
        const char* wanted = std::getenv("PATINA_DAMAGED_IMAGES"); // of each format
        const int files = wanted != nullptr ? std::max(1, std::atoi(wanted)) : 40;
        int read = 0;
        for (int i = 0; i < files; ++i) {
            test::SampleFile file = whole.read[random() % whole.read.size()];
            file.name += fmt::format(", damaged ({}, {})", seed, i);
            if (i % 3 == 0)
                file.bytes.resize(file.bytes.size() * (random() % 100) / 100 + 16);
            else
                for (unsigned int n = random() % 4 + 1; n > 0; --n)
                    file.bytes[8 + random() % (file.bytes.size() - 8)] =
                        static_cast<std::byte>(random());
            read += isReadAlike(file, {{"allParts", true}}) ? 1 : 0;
        }
        EXPECT_LT(read, files) << "none was damaged";
    }

    static void SetUpTestSuite() { s_client = std::make_unique<WorkerClient>(); }
    static void TearDownTestSuite() { s_client.reset(); }
    static std::unique_ptr<WorkerClient> s_client;
};
std::unique_ptr<WorkerClient> SameAsOpenImageIo::s_client;

TEST_F(SameAsOpenImageIo, Png) {
    check(test::pngFiles());
}

TEST_F(SameAsOpenImageIo, Jpeg) {
    check(test::jpegFiles());
}

TEST_F(SameAsOpenImageIo, OpenExr) {
    const test::TemporaryFolder folder;
    check(test::exrFiles(folder.path()));
}

TEST_F(SameAsOpenImageIo, Damaged) {
    const test::TemporaryFolder folder;
    checkDamaged(test::pngFiles(), 1);
    checkDamaged(test::jpegFiles(), 2);
    checkDamaged(test::exrFiles(folder.path()), 3);
}

// What is written is the same, too: half and float, one part and several, of one size and of more.
TEST_F(SameAsOpenImageIo, WritesTheSameOpenExrFiles) {
    const auto part = [](const char* name, int width, int height, bool half) {
        return json{{"name", name},
                    {"width", width},
                    {"height", height},
                    {"channels", 4},
                    {"type", "f32"},
                    {"half", half},
                    {"channelNames", {"R", "G", "B", "z.first"}},
                    {"attributes", {{"patina:basis", "real"}, {"patina:empty", ""}}}};
    };
    const std::vector<json> files{
        {part("", 50, 70, false)},
        {part("named", 70, 150, true)},
        {part("one", 9, 5, true), part("two", 9, 5, false)},
        {part("one", 9, 5, true), part("two", 3, 70, true), part("three", 1, 1, false)}};
    for (const json& parts : files) {
        std::vector<float> pixels(65536, 0.0f);
        std::minstd_rand random(7);
        for (float& value : pixels)
            value = static_cast<float>(random()) * 1e-7f - 100.0f;
        pixels[0] = std::numeric_limits<float>::quiet_NaN();
        pixels[1] = -std::numeric_limits<float>::infinity();
        pixels[2] = 1e-7f; // less than the smallest half
        const json header{
            {"op", "encodeImage"}, {"format", "openexr"}, {"jpegQuality", 90}, {"parts", parts}};
        const auto bytes = std::as_bytes(std::span(pixels));
        const auto ours = s_client->request(WorkerKind::Image, header.dump(), bytes, "a.exr");
        const auto theirs =
            s_client->request(WorkerKind::OpenImageIo, header.dump(), bytes, "a.exr");
        ASSERT_TRUE(ours.ok()) << ours.error().text();
        ASSERT_TRUE(theirs.ok()) << theirs.error().text();
        const auto a = ours->payload.bytes(), b = theirs->payload.bytes();
        EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end()))
            << parts << "\n"
            << a.size() << " and " << b.size() << " bytes";
    }
}

// Pictures of this repository and of its tests.
TEST_F(SameAsOpenImageIo, OurOwnFiles) {
    namespace fs = std::filesystem;
    int files = 0;
    for (const char* folder : {"tests/golden", "tests/core/bake/version-2"})
        for (const auto& entry :
             fs::recursive_directory_iterator(fs::path(PATINA_SOURCE_DIR) / folder)) {
            const std::string extension = entry.path().extension().string();
            if (extension != ".png" && extension != ".exr")
                continue;
            const test::SampleFile file{entry.path().filename().string(),
                                        extension == ".png" ? "png" : "openexr",
                                        readFile(entry.path(), std::size_t{1} << 24).value()};
            for (const json& how : requests())
                expectRead(file, how);
            ++files;
        }
    EXPECT_GT(files, 5);
}

} // namespace
} // namespace patina
