// Bake files: what is written comes back, and nothing else is believed.
#include "core/bake/BakeIO.h"
#include "core/bake/BakeParts.h"
#include "core/document/Document.h"
#include "core/worker/WorkerClient.h"
#include "tests/core/bake/BakeTestScene.h"
#include "tests/support/TemporaryFolder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

using namespace patina;
using namespace patina::test;
using testing::HasSubstr;

namespace {

// Two meshes of one name, one of them with more vertices than a row of the image.
Document testDocument() {
    Document document;
    for (const char* name : {"Skin", "Skin", ""}) {
        Material& material = document.materials.emplace_back();
        material.id = document.takeId();
        material.name = name;
    }
    const std::vector<Mesh> meshes = {sphereMesh(1.0, 96, 64), torusMesh(1.0, 0.3, 12, 8),
                                      cubeMesh()};
    for (const Mesh& mesh : meshes) {
        MeshInstance& instance = document.meshes.emplace_back();
        instance.id = document.takeId();
        instance.name = document.meshes.size() < 3 ? "Body" : "Body#2";
        instance.mesh = std::make_shared<const Mesh>(sanitized(mesh));
        instance.material = document.materials[document.meshes.size() - 1].id;
    }
    return document;
}

BakeArtifact testBake(const Document& document, BakeKind kind, int order = 0) {
    std::mt19937 random(11);
    BakeArtifact artifact;
    artifact.kind = kind;
    artifact.inputs = hashBakeInputs(bakeInputs(document));
    artifact.settings = {{"samples", "256"}, {"seed", "4294967295"}, {"note", "a \"note\", 100 %"}};
    artifact.order = order;
    artifact.samplesDone = 128;
    const auto number = [&] {
        const float unit = float(random()) / 4294967296.0f;
        return holdsTransfer(kind) ? 2.0f * unit - 1.0f : unit;
    };
    if (kind == BakeKind::AoTexel) {
        for (const Material& material : document.materials) {
            auto image = std::make_shared<Image>(33, 33, 1, PixelType::F32, ColorEncoding::Data);
            for (float& value : image->f32())
                value = number();
            artifact.texels.push_back({material.id, std::move(image)});
        }
        return artifact;
    }
    const int stride = holdsTransfer(kind) ? order * order : 1;
    if (kind == BakeKind::PrtTexel) {
        for (const Material& material : document.materials) {
            TexelBake& bake = artifact.texels.emplace_back();
            bake.material = material.id;
            bake.side = 17;
            bake.stride = stride;
            bake.values.resize(17u * 17u * std::size_t(stride));
            for (float& value : bake.values)
                value = number();
        }
        return artifact;
    }
    for (const MeshInstance& mesh : document.meshes) {
        VertexBake& bake = artifact.vertices.emplace_back();
        bake.mesh = mesh.id;
        bake.stride = stride;
        bake.values.resize(mesh.mesh->vertexCount() * std::size_t(stride));
        for (float& value : bake.values)
            value = number();
    }
    return artifact;
}

// Images compare by identity in the artifact; here their content matters.
void expectSame(const BakeArtifact& a, const BakeArtifact& b) {
    EXPECT_EQ(a.kind, b.kind);
    EXPECT_EQ(a.inputs, b.inputs);
    EXPECT_EQ(a.settings, b.settings);
    EXPECT_EQ(a.order, b.order);
    EXPECT_EQ(a.samplesDone, b.samplesDone);
    EXPECT_EQ(a.vertices, b.vertices);
    ASSERT_EQ(a.texels.size(), b.texels.size());
    for (std::size_t i = 0; i < a.texels.size(); ++i) {
        EXPECT_EQ(a.texels[i].material, b.texels[i].material);
        ASSERT_EQ(a.texels[i].image != nullptr, b.texels[i].image != nullptr);
        if (a.texels[i].image) {
            EXPECT_EQ(*a.texels[i].image, *b.texels[i].image);
        }
        EXPECT_EQ(a.texels[i].side, b.texels[i].side);
        EXPECT_EQ(a.texels[i].stride, b.texels[i].stride);
        EXPECT_EQ(a.texels[i].values, b.texels[i].values);
    }
}

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
    const Document document = testDocument();
    WorkerClient worker;
    const TemporaryFolder folder;
    std::vector<BakeArtifact> bakes = {testBake(document, BakeKind::AoTexel),
                                       testBake(document, BakeKind::AoVertex)};
    for (int order = 1; order <= 5; ++order)
        for (const BakeKind kind : {BakeKind::PrtVertex, BakeKind::PrtTexel})
            bakes.push_back(testBake(document, kind, order));
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
    const Document document = testDocument();
    WorkerClient worker;
    const TemporaryFolder folder;
    const Result<Bytes> bytes =
        encodeBake(worker, testBake(document, BakeKind::PrtVertex, 3), document);
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
    const Document document = testDocument();
    const std::vector<ImagePart> parts =
        bakeToParts(testBake(document, BakeKind::PrtVertex, 2), document);
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
    const Document document = testDocument();
    const BakeArtifact bake = testBake(document, BakeKind::PrtVertex, 2);
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
    Document document = testDocument();
    const BakeArtifact bake = testBake(document, BakeKind::AoVertex);
    const std::vector<ImagePart> parts = bakeToParts(bake, document);
    document.meshes[0].name = "Torso";
    document.meshes[1].name = "Ring";
    document.meshes[2].name = "Box";
    const Result<BakeArtifact> loaded = bakeFromParts(parts, document, "bake.exr");
    ASSERT_TRUE(loaded.ok());
    expectSame(*loaded, bake);
}

