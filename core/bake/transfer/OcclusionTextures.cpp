#include "core/bake/transfer/OcclusionTextures.h"

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
    , m_inputs(hashBakeInputs(inputs))
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
    const Result<TexelLayout> layout =
        texelLayout(*m_scene.geometry, std::span(m_materials).subspan(m_next, end - m_next),
                    m_settings.size, job);
    if (!layout)
        return layout.error();
    Result<std::optional<PassState>> traced = tracePoints(
        nullptr, {m_scene.rays, layout->points, layout->ranges, m_passes, PassCallbacks{}, job});
    if (!traced)
        return traced.error();
    const PassState& state = **traced;

    BakeArtifact artifact;
    artifact.kind = BakeKind::AoTexel;
    artifact.inputs = m_inputs;
    artifact.settings = aoSettingsText(artifact.kind, m_settings, m_passes.samples);
    artifact.settings["size"] = std::to_string(m_settings.size);
    if (const std::string note = layout->note(); !note.empty())
        artifact.settings["note"] = note;
    noteRays(artifact, state, m_passes, job);
    for (const MaterialTexels& part : layout->parts)
        artifact.texels.push_back({part.material, occlusionTexture(*layout, part, state.values)});
    m_passes.firstPoint += static_cast<std::uint32_t>(layout->points.size());
    m_next = end;
    return artifact;
}

} // namespace patina
