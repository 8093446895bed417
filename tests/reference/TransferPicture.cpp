#include "tests/reference/TransferPicture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace patina::reference {
namespace {

// Elements of a bake and how much each counts.
struct Blend {
    const std::vector<float>* values = nullptr;
    const std::vector<float>* bounced = nullptr;
    int stride = 0;
    std::array<std::pair<std::size_t, double>, 4> elements{};
};

Blend vertexBlend(const ReferenceScene& scene, const BakeArtifact& artifact, const Place& place) {
    const BakeMesh& mesh = scene.inputs().meshes[place.mesh];
    Blend blend;
    for (const VertexBake& bake : artifact.vertices)
        if (bake.mesh == mesh.id)
            blend = {&bake.values, &bake.bounced, bake.stride, {}};
    const std::uint32_t* corner = mesh.mesh->indices.data() + std::size_t{3} * place.triangle;
    blend.elements = {{{corner[0], 1.0 - place.b1 - place.b2},
                       {corner[1], place.b1},
                       {corner[2], place.b2},
                       {corner[0], 0.0}}};
    return blend;
}

Blend texelBlend(const ReferenceScene& scene, const BakeArtifact& artifact, const Place& place) {
    const BakeMesh& mesh = scene.inputs().meshes[place.mesh];
    Blend blend;
    int side = 0;
    for (const TexelBake& bake : artifact.texels)
        if (bake.material == mesh.material) {
            blend = {&bake.values, &bake.bounced, bake.stride, {}};
            side = bake.side;
        }
    const std::uint32_t* corner = mesh.mesh->indices.data() + std::size_t{3} * place.triangle;
    const auto uv = [&](int i) { return glm::dvec2(mesh.mesh->uvs[corner[i]]); };
    const glm::dvec2 at =
        ((1.0 - place.b1 - place.b2) * uv(0) + place.b1 * uv(1) + place.b2 * uv(2)) * double(side) -
        0.5;
    const glm::dvec2 low = glm::floor(at), part = at - low;
    for (int i = 0; i < 4; ++i) {
        const auto wrapped = [side](double c) { return ((int(c) % side) + side) % side; };
        const int x = wrapped(low.x + i % 2), y = wrapped(low.y + i / 2);
        blend.elements[std::size_t(i)] = {std::size_t(y) * std::size_t(side) + std::size_t(x),
                                          (i % 2 ? part.x : 1.0 - part.x) *
                                              (i / 2 ? part.y : 1.0 - part.y)};
    }
    return blend;
}

} // namespace

std::vector<glm::dvec3> transferPicture(const ReferenceScene& scene,
                                        std::span<const std::optional<Place>> places,
                                        const BakeArtifact& artifact,
                                        std::span<const glm::vec3> light, int order, bool bounced) {
    std::vector<glm::dvec3> picture(places.size(), glm::dvec3(0.0));
    for (std::size_t p = 0; p < places.size(); ++p) {
        if (!places[p])
            continue;
        const Blend blend = isPerTexel(artifact.kind) ? texelBlend(scene, artifact, *places[p])
                                                      : vertexBlend(scene, artifact, *places[p]);
        for (const auto& [element, weight] : blend.elements)
            for (std::size_t i = 0; i < std::size_t(order * order); ++i) {
                const std::size_t at = element * std::size_t(blend.stride) + i;
                for (int c = 0; c < 3; ++c)
                    picture[p][c] +=
                        weight * double(light[i][c]) *
                        (double((*blend.values)[at]) +
                         (bounced ? double((*blend.bounced)[3 * at + std::size_t(c)]) : 0.0));
            }
        picture[p] *= places[p]->albedo;
    }
    return picture;
}

double Distance::relative() const {
    return std::sqrt(std::max(0.0, rmse * rmse - noise * noise)) / mean;
}

Distance distance(std::span<const std::optional<Place>> places, std::span<const glm::dvec3> picture,
                  std::span<const glm::dvec3> reference, std::span<const glm::dvec3> noise) {
    Distance result;
    double count = 0.0;
    for (std::size_t p = 0; p < places.size(); ++p) {
        if (!places[p])
            continue;
        const glm::dvec3 off = picture[p] - reference[p];
        result.mean += reference[p].x + reference[p].y + reference[p].z;
        result.bias += off.x + off.y + off.z;
        result.rmse += glm::dot(off, off);
        result.noise += glm::dot(noise[p], noise[p]);
        result.worst = std::max({result.worst, std::abs(off.x), std::abs(off.y), std::abs(off.z)});
        count += 3.0;
    }
    result.mean /= count;
    result.bias /= count;
    result.rmse = std::sqrt(result.rmse / count);
    result.noise = std::sqrt(result.noise / count);
    return result;
}

} // namespace patina::reference
