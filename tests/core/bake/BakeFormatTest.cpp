// What version 2 of the format added, and that versions 1 and 2 are still read.
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/bake/domain/BakeHash.h"
#include "core/bake/file/BakeIO.h"
#include "core/bake/file/BakePacking.h"
#include "core/bake/file/BakeParts.h"
#include "core/scene/Scene.h"
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

BakeArtifact throughFile(const BakeArtifact& bake, const Document& document,
                         const BakeFileOptions& options, std::size_t* size = nullptr) {
    WorkerClient worker;
    const TemporaryFolder folder;
    const Result<Bytes> bytes = encodeBake(worker, bake, document, options);
    EXPECT_TRUE(bytes.ok()) << bytes.error().text();
    if (size != nullptr)
        *size = bytes->size();
    const Result<BakeArtifact> loaded =
        loadBake(worker, folder.write("bake.exr", *bytes), document);
    EXPECT_TRUE(loaded.ok()) << loaded.error().text();
    return *loaded;
}

// Every difference between two bakes' coefficients, added up as storageError() promises it.
StorageError difference(const BakeArtifact& exact, const BakeArtifact& stored) {
    StorageError error;
    for (std::size_t m = 0; m < exact.vertices.size(); ++m)
        for (const auto member : {&VertexBake::values, &VertexBake::bounced})
            for (std::size_t i = 0; i < (exact.vertices[m].*member).size(); ++i)
                error.add((exact.vertices[m].*member)[i], (stored.vertices[m].*member)[i]);
    return error;
}

} // namespace

TEST(BakeFormat, StorageCostsWhatIsStated) {
    const Document document = bakeDocument();
    const BakeArtifact bake =
        randomBake(document, BakeKind::PrtVertex, 4, TransferKind::Interreflected);
    std::size_t exactSize = 0;
    throughFile(bake, document, {}, &exactSize);
    std::size_t before = exactSize;
    double lastError = 0.0;
    for (const BakeFileOptions& options :
         {BakeFileOptions{BakeStorage::Half, 8}, BakeFileOptions{BakeStorage::Quantised, 8},
          BakeFileOptions{BakeStorage::Quantised, 4}}) {
        SCOPED_TRACE(fmt::format("{} {}", storageName(options.storage), options.bits));
        std::size_t size = 0;
        const BakeArtifact stored = throughFile(bake, document, options, &size);
        const StorageError promised = storageError(bake, options);
        const StorageError found = difference(bake, stored);
        EXPECT_EQ(found.count, promised.count);
        EXPECT_DOUBLE_EQ(found.rms(), promised.rms());
        EXPECT_DOUBLE_EQ(found.largest, promised.largest);
        EXPECT_GT(promised.rms(), 2.0 * lastError);
        EXPECT_LT(size, before);
        before = size;
        lastError = promised.rms();
        EXPECT_THAT(bakeToParts(bake, document, options)[0].attributes.at("patina:storageError"),
                    HasSubstr("RMS error"));
        // Shares are not quantised.
        for (std::size_t i = 0; i < bake.vertices[0].sky.size(); ++i) {
            EXPECT_NEAR(stored.vertices[0].sky[i], bake.vertices[0].sky[i], 0.5 / 2048);
            EXPECT_NEAR(stored.vertices[0].error[i], bake.vertices[0].error[i], 0.5 / 2048);
        }
    }
    EXPECT_LT(before, exactSize / 4);
}

TEST(BakeStorage, StepsReachTheLargestOfTheirBand) {
    // Bands 0 and 1, two elements; largest |values| 0.7 and 1.4; 4 bits count to 7.
    std::vector<float> values = {0.5f, 0.2f, -1.4f, 0.0f, -0.7f, 0.3f, 0.1f, 0.72f};
    const std::vector<float> steps = bandSteps(values, 2, 1, 4);
    ASSERT_EQ(steps.size(), 2u);
    EXPECT_FLOAT_EQ(steps[0], 0.1f);
    EXPECT_FLOAT_EQ(steps[1], 0.2f);
    quantise(values, 2, 1, steps);
    EXPECT_EQ(values, (std::vector<float>{5, 1, -7, 0, -7, 2, 0, 4}));
    dequantise(values, 2, 1, steps);
    EXPECT_FLOAT_EQ(values[2], -1.4f);
    EXPECT_FLOAT_EQ(values[4], -0.7f);
    EXPECT_EQ(bandSteps(std::vector<float>(12, 0.0f), 2, 3, 8), std::vector<float>(2, 0.0f));
    EXPECT_EQ(roundedToHalf(2047.0f), 2047.0f); // whole numbers of 12 bits are exact
    EXPECT_EQ(roundedToHalf(1e9f), 65504.0f);
}

