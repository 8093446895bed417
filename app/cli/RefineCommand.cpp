// patina refine: a model with finer triangles where its shadows need them.
#include "app/cli/Commands.h"
#include "app/cli/SceneSetup.h"
#include "core/bake/TransferRefinement.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/export/Export.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <system_error>

namespace patina::cli {

Result<void> run(Session& session, const RefineOptions& options) {
    ExportSettings target;
    target.output = options.output;
    const Result<ExportFormat> format = exportFormatOf(target.output);
    if (!format)
        return format.error();
    if (Result<void> output = checkOutput(target.output); !output)
        return output;
    target.format = *format;
    target.visibleOnly = false;

    Report& report = session.report();
    report.json()["settings"] = {{"scene", options.scene},   {"tolerance", options.tolerance},
                                 {"rounds", options.rounds}, {"maxTriangles", options.maxTriangles},
                                 {"order", options.order},   {"samples", options.samples},
                                 {"seed", options.seed}};
    session.beginPhase();
    SceneRequest request;
    request.scene = options.scene;
    Result<Document> document = openSceneFor(session, request);
    if (!document)
        return document.error();

    RefinementSettings settings;
    settings.tolerance = options.tolerance;
    settings.rounds = options.rounds;
    settings.maxTriangles = options.maxTriangles;
    settings.bake.order = options.order;
    settings.bake.samples = options.samples;
    settings.bake.seed = options.seed;
    const BakeInputs inputs = bakeInputs(*document);
    const std::size_t before = document->triangleCount();
    session.beginPhase();
    const Result<RefinedMeshes> refined = refineForTransfer(inputs, settings, session.job());
    if (!refined)
        return refined.error();
    for (std::size_t i = 0; i < inputs.meshes.size(); ++i)
        for (MeshInstance& mesh : document->meshes)
            if (mesh.id == inputs.meshes[i].id)
                mesh.mesh = refined->meshes[i];

    session.beginPhase();
    const ExportPlan plan = planExport(*document, target);
    for (const std::string& warning : plan.warnings)
        report.warn(warning);
    Result<std::vector<std::filesystem::path>> written =
        runExport(session.worker(), plan, session.job());
    if (!written)
        return written.error();
    for (const std::filesystem::path& file : *written) {
        std::error_code unknown;
        const std::uintmax_t size = std::filesystem::file_size(file, unknown);
        report.output(file, unknown ? "" : bytesText(size));
    }
    if (refined->rounds == 0 && refined->tooCoarse == 0)
        report.warn(fmt::format("nothing was split: no triangle's error is above the tolerance of "
                                "{}; finer shadows take a smaller --tolerance, and more --samples "
                                "so that it is above their noise",
                                options.tolerance));
    if (refined->tooCoarse > 0)
        report.warn(fmt::format("{} triangles are still above the tolerance; allow more rounds or "
                                "triangles, or bake per texel",
                                refined->tooCoarse));
    report.json()["counts"] = {{"trianglesBefore", before},
                               {"triangles", document->triangleCount()},
                               {"rounds", refined->rounds},
                               {"tooCoarse", refined->tooCoarse}};
    report.json()["error"] = {{"before", refined->errorBefore}, {"after", refined->errorAfter}};
    report.table({}, {{"triangles", fmt::format("{} -> {}", before, document->triangleCount())},
                      {"error", fmt::format("{:.5f} -> {:.5f} in {} rounds", refined->errorBefore,
                                            refined->errorAfter, refined->rounds)}});
    return {};
}

} // namespace patina::cli
