// What is planned is what is written, and what was written is read back the same.
#include "ExportScene.h"
#include "core/io/ImageIO.h"
#include "core/io/MeshImport.h"
#include "core/light/Light.h"
#include "core/light/Lights.h"
#include "core/material/Material.h"
#include "core/material/MaterialInputs.h"
#include "core/scene/ModelConversion.h"
#include "core/scene/Scene.h"
#include "core/worker/WorkerClient.h"

#include "tests/support/TemporaryFolder.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <gmock/gmock.h>
#include <set>

using namespace patina;
using namespace patina::test;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

namespace fs = std::filesystem;

namespace {

class ExportRun : public testing::Test {
  protected:
    ExportRun() {
        Material& paint = addMaterial(m_document, "Paint");
        paint.baseColor = {0.5f, 0.25f, 0.75f};
        paint.metallic = 0.5f;
        paint.perceptualRoughness = 0.25f;
        paint.baseColorMap = map(codes(8, 4, 3, {200, 100, 50, 10}, ColorEncoding::Srgb));
        paint.perceptualRoughnessMap = map(codes(4, 4, 1, {40, 80, 120}));
        paint.metallicMap = map(codes(8, 8, 1, {255, 0}));
        paint.normalMap = map(codes(4, 4, 3, {128, 128, 255}));
        paint.normalMap.uvScale = {2, 3};
        paint.occlusionMap = map(codes(4, 4, 1, {90}));
        const Id first = paint.id;
        Material& lamp = addMaterial(m_document, "Lamp");
        lamp.emissive = {1, 0.5f, 0.25f};
        lamp.emissiveStrength = 4;
        lamp.emissiveMap = map(codes(2, 2, 3, {255, 128, 0}, ColorEncoding::Srgb));
        lamp.doubleSided = true;
        addSquare(m_document, first).placement =
            glm::translate(glm::mat4(1.0f), {0.5f, 0.25f, -2.0f});
        addSquare(m_document, lamp.id, squareMesh("lamp"));
    }
    ExportSettings settings(const std::string& name) const {
        ExportSettings result;
        result.output = m_folder / name;
        result.format =
            result.output.extension() == ".glb" ? ExportFormat::Glb : ExportFormat::Gltf;
        return result;
    }
    std::set<fs::path> folderContents() const {
        std::set<fs::path> result;
        for (const auto& entry : fs::directory_iterator(m_folder.path()))
            result.insert(entry.path());
        return result;
    }
    std::string formatOf(const Image& image, const char* type) const {
        return fmt::format("{} {}-bit {} {} × {}", type, image.type() == PixelType::U16 ? 16 : 8,
                           image.channels() == 1   ? "grey"
                           : image.channels() == 3 ? "RGB"
                                                   : "RGBA",
                           image.width(), image.height());
    }

    const TemporaryFolder m_folder;
    Document m_document;
    WorkerClient m_worker;
};

} // namespace

TEST_F(ExportRun, TheFolderHoldsWhatThePlanSays) {
    const ExportPlan plan = planExport(m_document, settings("scene.gltf"));
    const Result<std::vector<fs::path>> written = runExport(m_worker, plan, JobContext());
    ASSERT_TRUE(written.ok()) << written.error().text();

    std::set<fs::path> planned;
    for (const PlannedFile& file : plan.files) {
        EXPECT_FALSE(file.embedded);
        EXPECT_FALSE(file.overwrites);
        planned.insert(file.path);
        if (file.path.extension() != ".png")
            continue;
        const Result<LoadedImage> image = loadImage(m_worker, file.path);
        ASSERT_TRUE(image.ok()) << image.error().text();
        EXPECT_EQ(formatOf(image->image(), "PNG"), file.format) << file.path;
    }
    EXPECT_EQ(planned.size(), plan.files.size());
    EXPECT_EQ(folderContents(), planned);
    EXPECT_EQ(std::set<fs::path>(written->begin(), written->end()), planned);
    EXPECT_EQ(written->back(), m_folder / "scene.gltf"); // what refers to the others comes last

    for (const PlannedFile& file : planExport(m_document, settings("scene.gltf")).files)
        EXPECT_TRUE(file.overwrites) << file.path;
}

