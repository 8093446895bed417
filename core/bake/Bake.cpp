#include "core/bake/Bake.h"

#include "core/bake/BakeDomain.h"
#include "core/bake/PrtSettingsCheck.h"
#include "core/bake/domain/BakeOptions.h"
#include "core/bake/transfer/AoSettingsCheck.h"
#include "core/bake/transfer/BakeTracer.h"
#include "core/bake/transfer/TexelTransfer.h"
#include "core/bake/transfer/WorkOrder.h"

namespace patina {
namespace {

Result<PassSettings> passSettings(const BakeRequest& request) {
    return holdsTransfer(request.kind) ? prtPassSettings(request.prt) : aoPassSettings(request.ao);
}

Result<BakeDomainPtr> domainOf(const BakeRequest& request, const BakeInputs& inputs,
                               const BakeGeometry& geometry, const JobContext& job) {
    if (!isPerTexel(request.kind))
        return vertexDomain(inputs, geometry, request, job);
    const int size = holdsTransfer(request.kind) ? request.prt.size : request.ao.size;
    return texelDomain(inputs, geometry, materialsInOrder(geometry), size, job);
}

} // namespace

BakeRequest normalized(BakeRequest request) {
    // What is out of range is refused when the bake starts.
    if (const Result<int> samples = roundSamples(request.ao.samples))
        request.ao.samples = *samples;
    if (const Result<int> samples = roundSamples(request.prt.samples, request.prt.method))
        request.prt.samples = *samples;
    if (const Result<int> samples = roundSamples(request.lightMap.samples))
        request.lightMap.samples = *samples;
    return request;
}

BakeArtifact describeBake(BakeRequest request, const PassSettings& settings) {
    request.ao.samples = request.prt.samples = settings.samples;
    BakeArtifact artifact;
    artifact.kind = request.kind;
    if (holdsTransfer(request.kind)) {
        artifact.order = request.prt.order;
        artifact.transfer = request.prt.transfer;
    }
    artifact.settings = settingsText(request);
    return artifact;
}

Result<BakeArtifact> bake(const BakeRequest& request, const BakeInputs& inputs, TileSink& sink,
                          const JobContext& job, BakeTracer* tracer) {
    Result<PassSettings> settings = passSettings(request);
    if (!settings)
        return settings.error();

    // The scene, and what of it is baked.
    job.setActivity("preparing the scene");
    const Result<BakeGeometry> geometry = makeBakeGeometry(inputs, job);
    if (!geometry)
        return geometry.error();
    const Result<BakeDomainPtr> made = domainOf(request, inputs, *geometry, job);
    if (!made)
        return made.error();
    const BakeDomain& domain = **made;
    std::optional<RayScene> scene; // none: what an open surface sees is known without a ray
    if (!settings->unshadowed) {
        Result<RayScene> built = RayScene::build(
            *geometry, job, 0, static_cast<double>(domain.points().size()) * settings->samples);
        if (!built)
            return built.error();
        scene.emplace(std::move(*built));
    }
    settings->maxDistance *= static_cast<float>(geometry->unitsPerMetre);

    // What its points see.
    PassCallbacks callbacks;
    callbacks.range = [&](const PointRange& range, std::span<const float> values) {
        domain.report(range, settings->stride(), values, sink);
    };
    callbacks.passDone = [&](int rays) { sink.passDone(rays); };
    callbacks.view = [&] { return toSceneUnits(sink.view(), *geometry); };
    Result<std::optional<PassState>> traced =
        scene ? tracePoints(tracer,
                            {*scene, domain.points(), domain.ranges(), *settings, callbacks, job})
              : passesOrNothing(
                    openPasses(domain.points(), domain.ranges(), *settings, callbacks, job));
    if (!traced)
        return traced.error();
    BakeArtifact artifact = describeBake(request, *settings);
    artifact.inputs = hashBakeInputs(inputs);
    if (!traced->has_value())
        return artifact;
    PassState& passes = **traced;

    // Values of it. What is not needed any more makes room for what comes.
    noteRays(artifact, passes, *settings, job);
    artifact.note = domain.note(scene ? &*scene : nullptr, *settings, passes, job);
    const bool bounces =
        holdsTransfer(request.kind) && request.prt.transfer == TransferKind::Interreflected;
    if (!bounces)
        scene.reset();
    if (Result<void> finished = domain.finish(artifact, *settings, passes, job); !finished)
        return finished.error();
    if (bounces)
        if (std::optional<Error> error =
                domain.addBounces(artifact, *scene, passes, request.prt, sink, job))
            return *std::move(error);
    job.setProgress(1.0);
    return artifact;
}

Result<BakeArtifact> bakeAoTexel(const BakeInputs& inputs, const AoSettings& settings,
                                 TileSink& sink, const JobContext& job, BakeTracer* tracer) {
    return bake({BakeKind::AoTexel, settings, {}}, inputs, sink, job, tracer);
}

Result<BakeArtifact> bakeAoVertex(const BakeInputs& inputs, const AoSettings& settings,
                                  TileSink& sink, const JobContext& job, BakeTracer* tracer) {
    return bake({BakeKind::AoVertex, settings, {}}, inputs, sink, job, tracer);
}

Result<BakeArtifact> bakePrtVertex(const BakeInputs& inputs, const PrtSettings& settings,
                                   TileSink& sink, const JobContext& job, BakeTracer* tracer) {
    return bake({BakeKind::PrtVertex, {}, settings}, inputs, sink, job, tracer);
}

Result<BakeArtifact> bakePrtTexel(const BakeInputs& inputs, const PrtSettings& settings,
                                  TileSink& sink, const JobContext& job, BakeTracer* tracer) {
    return bake({BakeKind::PrtTexel, {}, settings}, inputs, sink, job, tracer);
}

} // namespace patina
