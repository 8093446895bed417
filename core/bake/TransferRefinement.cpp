#include "core/bake/TransferRefinement.h"

#include "core/bake/Bake.h"
#include "core/mesh/RefineMesh.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>

namespace patina {
namespace {

constexpr float kSmallestEdge = 1.0f / 2000.0f; // of the scene's size

std::size_t countTriangles(const BakeInputs& inputs) {
    std::size_t count = 0;
    for (const BakeMesh& mesh : inputs.meshes)
        count += mesh.mesh ? mesh.mesh->triangleCount() : 0;
    return count;
}

float sceneSize(const BakeInputs& inputs) {
    Bounds bounds;
    for (const BakeMesh& mesh : inputs.meshes)
        if (mesh.mesh)
            bounds.add(mesh.mesh->bounds().transformed(mesh.transform));
    const glm::vec3 size = bounds.size();
    return std::max({size.x, size.y, size.z});
}

// How much longer than in the mesh an edge may be in the world.
float largestScale(const glm::mat4& transform) {
    return std::max({glm::length(glm::vec3(transform[0])), glm::length(glm::vec3(transform[1])),
                     glm::length(glm::vec3(transform[2]))});
}

float meanError(const std::vector<float>& error, const std::uint32_t* index) {
    return (error[index[0]] + error[index[1]] + error[index[2]]) / 3.0f;
}

// The triangles of a mesh whose corners' mean error passes the tolerance.
std::vector<std::uint8_t> coarseOnes(const Mesh& mesh, const std::vector<float>& error,
                                     float tolerance) {
    std::vector<std::uint8_t> coarse(mesh.triangleCount());
    for (std::size_t t = 0; t < coarse.size(); ++t) {
        const std::uint32_t* index = mesh.indices.data() + 3 * t;
        coarse[t] = meanError(error, index) > tolerance ? 1 : 0;
    }
    return coarse;
}

// Calls use(bake, three indices, twice the area) for every triangle that was baked.
template <class Use>
void forEachTriangle(const BakeInputs& inputs, std::span<const VertexBake> bakes, Use&& use) {
    auto values = bakes.begin();
    for (const BakeMesh& mesh : inputs.meshes) {
        if (values == bakes.end() || values->mesh != mesh.id)
            continue;
        const glm::dmat4 toWorld(mesh.transform);
        const std::vector<std::uint32_t>& indices = mesh.mesh->indices;
        for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
            glm::dvec3 corner[3];
            for (std::size_t k = 0; k < 3; ++k)
                corner[k] = glm::dvec3(
                    toWorld * glm::dvec4(glm::dvec3(mesh.mesh->positions[indices[i + k]]), 1.0));
            use(*values, indices.data() + i,
                glm::length(glm::cross(corner[1] - corner[0], corner[2] - corner[0])));
        }
        ++values;
    }
}

// Over the surface: of a vertex by the area around it, or finer places would count the more.
double rmsError(const BakeInputs& inputs, std::span<const VertexBake> bakes) {
    double squares = 0.0, area = 0.0;
    forEachTriangle(inputs, bakes,
                    [&](const VertexBake& bake, const std::uint32_t* index, double own) {
                        double square = 0.0;
                        for (int k = 0; k < 3; ++k)
                            square += double{bake.error[index[k]]} * double{bake.error[index[k]]};
                        squares += own * square / 3.0;
                        area += own;
                    });
    return area > 0.0 ? std::sqrt(squares / area) : 0.0;
}

} // namespace

Result<RefinedMeshes> refineForTransfer(BakeInputs inputs, const RefinementSettings& settings,
                                        const JobContext& job) {
    if (!(settings.tolerance > 0.0f) || settings.rounds < 1 || settings.rounds > 12)
        return Error{ErrorKind::Usage,
                     fmt::format("Refinement takes a tolerance above 0 and 1 to 12 rounds, not {} "
                                 "and {}.",
                                 settings.tolerance, settings.rounds),
                     {},
                     {}};
    PrtSettings bake = settings.bake;
    bake.fitted = true;
    bake.transfer = TransferKind::Shadowed;
    const float smallest = kSmallestEdge * sceneSize(inputs);
    RefinedMeshes result;
    for (;;) {
        TileSink nobodyWatches;
        const Result<BakeArtifact> artifact = bakePrtVertex(inputs, bake, nobodyWatches, job);
        if (!artifact)
            return artifact.error();
        result.errorAfter = rmsError(inputs, artifact->vertices);
        if (result.rounds == 0)
            result.errorBefore = result.errorAfter;

        // Split what is too coarse, unless that gives too many triangles.
        result.tooCoarse = 0;
        std::vector<MeshPtr> finer;
        std::size_t triangles = 0;
        auto values = artifact->vertices.begin();
        for (const BakeMesh& mesh : inputs.meshes) {
            finer.push_back(mesh.mesh);
            if (values != artifact->vertices.end() && values->mesh == mesh.id) {
                const std::vector<std::uint8_t> coarse =
                    coarseOnes(*mesh.mesh, values->error, settings.tolerance);
                const auto count =
                    static_cast<std::size_t>(std::count(coarse.begin(), coarse.end(), 1));
                result.tooCoarse += count;
                if (count > 0)
                    finer.back() = std::make_shared<const Mesh>(
                        refineMesh(*mesh.mesh, coarse, smallest / largestScale(mesh.transform)));
                ++values;
            }
            triangles += finer.back() ? finer.back()->triangleCount() : 0;
        }
        const std::size_t before = countTriangles(inputs);
        if (result.rounds == settings.rounds || triangles == before ||
            triangles > settings.maxTriangles)
            break;
        ++result.rounds;
        for (std::size_t m = 0; m < finer.size(); ++m)
            inputs.meshes[m].mesh = finer[m];
        if (job.stopping())
            break;
    }
    for (const BakeMesh& mesh : inputs.meshes)
        result.meshes.push_back(mesh.mesh);
    result.triangles = countTriangles(inputs);
    return result;
}

double coarseShare(const BakeInputs& inputs, std::span<const VertexBake> bakes, float tolerance) {
    double coarse = 0.0, area = 0.0;
    forEachTriangle(inputs, bakes,
                    [&](const VertexBake& bake, const std::uint32_t* index, double own) {
                        if (meanError(bake.error, index) > tolerance)
                            coarse += own;
                        area += own;
                    });
    return area > 0.0 ? coarse / area : 0.0;
}

} // namespace patina
