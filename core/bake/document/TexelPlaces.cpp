#include "core/bake/document/TexelPlaces.h"

#include "core/bake/document/DocumentBakeInputs.h"
#include "core/bake/domain/BakePoints.h"
#include "core/bake/domain/GutterFill.h"
#include "core/base/Check.h"

#include <array>
#include <glm/geometric.hpp>

namespace patina {
namespace {

constexpr std::size_t kNumbers = 6; // of a place

glm::vec3 unitOrZero(const glm::vec3& v) {
    const float length = glm::length(v);
    return length > 1e-6f ? v / length : glm::vec3(0.0f);
}

} // namespace

std::vector<TexelPlace> texelPlaces(const Document& document, Id material, int side) {
    CHECK(side > 0);
    const std::size_t count = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
    std::vector<TexelPlace> places(count);
    BakeInputs inputs = bakeInputs(document);
    std::erase_if(inputs.meshes, [&](const BakeMesh& mesh) {
        return mesh.material != material || mesh.mesh->uvs.size() != mesh.mesh->positions.size();
    });
    const Result<BakeGeometry> geometry = makeBakeGeometry(inputs, {});
    if (!geometry)
        return places;

    const TexelPoints texels = texelPoints(*geometry, material, side, {});
    std::vector<float> values(kNumbers * count, 0.0f);
    std::vector<std::uint8_t> known(count, 0);
    for (std::size_t t = 0; t < texels.texels.size(); ++t) {
        const std::uint32_t first = texels.firstPoint[t], end = texels.firstPoint[t + 1];
        glm::vec3 sum(0.0f), normals(0.0f);
        for (std::uint32_t p = first; p < end; ++p) {
            sum += texels.points[p].origin;
            normals += texels.points[p].normal;
        }
        const glm::vec3 mean(geometry->centre +
                             glm::dvec3(sum) / (geometry->unitsPerMetre * (end - first)));
        const glm::vec3 normal = unitOrZero(normals);
        const std::size_t at = texels.texels[t];
        for (int c = 0; c < 3; ++c) {
            values[kNumbers * at + static_cast<std::size_t>(c)] = mean[c];
            values[kNumbers * at + 3 + static_cast<std::size_t>(c)] = normal[c];
        }
        known[at] = 1;
    }
    constexpr std::array<float, kNumbers> kNowhere{};
    fillGutters(values, std::move(known), side, kNowhere);
    for (std::size_t i = 0; i < count; ++i) {
        const float* v = values.data() + kNumbers * i;
        places[i] = {{v[0], v[1], v[2], 1.0f}, {unitOrZero({v[3], v[4], v[5]}), 0.0f}};
    }
    return places;
}

} // namespace patina
