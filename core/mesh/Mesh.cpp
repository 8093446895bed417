#include "core/mesh/Mesh.h"

#include "core/base/Check.h"
#include "core/mesh/MeshSource.h"
#include "core/mesh/TriangleGeometry.h"
#include "core/mesh/UvUnwrap.h"
#include "core/mesh/Weld.h"

#include <cmath>
#include <span>

namespace patina {
namespace {

constexpr glm::vec3 kUp{0.0f, 1.0f, 0.0f};

bool isFinite(const glm::vec2& v) {
    return std::isfinite(v.x) && std::isfinite(v.y);
}
bool isFinite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
bool isFinite(const glm::vec4& v) {
    return isFinite(glm::vec3(v)) && std::isfinite(v.w);
}

// Unit vector of any finite, non-zero vector, however large or small.
glm::vec3 unit(const glm::dvec3& v) {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    return glm::vec3(glm::normalize(v / largest));
}

// Any unit vector perpendicular to unit n (Duff et al. 2017, "Building an orthonormal basis,
// revisited").
glm::vec3 anyPerpendicular(const glm::vec3& n) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    return {1.0f + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x};
}

glm::dvec3 perpendicularPart(const glm::dvec3& v, const glm::dvec3& n) {
    return v - n * glm::dot(n, v);
}

// Drops triangles that break the promises, and counts them.
void dropBadTriangles(Mesh& mesh, MeshRepairs& repairs) {
    const std::size_t vertexCount = mesh.positions.size();
    repairs.invalidTriangles += mesh.indices.size() % 3 != 0 ? 1 : 0; // an unfinished triangle
    std::size_t kept = 0;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
        if (a >= vertexCount || b >= vertexCount || c >= vertexCount ||
            !isFinite(mesh.positions[a]) || !isFinite(mesh.positions[b]) ||
            !isFinite(mesh.positions[c])) {
            ++repairs.invalidTriangles;
            continue;
        }
        if (a == b || b == c || c == a ||
            isDegenerate(mesh.positions[a], mesh.positions[b], mesh.positions[c])) {
            ++repairs.droppedTriangles;
            continue;
        }
        mesh.indices[kept++] = a;
        mesh.indices[kept++] = b;
        mesh.indices[kept++] = c;
    }
    mesh.indices.resize(kept);
}

// Removes the vertices no triangle uses (they may hold anything and would distort the bounds),
// keeping the order of the others.
void dropUnusedVertices(Mesh& mesh, std::vector<std::uint32_t>* origin) {
    const std::size_t vertexCount = mesh.positions.size();
    std::vector<std::uint32_t> newIndex(vertexCount, 0);
    for (const std::uint32_t index : mesh.indices)
        newIndex[index] = 1;
    std::uint32_t used = 0;
    for (std::size_t i = 0; i < vertexCount; ++i) {
        if (newIndex[i] == 0)
            continue;
        mesh.positions[used] = mesh.positions[i];
        if (!mesh.normals.empty())
            mesh.normals[used] = mesh.normals[i];
        if (!mesh.tangents.empty())
            mesh.tangents[used] = mesh.tangents[i];
        if (!mesh.uvs.empty())
            mesh.uvs[used] = mesh.uvs[i];
        if (origin != nullptr)
            (*origin)[used] = (*origin)[i];
        newIndex[i] = used++;
    }
    if (used == vertexCount)
        return;
    for (std::uint32_t& index : mesh.indices)
        index = newIndex[index];
    mesh.positions.resize(used);
    mesh.normals.resize(mesh.normals.empty() ? 0 : used);
    mesh.tangents.resize(mesh.tangents.empty() ? 0 : used);
    mesh.uvs.resize(mesh.uvs.empty() ? 0 : used);
    if (origin != nullptr)
        origin->resize(used);
}

void repairNormals(Mesh& mesh, MeshRepairs& repairs) {
    if (mesh.normals.empty()) {
        computeNormals(mesh);
        repairs.generatedNormals = true;
        return;
    }
    std::vector<std::size_t> bad;
    for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
        glm::vec3& normal = mesh.normals[i];
        if (!isFinite(normal) || normal == glm::vec3(0.0f))
            bad.push_back(i);
        else if (std::abs(glm::dot(normal, normal) - 1.0f) > 1e-5f)
            normal = unit(normal);
    }
    if (bad.empty())
        return;
    Mesh computed;
    computed.positions = mesh.positions;
    computed.indices = mesh.indices;
    computeNormals(computed);
    for (const std::size_t i : bad)
        mesh.normals[i] = computed.normals[i];
    repairs.repairedNormals += bad.size();
}

