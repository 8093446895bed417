// A light map's files hold its numbers, and the scene names them.
#include "core/export/LightMapExport.h"
#include "ExportScene.h"
#include "core/bake/Bake.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/bake/lightmap/LightMap.h"
#include "core/bake/lightmap/LightMapBake.h"
#include "core/export/Export.h"
#include "core/io/ImageIO.h"
#include "core/trace/document/DocumentTraceInputs.h"
#include "core/worker/WorkerClient.h"
#include "tests/support/TemporaryFolder.h"

#include <filesystem>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <random>

using namespace patina;
using namespace patina::test;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

namespace {

constexpr int kSide = 8;

class LightMapExport : public testing::Test {
  protected:
    // Two materials of one name, of which the second has no map.
    LightMapExport() {
        m_mapped = addMaterial(m_document, "Clay / red").id;
        const Id other = addMaterial(m_document, "Clay / red").id;
        addSquare(m_document, m_mapped);
        addSquare(m_document, other);
        m_bake.kind = BakeKind::LightMap;
        m_bake.inputs = hashBakeInputs(bakeInputs(m_document));
        m_bake.light = hashLightMapLight(traceInputs(m_document));
        TexelBake& texels = m_bake.texels.emplace_back();
        texels.material = m_mapped;
        texels.side = kSide;
        texels.stride = kLightMapStride;
        texels.values.resize(std::size_t{kSide * kSide} * kLightMapStride);
        std::mt19937 random(3);
        for (float& value : texels.values) // of 1/256: exact as half floats
            value = float(int(random() % 1024) - 512) / 256.0f;
        attach();
    }
    void attach() { m_document.bakes = {std::make_shared<const BakeArtifact>(m_bake)}; }
    [[nodiscard]] float number(int x, int y, int index) const {
        return m_bake.texels[0].values[std::size_t((y * kSide + x) * kLightMapStride + index)];
    }
    ExportSettings settings(const std::string& name) const {
        ExportSettings result;
        result.output = m_folder / name;
        result.format =
            result.output.extension() == ".glb" ? ExportFormat::Glb : ExportFormat::Gltf;
        return result;
    }
    static ImageLoadOptions signedNumbers() {
        ImageLoadOptions options;
        options.sanitize = false;
        return options;
    }
    // The picture that the scene's material names.
    Image picture(const Json& names, const char* key) {
        Result<LoadedImage> loaded =
            loadImage(m_worker, m_folder / names[key].get<std::string>(), signedNumbers());
        EXPECT_TRUE(loaded.ok()) << loaded.error().text();
        return loaded->image();
    }

    const TemporaryFolder m_folder;
    Document m_document;
    BakeArtifact m_bake;
    Id m_mapped = 0;
    WorkerClient m_worker;
};

} // namespace

TEST_F(LightMapExport, FilesHoldTheNumbersOfTheBake) {
    const ExportPlan plan = planExport(m_document, settings("a b.gltf"));
    EXPECT_THAT(plan.warnings, IsEmpty());
    const auto written = runExport(m_worker, plan, JobContext());
    ASSERT_TRUE(written.ok()) << written.error().text();
    const Result<std::string> text = readTextFile(m_folder / "a b.gltf", 1 << 20);
    const Json root = Json::parse(*text);
    EXPECT_FALSE(root["materials"][1].contains("extras")) << "it has no map";
    const Json names = root["materials"][0]["extras"]["patinaBakedLight"];
    EXPECT_EQ(names["irradiance"], "a_b_Clay___red_irradiance.exr");
    EXPECT_EQ(names["reflections"], "a_b_Clay___red_reflections.exr");
    EXPECT_EQ(names["bentNormal"], "a_b_Clay___red_bent-normal.exr");
    EXPECT_EQ(root["extras"]["patinaBakedLight"]["texCoord"], 0);
    const Result<std::string> shader = readTextFile(
        m_folder / root["extras"]["patinaBakedLight"]["shader"].get<std::string>(), 1 << 20);
    ASSERT_TRUE(shader.ok());
    EXPECT_THAT(*shader, HasSubstr("a b.gltf"));

    const Image irradiance = picture(names, "irradiance");
    const Image reflections = picture(names, "reflections");
    const Image bent = picture(names, "bentNormal");
    ASSERT_EQ(irradiance.width(), kSide);
    ASSERT_EQ(reflections.width(), 3 * kSide);
    ASSERT_EQ(reflections.channels(), 4);
    bool negative = false;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            for (int c = 0; c < 3; ++c) {
                EXPECT_EQ(irradiance.sample(x, y, c), number(x, y, c));
                EXPECT_EQ(bent.sample(x, y, c), number(x, y, kLightMapStride - 3 + c));
                negative = negative || irradiance.sample(x, y, c) < 0.0f;
            }
            for (int term = 0; term < 9; ++term)
                for (int c = 0; c < 4; ++c)
                    EXPECT_EQ(reflections.sample(term % 3 * kSide + x, term / 3 * kSide + y, c),
                              number(x, y, 4 + 4 * term + c));
        }
    EXPECT_TRUE(negative) << "the test would not see whether they are kept";
}

