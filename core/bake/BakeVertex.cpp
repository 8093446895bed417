// Ambient occlusion and radiance transfer per vertex.

#include "core/bake/AoSettingsCheck.h"
#include "core/bake/Bake.h"
#include "core/bake/BakePoints.h"
#include "core/bake/BakeTracer.h"
#include "core/bake/Interreflection.h"
#include "core/bake/PrtSettingsCheck.h"
#include "core/bake/RayScene.h"
#include "core/bake/WorkOrder.h"

#include <algorithm>

namespace patina {
namespace {

// Everything the two vertex bakes share; `artifact` arrives with kind, order and settings, `prt`
// with those of a transfer bake.
Result<BakeArtifact> bakeVertices(const BakeInputs& inputs, PassSettings settings,
                                  const PrtSettings* prt, BakeArtifact artifact, TileSink& sink,
                                  const JobContext& job, BakeTracer* tracer) {
    job.setActivity("preparing the scene");
    const Result<BakeGeometry> geometry = makeBakeGeometry(inputs, job);
    if (!geometry)
        return geometry.error();
    const std::size_t pointCount = geometry->vertexCount();
    const Result<RayScene> scene =
        RayScene::build(*geometry, job, 0, static_cast<double>(pointCount) * settings.samples);
    if (!scene)
        return scene.error();
    settings.maxDistance *= static_cast<float>(geometry->unitsPerMetre);

    const std::vector<BakePoint> points = vertexPoints(*geometry, job);
    const std::vector<PointRange> ranges = vertexRanges(*geometry, rangeSize(pointCount));
    std::vector<std::size_t> firstOfMesh; // and the end
    for (const BakeGeometryMesh& mesh : geometry->meshes)
        firstOfMesh.push_back((firstOfMesh.empty() ? 0 : firstOfMesh.back()) +
                              mesh.positions.size());
    firstOfMesh.insert(firstOfMesh.begin(), 0);

    PassCallbacks callbacks;
    callbacks.range = [&](const PointRange& range, std::span<const float> values) {
        const auto next = std::upper_bound(firstOfMesh.begin(), firstOfMesh.end(), range.first);
        const auto mesh = static_cast<std::size_t>(next - firstOfMesh.begin()) - 1;
        sink.vertices(geometry->meshes[mesh].id, range.first - firstOfMesh[mesh], settings.stride(),
                      values);
    };
    callbacks.passDone = [&](int samples) { sink.passDone(samples); };
    callbacks.view = [&] { return toSceneUnits(sink.view(), *geometry); };
    Result<std::optional<PassState>> traced =
        tracePoints(tracer, {*scene, points, ranges, settings, callbacks, job});
    if (!traced)
        return traced.error();
    artifact.inputs = hashBakeInputs(inputs);
    if (!traced->has_value())
        return artifact;
    const PassState& passes = **traced;

    artifact.samplesDone = passes.samplesDone;
    const auto stride = static_cast<std::size_t>(settings.stride());
    for (std::size_t m = 0; m < geometry->meshes.size(); ++m) {
        const auto values = passes.values.begin();
        const auto at = [&](std::size_t point) {
            return values + static_cast<std::ptrdiff_t>(point * stride);
        };
        VertexBake bake;
        bake.mesh = geometry->meshes[m].id;
        bake.stride = settings.stride();
        bake.values.assign(at(firstOfMesh[m]), at(firstOfMesh[m + 1]));
        if (artifact.kind == BakeKind::PrtVertex) {
            const auto first = static_cast<std::ptrdiff_t>(firstOfMesh[m]);
            const auto end = static_cast<std::ptrdiff_t>(firstOfMesh[m + 1]);
            for (std::size_t p = firstOfMesh[m]; p < firstOfMesh[m + 1]; ++p)
                bake.sky.push_back(skyShare(passes.hiddenSky[p], points[p].normal));
            if (settings.method != SampleMethod::Stratified) // whose one pass cannot tell
                bake.error.assign(passes.error.begin() + first, passes.error.begin() + end);
        }
        artifact.vertices.push_back(std::move(bake));
    }
    if (prt && prt->transfer == TransferKind::Interreflected)
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
    artifact.settings = prtSettingsText(artifact.kind, settings, passes->samples);
    return bakeVertices(inputs, *passes, &settings, std::move(artifact), sink, job, tracer);
}

} // namespace patina
