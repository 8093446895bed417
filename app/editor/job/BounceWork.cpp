#include "app/editor/job/BounceWork.h"

#include "core/bake/bounce/Interreflection.h"
#include "core/bake/domain/BakeHash.h"
#include "core/bake/domain/BakeOptions.h"
#include "core/trace/BakeScene.h"

#include <algorithm>

namespace patina::editor {
namespace {

// The hits are of these meshes; where those stand, the bake's hash has told.
bool fits(const HitSource& hits, const HitSettings& settings, const BakeInputs& inputs) {
    return hits.settings() == settings &&
           std::all_of(hits.elements().meshes().begin(), hits.elements().meshes().end(),
                       [&](const BounceElements::MeshPart& part) {
                           return std::any_of(inputs.meshes.begin(), inputs.meshes.end(),
                                              [&](const BakeMesh& mesh) {
                                                  return mesh.id == part.id &&
                                                         mesh.mesh == part.mesh &&
                                                         mesh.doubleSided == part.doubleSided;
                                              });
                       });
}

} // namespace

std::vector<BakeSurface> surfacesOf(const BakeInputs& inputs) {
    std::vector<BakeSurface> surfaces;
    for (const BakeMesh& mesh : inputs.meshes)
        surfaces.push_back(mesh.surface);
    return surfaces;
}

Result<HitSourcePtr> hitsFor(const BakeArtifact& artifact, const BakeInputs& inputs,
                             const HitSourcePtr& ofBake, const JobContext& job) {
    if (hashBakeInputs(inputs) != artifact.inputs)
        return HitSourcePtr();
    PrtSettings settings = requestOf(artifact).prt;
    settings.order = artifact.order;
    const Result<HitSettings> rays = hitSettings(settings);
    if (!rays)
        return rays.error();
    if (ofBake && fits(*ofBake, *rays, inputs))
        return ofBake;
    const Result<BakeScene> scene = BakeScene::build(inputs, job);
    if (!scene)
        return scene.error();
    Result<HitSourcePtr> hits = traceHits(scene->rays, *scene->geometry, settings, job);
    if (hits && !(*hits)->kept()) // would need the scene to live on
        return HitSourcePtr();
    return hits;
}

BounceSolverPtr resurfaced(const BounceSolver& solver, const BakeInputs& inputs,
                           const JobContext& job) {
    auto result = std::make_shared<BounceSolver>(solver);
    result->setSurfaces(patina::surfacesOf(solver.hits().elements(), inputs), job);
    return result;
}

Result<BakeArtifactPtr> withBounces(const BounceSolver& solver, const BakeArtifact& artifact,
                                    const BakeInputs& inputs, const JobContext& job) {
    const Hash albedo = hashBakeAlbedo(inputs);
    if (albedo == artifact.albedo)
        return BakeArtifactPtr();
    const BounceElements& elements = solver.hits().elements();
    const std::optional<std::vector<float>> direct = directTransfer(elements, artifact);
    if (!direct)
        return BakeArtifactPtr();
    BounceSolver opened = solver;
    opened.setOpen(openness(*direct, artifact.order));
    const Result<std::vector<float>> bounced = opened.solve(*direct, artifact.bounces, job);
    if (!bounced)
        return bounced.error();
    BakeArtifact result = artifact;
    setBounced(result, elements, *bounced);
    result.albedo = albedo;
    return BakeArtifactPtr(std::make_shared<const BakeArtifact>(std::move(result)));
}

Result<BouncedLightPtr> bouncedLight(const BounceSolver& solver, const BakeArtifact& artifact,
                                     std::span<const glm::vec3> light, int bounces,
                                     const JobContext& job) {
    const BounceElements& elements = solver.hits().elements();
    const std::optional<std::vector<glm::vec3>> direct = directLight(elements, artifact, light);
    const std::optional<std::vector<float>> coefficients = directTransfer(elements, artifact);
    if (!direct || !coefficients)
        return BouncedLightPtr();
    BounceSolver opened = solver;
    opened.setOpen(openness(*coefficients, artifact.order));
    const Result<std::vector<glm::vec3>> bounced = opened.solveLight(*direct, light, bounces, job);
    if (!bounced)
        return bounced.error();
    auto result = std::make_shared<BouncedLight>();
    for (const BounceElements::MeshPart& part : elements.meshes()) {
        const auto first = bounced->begin() + part.firstElement;
        (*result)[part.id].assign(first,
                                  first + static_cast<std::ptrdiff_t>(part.mesh->vertexCount()));
    }
    return BouncedLightPtr(std::move(result));
}

} // namespace patina::editor