TEST_F(ExportRun, TheGlbHoldsWhatThePlanSays) {
    ExportSettings glb = settings("scene.glb");
    glb.textures = ExportTextureFormat::Jpeg;
    const ExportPlan plan = planExport(m_document, glb);
    ASSERT_TRUE(runExport(m_worker, plan, JobContext()).ok());
    EXPECT_EQ(folderContents(), std::set<fs::path>{m_folder / "scene.glb"});

    const Result<Bytes> bytes = readFile(m_folder / "scene.glb", 1 << 20);
    ASSERT_TRUE(bytes.ok());
    std::uint32_t jsonSize = 0;
    std::memcpy(&jsonSize, bytes->data() + 12, 4);
    const char* text = reinterpret_cast<const char*>(bytes->data()) + 20;
    Json json = Json::parse(text, text + jsonSize);
    ASSERT_EQ(json["images"].size() + 1, plan.files.size());
    for (std::size_t i = 0; i < json["images"].size(); ++i) {
        Json& image = json["images"][i];
        Json& view = json["bufferViews"][image["bufferView"].get<std::size_t>()];
        const bool jpeg = image["mimeType"] == "image/jpeg";
        const PlannedFile& file = plan.files[i + 1];
        EXPECT_TRUE(file.embedded);
        EXPECT_FALSE(file.overwrites);
        EXPECT_EQ(file.path.string(),
                  fmt::format("{}#{}{}", (m_folder / "scene.glb").string(),
                              image["name"].get<std::string>(), jpeg ? ".jpg" : ".png"));
        const Result<LoadedImage> loaded = loadImageFromMemory(
            m_worker,
            std::span(*bytes).subspan(28 + jsonSize + view["byteOffset"].get<std::size_t>(),
                                      view["byteLength"].get<std::size_t>()),
            "image");
        ASSERT_TRUE(loaded.ok()) << loaded.error().text();
        EXPECT_EQ(formatOf(loaded->image(), jpeg ? "JPEG" : "PNG"), file.format);
    }
}

TEST_F(ExportRun, ReadBackItIsTheSameScene) {
    for (const char* name : {"scene.glb", "scene.gltf"}) {
        const ExportPlan plan = planExport(m_document, settings(name));
        ASSERT_TRUE(runExport(m_worker, plan, JobContext()).ok());
        const Result<ImportedModel> model = importModel(m_worker, m_folder / name);
        ASSERT_TRUE(model.ok()) << model.error().text();
        EXPECT_THAT(model->missingTextures, IsEmpty());
        ASSERT_EQ(model->instances.size(), 2u);
        const ImportedInstance& square = model->instances[0];
        EXPECT_EQ(square.name, "square");
        EXPECT_EQ(square.transform, m_document.meshes[0].placement.matrix());
        const Mesh& mesh = *model->meshes[static_cast<std::size_t>(square.mesh)];
        EXPECT_EQ(mesh.positions, squareMesh()->positions);
        EXPECT_EQ(mesh.normals, squareMesh()->normals);
        EXPECT_EQ(mesh.tangents, squareMesh()->tangents);
        EXPECT_EQ(mesh.uvs, squareMesh()->uvs);
        EXPECT_EQ(mesh.indices, squareMesh()->indices);

        const ImportedMaterial& paint = model->materials[static_cast<std::size_t>(square.material)];
        EXPECT_EQ(paint.name, "Paint");
        EXPECT_EQ(paint.baseColor, glm::vec4(0.5f, 0.25f, 0.75f, 1.0f));
        EXPECT_EQ(paint.numbers[MaterialInput::Metallic], 0.5f);
        EXPECT_EQ(paint.numbers[MaterialInput::PerceptualRoughness], 0.25f);
        for (const MaterialInputInfo& info : kMaterialInputs) {
            const bool sent = (m_document.materials[0].*info.map).image != nullptr;
            ASSERT_EQ(paint.maps[info.input].has_value(), sent) << info.id;
            if (sent) {
                EXPECT_EQ(paint.maps[info.input]->channel, info.gltf.channel) << info.id;
            }
        }
        EXPECT_EQ(paint.maps[MaterialInput::Normal]->uvScale, glm::vec2(2, 3));
        const ImportedMaterial& lamp =
            model->materials[static_cast<std::size_t>(model->instances[1].material)];
        EXPECT_NEAR(lamp.emissive.r, 4.0f, 1e-5f);
        EXPECT_NEAR(lamp.emissive.b, 1.0f, 1e-5f);
        EXPECT_TRUE(lamp.doubleSided);
    }
}

