#include "core/bake/TexelPositions.h"

#include "core/bake/Bake.h"
#include "core/bake/BakePoints.h"
#include "core/bake/GutterFill.h"
#include "core/base/Check.h"

#include <array>

namespace patina {

std::vector<glm::vec4> texelPositions(const Document& document, Id material, int side) {
    CHECK(side > 0);
    const std::size_t count = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
    std::vector<glm::vec4> positions(count, glm::vec4(0.0f, 0.0f, 0.0f, 1.0f));
    BakeInputs inputs = bakeInputs(document);
    std::erase_if(inputs.meshes, [&](const BakeMesh& mesh) {
        return mesh.material != material || mesh.mesh->uvs.size() != mesh.mesh->positions.size();
    });
    const Result<BakeGeometry> geometry = makeBakeGeometry(inputs, {});
    if (!geometry)
        return positions;

    const TexelPoints texels = texelPoints(*geometry, material, side, {});
    std::vector<float> values(4 * count, 0.0f);
    std::vector<std::uint8_t> known(count, 0);
    for (std::size_t t = 0; t < texels.texels.size(); ++t) {
        const std::uint32_t first = texels.firstPoint[t], end = texels.firstPoint[t + 1];
        glm::vec3 sum(0.0f);
        for (std::uint32_t p = first; p < end; ++p)
            sum += texels.points[p].origin;
        const glm::vec3 mean(geometry->centre +
                             glm::dvec3(sum) / (geometry->unitsPerMetre * (end - first)));
        const std::size_t at = texels.texels[t];
        for (int c = 0; c < 3; ++c)
            values[4 * at + static_cast<std::size_t>(c)] = mean[c];
        known[at] = 1;
    }
    constexpr std::array<float, 4> kNowhere{};
    fillGutters(values, std::move(known), side, kNowhere);
    for (std::size_t i = 0; i < count; ++i)
        positions[i] = {values[4 * i], values[4 * i + 1], values[4 * i + 2], 1.0f};
    return positions;
}

} // namespace patina
