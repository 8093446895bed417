#include "app/cli/BakeRun.h"

#include "app/cli/BakeOutput.h"
#include "app/cli/LightMapRun.h"
#include "app/cli/LongBake.h"
#include "app/cli/LongRun.h"
#include "app/cli/OcclusionRun.h"
#include "app/cli/Report.h"
#include "app/cli/SceneSetup.h"
#include "core/bake/Bake.h"
#include "core/bake/BakeMemory.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/bake/domain/BakeOptions.h"
#include "core/bake/file/BakeFileSize.h"
#include "core/bake/transfer/ResumableTracer.h"
#include "core/base/DiskSpace.h"
#include "core/base/FileLock.h"
#include "core/base/LowerCase.h"
#include "core/base/PrintableText.h"
#include "core/base/ProcessMemory.h"
#include "core/mesh/UvUnwrap.h"
#include "core/scene/Scene.h"

#include <filesystem>
#include <fmt/format.h>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <unistd.h>

namespace patina::cli {
namespace {

namespace fs = std::filesystem;

// What the options of a long bake come to.
struct Plan : LongRun {
    PassShard shard;
    bool part = false;           // writes a part, not the bake
    std::uint64_t maxMemory = 0; // bytes; 0: no limit is known
};

Result<Plan> planBake(const CommonOptions& common, const std::string& output,
                      const LongBakeOptions& options, const BakeRequest& request) {
    const Result<LongRun> run = planLongRun(output, options);
    if (!run)
        return run.error();
    Plan plan{*run, {}, false, 0};
    plan.maxMemory = availableMemory();
    if (!options.maxMemory.empty()) {
        const Result<std::uint64_t> bytes = parseSize("--max-memory", options.maxMemory);
        if (!bytes)
            return bytes.error();
        plan.maxMemory = *bytes;
    }
    if (options.shard.empty())
        return plan;
    const Result<PassShard> shard = parseShard(options.shard, environmentVariable);
    if (!shard)
        return shard.error();
    plan.shard = *shard;
    plan.part = true;
    if (common.keepPartial)
        return usageError("--keep-partial is for whole bakes; a part that is stopped goes on with "
                          "--checkpoint and --resume");
    if (holdsTransfer(request.kind) && request.prt.transfer == TransferKind::Unshadowed)
        return usageError(
            "unshadowed transfer needs no rays, so there is nothing to split; bake it "
            "without --shard");
    if (holdsTransfer(request.kind) && request.prt.tolerance > 0.0f)
        return usageError(
            "--tolerance looks at the whole surface, of which a part sees little; give "
            "the parts --samples instead");
    return plan;
}

// `light`: of a light map, else null.
BakeManifest manifestOf(const Session& session, const SceneBake& bake, const BakeInputs& inputs,
                        const LightMapInputs* light, const PassShard& shard) {
    const BakeRequest& request = bake.request;
    BakeManifest manifest;
    manifest.kind = request.kind;
    manifest.settings = settingsText(request);
    manifest.inputs = hashBakeInputs(inputs);
    if (holdsTransfer(request.kind) && request.prt.transfer == TransferKind::Interreflected)
        manifest.albedo = hashBakeAlbedo(inputs);
    if (light != nullptr) {
        manifest.light = hashLightMapLight(light->scene);
        if (!bake.environment.empty())
            manifest.environment = environmentFromAnywhere(bake.environment);
        manifest.environmentLayout = bake.environmentLayout;
    }
    manifest.scene = absoluteSource(bake.scene);
    manifest.storage = bake.storage;
    manifest.sets = session.options().sets;
    manifest.shard = shard;
    return manifest;
}

void warnAboutOverlaps(Session& session, const Document& document) {
    std::map<const Mesh*, bool> overlaps; // many objects may be copies of one mesh
    const auto overlap = [&](const MeshInstance& mesh) {
        const auto [known, isNew] = overlaps.try_emplace(mesh.mesh.get());
        if (isNew)
            known->second = hasOverlappingUvs(*mesh.mesh);
        return known->second;
    };
    for (const MeshInstance& mesh : document.meshes)
        if (mesh.visible && mesh.mesh != nullptr && overlap(mesh))
            session.report().warn(fmt::format(
                "{}: its texture coordinates overlap, so that places share a texel; bake with "
                "--target vertex, or unwrap the mesh",
                mesh.name));
}

// What cannot be written is refused before the first ray; what can is said.
Result<void> checkOutputSize(Session& session, const BakeRequest& request, const BakeInputs& inputs,
                             const Plan& plan, const std::string& output,
                             const BakeFileOptions& storage) {
    if (plan.part) // whose state is about as large as the memory it takes, and says so itself
        return {};
    const bool pictures = extensionOf(output) == ".png";
    if (!pictures)
        if (Result<void> fits = checkBakeFile(request, inputs); !fits)
            return fits;
    const std::uint64_t bytes =
        pictures ? bakePictureBytes(request, inputs) : bakeFileBytes(request, inputs, storage);
    session.report().json()["plan"] = {{"memoryBytes", estimateBake(request, inputs).bytes},
                                       {"outputBytes", bytes}};
    return checkDiskSpace(output, bytes, pictures ? 0 : bytes);
}

// A result that cannot be written where it was wanted is not lost: a user at a terminal is asked
// for another place, else it goes into the folder for temporary files.
Result<void> rescueBake(Session& session, const Document& document, const BakeArtifact& artifact,
                        const std::string& output, const BakeFileOptions& storage, Error error) {
    if (error.kind != ErrorKind::Io && error.kind != ErrorKind::CannotCreate)
        return error;
    const CommonOptions& common = session.options();
    if (!common.quiet && !common.json && ::isatty(STDIN_FILENO) == 1 &&
        ::isatty(STDERR_FILENO) == 1) {
        session.endProgress();
        for (std::string place; !session.interrupted();) {
            fmt::print(stderr, "patina: {}\nAnother place for the bake (empty: none): ",
                       printableText(error.text()));
            if (!std::getline(std::cin, place) || place.empty())
                return error;
            Result<void> written = checkBakeOutput(place, artifact.kind);
            if (written)
                written = writeBake(session, document, artifact, place, storage);
            if (written)
                return written;
            error = written.error();
        }
        return error;
    }
    std::error_code none;
    const fs::path folder = fs::temp_directory_path(none);
    const fs::path kept =
        folder / fmt::format("patina-{}-{}", ::getpid(), fs::path(output).filename().string());
    if (none || !writeBake(session, document, artifact, kept, storage))
        return error;
    error.message += fmt::format("; the bake is kept in {}", kept.string());
    return error;
}

} // namespace

void reportBake(Session& session, const BakeInputs& inputs, const BakeArtifact& artifact) {
    std::size_t triangles = 0, vertices = 0, texels = 0;
    for (const BakeMesh& mesh : inputs.meshes) {
        triangles += mesh.mesh->triangleCount();
        vertices += mesh.mesh->vertexCount();
    }
    for (const TexelBake& texel : artifact.texels) {
        const int width = texel.image ? texel.image->width() : texel.side;
        const int height = texel.image ? texel.image->height() : texel.side;
        texels += static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }
    nlohmann::ordered_json& json = session.report().json();
    json["counts"] = {{"meshes", inputs.meshes.size()},
                      {"triangles", triangles},
                      {"vertices", vertices},
                      {"texels", texels}};
    json["inputs"] = artifact.inputs.hex();
    json["samplesDone"] = artifact.samplesDone;
    if (!artifact.note.empty())
        session.report().warn(artifact.note);
}

Result<void> bakeScene(Session& session, const SceneBake& sceneBake) {
    const std::string& output = sceneBake.output;
    const BakeRequest& request = sceneBake.request;
    const BakeFileOptions& storage = sceneBake.storage;
    const Result<Plan> plan = planBake(session.options(), output, sceneBake.work, request);
    if (!plan)
        return plan.error();
    if (Result<void> checked =
            plan->part ? checkOutput(output) : checkBakeOutput(output, request.kind);
        !checked)
        return checked;
    const Result<std::optional<FileLock>> lock = beginLongRun(session, *plan, output, "bake");
    if (!lock)
        return lock.error();
    Report& report = session.report();

    session.beginPhase();
    SceneRequest sceneRequest;
    sceneRequest.scene = sceneBake.scene;
    sceneRequest.environment = sceneBake.environment;
    sceneRequest.environmentLayout = sceneBake.environmentLayout;
    Result<Document> document = openSceneFor(session, sceneRequest);
    if (!document)
        return document.error();
    if (isPerTexel(request.kind))
        warnAboutOverlaps(session, *document);

    const BakeInputs inputs = bakeInputs(*document);
    if (Result<void> fits = checkOutputSize(session, request, inputs, *plan, output, storage);
        !fits)
        return fits;
    if (Result<void> fits = checkBakeMemory(request, inputs, plan->maxMemory); !fits) {
        const bool inGroups = request.kind == BakeKind::AoTexel && extensionOf(output) == ".png" &&
                              !plan->part && !plan->keepWhenInterrupted &&
                              !session.options().keepPartial;
        return inGroups ? bakeOcclusionPictures(session, *document, inputs, request,
                                                plan->maxMemory, output)
                        : fits;
    }
    std::optional<LightMapInputs> light;
    if (request.kind == BakeKind::LightMap) {
        session.beginPhase();
        Result<LightMapInputs> prepared = lightMapInputsOf(session, *document);
        if (!prepared)
            return prepared.error();
        light.emplace(*std::move(prepared));
    }
    ResumeSettings resume;
    resume.manifest =
        manifestOf(session, sceneBake, inputs, light ? &*light : nullptr, plan->shard);
    resume.checkpoint = plan->checkpoint;
    resume.everySeconds = plan->everySeconds;
    resume.resume = plan->resume;
    resume.keepOnCancel = plan->keepWhenInterrupted;
    if (plan->part)
        resume.part = output;
    resume.warn = [&](const Error& error) {
        report.warn(
            fmt::format("no checkpoint could be kept, the bake goes on without: {}", error.text()));
    };
    ResumableTracer tracer(std::move(resume));

    TileSink nobodyWatches;
    session.beginPhase();
    session.allowPartialResult();
    session.expectCheckpoint(plan->checkpoint, plan->keepWhenInterrupted);
    const Result<BakeArtifact> artifact =
        light ? bakeLightMap(*light, request.lightMap, session.job(), &tracer)
              : bake(request, inputs, nobodyWatches, session.job(), &tracer);
    if (tracer.keptCheckpoint())
        session.keptCheckpoint(plan->checkpoint);
    if (tracer.resumedFrom() >= 0)
        report.json()["resumedFrom"] = tracer.resumedFrom();
    if (!artifact)
        return artifact.error();
    reportBake(session, inputs, *artifact);
    report.json()["partial"] = session.interrupted();
    if (plan->part) {
        report.json()["shard"] = {plan->shard.index + 1, plan->shard.count};
        report.json()["samplesDone"] = tracer.samplesDone();
        report.output(output, fmt::format("part {} of {}, for patina merge", plan->shard.index + 1,
                                          plan->shard.count));
    } else if (Result<void> written = writeBake(session, *document, *artifact, output, storage);
               !written) {
        written = rescueBake(session, *document, *artifact, output, storage, written.error());
        if (!written)
            return written;
    }
    // What is complete needs no checkpoint; neither does anybody need an older one.
    if (!session.interrupted())
        tracer.removeCheckpoint();
    return {};
}

} // namespace patina::cli