// One texel for each input, another code in each, and no two numbers alike.
TEST_F(ExportRun, EveryInputOfAMaterialIsReadBack) {
    Document document;
    Material& out = addMaterial(document, "All");
    const auto code = [](const MaterialInputInfo& info) {
        return 60 + 20 * static_cast<int>(info.input);
    };
    const auto number = [](const MaterialInputInfo& info) {
        return 0.25f + 0.0625f * static_cast<float>(info.input);
    };
    for (const MaterialInputInfo& info : kMaterialInputs) {
        out.*info.map = map(codes(1, 1, 3, {code(info)}, info.encoding), info.channel);
        (out.*info.map).uvOffset.x = 0.125f * static_cast<float>(info.input);
        if (info.color != nullptr)
            out.*info.color = glm::vec3(number(info));
        else
            out.*info.number = number(info);
    }
    out.metallicMap.uvOffset = out.perceptualRoughnessMap.uvOffset; // of one image
    addSquare(document, out.id);
    const Material sent = out;

    for (const char* name : {"inputs.glb", "inputs.gltf"}) {
        ASSERT_TRUE(runExport(m_worker, planExport(document, settings(name)), JobContext()).ok());
        const Result<OpenedScene> opened = openScene(m_worker, m_folder / name);
        ASSERT_TRUE(opened.ok()) << opened.error().text();
        ASSERT_EQ(opened->document.materials.size(), 1u);
        const Material& back = opened->document.materials[0];
        for (const MaterialInputInfo& info : kMaterialInputs) {
            const MapSlot& read = back.*info.map;
            ASSERT_TRUE(read.image) << name << ' ' << info.id << read.problem;
            EXPECT_EQ(read.image->encoding(), info.encoding) << info.id;
            EXPECT_EQ(read.uvOffset, (sent.*info.map).uvOffset) << info.id;
            const int channel =
                read.channel == MapChannel::Rgb
                    ? 0
                    : static_cast<int>(read.channel) - static_cast<int>(MapChannel::R);
            const int stored = static_cast<int>(std::lround(
                read.image->sample(0, 0, std::min(channel, read.image->channels() - 1)) * 255.0f));
            EXPECT_EQ(stored, code(info)) << name << ' ' << info.id;
            if (info.number != nullptr)
                EXPECT_FLOAT_EQ(back.*info.number, number(info)) << name << ' ' << info.id;
            else // the brightest channel of a colour may have gone into its strength
                EXPECT_NEAR((back.*info.color).x * (info.input == MaterialInput::Emissive
                                                        ? back.emissiveStrength
                                                        : 1.0f),
                            number(info), 1e-6f)
                    << name << ' ' << info.id;
        }
    }
}

TEST_F(ExportRun, GlassIsReadBack) {
    Document document;
    Material& pane = addMaterial(document, "Pane");
    pane.transmission = 1.0f;
    const Id paneId = pane.id;
    Material& juice = addMaterial(document, "Juice");
    juice.transmission = 0.5f;
    juice.ior = 1.25f;
    juice.thinWalled = false;
    juice.attenuationColor = {0.5f, 0.25f, 0.125f};
    juice.attenuationDistance = 0.75f;
    const Id juiceId = juice.id;
    const Id plain = addMaterial(document, "Plain").id;
    for (const Id id : {paneId, juiceId, plain})
        addSquare(document, id);
    ASSERT_TRUE(runExport(m_worker, planExport(document, settings("g.gltf")), JobContext()).ok());
    const Result<OpenedScene> opened = openScene(m_worker, m_folder / "g.gltf");
    ASSERT_TRUE(opened.ok()) << opened.error().text();
    ASSERT_EQ(opened->document.materials.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        const Material &out = document.materials[i], &back = opened->document.materials[i];
        EXPECT_EQ(back.transmission, out.transmission) << out.name;
        EXPECT_EQ(back.ior, out.ior) << out.name;
        EXPECT_EQ(back.thinWalled, out.thinWalled) << out.name;
        EXPECT_EQ(back.attenuationColor, out.attenuationColor) << out.name;
        EXPECT_EQ(back.attenuationDistance, out.attenuationDistance) << out.name;
    }
    const Result<Bytes> bytes = readFile(m_folder / "g.gltf", 1 << 20);
    ASSERT_TRUE(bytes.ok());
    const char* text = reinterpret_cast<const char*>(bytes->data());
    const Json json = Json::parse(text, text + bytes->size());
    // A material that needs none of them names none.
    EXPECT_FALSE(json["materials"][2].contains("extensions"));
    EXPECT_GT(json["materials"][1]["extensions"]["KHR_materials_volume"]["thicknessFactor"], 0.0f);
}

