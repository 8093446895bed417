#include "core/bake/document/TransferPoint.h"

#include "core/document/Document.h"
#include "core/math/SphericalHarmonics.h"
#include "core/trace/BakeScene.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

namespace patina {
namespace {

// Weights of the triangle's point nearest to p. Ericson 2005, "Real-Time Collision Detection",
// 5.1.5, by the region that p lies in.
glm::dvec3 nearestWeights(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                          const glm::dvec3& c) {
    const glm::dvec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
    if (d1 <= 0.0 && d2 <= 0.0)
        return {1.0, 0.0, 0.0};
    const double d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
    if (d3 >= 0.0 && d4 <= d3)
        return {0.0, 1.0, 0.0};
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0)
        return {1.0 - d1 / (d1 - d3), d1 / (d1 - d3), 0.0};
    const double d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    if (d6 >= 0.0 && d5 <= d6)
        return {0.0, 0.0, 1.0};
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0)
        return {1.0 - d2 / (d2 - d6), 0.0, d2 / (d2 - d6)};
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0.0 && d4 >= d3 && d5 >= d6) {
        const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return {0.0, 1.0 - w, w};
    }
    const double sum = va + vb + vc;
    return {va / sum, vb / sum, vc / sum};
}

const MeshInstance* find(const Document& document, Id id) {
    for (const MeshInstance& mesh : document.meshes)
        if (mesh.id == id && mesh.mesh != nullptr)
            return &mesh;
    return nullptr;
}

std::array<std::size_t, 3> corners(const Mesh& mesh, std::size_t triangle) {
    return {mesh.indices[3 * triangle], mesh.indices[3 * triangle + 1],
            mesh.indices[3 * triangle + 2]};
}

// The elements whose weighted sum is the point's, from the vectors of VertexBake and TexelBake.
template <class Bake>
PointTransfer gather(const Bake& bake, int order, const std::array<std::size_t, 3>& elements,
                     const glm::vec3& weights) {
    const auto stride = static_cast<std::size_t>(bake.stride);
    PointTransfer result{order, std::vector<float>(stride, 0.0f), {}};
    if (!bake.bounced.empty())
        result.bounced.assign(stride, glm::vec3(0.0f));
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t i = 0; i < stride; ++i) {
            const std::size_t from = elements[k] * stride + i;
            const float weight = weights[static_cast<glm::length_t>(k)];
            result.direct[i] += weight * bake.values[from];
            if (!bake.bounced.empty())
                result.bounced[i] +=
                    weight * glm::vec3(bake.bounced[3 * from], bake.bounced[3 * from + 1],
                                       bake.bounced[3 * from + 2]);
        }
    return result;
}

template <class Use>
void forEachOf(int order, unsigned bands, const Use& use) {
    std::size_t i = 0;
    for (int l = 0; l < order; ++l)
        for (int m = -l; m <= l; ++m, ++i)
            if ((bands >> static_cast<unsigned>(l) & 1u) != 0)
                use(i);
}

} // namespace

std::optional<MeshPoint> nearestMeshPoint(const Document& document, Id id,
                                          const glm::vec3& position) {
    const MeshInstance* instance = find(document, id);
    if (instance == nullptr)
        return std::nullopt;
    const Mesh& mesh = *instance->mesh;
    const glm::dmat4 transform(instance->placement.matrix());
    std::vector<glm::dvec3> world;
    world.reserve(mesh.positions.size());
    for (const glm::vec3& p : mesh.positions)
        world.emplace_back(transform * glm::dvec4(glm::dvec3(p), 1.0));
    std::optional<MeshPoint> best;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
        const auto [a, b, c] = corners(mesh, t);
        const glm::dvec3 w = nearestWeights(position, world[a], world[b], world[c]);
        const glm::dvec3 away =
            w.x * world[a] + w.y * world[b] + w.z * world[c] - glm::dvec3(position);
        if (const double distance = glm::dot(away, away); distance < nearest) {
            nearest = distance;
            best = MeshPoint{id, t, glm::vec3(w)};
        }
    }
    return best;
}

std::size_t texelOf(const Mesh& mesh, const MeshPoint& point, int side) {
    const auto [a, b, c] = corners(mesh, point.triangle);
    const glm::vec2 uv = point.weights.x * mesh.uvs[a] + point.weights.y * mesh.uvs[b] +
                         point.weights.z * mesh.uvs[c];
    const auto texel = [side](float at) {
        const float wrapped = (at - std::floor(at)) * static_cast<float>(side);
        return static_cast<std::size_t>(std::min(static_cast<int>(wrapped), side - 1));
    };
    return texel(uv.y) * static_cast<std::size_t>(side) + texel(uv.x);
}

