// Bake files: what is written comes back, and nothing else is believed.
#include "core/bake/file/BakeIO.h"
#include "core/bake/file/BakeParts.h"
#include "core/document/Document.h"
#include "core/worker/WorkerClient.h"
#include "tests/core/bake/BakeFileScene.h"
#include "tests/support/TemporaryFolder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace patina;
using namespace patina::test;
using testing::HasSubstr;

namespace {

std::string refusal(const std::vector<ImagePart>& parts, const Document& document) {
    const Result<BakeArtifact> result = bakeFromParts(parts, document, "bake.exr");
    EXPECT_FALSE(result.ok());
    if (result.ok())
        return "";
    EXPECT_EQ(result.error().kind, ErrorKind::InputBroken);
    EXPECT_EQ(result.error().file, "bake.exr");
    return result.error().message;
}

} // namespace

TEST(BakeIO, FilesHoldEveryKindExactly) {
    const Document document = bakeDocument();
    WorkerClient worker;
    const TemporaryFolder folder;
    std::vector<BakeArtifact> bakes = {randomBake(document, BakeKind::AoTexel),
                                       randomBake(document, BakeKind::AoVertex),
                                       randomBake(document, BakeKind::LightMap)};
    for (int order = 1; order <= 8; ++order)
        for (const BakeKind kind : {BakeKind::PrtVertex, BakeKind::PrtTexel})
            bakes.push_back(randomBake(document, kind, order));
    for (const TransferKind transfer : {TransferKind::Unshadowed, TransferKind::Interreflected})
        for (const BakeKind kind : {BakeKind::PrtVertex, BakeKind::PrtTexel})
            bakes.push_back(randomBake(document, kind, 3, transfer));
    for (const BakeArtifact& bake : bakes) {
        const Result<Bytes> bytes = encodeBake(worker, bake, document);
        ASSERT_TRUE(bytes.ok()) << bytes.error().text();
        const Result<BakeArtifact> loaded =
            loadBake(worker, folder.write("bake.exr", *bytes), document);
        ASSERT_TRUE(loaded.ok()) << loaded.error().text();
        expectSame(*loaded, bake);
    }
}

TEST(BakeIO, TruncatedForeignAndMissingFilesAreErrors) {
    const Document document = bakeDocument();
    WorkerClient worker;
    const TemporaryFolder folder;
    const Result<Bytes> bytes =
        encodeBake(worker, randomBake(document, BakeKind::PrtVertex, 3), document);
    ASSERT_TRUE(bytes.ok());
    for (const double part : {0.0, 0.01, 0.3, 0.99}) {
        const auto size = static_cast<std::size_t>(double(bytes->size()) * part);
        const Result<BakeArtifact> result =
            loadBake(worker, folder.write("cut.exr", std::span(*bytes).first(size)), document);
        ASSERT_FALSE(result.ok()) << part;
        EXPECT_EQ(result.error().kind, ErrorKind::InputBroken);
    }
    const Image picture(4, 4, 3, PixelType::F32, ColorEncoding::Linear);
    const Result<Bytes> foreign = encodeImage(worker, picture, ImageFileFormat::Exr);
    ASSERT_TRUE(foreign.ok());
    const Result<BakeArtifact> result =
        loadBake(worker, folder.write("foreign.exr", *foreign), document);
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().kind, ErrorKind::InputBroken);
    EXPECT_THAT(result.error().message, HasSubstr("no bake"));
    const Result<BakeArtifact> missing = loadBake(worker, folder.path() / "none.exr", document);
    ASSERT_FALSE(missing.ok());
    EXPECT_EQ(missing.error().kind, ErrorKind::InputMissing);
}

TEST(BakeParts, DescribeThemselvesForOtherPrograms) {
    const Document document = bakeDocument();
    const std::vector<ImagePart> parts =
        bakeToParts(randomBake(document, BakeKind::PrtVertex, 2), document);
    ASSERT_EQ(parts.size(), 3u);
    EXPECT_EQ(parts[0].name, "Body");
    EXPECT_EQ(parts[1].name, "Body#2");
    EXPECT_EQ(parts[2].name, "Body#2#2"); // the third mesh is really called Body#2
    EXPECT_EQ(parts[0].image.width(), kMaxBakeRow);
    EXPECT_EQ(parts[0].image.channelNames(),
              (std::vector<std::string>{"sh.l0m0", "sh.l1m-1", "sh.l1m0", "sh.l1m1"}));
    for (const ImagePart& part : parts)
        for (const char* key :
             {"patina:basis", "patina:transfer", "patina:order", "patina:inputHash",
              "patina:meshHash", "patina:samplesDone", "patina:vertexCount", "patina:set.seed"})
            EXPECT_TRUE(part.attributes.contains(key)) << key;
}