TEST_F(ExportRun, ACancelLeavesNothing) {
    for (const char* name : {"scene.glb", "scene.gltf"}) {
        JobControl control;
        control.cancel();
        const Result<std::vector<fs::path>> written =
            runExport(m_worker, planExport(m_document, settings(name)), control.context());
        ASSERT_FALSE(written.ok());
        EXPECT_EQ(written.error().kind, ErrorKind::Cancelled);
        EXPECT_THAT(folderContents(), IsEmpty());
    }
}

TEST_F(ExportRun, AFailureTakesItsNewFilesAway) {
    fs::create_directory(m_folder / "scene.bin"); // the geometry cannot be written
    const ExportPlan plan = planExport(m_document, settings("scene.gltf"));
    const Result<std::vector<fs::path>> written = runExport(m_worker, plan, JobContext());
    ASSERT_FALSE(written.ok());
    EXPECT_EQ(written.error().kind, ErrorKind::CannotCreate);
    EXPECT_EQ(folderContents(), std::set<fs::path>{m_folder / "scene.bin"});
}

TEST_F(ExportRun, EditsAfterThePlanAreNotExported) {
    const auto exported = [&](const ExportPlan& plan) {
        EXPECT_TRUE(runExport(m_worker, plan, JobContext()).ok());
        return *readFile(m_folder / "scene.glb", 1 << 20);
    };
    const ExportPlan plan = planExport(m_document, settings("scene.glb"));
    const Bytes before = exported(plan);
    m_document.materials[0].normalMap = {};
    m_document.meshes.pop_back();
    EXPECT_EQ(exported(plan), before);
    EXPECT_NE(exported(planExport(m_document, settings("scene.glb"))), before);
}

// Of the table of formats: each is found by its extension, and writes what it plans.
TEST_F(ExportRun, EveryFormatWritesWhatItPlans) {
    std::set<std::string> extensions;
    for (const ExportFormatInfo& info : exportFormats()) {
        SCOPED_TRACE(info.extension);
        EXPECT_TRUE(extensions.insert(info.extension).second);
        ExportSettings of = settings("every." + std::string(info.extension));
        EXPECT_EQ(*exportFormatOf(of.output), info.format);
        of.format = info.format;
        const ExportPlan plan = planExport(m_document, of);
        EXPECT_FALSE(plan.problem.has_value());
        const Result<std::vector<fs::path>> written = runExport(m_worker, plan, JobContext());
        ASSERT_TRUE(written.ok()) << written.error().text();
        EXPECT_THAT(*written, testing::Contains(of.output));
        for (const PlannedFile& file : plan.files) {
            EXPECT_FALSE(file.contents.empty() || file.format.empty()) << file.path;
            if (!file.embedded) {
                EXPECT_GT(fs::file_size(file.path), 0u) << file.path;
            }
        }
    }
}

TEST_F(ExportRun, TheExtensionDecidesTheFormat) {
    EXPECT_EQ(*exportFormatOf("a/scene.GLB"), ExportFormat::Glb);
    EXPECT_EQ(*exportFormatOf("scene.v2.gltf"), ExportFormat::Gltf);
    const Result<ExportFormat> unknown = exportFormatOf("scene.usd");
    ASSERT_FALSE(unknown.ok());
    EXPECT_EQ(unknown.error().kind, ErrorKind::Usage);
    EXPECT_THAT(unknown.error().message, HasSubstr(".glb or .gltf"));
}

