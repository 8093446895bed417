#include "app/cli/Commands.h"
#include "app/cli/SceneSetup.h"
#include "core/bake/domain/BakeArtifact.h"
#include "core/edit/Edit.h"
#include "core/export/Export.h"
#include "core/material/Material.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <system_error>

namespace patina::cli {
namespace {

void describe(Report& report, const ExportPlan& plan, bool dryRun) {
    nlohmann::ordered_json files = nlohmann::ordered_json::array();
    std::vector<std::pair<std::string, std::string>> rows;
    for (const PlannedFile& file : plan.files) {
        files.push_back({{"path", file.path.string()},
                         {"contents", file.contents},
                         {"colorSpace", file.colorSpace},
                         {"format", file.format},
                         {"embedded", file.embedded},
                         {"overwrites", file.overwrites}});
        rows.emplace_back(file.path.filename().string(),
                          fmt::format("{}, {}{}{}", file.contents, file.format,
                                      file.colorSpace.empty() ? "" : ", " + file.colorSpace,
                                      file.overwrites && dryRun ? " (overwrites)" : ""));
    }
    report.json()["files"] = std::move(files);
    report.table({}, rows);
}

} // namespace

Result<void> run(Session& session, const ExportOptions& options) {
    ExportSettings settings;
    settings.output = options.output;
    const Result<ExportFormat> format = exportFormatOf(settings.output);
    if (!format)
        return format.error();
    if (Result<void> output = checkOutput(settings.output); !output)
        return output;
    settings.format = *format;
    settings.textures = options.jpeg ? ExportTextureFormat::Jpeg : ExportTextureFormat::Png;
    settings.maxTextureSize = options.textureSize;
    settings.includeBakedAo = !options.noBakedAo;
    settings.includeTransfer = options.transfer || options.transferBands > 0;
    settings.transferBands = options.transferBands;
    settings.includeLightMap = !options.noLightMap;
    settings.includeLights = !options.noLights;
    settings.includeVariants = !options.noVariants;
    settings.visibleOnly = !options.hidden;
    settings.includeEnvironment = options.environmentLight || !options.environment.empty();

    Report& report = session.report();
    report.json()["settings"] = {{"scene", options.scene},
                                 {"textures", options.jpeg ? "jpg" : "png"},
                                 {"textureSize", options.textureSize},
                                 {"bakedAo", settings.includeBakedAo},
                                 {"transfer", settings.includeTransfer},
                                 {"transferBands", settings.transferBands},
                                 {"lightMap", settings.includeLightMap},
                                 {"lights", settings.includeLights},
                                 {"variants", settings.includeVariants},
                                 {"hidden", options.hidden},
                                 {"environmentLight", settings.includeEnvironment}};
    session.beginPhase();
    SceneRequest request{options.scene, options.environment, options.environmentLayout,
                         options.bakes};
    Result<Document> document = openSceneFor(session, request);
    if (!document)
        return document.error();

    if (!settings.includeTransfer && findBake(*document, BakeKind::PrtVertex))
        report.warn("the bake of radiance transfer is left out, as few programs read it; "
                    "--transfer takes it along");
    const ExportPlan plan = planExport(*document, settings);
    for (const std::string& warning : plan.warnings)
        report.warn(warning);
    if (plan.problem)
        return *plan.problem;
    if (!options.dryRun) {
        session.beginPhase();
        Result<std::vector<std::filesystem::path>> written =
            runExport(session.worker(), plan, session.job());
        if (!written)
            return written.error();
        for (const std::filesystem::path& file : *written) {
            std::error_code unknown;
            const std::uintmax_t size = std::filesystem::file_size(file, unknown);
            report.output(file, unknown ? "" : bytesText(size));
        }
    }
    report.json()["counts"] = {{"meshes", document->meshes.size()},
                               {"materials", document->materials.size()},
                               {"triangles", document->triangleCount()}};
    describe(report, plan, options.dryRun);
    return {};
}

} // namespace patina::cli