TEST(BakeFormat, GreyBouncesTakeAThirdAndComeBackExactly) {
    const Document document = bakeDocument();
    BakeArtifact bake = randomBake(document, BakeKind::PrtVertex, 2, TransferKind::Interreflected);
    std::vector<float>& bounced = bake.vertices[1].bounced;
    for (std::size_t i = 0; i < bounced.size(); i += 3)
        bounced[i + 1] = bounced[i + 2] = bounced[i];
    const std::vector<ImagePart> parts = bakeToParts(bake, document);
    EXPECT_EQ(parts[0].image.channels(), 4 + 12 + 2);
    EXPECT_EQ(parts[1].image.channels(), 4 + 4 + 2);
    EXPECT_EQ(parts[1].image.channelNames()[5], "bounced.l1m-1");
    EXPECT_EQ(parts[0].image.channelNames()[8], "bounced.l1m-1.G");
    expectSame(throughFile(bake, document, {}), bake);
    bounced[3 * 5 + 2] += 0.01f; // one blue number
    EXPECT_EQ(bakeToParts(bake, document)[1].image.channels(), 4 + 12 + 2);
    expectSame(throughFile(bake, document, {}), bake);
}

TEST(BakeFormat, TheFirstVersionIsStillRead) {
    const Document document = bakeDocument();
    const BakeArtifact bake = randomBake(document, BakeKind::PrtVertex, 2);
    std::vector<ImagePart> parts = bakeToParts(bake, document);
    for (ImagePart& part : parts) {
        part.attributes["patina:version"] = "1";
        part.attributes["patina:transfer"] = part.attributes["patina:definition"];
        for (const char* later :
             {"patina:definition", "patina:storage", "patina:triangleCount", "patina:transform",
              "patina:meshHash.positions", "patina:meshHash.indices", "patina:meshHash.normals",
              "patina:meshHash.uvs", "patina:meshHash.tangents", "patina:contentHash"})
            ASSERT_EQ(part.attributes.erase(later), 1u) << later;
    }
    const Result<BakeArtifact> loaded = bakeFromParts(parts, document, "bake.exr");
    ASSERT_TRUE(loaded.ok()) << loaded.error().text();
    expectSame(*loaded, bake);
    Document other = document;
    Mesh moved = *other.meshes[0].mesh;
    moved.positions[0].x += 1.0f;
    other.meshes[0].mesh = std::make_shared<const Mesh>(moved);
    const Result<BakeArtifact> refused = bakeFromParts(parts, other, "bake.exr");
    ASSERT_FALSE(refused.ok());
    EXPECT_THAT(refused.error().message,
                HasSubstr("another mesh \"Body\" with as many vertices; open"));
}

// Files that a Patina wrote which knew nothing of sources and coverage.
TEST(BakeFormat, TheSecondVersionIsStillRead) {
    const std::filesystem::path folder = PATINA_SOURCE_DIR "/tests/core/bake/version-2";
    WorkerClient worker;
    const Result<OpenedScene> scene = openScene(worker, (folder / "quad.obj").string());
    ASSERT_TRUE(scene.ok()) << scene.error().text();
    const Document& document = scene->document;
    for (const char* name : {"vertex.exr", "texel.exr"}) {
        const Result<BakeArtifact> bake = loadBake(worker, folder / name, document);
        ASSERT_TRUE(bake.ok()) << bake.error().text();
        EXPECT_EQ(bake->inputs, hashBakeInputs(bakeInputs(document))) << name;
        EXPECT_EQ(bake->order, 2);
        EXPECT_EQ(bake->bounces, 1);
        EXPECT_EQ(bake->vertices.size() + bake->texels.size(), 1u);

        // Packed, as a larger one would have been.
        ImageLoadOptions asBake;
        asBake.sanitize = false;
        asBake.allParts = true;
        Result<LoadedImage> file = loadImage(worker, folder / name, asBake);
        ASSERT_TRUE(file.ok()) << file.error().text();
        EXPECT_EQ(file->parts.front().attributes.at("patina:version"), "2");
        std::vector<ImagePart> packed = packParts(std::move(file->parts), 0);
        ASSERT_EQ(packed.size(), 1u);
        packed[0].attributes["patina:version"] = "3"; // of that time
        const Result<std::vector<ImagePart>> plain = unpackParts(packed, folder / name);
        ASSERT_TRUE(plain.ok()) << plain.error().text();
        const Result<BakeArtifact> again = bakeFromParts(*plain, document, folder / name);
        ASSERT_TRUE(again.ok()) << again.error().text();
        expectSame(*again, *bake);
    }
}

