#include "core/trace/BakeGeometry.h"

#include "core/job/Parallel.h"
#include "core/trace/BakeInputs.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numeric>

namespace patina {
namespace {

constexpr std::size_t kGrain = 16384;

Error broken(const BakeMesh& mesh, const char* what) {
    return {ErrorKind::InputBroken,
            fmt::format("The mesh \"{}\" {}; hide it or repair it, then bake again.", nameOf(mesh),
                        what),
            {},
            {}};
}

// Normals transform by the inverse transpose. The cofactor matrix is that times the determinant and
// exists for flattening transforms too.
glm::dmat3 normalMatrix(const glm::dmat3& m) {
    const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]),
                               glm::cross(m[0], m[1]));
    return glm::determinant(m) < 0.0 ? -cofactors : cofactors;
}

glm::vec3 unitOr(const glm::dvec3& v, const glm::vec3& fallback) {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (!(largest > 0.0) || !std::isfinite(largest))
        return fallback;
    return glm::vec3(glm::normalize(v / largest));
}

struct Box {
    glm::dvec3 min{std::numeric_limits<double>::max()};
    glm::dvec3 max{std::numeric_limits<double>::lowest()};
};

bool validMesh(const Mesh& mesh) {
    const std::size_t count = mesh.positions.size();
    return mesh.indices.size() % 3 == 0 && mesh.normals.size() == count &&
           std::all_of(mesh.indices.begin(), mesh.indices.end(),
                       [count](std::uint32_t index) { return index < count; });
}

} // namespace

std::size_t BakeGeometry::triangleCount() const {
    return std::accumulate(meshes.begin(), meshes.end(), std::size_t{0},
                           [](std::size_t sum, const BakeGeometryMesh& mesh) {
                               return sum + mesh.mesh->triangleCount();
                           });
}

std::size_t BakeGeometry::vertexCount() const {
    return std::accumulate(
        meshes.begin(), meshes.end(), std::size_t{0},
        [](std::size_t sum, const BakeGeometryMesh& mesh) { return sum + mesh.positions.size(); });
}

Result<BakeGeometry> makeBakeGeometry(const BakeInputs& inputs, const JobContext& job) {
    // The box of all triangles in the world, in double precision.
    Box box;
    for (const BakeMesh& input : inputs.meshes) {
        if (!input.mesh || input.mesh->indices.empty())
            continue;
        if (!validMesh(*input.mesh))
            return broken(input, "has indices or normals that do not fit its vertices");
        const glm::dmat4 toWorld(input.transform);
        for (const std::uint32_t index : input.mesh->indices) {
            const glm::dvec3 p(toWorld * glm::dvec4(glm::dvec3(input.mesh->positions[index]), 1.0));
            if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
                return broken(input, "has a position or a transform that is not a finite number");
            box.min = glm::min(box.min, p);
            box.max = glm::max(box.max, p);
        }
        if (job.cancelled())
            return bakeCancelled();
    }
    if (box.min.x > box.max.x)
        return Error{ErrorKind::InputBroken,
                     "There is nothing to bake: the scene has no visible triangles. Show or add a "
                     "mesh.",
                     {},
                     {}};

    // A power of two, so that scaling rounds nothing.
    const glm::dvec3 centre = 0.5 * box.min + 0.5 * box.max, half = 0.5 * (box.max - box.min);
    const double radius = std::max({half.x, half.y, half.z});
    BakeGeometry geometry;
    geometry.centre = centre;
    geometry.unitsPerMetre = radius > 0.0 ? std::exp2(-std::ceil(std::log2(radius))) : 1.0;
    for (const BakeMesh& input : inputs.meshes) {
        if (!input.mesh || input.mesh->indices.empty())
            continue;
        BakeGeometryMesh& mesh = geometry.meshes.emplace_back();
        mesh.name = nameOf(input);
        mesh.id = input.id;
        mesh.material = input.material;
        mesh.mesh = input.mesh;
        mesh.doubleSided = input.doubleSided;
        mesh.surface = input.surface;
        const glm::dmat4 toWorld(input.transform);
        const glm::dmat3 linear(toWorld), toWorldNormal = normalMatrix(linear);
        mesh.winding = glm::determinant(linear) < 0.0 ? -1.0f : 1.0f;
        const std::size_t count = input.mesh->positions.size();
        mesh.positions.reserve(count + 1); // Embree reads 16 bytes of the last position
        mesh.positions.resize(count);
        mesh.normals.resize(count);
        parallelFor(job, count, kGrain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const glm::dvec3 p(toWorld * glm::dvec4(glm::dvec3(input.mesh->positions[i]), 1.0));
                // A vertex without triangles may stand anywhere; it is kept close.
                mesh.positions[i] = glm::vec3(glm::clamp((p - centre) * geometry.unitsPerMetre,
                                                         glm::dvec3(-2), glm::dvec3(2)));
                mesh.normals[i] =
                    unitOr(toWorldNormal * glm::dvec3(input.mesh->normals[i]), {0, 1, 0});
            }
        });
    }
    return geometry;
}

} // namespace patina