TEST_F(LightMapExport, WhatIsPlannedIsWhatIsWritten) {
    const ExportPlan plan = planExport(m_document, settings("scene.glb"));
    ASSERT_TRUE(runExport(m_worker, plan, JobContext()).ok());
    int pictures = 0;
    for (const PlannedFile& file : plan.files) {
        if (file.embedded)
            continue;
        EXPECT_TRUE(std::filesystem::exists(file.path)) << file.path;
        if (file.path.extension() != ".exr")
            continue;
        const Result<ImageInfo> info = inspectImage(m_worker, file.path);
        ASSERT_TRUE(info.ok());
        EXPECT_EQ(file.format,
                  fmt::format("EXR 16-bit {} {} × {}", info->channels == 4 ? "RGBA" : "RGB",
                              info->width, info->height));
        EXPECT_EQ(info->pixelType, "half");
        ++pictures;
    }
    EXPECT_EQ(pictures, 3);
}

TEST_F(LightMapExport, LargeMapsAreAveragedTileByTile) {
    const Image half = lightMapPartImage(m_bake.texels[0], LightMapPart::Reflections, kSide / 2);
    ASSERT_EQ(half.width(), 3 * kSide / 2);
    for (int term = 0; term < 9; ++term)
        for (int y = 0; y < kSide / 2; ++y)
            for (int x = 0; x < kSide / 2; ++x)
                for (int c = 0; c < 4; ++c) {
                    float mean = 0.0f;
                    for (int k = 0; k < 4; ++k)
                        mean += number(2 * x + k % 2, 2 * y + k / 2, 4 + 4 * term + c) / 4.0f;
                    EXPECT_NEAR(half.sample(term % 3 * kSide / 2 + x, term / 3 * kSide / 2 + y, c),
                                mean, 1e-6f);
                }
    ExportSettings wanted = settings("small.glb");
    wanted.maxTextureSize = kSide / 2;
    const ExportPlan plan = planExport(m_document, wanted);
    ASSERT_TRUE(runExport(m_worker, plan, JobContext()).ok());
    const Result<ImageInfo> info =
        inspectImage(m_worker, m_folder / "small_Clay___red_reflections.exr");
    ASSERT_TRUE(info.ok()) << info.error().text();
    EXPECT_EQ(info->width, 3 * kSide / 2);
}

// A program that knows nothing of light maps gets what it can read.
TEST_F(LightMapExport, AmbientVisibilityIsTheOcclusionTexture) {
    ExportSettings wanted = settings("a.gltf");
    ASSERT_TRUE(runExport(m_worker, planExport(m_document, wanted), JobContext()).ok());
    const Json root = Json::parse(*readTextFile(m_folder / "a.gltf", 1 << 20));
    EXPECT_TRUE(root["materials"][0].contains("occlusionTexture"));
    EXPECT_FALSE(root["materials"][1].contains("occlusionTexture"));
    const Result<LoadedImage> picture =
        loadImage(m_worker, m_folder / root["images"][0]["uri"].get<std::string>());
    ASSERT_TRUE(picture.ok()) << picture.error().text();
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
            EXPECT_NEAR(picture->image().sample(x, y, 0), std::clamp(number(x, y, 3), 0.0f, 1.0f),
                        0.5f / 255.0f + 1e-6f);
    wanted.includeBakedAo = false;
    for (const PlannedFile& file : planExport(m_document, wanted).files)
        EXPECT_THAT(file.contents, testing::Not(HasSubstr("baked occlusion")));
}

TEST_F(LightMapExport, SaysWhatDoesNotFitAndCanBeLeftOut) {
    ExportSettings wanted = settings("a.glb");
    m_document.materials[0].baseColor = {0.1f, 0.2f, 0.3f};
    EXPECT_THAT(planExport(m_document, wanted).warnings,
                ElementsAre(HasSubstr("of other lights, environments or materials")));
    m_bake.inputs.low ^= 1;
    attach();
    EXPECT_THAT(planExport(m_document, wanted).warnings,
                ElementsAre(HasSubstr("older than the geometry")));
    wanted.includeLightMap = wanted.includeBakedAo = false;
    const ExportPlan plan = planExport(m_document, wanted);
    EXPECT_THAT(plan.warnings, IsEmpty());
    EXPECT_EQ(plan.files.size(), 1u);
}
