// Several meshes in a part of a bake file: the same bits come back, damage is refused.
#include "core/bake/file/BakePacking.h"
#include "core/bake/file/BakeIO.h"
#include "core/bake/file/BakeParts.h"
#include "core/worker/WorkerClient.h"
#include "tests/core/bake/BakeFileScene.h"
#include "tests/support/TemporaryFolder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace patina;
using namespace patina::test;
using ::testing::HasSubstr;

namespace {

std::vector<ImagePart> partsOf(const Document& document, BakeKind kind, int order = 0,
                               TransferKind transfer = TransferKind::Shadowed) {
    return bakeToParts(randomBake(document, kind, order, transfer), document);
}

void expectEqual(const std::vector<ImagePart>& a, const std::vector<ImagePart>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].name, b[i].name);
        EXPECT_EQ(a[i].attributes, b[i].attributes);
        EXPECT_EQ(a[i].image, b[i].image);
    }
}

std::string refusal(std::vector<ImagePart> parts) {
    const Result<std::vector<ImagePart>> result = unpackParts(std::move(parts), "bake.exr");
    return result ? "" : result.error().text();
}

} // namespace

TEST(BakePacking, ComesBackBitForBit) {
    const Document document = bakeDocument();
    for (const BakeKind kind :
         {BakeKind::AoVertex, BakeKind::AoTexel, BakeKind::PrtVertex, BakeKind::PrtTexel}) {
        const int order = holdsTransfer(kind) ? 3 : 0;
        const std::vector<ImagePart> parts =
            partsOf(document, kind, order, TransferKind::Interreflected);
        expectEqual(packParts(parts), parts); // few: as they were
        const std::vector<ImagePart> packed = packParts(parts, 1);
        ASSERT_EQ(packed.size(), 1u);
        EXPECT_TRUE(isPacked(packed[0]));
        const Result<std::vector<ImagePart>> back = unpackParts(packed, "bake.exr");
        ASSERT_TRUE(back) << back.error().text();
        expectEqual(*back, parts);
    }
}

TEST(BakePacking, PartsOfOtherChannelsAreKeptApart) {
    const Document document = bakeDocument();
    BakeArtifact bake = randomBake(document, BakeKind::PrtVertex, 2, TransferKind::Interreflected);
    // Grey bounces have a channel for all colours.
    std::vector<float>& bounced = bake.vertices[1].bounced;
    for (std::size_t i = 0; i < bounced.size(); ++i)
        bounced[i] = bounced[i - i % 3];
    const std::vector<ImagePart> parts = bakeToParts(bake, document);
    const std::vector<ImagePart> packed = packParts(parts, 1);
    EXPECT_EQ(packed.size(), 2u);
    const Result<std::vector<ImagePart>> back = unpackParts(packed, "bake.exr");
    ASSERT_TRUE(back);
    const Result<BakeArtifact> loaded = bakeFromParts(*back, document, "bake.exr");
    ASSERT_TRUE(loaded) << loaded.error().text();
    EXPECT_EQ(loaded->vertices.size(), bake.vertices.size());
    for (const VertexBake& own : bake.vertices)
        EXPECT_NE(std::ranges::find(loaded->vertices, own), loaded->vertices.end());
}

TEST(BakePacking, OlderReadersRefuseItInsteadOfFindingNothing) {
    const Document document = bakeDocument();
    const std::vector<ImagePart> packed = packParts(partsOf(document, BakeKind::AoVertex), 1);
    const Result<BakeArtifact> loaded = bakeFromParts(packed, document, "bake.exr");
    ASSERT_FALSE(loaded);
    EXPECT_THAT(loaded.error().text(), HasSubstr("newer Patina"));
    // We say the same of what comes after us.
    std::vector<ImagePart> later = packed;
    for (ImagePart& part : later)
        part.attributes["patina:version"] = "5";
    const Result<std::vector<ImagePart>> kept = unpackParts(later, "bake.exr");
    ASSERT_TRUE(kept.ok());
    EXPECT_THAT(bakeFromParts(*kept, document, "bake.exr").error().text(),
                HasSubstr("newer Patina"));
}

TEST(BakePacking, DamageIsRefused) {
    const Document document = bakeDocument();
    const std::vector<ImagePart> packed = packParts(partsOf(document, BakeKind::AoVertex), 1);
    const auto with = [&](const std::string& from, const std::string& to) {
        std::vector<ImagePart> parts = packed;
        std::string& text = parts[0].attributes[kPackedAttribute];
        const std::size_t at = text.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        text.replace(at, from.size(), to);
        return refusal(parts);
    };
    EXPECT_EQ(refusal(packed), "");
    for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
             {"[", ""},                              // no JSON
             {"\"first\":0", "\"first\":1"},         // a gap
             {"\"width\"", "\"breadth\""},           // missing
             {"\"height\":", "\"height\":99999999"}, // beyond the pixels
             {"\"height\":", "\"height\":-"},
             {"\"name\":\"Body\"", "\"name\":7"}})
        EXPECT_THAT(with(from, to), HasSubstr("damaged")) << from << " -> " << to;
    // Numbers that were changed are found by the hash of the member they belong to.
    std::vector<ImagePart> parts = packed;
    parts[0].image.f32()[5] *= 0.5f;
    const Result<std::vector<ImagePart>> unpacked = unpackParts(parts, "bake.exr");
    ASSERT_TRUE(unpacked);
    EXPECT_FALSE(bakeFromParts(*unpacked, document, "bake.exr"));
}

// As many meshes as a city has; all of one name, as instances often are.
TEST(BakePacking, SixteenThousandMeshesFitIntoAFile) {
    Document document = bakeDocument();
    document.meshes.erase(document.meshes.begin(), document.meshes.begin() + 2); // the cube is left
    while (document.meshes.size() < 16'000) {
        document.meshes.push_back(document.meshes.front());
        document.meshes.back().id = document.takeId();
    }
    const BakeArtifact bake = randomBake(document, BakeKind::AoVertex);
    WorkerClient worker;
    const Result<Bytes> bytes = encodeBake(worker, bake, document);
    ASSERT_TRUE(bytes) << bytes.error().text();
    const TemporaryFolder folder;
    const Result<BakeArtifact> loaded =
        loadBake(worker, folder.write("bake.exr", *bytes), document);
    ASSERT_TRUE(loaded) << loaded.error().text();
    EXPECT_EQ(loaded->vertices, bake.vertices);
}