void repairUvs(Mesh& mesh, MeshRepairs& repairs, std::vector<std::uint32_t>* origin) {
    std::size_t bad = 0;
    for (const glm::vec2& uv : mesh.uvs)
        bad += isFinite(uv) ? 0 : 1;
    if (bad == mesh.uvs.size()) {
        unwrapUvs(mesh, {}, origin);
        repairs.generatedUvs = true;
    } else if (bad > 0) {
        for (glm::vec2& uv : mesh.uvs)
            if (!isFinite(uv))
                uv = glm::vec2(0.0f);
    }
}

void repairTangents(Mesh& mesh, MeshRepairs& repairs) {
    if (mesh.tangents.empty() || repairs.generatedUvs) { // tangents follow the UVs
        computeTangents(mesh);
        repairs.generatedTangents = true;
        return;
    }
    std::vector<std::size_t> bad;
    for (std::size_t i = 0; i < mesh.tangents.size(); ++i) {
        glm::vec4& tangent = mesh.tangents[i];
        const glm::vec3 direction(tangent);
        if (!isFinite(tangent) || direction == glm::vec3(0.0f)) {
            bad.push_back(i);
            continue;
        }
        glm::vec3 unitDirection = direction;
        if (std::abs(glm::dot(direction, direction) - 1.0f) > 1e-5f)
            unitDirection = unit(direction);
        if (std::abs(glm::dot(unitDirection, mesh.normals[i])) > 0.999f) { // no bitangent
            bad.push_back(i);
            continue;
        }
        tangent = glm::vec4(unitDirection, tangent.w < 0.0f ? -1.0f : 1.0f);
    }
    if (bad.empty())
        return;
    std::vector<glm::vec4> given = std::move(mesh.tangents);
    computeTangents(mesh);
    for (const std::size_t i : bad)
        given[i] = mesh.tangents[i];
    mesh.tangents = std::move(given);
}

MeshRepairs sanitize(Mesh& mesh, std::vector<std::uint32_t>* origin) {
    MeshRepairs repairs;
    // An attribute that does not have one value per position is of no use.
    if (mesh.normals.size() != mesh.positions.size())
        mesh.normals.clear();
    if (mesh.tangents.size() != mesh.positions.size())
        mesh.tangents.clear();
    if (mesh.uvs.size() != mesh.positions.size())
        mesh.uvs.clear();

    dropBadTriangles(mesh, repairs);
    dropUnusedVertices(mesh, origin);
    if (mesh.positions.empty()) // nothing is left to generate anything for
        return repairs;
    repairNormals(mesh, repairs);
    repairUvs(mesh, repairs, origin);
    repairTangents(mesh, repairs);
    return repairs;
}

} // namespace

Bounds Mesh::bounds() const {
    Bounds result;
    for (const glm::vec3& position : positions)
        result.add(position);
    return result;
}

Hash hashMesh(const Mesh& mesh) {
    Hasher hasher;
    hasher.array(std::span(mesh.positions));
    hasher.array(std::span(mesh.normals));
    hasher.array(std::span(mesh.tangents));
    hasher.array(std::span(mesh.uvs));
    hasher.array(std::span(mesh.indices));
    return hasher.finish();
}

void computeNormals(Mesh& mesh) {
    const std::size_t vertexCount = mesh.positions.size();
    std::vector<glm::dvec3> own(vertexCount, glm::dvec3(0.0));
    std::vector<double> ownWeight(vertexCount, 0.0);
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
        const std::uint32_t* index = mesh.indices.data() + 3 * t;
        const glm::vec3 &a = mesh.positions[index[0]], &b = mesh.positions[index[1]],
                        &c = mesh.positions[index[2]];
        if (isDegenerate(a, b, c))
            continue;
        const glm::dvec3 area = areaVector(a, b, c);
        const std::array<double, 3> angles = cornerAngles(a, b, c);
        for (std::size_t corner = 0; corner < 3; ++corner) {
            own[index[corner]] += area * angles[corner];
            ownWeight[index[corner]] += glm::length(area) * angles[corner];
        }
    }

    // Vertices at one point share their sum.
    const std::vector<std::uint32_t> first = weldPositions(mesh.positions);
    std::vector<glm::dvec3> shared(vertexCount, glm::dvec3(0.0));
    std::vector<double> sharedWeight(vertexCount, 0.0);
    for (std::size_t i = 0; i < vertexCount; ++i) {
        shared[first[i]] += own[i];
        sharedWeight[first[i]] += ownWeight[i];
    }

    // Two sheets back to back cancel; each then keeps the normal of its own vertices.
    constexpr double kCancelled = 1e-6;
    mesh.normals.assign(vertexCount, kUp);
    for (std::size_t i = 0; i < vertexCount; ++i) {
        const std::uint32_t f = first[i];
        if (glm::length(shared[f]) > kCancelled * sharedWeight[f])
            mesh.normals[i] = unit(shared[f]);
        else if (glm::length(own[i]) > kCancelled * ownWeight[i])
            mesh.normals[i] = unit(own[i]);
    }

    // What is left touches nothing, or cancels even alone: the first triangle decides.
    std::vector<bool> undecided(vertexCount, false);
    for (std::size_t i = 0; i < vertexCount; ++i)
        undecided[i] = ownWeight[i] > 0.0 && !(glm::length(own[i]) > kCancelled * ownWeight[i]) &&
                       !(glm::length(shared[first[i]]) > kCancelled * sharedWeight[first[i]]);
    for (std::size_t corner = 0; corner < 3 * mesh.triangleCount(); ++corner) {
        const std::uint32_t i = mesh.indices[corner];
        if (!undecided[i])
            continue;
        const glm::dvec3 area = areaVector(mesh, corner / 3);
        if (glm::length(area) > 0.0) {
            mesh.normals[i] = unit(area);
            undecided[i] = false;
        }
    }
}

