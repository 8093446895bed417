#include "core/radiosity/document/LitFiles.h"

#include "core/base/LowerCase.h"
#include "core/io/ImageIO.h"
#include "core/radiosity/document/LitCollada.h"
#include "core/radiosity/document/PlyFile.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <span>
#include <utility>

namespace patina {
namespace {

PlannedFile plannedScene(const std::filesystem::path& output, const char* format, MakeFile make,
                         int stage) {
    std::error_code unknown;
    return {output,          "Scene", "", format, false, std::filesystem::exists(output, unknown),
            std::move(make), stage};
}

Result<ExportPlan> planCollada(const LitDocument& lit, const Document& source,
                               const LitFilesSettings& settings) {
    const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
    Result<LitCollada> collada = Error{};
    if (settings.document.empty()) {
        collada = newLitCollada(lit, settings.camera, now, settings.output);
    } else {
        Result<ColladaDocument> document = ColladaDocument::read(settings.document);
        if (!document)
            return document.error();
        if (Result<void> taken = document->takeScene(settings.visualScene); !taken)
            return taken.error();
        collada = lightCollada(*std::move(document), source, lit, now, settings.output);
    }
    if (!collada)
        return collada.error();
    ExportPlan plan;
    plan.settings.output = settings.output;
    plan.warnings = std::move(collada->notices);
    const auto text = std::make_shared<const std::string>(collada->document.text());
    plan.files.push_back(plannedScene(
        settings.output, "COLLADA",
        [text](WorkerClient&, const JobContext&) -> Result<Bytes> {
            const auto bytes = std::as_bytes(std::span(*text));
            return Bytes(bytes.begin(), bytes.end());
        },
        1));
    if (lit.lightMap != nullptr) {
        plan.files.push_back(plannedRadiance(settings.output, lit.lightMap, 0));
        plan.files.push_back({lightMapPath(settings.output, ".png"), "Light map", "sRGB",
                              "PNG 8-bit RGB", false, false,
                              [map = lit.lightMap](WorkerClient& worker, const JobContext&) {
                                  return encodeImage(worker, *map->shown, ImageFileFormat::Png);
                              },
                              0});
    }
    return plan;
}

Result<ExportPlan> planPly(const LitDocument& lit, const LitFilesSettings& settings) {
    if (lit.lightMap != nullptr)
        return Error{ErrorKind::Usage,
                     "PLY has no textures; write a light map into a .dae, .glb or .gltf",
                     settings.output,
                     {}};
    ExportPlan plan;
    plan.settings.output = settings.output;
    const auto bytes = std::make_shared<const Bytes>(litPly(lit));
    plan.files.push_back(plannedScene(
        settings.output, "PLY",
        [bytes](WorkerClient&, const JobContext&) -> Result<Bytes> { return *bytes; }, 0));
    return plan;
}

} // namespace

Result<ExportPlan> planLitFiles(const LitDocument& lit, const Document& source,
                                const LitFilesSettings& settings) {
    const std::string extension = lowerCase(settings.output.extension().string());
    if (extension == ".dae")
        return planCollada(lit, source, settings);
    if (extension == ".ply")
        return planPly(lit, settings);
    const Result<ExportFormat> format = exportFormatOf(settings.output);
    if (!format)
        return Error{ErrorKind::Usage,
                     "radiosity is written to .dae, .glb, .gltf or .ply",
                     settings.output,
                     {}};
    ExportSettings files;
    files.output = settings.output;
    files.format = *format;
    files.lit = lit.lit;
    files.lightMap = lit.lightMap;
    files.includeLights = files.includeVariants = files.includeBakedAo = files.includeTransfer =
        files.includeLightMap = false;
    ExportPlan plan = planExport(lit.document, files);
    if (plan.problem)
        return *plan.problem;
    return plan;
}

} // namespace patina
