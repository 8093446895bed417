#include "core/bake/OcclusionTextures.h"

#include "core/bake/BakeDomain.h"
#include "core/bake/domain/BakeHash.h"
#include "core/bake/transfer/AoSettingsCheck.h"
#include "core/bake/transfer/BakeTracer.h"
#include "core/bake/transfer/TexelTransfer.h"

#include <algorithm>
#include <span>
#include <utility>

namespace patina {

OcclusionTextures::OcclusionTextures(BakeScene scene, const AoSettings& settings,
                                     const PassSettings& passes, const BakeInputs& inputs)
    : m_scene(std::move(scene))
    , m_settings(settings)
    , m_passes(passes)
    , m_inputs(inputs)
    , m_hash(hashBakeInputs(inputs))
    , m_materials(materialsInOrder(*m_scene.geometry)) {}

Result<OcclusionTextures> OcclusionTextures::prepare(const BakeInputs& inputs,
                                                     const AoSettings& settings,
                                                     const JobContext& job) {
    Result<PassSettings> passes = aoPassSettings(settings);
    if (!passes)
        return passes.error();
    job.setActivity("preparing the scene");
    Result<BakeScene> scene = BakeScene::build(inputs, job);
    if (!scene)
        return scene.error();
    passes->maxDistance *= static_cast<float>(scene->geometry->unitsPerMetre);
    return OcclusionTextures(*std::move(scene), settings, *passes, inputs);
}

Result<BakeArtifact> OcclusionTextures::bakeNext(std::size_t count, const JobContext& job) {
    const std::size_t end = m_next + std::min(count, m_materials.size() - m_next);
    const Result<BakeDomainPtr> domain =
        texelDomain(m_inputs, *m_scene.geometry,
                    std::span(m_materials).subspan(m_next, end - m_next), m_settings.size, job);
    if (!domain)
        return domain.error();
    const std::span<const BakePoint> points = (*domain)->points();
    Result<std::optional<PassState>> traced = tracePoints(
        nullptr, {m_scene.rays, points, (*domain)->ranges(), m_passes, PassCallbacks{}, job});
    if (!traced)
        return traced.error();
    PassState& state = **traced;

    BakeArtifact artifact = describeBake({BakeKind::AoTexel, m_settings, {}}, m_passes);
    artifact.inputs = m_hash;
    artifact.note = (*domain)->note(&m_scene.rays, m_passes, state, job);
    noteRays(artifact, state, m_passes, job);
    if (Result<void> finished = (*domain)->finish(artifact, m_passes, state, job); !finished)
        return finished.error();
    m_passes.firstPoint += static_cast<std::uint32_t>(points.size());
    m_next = end;
    return artifact;
}

} // namespace patina
