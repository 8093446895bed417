// Radiance transfer in a GLB gives, with the light beside it, what ours gives.
#include "core/export/TransferExport.h"
#include "ExportScene.h"
#include "core/bake/Bake.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/base/AtomicFile.h"
#include "core/export/Export.h"
#include "core/io/MeshImport.h"
#include "core/light/OrientedEnvironment.h"
#include "core/math/SphericalHarmonics.h"
#include "core/worker/WorkerClient.h"
#include "tests/support/TemporaryFolder.h"

#include <cstring>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <random>

using namespace patina;
using namespace patina::test;
using nlohmann::json;
using testing::HasSubstr;

namespace {

// Two squares of one mesh, each with light of its own, under a turned and exposed sky.
struct Scene {
    Document document;
    BakeArtifact bake;
};

Scene makeScene(int order, bool bounced, bool colored) {
    Scene scene;
    Document& document = scene.document;
    const Id material = addMaterial(document, "Clay").id;
    const MeshPtr mesh = addSquare(document, material).mesh;
    MeshInstance& second = addSquare(document, material);
    second.mesh = mesh;
    std::mt19937 random(5);
    const auto number = [&] { return float(random()) / 4294967296.0f - 0.4f; };
    auto sky = std::make_shared<Image>(16, 8, 3, PixelType::F32, ColorEncoding::Linear);
    for (float& value : sky->f32())
        value = 0.5f + number();
    document.environment().image = document.environment().fileImage = sky;
    document.environment().rotationDeg = 90.0f; // four of the sixteen columns
    document.environment().exposureEv = 1.0f;

    scene.bake.kind = BakeKind::PrtVertex;
    scene.bake.order = order;
    scene.bake.inputs = hashBakeInputs(bakeInputs(document));
    for (const MeshInstance& instance : document.meshes) {
        VertexBake& bake = scene.bake.vertices.emplace_back();
        bake.mesh = instance.id;
        bake.stride = order * order;
        bake.values.resize(instance.mesh->vertexCount() * std::size_t(bake.stride));
        for (float& value : bake.values)
            value = number();
        bake.bounced.resize(bounced ? 3 * bake.values.size() : 0);
        for (std::size_t i = 0; i < bake.bounced.size(); ++i)
            bake.bounced[i] = colored || i % 3 == 0 ? number() : bake.bounced[i - 1];
    }
    document.bakes = {std::make_shared<const BakeArtifact>(scene.bake)};
    return scene;
}

struct Glb {
    json root;
    std::string buffer;

    [[nodiscard]] glm::vec4 vec4(int accessor, std::size_t vertex) const {
        const json& a = root["accessors"][std::size_t(accessor)];
        EXPECT_EQ(a["type"], "VEC4");
        EXPECT_EQ(a["componentType"], 5126);
        const json& view = root["bufferViews"][a["bufferView"].get<std::size_t>()];
        glm::vec4 value;
        std::memcpy(&value, buffer.data() + view["byteOffset"].get<std::size_t>() + 16 * vertex,
                    16);
        return value;
    }
};

Glb parseGlb(const std::string& file) {
    std::uint32_t size = 0;
    std::memcpy(&size, file.data() + 12, 4);
    return {json::parse(file.substr(20, size)), file.substr(28 + size)};
}

} // namespace

class TransferExport : public testing::TestWithParam<std::tuple<int, bool, bool, int>> {};

