#include "tests/core/trace/CornellScene.h"

#include <array>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

namespace patina::test {
namespace {

using Quad = std::array<glm::vec3, 4>;

TraceMesh meshOf(const std::vector<Quad>& quads, std::size_t material) {
    Mesh mesh;
    for (const Quad& quad : quads)
        for (const std::array<int, 3>& corners : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
            const auto at = [&](std::size_t i) {
                return quad[static_cast<std::size_t>(corners[i])] / 1000.0f;
            };
            const glm::vec3 normal = glm::normalize(glm::cross(at(1) - at(0), at(2) - at(0)));
            for (std::size_t i = 0; i < 3; ++i) {
                mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
                mesh.positions.push_back(at(i));
                mesh.normals.push_back(normal);
                mesh.tangents.emplace_back(1, 0, 0, 1);
                mesh.uvs.emplace_back(0.0f);
            }
        }
    return {static_cast<Id>(material + 1), std::make_shared<const Mesh>(std::move(mesh)),
            glm::mat4(1.0f), material};
}

} // namespace

TraceInputs cornellBox(const CornellWalls& walls, bool blocks) {
    TraceInputs inputs;
    inputs.model.fresnel = Fresnel::Dielectric; // of index 1: nothing is reflected
    inputs.model.ior = 1.0f;
    for (const glm::vec3& color : {walls.white, walls.red, walls.green, glm::vec3(0.0f)}) {
        Material& material = inputs.materials.emplace_back();
        material.baseColor = color;
    }
    inputs.materials[3].emissive = glm::vec3(1.0f);
    const float y = 548.8f, z = 559.2f;
    std::vector<Quad> white{{{{552.8f, 0, 0}, {0, 0, 0}, {0, 0, z}, {549.6f, 0, z}}},
                            {{{549.6f, 0, z}, {0, 0, z}, {0, y, z}, {556, y, z}}},
                            // The ceiling around the lamp.
                            {{{556, y, 0}, {556, y, 227}, {0, y, 227}, {0, y, 0}}},
                            {{{556, y, 332}, {556, y, z}, {0, y, z}, {0, y, 332}}},
                            {{{556, y, 227}, {556, y, 332}, {343, y, 332}, {343, y, 227}}},
                            {{{213, y, 227}, {213, y, 332}, {0, y, 332}, {0, y, 227}}}};
    if (blocks)
        white.insert(white.end(),
                     {{{{130, 165, 65}, {82, 165, 225}, {240, 165, 272}, {290, 165, 114}}},
                      {{{290, 0, 114}, {290, 165, 114}, {240, 165, 272}, {240, 0, 272}}},
                      {{{130, 0, 65}, {130, 165, 65}, {290, 165, 114}, {290, 0, 114}}},
                      {{{82, 0, 225}, {82, 165, 225}, {130, 165, 65}, {130, 0, 65}}},
                      {{{240, 0, 272}, {240, 165, 272}, {82, 165, 225}, {82, 0, 225}}},
                      {{{423, 330, 247}, {265, 330, 296}, {314, 330, 456}, {472, 330, 406}}},
                      {{{423, 0, 247}, {423, 330, 247}, {472, 330, 406}, {472, 0, 406}}},
                      {{{472, 0, 406}, {472, 330, 406}, {314, 330, 456}, {314, 0, 456}}},
                      {{{314, 0, 456}, {314, 330, 456}, {265, 330, 296}, {265, 0, 296}}},
                      {{{265, 0, 296}, {265, 330, 296}, {423, 330, 247}, {423, 0, 247}}}});
    inputs.meshes = {meshOf(white, 0),
                     meshOf({{{{552.8f, 0, 0}, {549.6f, 0, z}, {556, y, z}, {556, y, 0}}}}, 1),
                     meshOf({{{{0, 0, z}, {0, 0, 0}, {0, y, 0}, {0, y, z}}}}, 2),
                     meshOf({{{{343, y, 227}, {343, y, 332}, {213, y, 332}, {213, y, 227}}}}, 3)};
    return inputs;
}

} // namespace patina::test