void computeTangents(Mesh& mesh) {
    const std::size_t vertexCount = mesh.positions.size();
    CHECK_EQ(mesh.normals.size(), vertexCount);
    CHECK_EQ(mesh.uvs.size(), vertexCount);

    // Corners with the same position, normal and UV are one vertex for MikkTSpace, also when the
    // file repeats them.
    const std::vector<std::uint32_t> first = weldVertices(mesh.positions, mesh.normals, mesh.uvs);

    // Where mirrored and unmirrored triangles meet MikkTSpace splits the vertex; here the
    // orientation with more weight wins.
    struct Sum {
        glm::dvec3 direction{0.0};
        double weight = 0.0;
    };
    std::array<std::vector<Sum>, 2> sums; // [0] as drawn, [1] mirrored; empty where nothing is
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
        const std::uint32_t* index = mesh.indices.data() + 3 * t;
        const glm::dvec2 uv0(mesh.uvs[index[0]]), uv1(mesh.uvs[index[1]]), uv2(mesh.uvs[index[2]]);
        // "Up" in the image is towards smaller v.
        const double du1 = uv1.x - uv0.x, dv1 = uv0.y - uv1.y, du2 = uv2.x - uv0.x,
                     dv2 = uv0.y - uv2.y;
        const double determinant = du1 * dv2 - du2 * dv1;
        if (determinant == 0.0)
            continue;
        const glm::vec3 &a = mesh.positions[index[0]], &b = mesh.positions[index[1]],
                        &c = mesh.positions[index[2]];
        const bool mirrored = determinant < 0.0;
        const glm::dvec3 alongU =
            ((glm::dvec3(b) - glm::dvec3(a)) * dv2 - (glm::dvec3(c) - glm::dvec3(a)) * dv1) *
            (mirrored ? -1.0 : 1.0);
        if (!(glm::length(alongU) > 0.0))
            continue;
        const std::array<double, 3> angles = cornerAngles(a, b, c);
        std::vector<Sum>& own = sums[mirrored ? 1 : 0];
        if (own.empty())
            own.resize(vertexCount);
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t vertex = index[corner];
            const glm::dvec3 direction =
                perpendicularPart(glm::dvec3(unit(alongU)), glm::dvec3(mesh.normals[vertex]));
            const double length = glm::length(direction);
            if (!(length > 1e-6))
                continue;
            Sum& sum = own[first[vertex]];
            sum.direction += direction * (angles[corner] / length);
            sum.weight += angles[corner];
        }
    }

    mesh.tangents.resize(vertexCount);
    for (std::size_t i = 0; i < vertexCount; ++i) {
        const auto sumOf = [&](std::size_t side) {
            return sums[side].empty() ? Sum{} : sums[side][first[i]];
        };
        const bool mirrored = sumOf(1).weight > sumOf(0).weight;
        const Sum sum = sumOf(mirrored ? 1 : 0);
        const glm::dvec3 direction = perpendicularPart(sum.direction, glm::dvec3(mesh.normals[i]));
        if (glm::length(direction) > 1e-6 * sum.weight)
            mesh.tangents[i] = glm::vec4(unit(direction), mirrored ? -1.0f : 1.0f);
        else
            mesh.tangents[i] = glm::vec4(anyPerpendicular(mesh.normals[i]), 1.0f);
    }
}

MeshRepairs sanitizeMesh(Mesh& mesh) {
    return sanitize(mesh, nullptr);
}

MeshRepairs sanitizeMesh(Mesh& mesh, std::vector<std::uint32_t>& origin) {
    CHECK_EQ(origin.size(), mesh.vertexCount());
    return sanitize(mesh, &origin);
}

} // namespace patina
