#include "core/bake/bounce/Interreflection.h"

#include "core/bake/domain/BakeHash.h"
#include "core/bake/domain/BakeOptions.h"
#include "core/bake/transfer/Passes.h"
#include "core/base/ById.h"
#include "core/base/Check.h"
#include "core/trace/BakeScene.h"

#include <algorithm>
#include <fmt/format.h>

namespace patina {
namespace {

constexpr int kMaxBounces = 64;

// Null when the artifact is of other meshes; `stride`: of its elements.
const VertexBake* bakeOf(const BounceElements::MeshPart& part, const ById<VertexBake>& bakes,
                         std::size_t stride) {
    const VertexBake* bake = bakes.find(part.id);
    return bake != nullptr && bake->values.size() == part.mesh->vertexCount() * stride ? bake
                                                                                       : nullptr;
}

} // namespace

std::optional<Error> checkBounceSettings(const PrtSettings& settings) {
    if (settings.bounces < 1 || settings.bounces > kMaxBounces)
        return Error{
            ErrorKind::Usage,
            fmt::format("Light can bounce 1 to {} times, not {}.", kMaxBounces, settings.bounces),
            {},
            {}};
    const Result<int> samples = roundSamples(settings.bounceSamples);
    if (!samples)
        return samples.error();
    return std::nullopt;
}

Result<HitSettings> hitSettings(const PrtSettings& settings) {
    if (std::optional<Error> error = checkBounceSettings(settings))
        return *std::move(error);
    return HitSettings{*roundSamples(settings.bounceSamples), settings.seed, settings.order};
}

Result<HitSourcePtr> traceHits(const RayScene& scene, const BakeGeometry& geometry,
                               const PrtSettings& settings, const JobContext& job) {
    const Result<HitSettings> hits = hitSettings(settings);
    if (!hits)
        return hits.error();
    Result<BounceElements> elements = BounceElements::make(geometry);
    if (!elements)
        return elements.error();
    job.setActivity("tracing bounces");
    if (HitCache::maxHitBytes(elements->count(), hits->samples) > settings.hitBudget)
        return HitRetracer::make(scene, geometry, std::move(*elements), *hits, job);
    const Result<HitCachePtr> cache =
        HitCache::trace(scene, geometry, std::move(*elements), *hits, job);
    if (!cache)
        return cache.error();
    return HitSourcePtr(*cache);
}

std::vector<BakeSurface> surfacesOf(const BounceElements& elements, const BakeInputs& inputs) {
    std::vector<BakeSurface> surfaces;
    const ById meshes(inputs.meshes);
    for (const BounceElements::MeshPart& part : elements.meshes()) {
        const BakeMesh* mesh = meshes.find(part.id);
        surfaces.push_back(mesh != nullptr ? mesh->surface : BakeSurface{});
    }
    return surfaces;
}

std::optional<std::vector<float>> directTransfer(const BounceElements& elements,
                                                 const BakeArtifact& artifact) {
    const auto stride = static_cast<std::size_t>(artifact.order * artifact.order);
    std::vector<float> direct;
    direct.reserve(elements.fronts() * stride);
    const ById bakes(artifact.vertices, &VertexBake::mesh);
    for (const BounceElements::MeshPart& part : elements.meshes()) {
        const VertexBake* bake = bakeOf(part, bakes, stride);
        if (!bake)
            return std::nullopt;
        direct.insert(direct.end(), bake->values.begin(), bake->values.end());
    }
    return direct;
}

std::vector<float> openness(std::span<const float> direct, int order) {
    constexpr float kY00 = 0.28209479177387814f; // uniform light of radiance 1 has L_00 = 1 / Y_00
    const auto stride = static_cast<std::size_t>(order * order);
    std::vector<float> open;
    open.reserve(direct.size() / stride);
    for (std::size_t first = 0; first < direct.size(); first += stride)
        open.push_back(direct[first] / kY00);
    return open;
}

std::optional<std::vector<glm::vec3>> directLight(const BounceElements& elements,
                                                  const BakeArtifact& artifact,
                                                  std::span<const glm::vec3> light) {
    const auto stride = static_cast<std::size_t>(artifact.order * artifact.order);
    const std::span<const glm::vec3> used = light.first(std::min(light.size(), stride));
    std::vector<glm::vec3> direct;
    direct.reserve(elements.fronts());
    const ById bakes(artifact.vertices, &VertexBake::mesh);
    for (const BounceElements::MeshPart& part : elements.meshes()) {
        const VertexBake* bake = bakeOf(part, bakes, stride);
        if (!bake)
            return std::nullopt;
        for (std::size_t first = 0; first < bake->values.size(); first += stride) {
            glm::vec3 sum(0.0f);
            for (std::size_t i = 0; i < used.size(); ++i)
                sum += bake->values[first + i] * used[i];
            direct.push_back(sum);
        }
    }
    return direct;
}

void setBounced(BakeArtifact& artifact, const BounceElements& elements,
                std::span<const float> bounced) {
    const auto row = static_cast<std::size_t>(3 * artifact.order * artifact.order);
    CHECK_EQ(bounced.size(), elements.fronts() * row);
    const ById parts(elements.meshes());
    for (VertexBake& bake : artifact.vertices)
        if (const BounceElements::MeshPart* part = parts.find(bake.mesh)) {
            const std::span<const float> own =
                bounced.subspan(part->firstElement * row, part->mesh->vertexCount() * row);
            bake.bounced.assign(own.begin(), own.end());
        }
}

std::optional<Error> addInterreflection(BakeArtifact& artifact, const BakeInputs& inputs,
                                        const BakeGeometry& geometry, const RayScene& scene,
                                        const PrtSettings& settings, TileSink& sink,
                                        const JobContext& job) {
    const Result<HitSourcePtr> hits = traceHits(scene, geometry, settings, job);
    if (!hits)
        return hits.error();
    if ((*hits)->kept())
        sink.hits(*hits);
    const BounceElements& elements = (*hits)->elements();
    const std::optional<std::vector<float>> direct = directTransfer(elements, artifact);
    CHECK(direct.has_value());
    job.setActivity("following bounces");
    BounceSolver solver(*hits);
    solver.setSurfaces(surfacesOf(elements, inputs), job);
    solver.setOpen(openness(*direct, artifact.order));
    const Result<std::vector<float>> bounced = solver.solve(*direct, settings.bounces, job);
    if (!bounced)
        return bounced.error();
    setBounced(artifact, elements, *bounced);
    artifact.albedo = hashBakeAlbedo(inputs);
    artifact.transfer = TransferKind::Interreflected;
    artifact.bounces = settings.bounces;
    return std::nullopt;
}

Result<BakeArtifactPtr> withBounces(const BakeArtifact& artifact, const BakeInputs& inputs,
                                    int bounces, const JobContext& job) {
    const auto refused = [&](std::string_view why) {
        return Error{ErrorKind::Usage,
                     fmt::format("The bake holds {} bounces together, and not {} alone: {}. Bake "
                                 "with --bounces {}, or leave view.bounces at 0.",
                                 artifact.bounces, bounces, why, bounces),
                     {},
                     {}};
    };
    if (artifact.kind != BakeKind::PrtVertex)
        return refused("between texels light is not followed again");
    if (hashBakeInputs(inputs) != artifact.inputs)
        return refused("it is of other geometry, where its rays cannot be traced again");
    PrtSettings settings = requestOf(artifact).prt;
    settings.order = artifact.order;
    settings.bounces = bounces;
    const Result<BakeScene> scene = BakeScene::build(inputs, job);
    if (!scene)
        return scene.error();
    auto result = std::make_shared<BakeArtifact>(artifact);
    TileSink nobody;
    if (const std::optional<Error> error = addInterreflection(*result, inputs, *scene->geometry,
                                                              scene->rays, settings, nobody, job))
        return *error;
    result->settings["bounces"] = fmt::format("{}", bounces);
    return BakeArtifactPtr(std::move(result));
}

} // namespace patina
