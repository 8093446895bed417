#include "core/export/GltfExport.h"

#include "core/export/ExportContents.h"
#include "core/export/GltfEnvironment.h"
#include "core/export/GltfWriter.h"
#include "core/io/ImageIO.h"

#include <algorithm>
#include <fmt/format.h>
#include <memory>
#include <utility>

namespace patina {
namespace {

// When a file is made: whoever refers to others comes after them.
constexpr int kParts = 0, kEnvironment = 1, kBuffer = 2, kScene = 3;

Bytes bytesOf(const std::string& text) {
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

// The document as it was planned, and what has been made of it.
class GltfExport {
  public:
    GltfExport(const Document& document, const ExportSettings& settings)
        : m_document(document)
        , m_settings(settings)
        , m_contents(gatherContents(m_document, m_settings))
        , m_images(isGlb() ? m_contents.textures.textures.size() : 0) {}

    [[nodiscard]] bool isGlb() const { return m_settings.format == ExportFormat::Glb; }
    [[nodiscard]] const ExportContents& contents() const { return m_contents; }

    Result<Bytes> makeTexture(std::size_t index, WorkerClient& worker, const JobContext& job) {
        const PackedTexture& texture = m_contents.textures.textures[index];
        job.setActivity(fmt::format("packing {}", texture.name));
        const Image image = packTexture(texture, job);
        if (job.cancelled())
            return Bytes{};
        Result<Bytes> encoded = encodeImage(worker, image, texture.format);
        if (!encoded || !isGlb())
            return encoded;
        m_images[index] = std::move(*encoded);
        return Bytes{};
    }
    Result<Bytes> makeEnvironment(WorkerClient& worker, const JobContext& job) {
        Result<GltfEnvironment> encoded =
            encodeGltfEnvironment(worker, *m_contents.environment, job);
        if (!encoded)
            return encoded.error();
        m_environment = std::move(*encoded);
        return Bytes{};
    }
    Result<Bytes> makeTransferLight(const JobContext& job) const {
        return bytesOf(transferLightJson(m_document, m_contents.transferLayout, job));
    }
    [[nodiscard]] Result<Bytes> makeTransferShader() const {
        return bytesOf(
            transferShader(m_contents.transferLayout, m_settings.output.filename().string(),
                           m_contents.transferLightPath(m_settings).filename().string()));
    }
    Result<Bytes> makeBuffer(const JobContext& job) {
        job.setActivity("writing");
        Result<GltfOutput> gltf = write();
        if (!gltf)
            return gltf.error();
        m_json = std::move(gltf->json);
        return std::move(gltf->buffer);
    }
    Result<Bytes> makeScene(const JobContext& job) {
        if (!isGlb())
            return bytesOf(m_json);
        job.setActivity("writing");
        const Result<GltfOutput> gltf = write();
        if (!gltf)
            return gltf.error();
        return packGlb(*gltf);
    }

  private:
    [[nodiscard]] Result<GltfOutput> write() const {
        return writeGltf(m_contents, m_settings, m_images,
                         m_environment ? &*m_environment : nullptr);
    }

    const Document m_document;
    const ExportSettings m_settings;
    const ExportContents m_contents; // points into the document
    std::vector<Bytes> m_images;     // of a GLB, which holds them
    std::optional<GltfEnvironment> m_environment;
    std::string m_json; // of a .gltf, written with its buffer
};

// `owner` keeps what `map` points to.
PlannedFile plannedPart(const std::shared_ptr<const GltfExport>& owner,
                        const ExportContents& contents, const ExportSettings& settings,
                        const ExportedLightMap& map, std::size_t index) {
    const LightMapPartInfo& info = kLightMapParts[index];
    const int maxSide = settings.maxTextureSize;
    const int side = lightMapPartSide(info.part, maxSide > 0 ? std::min(maxSide, map.texels->side)
                                                             : map.texels->side);
    const bool four = info.part == LightMapPart::Reflections;
    return {map.paths[index],
            fmt::format("{}: {}", contents.materials[static_cast<std::size_t>(map.material)]->name,
                        info.contents),
            "linear",
            fmt::format("EXR 16-bit {0} {1} × {1}", four ? "RGBA" : "RGB", side),
            false,
            false,
            [owner, texels = map.texels, part = info.part, maxSide](WorkerClient& worker,
                                                                    const JobContext& job) {
                job.setActivity("packing the light map");
                return encodeImage(worker, lightMapPartImage(*texels, part, maxSide),
                                   ImageFileFormat::Exr, {.half = true, .jpegQuality = 0});
            },
            kParts};
}

} // namespace

ExportPlan planGltf(const Document& document, const ExportSettings& settings) {
    const auto gltf = std::make_shared<GltfExport>(document, settings);
    const ExportContents& contents = gltf->contents();
    const bool glb = gltf->isGlb();
    ExportPlan plan;
    plan.settings = settings;
    plan.warnings = contents.warnings;
    if (contents.instances.empty())
        plan.problem = {ErrorKind::Usage,
                        "there is nothing to export; make at least one mesh visible",
                        settings.output,
                        {}};

    const bool textured = !contents.textures.textures.empty();
    std::string all = textured ? "Geometry, materials and textures" : "Geometry and materials";
    std::string scene = "Scene and materials";
    if (const std::size_t count = contents.variants.size(); count > 0)
        for (std::string* text : {&all, &scene})
            *text += fmt::format(", {} variant{}", count, count == 1 ? "" : "s");
    const auto job = [gltf](auto member) -> MakeFile {
        return [gltf, member](WorkerClient&, const JobContext& of) {
            return (gltf.get()->*member)(of);
        };
    };
    plan.files.push_back({settings.output, glb ? all : scene, "", glb ? "GLB" : "glTF (JSON)",
                          false, false, job(&GltfExport::makeScene), kScene});
    if (!glb)
        plan.files.push_back({contents.buffer, "Geometry", "", "binary", false, false,
                              job(&GltfExport::makeBuffer), kBuffer});
    for (std::size_t i = 0; i < contents.textures.textures.size(); ++i) {
        const PackedTexture& texture = contents.textures.textures[i];
        plan.files.push_back({contents.texturePath(settings, texture), texture.contents,
                              texture.kind == PackKind::Color ? "sRGB" : "linear",
                              texture.formatText(), glb, false,
                              [gltf, i](WorkerClient& worker, const JobContext& of) {
                                  return gltf->makeTexture(i, worker, of);
                              },
                              kParts});
    }
    if (contents.environment != nullptr)
        plan.files.push_back(
            {contents.environmentPath(settings),
             fmt::format("Environment's light: {} levels of 6 faces, irradiance",
                         kGltfEnvironmentLevels),
             "linear", fmt::format("PNG 8-bit RGBD {0} × {0}", kGltfEnvironmentSize), true, false,
             [gltf](WorkerClient& worker, const JobContext& of) {
                 return gltf->makeEnvironment(worker, of);
             },
             kEnvironment});
    if (settings.lightMap != nullptr)
        plan.files.push_back(plannedRadiance(settings.output, settings.lightMap, kParts));
    if (contents.transfer != nullptr) {
        const TransferLayout& layout = contents.transferLayout;
        plan.files.push_back({contents.transferLightPath(settings),
                              fmt::format("Light for radiance transfer: {} bands", layout.bands),
                              "linear", "JSON", false, false, job(&GltfExport::makeTransferLight),
                              kParts});
        plan.files.push_back(
            {contents.transferShaderPath(settings),
             fmt::format("Shader for the attributes _PRT_0 to _PRT_{}", layout.attributes() - 1),
             "", "GLSL", false, false,
             [gltf](WorkerClient&, const JobContext&) { return gltf->makeTransferShader(); },
             kParts});
    }
    for (const ExportedLightMap& map : contents.lightMaps)
        for (std::size_t i = 0; i < kLightMapParts.size(); ++i)
            plan.files.push_back(plannedPart(gltf, contents, settings, map, i));
    if (!contents.lightMaps.empty())
        plan.files.push_back(
            {contents.lightMapShaderPath(settings), "Shader for the light map", "", "GLSL", false,
             false,
             [name = settings.output.filename().string()](WorkerClient&, const JobContext&) {
                 return Result<Bytes>(bytesOf(lightMapShader(name)));
             },
             kParts});
    return plan;
}

} // namespace patina