TEST_F(ExportRun, HiddenMeshesStayBehind) {
    m_document.meshes[0].visible = false;
    ExportSettings visible = settings("scene.glb");
    EXPECT_EQ(planExport(m_document, visible).files.size(), 2u); // the lamp and its one texture
    visible.visibleOnly = false;
    EXPECT_GT(planExport(m_document, visible).files.size(), 2u);
    m_document.meshes[1].visible = false;
    const Result<std::vector<fs::path>> nothing =
        runExport(m_worker, planExport(m_document, settings("scene.glb")), JobContext());
    ASSERT_FALSE(nothing.ok());
    EXPECT_EQ(nothing.error().kind, ErrorKind::Usage);
}

TEST_F(ExportRun, SaysThatTheShadingModelStaysBehind) {
    m_document.model.ior = 1.3f; // unused by the default
    const std::size_t before = planExport(m_document, settings("scene.glb")).warnings.size();
    m_document.model.diffuse = Diffuse::Eon;
    const auto warnings = planExport(m_document, settings("scene.glb")).warnings;
    ASSERT_EQ(warnings.size(), before + 1);
    EXPECT_THAT(warnings, testing::Contains(HasSubstr("shading model")));
}

TEST_F(ExportRun, ThePlanTellsWhatIsLost) {
    BakeArtifact prt, stale;
    prt.kind = BakeKind::PrtTexel;
    stale.kind = BakeKind::AoTexel;
    stale.inputs = {1, 2};
    stale.texels.push_back({m_document.materials[0].id, codes(2, 2, 1, {9})});
    m_document.bakes = {std::make_shared<const BakeArtifact>(prt),
                        std::make_shared<const BakeArtifact>(stale)};
    ExportSettings all = settings("scene.glb");
    all.includeTransfer = true;
    EXPECT_THAT(planExport(m_document, all).warnings,
                ElementsAre(HasSubstr("radiance transfer per texel"),
                            HasSubstr("older than the geometry")));
}

TEST_F(ExportRun, PunctualLightsComeBackAsTheyWent) {
    Light sun, lamp, spot, area;
    sun.name = "Sun";
    sun.azimuthDeg = 70.0f;
    sun.elevationDeg = 25.0f;
    sun.color = {1.0f, 0.5f, 0.25f};
    lamp.name = "Lamp";
    lamp.type = LightType::Point;
    lamp.position = {1, 2, -3};
    lamp.range = 6.0f;
    lamp.intensity = 12.0f;
    spot = lamp;
    spot.name = "Spot";
    spot.type = LightType::Spot;
    spot.azimuthDeg = -110.0f;
    spot.elevationDeg = -15.0f;
    spot.range = 0.0f;
    spot.innerConeDeg = 12.0f;
    spot.outerConeDeg = 33.0f;
    spot.usesTemperature = true;
    spot.temperatureK = 3000.0f;
    area.name = "Panel";
    area.type = LightType::Rectangle;
    m_document.lights = {sun, lamp, spot, area};
    m_document.lights[0].solo = true; // a matter of looking, not of the scene

    const ExportPlan plan = planExport(m_document, settings("lights.glb"));
    EXPECT_THAT(plan.warnings, ElementsAre(HasSubstr("no area lights: \"Panel\" is left out")));
    ASSERT_TRUE(runExport(m_worker, plan, JobContext()).ok());
    Result<ImportedModel> model = importModel(m_worker, m_folder / "lights.glb");
    ASSERT_TRUE(model.ok()) << model.error().text();
    const std::vector<Light> lights = convertModel(std::move(*model), "lights.glb").lights;
    ASSERT_EQ(lights.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        const Light& before = m_document.lights[i];
        const Light& after = lights[i];
        EXPECT_EQ(after.name, before.name);
        EXPECT_EQ(after.type, before.type);
        const glm::vec3 power = lightColor(before) * before.intensity;
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(lightColor(after)[c] * after.intensity, power[c], 1e-4f * before.intensity);
        if (hasPosition(before.type)) {
            EXPECT_EQ(after.position, before.position);
            EXPECT_EQ(after.range, before.range);
        }
        if (hasDirection(before.type)) {
            EXPECT_NEAR(after.azimuthDeg, before.azimuthDeg, 1e-3f);
            EXPECT_NEAR(after.elevationDeg, before.elevationDeg, 1e-3f);
        }
    }
    EXPECT_NEAR(lights[2].innerConeDeg, 12.0f, 1e-4f);
    EXPECT_NEAR(lights[2].outerConeDeg, 33.0f, 1e-4f);
}