glm::vec3 PointTransfer::radiance(const std::vector<glm::vec3>& light, unsigned bands) const {
    glm::vec3 sum(0.0f);
    forEachOf(order, bands, [&](std::size_t i) { sum += light[i] * coefficient(i); });
    return sum;
}

glm::vec3 PointTransfer::bouncedRadiance(const std::vector<glm::vec3>& light,
                                         unsigned bands) const {
    glm::vec3 sum(0.0f);
    if (!bounced.empty())
        forEachOf(order, bands, [&](std::size_t i) { sum += light[i] * bounced[i]; });
    return sum;
}

float PointTransfer::towards(const glm::vec3& direction, unsigned bands) const {
    std::array<float, kMaxShOrder * kMaxShOrder> y{};
    evaluateSh(order, direction, std::span(y).first(direct.size()));
    float sum = 0.0f;
    forEachOf(order, bands, [&](std::size_t i) {
        const glm::vec3 t = coefficient(i);
        sum += y[i] * (t.x + t.y + t.z) / 3.0f;
    });
    return sum;
}

std::optional<PointTransfer> pointTransfer(const Document& document, const BakeArtifact& bake,
                                           const MeshPoint& point) {
    const MeshInstance* instance = find(document, point.mesh);
    if (instance == nullptr || !holdsTransfer(bake.kind))
        return std::nullopt;
    const Mesh& mesh = *instance->mesh;
    const auto stride = static_cast<std::size_t>(bake.order) * static_cast<std::size_t>(bake.order);
    const std::array<std::size_t, 3> of = corners(mesh, point.triangle);
    for (const VertexBake& vertices : bake.vertices)
        if (vertices.mesh == point.mesh && vertices.values.size() == mesh.vertexCount() * stride)
            return gather(vertices, bake.order, of, point.weights);
    for (const TexelBake& texels : bake.texels) {
        if (texels.material != instance->material || texels.side < 1 || texels.values.empty())
            continue;
        const std::size_t element = texelOf(mesh, point, texels.side);
        return gather(texels, bake.order, {element, element, element}, point.weights);
    }
    return std::nullopt;
}

Result<std::vector<bool>> visibleDirections(const BakeInputs& inputs, const MeshPoint& point,
                                            int height, const JobContext& job) {
    const Result<BakeScene> scene = BakeScene::build(inputs, job);
    if (!scene)
        return scene.error();
    const int width = 2 * height;
    std::vector<bool> visible(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (const BakeGeometryMesh& mesh : scene->geometry->meshes) {
        if (mesh.id != point.mesh)
            continue;
        const auto of = corners(*mesh.mesh, point.triangle);
        glm::vec3 origin(0.0f), normal(0.0f);
        for (std::size_t k = 0; k < 3; ++k) {
            const float weight = point.weights[static_cast<glm::length_t>(k)];
            origin += weight * mesh.positions[of[k]];
            normal += weight * mesh.normals[of[k]];
        }
        normal = glm::normalize(normal);
        std::vector<OcclusionRay> rays(visible.size());
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                OcclusionRay& ray = rays[static_cast<std::size_t>(y * width + x)];
                ray.origin = origin + kRayOffset * normal;
                ray.direction = latLongDirection(x, y, width, height);
            }
        scene->rays.occlude(rays);
        for (int i = 0; i < width * height; ++i)
            visible[static_cast<std::size_t>(i)] =
                !rays[static_cast<std::size_t>(i)].occluded() &&
                glm::dot(latLongDirection(i % width, i / width, width, height), normal) > 0.0f;
    }
    if (job.cancelled())
        return Error{ErrorKind::Cancelled, "looking around was cancelled", {}, {}};
    return visible;
}

glm::vec3 latLongDirection(int x, int y, int width, int height) {
    constexpr float kPi = std::numbers::pi_v<float>;
    const float phi =
        2.0f * kPi * ((static_cast<float>(x) + 0.5f) / static_cast<float>(width) - 0.5f);
    const float theta = kPi * (static_cast<float>(y) + 0.5f) / static_cast<float>(height);
    return {std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)};
}

} // namespace patina