TEST(BakeParts, MeshesThatAreGoneOrReplacedAreLeftOut) {
    Document document = testDocument();
    const BakeArtifact bake = testBake(document, BakeKind::AoVertex);
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

TEST(BakeParts, OtherGeometryIsRefused) {
    Document document = testDocument();
    const std::vector<ImagePart> parts =
        bakeToParts(testBake(document, BakeKind::PrtVertex, 3), document);
    Mesh moved = *document.meshes[1].mesh;
    moved.positions[0].x += 0.001f;
    document.meshes[1].mesh = std::make_shared<const Mesh>(moved);
    EXPECT_THAT(refusal(parts, document), HasSubstr("other geometry"));
    document.meshes[1].mesh = nullptr;
    EXPECT_THAT(refusal(parts, document), HasSubstr("other geometry"));
    document.meshes.clear();
    EXPECT_THAT(refusal(parts, document), HasSubstr("other geometry"));
    Document bare;
    EXPECT_THAT(
        refusal(bakeToParts(testBake(testDocument(), BakeKind::AoTexel), testDocument()), bare),
        HasSubstr("material"));
}

TEST(BakeParts, DamageIsRefusedWithAReason) {
    const Document document = testDocument();
    const auto damaged = [&](BakeKind kind, const auto& damage) {
        std::vector<ImagePart> parts =
            bakeToParts(testBake(document, kind, holdsTransfer(kind) ? 3 : 0), document);
        damage(parts);
        return refusal(parts, document);
    };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const BakeKind kind :
         {BakeKind::AoTexel, BakeKind::AoVertex, BakeKind::PrtVertex, BakeKind::PrtTexel}) {
        for (const float value : {nan, std::numeric_limits<float>::infinity()})
            EXPECT_THAT(damaged(kind, [&](auto& parts) { parts[1].image.f32()[5] = value; }),
                        HasSubstr("out of range"));
        EXPECT_THAT(damaged(kind, [](auto& parts) { parts[0].attributes.erase("patina:format"); }),
                    HasSubstr("no bake"));
        EXPECT_THAT(damaged(kind, [](auto& parts) { parts[0].attributes["patina:version"] = "2"; }),
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
    EXPECT_THAT(refusal({}, document), HasSubstr("empty"));
}
