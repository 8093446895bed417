// Ambient occlusion and radiance transfer per vertex.

#include "core/bake/Bake.h"
#include "core/bake/PrtSettingsCheck.h"
#include "core/bake/TransferRefinement.h"
#include "core/bake/bounce/Interreflection.h"
#include "core/bake/transfer/AoSettingsCheck.h"
#include "core/bake/transfer/BakeTracer.h"
#include "core/bake/transfer/InsideGeometry.h"
#include "core/bake/transfer/TransferMeaning.h"
#include "core/bake/transfer/VertexFit.h"
#include "core/bake/transfer/WorkOrder.h"
#include "core/trace/RayScene.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>

namespace patina {
namespace {

// The values of the vertices themselves.
std::vector<VertexBake> visibilityOf(const BakeGeometry& geometry, const VertexSamples& samples,
                                     std::span<const float> values) {
    std::vector<VertexBake> bakes;
    for (std::size_t m = 0; m < geometry.meshes.size(); ++m) {
        const std::size_t first = samples.firstOfMesh[m], end = samples.firstOfMesh[m + 1];
        VertexBake& bake = bakes.emplace_back();
        bake.mesh = geometry.meshes[m].id;
        bake.values.assign(values.begin() + static_cast<std::ptrdiff_t>(first),
                           values.begin() + static_cast<std::ptrdiff_t>(end));
    }
    return bakes;
}

// What the user should know of the geometry, or nothing.
std::string noteOf(const BakeGeometry& geometry, const RayScene& scene,
                   const VertexSamples& samples, const PassSettings& settings,
                   const PassState& state, const JobContext& job) {
    const auto stride = static_cast<std::size_t>(settings.stride());
    std::vector<float> visibility(samples.vertexCount());
    for (std::size_t v = 0; v < visibility.size(); ++v)
        visibility[v] =
            settings.shOrder == 0
                ? state.values[v]
                : ambientVisibility(std::span(state.values).subspan(v * stride, stride));
    return insideNote(geometry,
                      countVerticesInside(geometry, scene,
                                          std::span(samples.points).first(visibility.size()),
                                          visibility, job));
}

// Advice where triangles cannot show their shadows: from about this share of the surface on it is
// seen in pictures, by a few per cent of their mean (docs/maths/transfer-truth.md).
void noteCoarseMeshes(BakeArtifact& artifact, const BakeInputs& inputs) {
    constexpr int kEnoughRays = 128; // their noise is below the tolerance
    constexpr double kMuch = 0.005;
    if (artifact.samplesDone < kEnoughRays)
        return;
    const double share = coarseShare(inputs, artifact.vertices);
    if (share < kMuch)
        return;
    std::string& note = artifact.settings["note"];
    if (!note.empty())
        note += ' ';
    note += fmt::format("On {:.1f} % of the surface, triangles are too coarse for its shadows: "
                        "smaller ones are needed there, or a bake per texel, which has no such "
                        "limit.",
                        100.0 * share);
}

// Everything the two vertex bakes share; `artifact` arrives with kind, order and settings, `prt`
// with those of a transfer bake.
Result<BakeArtifact> bakeVertices(const BakeInputs& inputs, PassSettings settings,
                                  const PrtSettings* prt, BakeArtifact artifact, TileSink& sink,
                                  const JobContext& job, BakeTracer* tracer) {
    job.setActivity("preparing the scene");
    const Result<BakeGeometry> geometry = makeBakeGeometry(inputs, job);
    if (!geometry)
        return geometry.error();
    // Nothing shades an open surface: its values are exact at the vertices, and no ray is needed.
    const bool traces = !settings.unshadowed;
    const bool fitted = prt && prt->fitted && traces;
    const VertexSamples samples =
        fitted ? fittedVertexSamples(*geometry, job) : vertexSamples(*geometry, job);
    std::optional<RayScene> scene;
    if (traces) {
        Result<RayScene> built = RayScene::build(
            *geometry, job, 0, static_cast<double>(samples.points.size()) * settings.samples);
        if (!built)
            return built.error();
        scene.emplace(std::move(*built));
    }
    settings.maxDistance *= static_cast<float>(geometry->unitsPerMetre);

    PassCallbacks callbacks;
    callbacks.range = [&](const PointRange& range, std::span<const float> values) {
        if (range.first >= samples.vertexCount())
            return; // on triangles: seen when they are fitted
        const std::size_t mesh = samples.meshOf(range.first);
        sink.vertices(geometry->meshes[mesh].id, range.first - samples.firstOfMesh[mesh],
                      settings.stride(), values);
    };
    callbacks.passDone = [&](int rays) { sink.passDone(rays); };
    callbacks.view = [&] { return toSceneUnits(sink.view(), *geometry); };
    Result<std::optional<PassState>> traced =
        traces
            ? tracePoints(tracer,
                          {*scene, samples.points, samples.ranges, settings, callbacks, job})
            : passesOrNothing(openPasses(samples.points, samples.ranges, settings, callbacks, job));
    if (!traced)
        return traced.error();
    artifact.inputs = hashBakeInputs(inputs);
    if (!traced->has_value())
        return artifact;
    PassState& passes = **traced;

    noteRays(artifact, passes, settings, job);
    if (traces)
        if (std::string note = noteOf(*geometry, *scene, samples, settings, passes, job);
            !note.empty())
            artifact.settings["note"] = std::move(note);
    // What is not needed any more makes room for what comes.
    const bool bounces = prt && prt->transfer == TransferKind::Interreflected;
    if (!bounces)
        scene.reset();
    if (!prt) {
        artifact.vertices = visibilityOf(*geometry, samples, passes.values);
    } else {
        if (fitted)
            job.setActivity("fitting values to the surface");
        Result<std::vector<VertexBake>> vertices =
            finishVertexTransfer(*geometry, samples, settings, passes, job);
        if (!vertices)
            return vertices.error();
        artifact.vertices = *std::move(vertices);
        if (fitted)
            noteCoarseMeshes(artifact, inputs);
    }
    passes = {};
    if (bounces)
        if (std::optional<Error> error =
                addInterreflection(artifact, inputs, *geometry, *scene, *prt, sink, job))
            return *std::move(error);
    job.setProgress(1.0);
    return artifact;
}

} // namespace

Result<BakeArtifact> bakeAoVertex(const BakeInputs& inputs, const AoSettings& settings,
                                  TileSink& sink, const JobContext& job, BakeTracer* tracer) {
    const Result<PassSettings> passes = aoPassSettings(settings);
    if (!passes)
        return passes.error();
    BakeArtifact artifact;
    artifact.kind = BakeKind::AoVertex;
    artifact.settings = aoSettingsText(artifact.kind, settings, passes->samples);
    return bakeVertices(inputs, *passes, nullptr, std::move(artifact), sink, job, tracer);
}

Result<BakeArtifact> bakePrtVertex(const BakeInputs& inputs, const PrtSettings& settings,
                                   TileSink& sink, const JobContext& job, BakeTracer* tracer) {
    const Result<PassSettings> passes = prtPassSettings(settings);
    if (!passes)
        return passes.error();
    BakeArtifact artifact;
    artifact.kind = BakeKind::PrtVertex;
    artifact.order = settings.order;
    artifact.transfer = settings.transfer;
    artifact.settings = prtSettingsText(artifact.kind, settings, passes->samples);
    return bakeVertices(inputs, *passes, &settings, std::move(artifact), sink, job, tracer);
}

} // namespace patina