TEST(BakeParts, ChannelsAndPartsInAnyOrder) {
    const Document document = bakeDocument();
    const BakeArtifact bake = randomBake(document, BakeKind::PrtVertex, 2);
    std::vector<ImagePart> parts = bakeToParts(bake, document);
    for (ImagePart& part : parts) { // channels reversed
        const std::vector<float> values(part.image.f32().begin(), part.image.f32().end());
        for (std::size_t i = 0; i < values.size(); ++i)
            part.image.f32()[i] = values[i / 4 * 4 + 3 - i % 4];
        std::vector<std::string> names = part.image.channelNames();
        std::reverse(names.begin(), names.end());
        part.image.setChannelNames(names);
    }
    const Result<BakeArtifact> loaded = bakeFromParts(parts, document, "bake.exr");
    ASSERT_TRUE(loaded.ok());
    expectSame(*loaded, bake);
    std::reverse(parts.begin(), parts.end());
    const Result<BakeArtifact> reversed = bakeFromParts(parts, document, "bake.exr");
    ASSERT_TRUE(reversed.ok());
    EXPECT_EQ(reversed->vertices.front(), bake.vertices.back());
}

TEST(BakeParts, RenamedMeshesAreFoundByPosition) {
    Document document = bakeDocument();
    const BakeArtifact bake = randomBake(document, BakeKind::AoVertex);
    const std::vector<ImagePart> parts = bakeToParts(bake, document);
    document.meshes[0].name = "Torso";
    document.meshes[1].name = "Ring";
    document.meshes[2].name = "Box";
    const Result<BakeArtifact> loaded = bakeFromParts(parts, document, "bake.exr");
    ASSERT_TRUE(loaded.ok());
    expectSame(*loaded, bake);
}

TEST(BakeParts, MeshesThatAreGoneOrReplacedAreLeftOut) {
    Document document = bakeDocument();
    const BakeArtifact bake = randomBake(document, BakeKind::AoVertex);
    document.meshes.erase(document.meshes.begin());
    document.meshes[1].mesh = document.meshes[0].mesh;
    const std::vector<ImagePart> parts = bakeToParts(bake, document);
    ASSERT_EQ(parts.size(), 1u);
    const Result<BakeArtifact> loaded = bakeFromParts(parts, document, "bake.exr");
    ASSERT_TRUE(loaded.ok());
    ASSERT_EQ(loaded->vertices.size(), 1u);
    EXPECT_EQ(loaded->vertices[0], bake.vertices[1]);
    document.meshes.clear(); // nothing is left: the file still says what it was
    const Result<BakeArtifact> empty =
        bakeFromParts(bakeToParts(bake, document), document, "bake.exr");
    ASSERT_TRUE(empty.ok());
    EXPECT_TRUE(empty->vertices.empty());
    EXPECT_EQ(empty->settings, bake.settings);
}

TEST(BakeParts, RefusalsOfOtherGeometryTellWhatDiffers) {
    const Document document = bakeDocument();
    const std::vector<ImagePart> parts =
        bakeToParts(randomBake(document, BakeKind::PrtVertex, 3), document);
    const auto whyNot = [&](const auto& change) {
        Document changed = document;
        Mesh mesh = *changed.meshes[1].mesh;
        change(mesh);
        changed.meshes[1].mesh = std::make_shared<const Mesh>(std::move(mesh));
        return refusal(parts, changed);
    };
    EXPECT_EQ(whyNot([](Mesh& mesh) { mesh.positions[0].x += 0.001f; }),
              "the bake was made for another mesh \"Body#2\" with as many vertices: its vertices "
              "stand elsewhere; open the scene it was made from, or bake this one");
    EXPECT_THAT(whyNot([](Mesh& mesh) {
                    std::swap(mesh.indices[0], mesh.indices[1]);
                    mesh.uvs[3].y = 7.0f;
                }),
                HasSubstr("its triangles join other vertices, its texture coordinates differ;"));
    EXPECT_THAT(whyNot([](Mesh& mesh) { mesh.normals[0] = -mesh.normals[0]; }),
                HasSubstr("vertices: its normals differ;"));
    const std::size_t vertices = document.meshes[1].mesh->vertexCount();
    const std::size_t triangles = document.meshes[1].mesh->triangleCount();
    EXPECT_THAT(whyNot([](Mesh& mesh) { mesh = sanitized(cubeMesh()); }),
                HasSubstr(fmt::format("was made for a mesh \"Body#2\" of {} vertices and {} "
                                      "triangles, but \"Body\" here has 24 vertices and 12 "
                                      "triangles;",
                                      vertices, triangles)));
    EXPECT_THAT(whyNot([](Mesh& mesh) { mesh.indices.resize(3); }), HasSubstr("and 1 triangle;"));

    Document other = document;
    other.meshes[1].mesh = nullptr;
    EXPECT_THAT(refusal(parts, other), HasSubstr("geometry is missing"));
    other.meshes.clear();
    EXPECT_THAT(refusal(parts, other), HasSubstr("a mesh \"Body\", which the scene does not have"));
    const Document bare;
    EXPECT_THAT(refusal(bakeToParts(randomBake(document, BakeKind::AoTexel), document), bare),
                HasSubstr("a material \"Skin\", which the scene does not have"));
}