TEST_P(TransferExport, DotProductsOfTheFilesAreOurs) {
    const auto [order, bounced, colored, bands] = GetParam();
    const Scene scene = makeScene(order, bounced, colored);
    const TemporaryFolder folder;
    WorkerClient worker;
    ExportSettings settings;
    settings.output = folder / "a b.glb";
    settings.includeTransfer = true;
    settings.transferBands = bands;
    const ExportPlan plan = planExport(scene.document, settings);
    EXPECT_TRUE(plan.warnings.empty()) << plan.warnings.front();
    ASSERT_EQ(plan.files.size(), 3u);
    const auto written = runExport(worker, plan, JobContext());
    ASSERT_TRUE(written.ok()) << written.error().text();
    EXPECT_EQ(written->size(), 3u);

    const auto text = [&](const char* name) {
        Result<std::string> content = readTextFile(folder / name, 1 << 20);
        EXPECT_TRUE(content.ok());
        return *content;
    };
    const Glb glb = parseGlb(text("a b.glb"));
    const json extras = glb.root["extras"]["patinaTransfer"];
    const int used = bands == 0 ? order : bands, vectors = (used * used + 3) / 4;
    EXPECT_EQ(extras["bands"], used);
    EXPECT_EQ(extras["colors"], colored ? 3 : 1);
    EXPECT_EQ(extras["attributes"], colored ? 3 * vectors : vectors);
    const json light = json::parse(text(extras["light"].get<std::string>().c_str()));
    ASSERT_EQ(light["coefficients"].size(), std::size_t(used * used));
    // The sky turned and exposed as pixels, not as coefficients.
    const std::vector<glm::vec3> ours = projectLatLong(
        orientEnvironment(*scene.document.environment().image, 90.0f, 1.0f), used, JobContext());

    ASSERT_EQ(glb.root["meshes"].size(), 2u); // one mesh, but light of its own for each place
    for (std::size_t m = 0; m < 2; ++m) {
        const json& attributes = glb.root["meshes"][m]["primitives"][0]["attributes"];
        const VertexBake& bake = scene.bake.vertices[m];
        const std::size_t stride = std::size_t(bake.stride);
        for (std::size_t v = 0; v < bake.values.size() / stride; ++v)
            for (int c = 0; c < 3; ++c) {
                double expected = 0.0, found = 0.0;
                for (std::size_t i = 0; i < std::size_t(used * used); ++i) {
                    const double own = bake.values[v * stride + i];
                    const double by =
                        bounced ? bake.bounced[3 * (v * stride + i) + std::size_t(c)] : 0.0;
                    expected += ours[i][c] * (own + by);
                    const int vector = int(i) / 4 + (colored ? c * vectors : 0);
                    found += light["coefficients"][i][std::size_t(c)].get<double>() *
                             glb.vec4(attributes[fmt::format("_PRT_{}", vector)], v)[int(i) % 4];
                }
                EXPECT_NEAR(found, expected, 1e-5) << m << " " << v << " " << c;
            }
        EXPECT_FALSE(attributes.contains(fmt::format("_PRT_{}", colored ? 3 * vectors : vectors)));
    }
    EXPECT_EQ(glb.root["accessors"].size(), // positions, normals, UVs and indices are shared
              4u + 2u * extras["attributes"].get<std::size_t>());
    EXPECT_THAT(text(extras["shader"].get<std::string>().c_str()),
                HasSubstr(fmt::format("uniform vec4 prtLight[{}];", 3 * vectors)));

    // Opened again it says that its transfer is not read.
    const Result<ImportedModel> again = importModel(worker, folder / "a b.glb");
    ASSERT_TRUE(again.ok()) << again.error().text();
    EXPECT_THAT(again->warnings, testing::ElementsAre(HasSubstr("_PRT_n")));
    settings.includeTransfer = false;
    settings.output = folder / "plain.glb";
    const ExportPlan plain = planExport(scene.document, settings);
    ASSERT_TRUE(runExport(worker, plain, JobContext()).ok());
    const Result<ImportedModel> without = importModel(worker, folder / "plain.glb");
    ASSERT_TRUE(without.ok()) << without.error().text();
    EXPECT_THAT(without->warnings, testing::IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Layouts, TransferExport,
                         testing::Values(std::tuple(3, false, false, 0),
                                         std::tuple(2, true, true, 0),
                                         std::tuple(3, true, false, 0),
                                         std::tuple(4, true, true, 3)));

TEST(TransferExportFiles, ShaderMultipliesTheRightVectors) {
    const std::string grey = transferShader({3, false}, "a.glb", "a-light.json");
    EXPECT_THAT(grey, HasSubstr("in vec4 _PRT_2;\nuniform vec4 prtLight[9];"));
    EXPECT_THAT(grey, HasSubstr("dot(_PRT_1, prtLight[1]), dot(_PRT_1, prtLight[4]),\n"
                                "                dot(_PRT_1, prtLight[7])"));
    const std::string colored = transferShader({3, true}, "a.glb", "a-light.json");
    EXPECT_THAT(colored, HasSubstr("in vec4 _PRT_8;\nuniform vec4 prtLight[9];"));
    EXPECT_THAT(colored, HasSubstr("dot(_PRT_2, prtLight[2]), dot(_PRT_5, prtLight[5]),\n"
                                   "                dot(_PRT_8, prtLight[8])"));
}

TEST(TransferExportFiles, PlansSayWhatDoesNotFit) {
    Scene scene = makeScene(5, true, true);
    ExportSettings settings;
    settings.output = "scene.glb";
    EXPECT_EQ(planExport(scene.document, settings).files.size(), 1u) << "not asked for";
    settings.includeTransfer = true;
    EXPECT_THAT(planExport(scene.document, settings).warnings,
                testing::ElementsAre(HasSubstr("takes 21 vertex attributes")));
    settings.transferBands = 4;
    EXPECT_TRUE(planExport(scene.document, settings).warnings.empty());
    scene.bake.inputs.low ^= 1;
    scene.document.bakes = {std::make_shared<const BakeArtifact>(scene.bake)};
    EXPECT_THAT(planExport(scene.document, settings).warnings,
                testing::ElementsAre(HasSubstr("older than the geometry")));
    settings.includeTransfer = false;
    EXPECT_EQ(planExport(scene.document, settings).files.size(), 1u);
    EXPECT_TRUE(planExport(scene.document, settings).warnings.empty());
}