TEST(BakeFormat, EditedFilesAreRefused) {
    const Document document = bakeDocument();
    const auto refusal = [&](const auto& edit) {
        std::vector<ImagePart> parts =
            bakeToParts(randomBake(document, BakeKind::PrtTexel, 2), document);
        for (ImagePart& part : parts)
            edit(part);
        const Result<BakeArtifact> result = bakeFromParts(parts, document, "bake.exr");
        return result.ok() ? std::string("none") : result.error().message;
    };
    EXPECT_EQ(refusal([](ImagePart&) {}), "none");
    EXPECT_THAT(refusal([](ImagePart& part) { part.image.f32().back() += 0.01f; }),
                HasSubstr("changed after"));
    EXPECT_THAT(refusal([](ImagePart& part) { part.attributes["patina:set.samples"] = "9"; }),
                HasSubstr("changed after"));
    EXPECT_THAT(refusal([](ImagePart& part) { part.attributes.erase("patina:contentHash"); }),
                HasSubstr("changed after"));
    EXPECT_THAT(refusal([](ImagePart& part) { // two channels swapped
                    std::vector<std::string> names = part.image.channelNames();
                    std::swap(names[1], names[2]);
                    part.image.setChannelNames(names);
                }),
                HasSubstr("changed after"));
}

TEST(BakeFormat, DamageOfTheNewKindsIsRefused) {
    const Document document = bakeDocument();
    const auto refusal = [&](const BakeFileOptions& options, const auto& damage) {
        std::vector<ImagePart> parts =
            bakeToParts(randomBake(document, BakeKind::PrtVertex, 2, TransferKind::Interreflected),
                        document, options);
        for (ImagePart& part : parts)
            damage(part);
        const Result<BakeArtifact> result = bakeFromParts(parts, document, "bake.exr");
        EXPECT_FALSE(result.ok());
        return result.ok() ? std::string() : result.error().message;
    };
    const auto set = [](const char* key, const char* value) {
        return [=](ImagePart& part) { part.attributes[key] = value; };
    };
    const auto pixel = [](std::size_t channel, float value) {
        return [=](ImagePart& part) { part.image.f32()[channel] = value; };
    };
    EXPECT_THAT(refusal({}, set("patina:storage", "zip")), HasSubstr("stored"));
    EXPECT_THAT(refusal({}, set("patina:transfer", "lit")), HasSubstr("transfer"));
    EXPECT_THAT(refusal({}, set("patina:bounces", "65")), HasSubstr("bounces"));
    EXPECT_THAT(refusal({}, set("patina:albedoHash", "5")), HasSubstr("bounces"));
    EXPECT_THAT(refusal({}, pixel(4, 1e5f)), HasSubstr("out of range"));   // bounced
    EXPECT_THAT(refusal({}, pixel(16, 1.01f)), HasSubstr("out of range")); // sky
    EXPECT_THAT(refusal({}, pixel(17, -0.1f)), HasSubstr("out of range")); // error
    const auto renamed = [](std::size_t channel, const char* name) {
        return [=](ImagePart& part) {
            std::vector<std::string> names = part.image.channelNames();
            names[channel] = name;
            part.image.setChannelNames(names);
        };
    };
    EXPECT_THAT(refusal({}, renamed(15, "bounced.l1m1.A")), HasSubstr("channels"));
    EXPECT_THAT(refusal({}, renamed(16, "depth")), HasSubstr("channels"));
    const BakeFileOptions quantised{BakeStorage::Quantised, 8};
    EXPECT_THAT(refusal(quantised, set("patina:bits", "99")), HasSubstr("stored"));
    for (const char* steps : {"", "0.1", "0.1 0.1 0.1", "0.1 nan", "0.1 x", "0.1,0.1", "1e99 1"}) {
        EXPECT_THAT(refusal(quantised, set("patina:step.sh", steps)), HasSubstr("steps")) << steps;
        EXPECT_THAT(refusal(quantised, set("patina:step.bounced", steps)), HasSubstr("steps"));
    }
    EXPECT_THAT(refusal(quantised, set("patina:step.sh", "1e30 1e30")), HasSubstr("out of range"));
}