TEST(BakeParts, DamageIsRefusedWithAReason) {
    const Document document = bakeDocument();
    const auto damaged = [&](BakeKind kind, const auto& damage) {
        std::vector<ImagePart> parts =
            bakeToParts(randomBake(document, kind, holdsTransfer(kind) ? 3 : 0), document);
        damage(parts);
        return refusal(parts, document);
    };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const BakeKind kind :
         {BakeKind::AoTexel, BakeKind::AoVertex, BakeKind::PrtVertex, BakeKind::PrtTexel}) {
        for (const float value : {nan, std::numeric_limits<float>::infinity()})
            EXPECT_THAT(damaged(kind,
                                [&](auto& parts) {
                                    Image& image = parts[1].image;
                                    image.f32()[5 * static_cast<std::size_t>(image.channels())] =
                                        value;
                                }),
                        HasSubstr("out of range"));
        EXPECT_THAT(damaged(kind, [](auto& parts) { parts[0].attributes.erase("patina:format"); }),
                    HasSubstr("no bake"));
        EXPECT_THAT(damaged(kind, [](auto& parts) { parts[0].attributes["patina:version"] = "4"; }),
                    HasSubstr("newer"));
        EXPECT_THAT(damaged(kind, [](auto& parts) { parts[0].attributes["patina:kind"] = "x"; }),
                    HasSubstr("kind"));
        EXPECT_THAT(
            damaged(kind, [](auto& parts) { parts[2].attributes["patina:samplesDone"] = "1"; }),
            HasSubstr("together"));
        EXPECT_THAT(
            damaged(kind, [](auto& parts) { parts[0].attributes["patina:inputHash"] = "12"; }),
            HasSubstr("missing"));
        EXPECT_THAT(damaged(kind, [](auto& parts) { parts.push_back(parts[1]); }),
                    HasSubstr("same target"));
        EXPECT_THAT(damaged(kind,
                            [](auto& parts) {
                                auto names = parts[0].image.channelNames();
                                names[0] = "R";
                                parts[0].image.setChannelNames(names);
                            }),
                    HasSubstr("channel"));
    }
    EXPECT_THAT(damaged(BakeKind::AoVertex, [](auto& parts) { parts[0].image.f32()[0] = 1.5f; }),
                HasSubstr("out of range"));
    EXPECT_THAT(damaged(BakeKind::PrtVertex,
                        [](auto& parts) { parts[0].attributes["patina:order"] = "9"; }),
                HasSubstr("order"));
    EXPECT_THAT(damaged(BakeKind::AoVertex,
                        [](auto& parts) { parts[0].attributes["patina:vertexCount"] = "99999"; }),
                HasSubstr("vertices"));
    // Finite, but no light does that.
    EXPECT_THAT(damaged(BakeKind::PrtTexel, [](auto& parts) { parts[0].image.f32()[4] = 1e30f; }),
                HasSubstr("out of range"));
    EXPECT_THAT(damaged(BakeKind::PrtTexel,
                        [](auto& parts) {
                            parts[0].image =
                                Image(17, 16, 9, PixelType::F32, ColorEncoding::Linear);
                        }),
                HasSubstr("square"));
    EXPECT_THAT(refusal({}, document), HasSubstr("empty"));
}
