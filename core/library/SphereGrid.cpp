// Twenty-five balls, metallic over roughness: what a shading model makes of each, at a glance.
#include "core/library/Meshes.h"
#include "core/material/Material.h"

#include <array>
#include <glm/vec3.hpp>

namespace patina::library {

std::vector<ModelPart> sphereGrid() {
    constexpr int kSteps = 5;
    constexpr float kSpacing = 0.4f, kRadius = 0.18f; // metres
    constexpr std::array<const char*, kSteps> kValues = {"0", "0.25", "0.5", "0.75", "1"};
    const Mesh ball = makeSphere(64, 32); // radius 0.5 m, standing on y = 0
    std::vector<ModelPart> parts;
    for (int row = 0; row < kSteps; ++row)
        for (int column = 0; column < kSteps; ++column) {
            Mesh mesh = ball;
            const glm::vec3 place(kSpacing * static_cast<float>(column - kSteps / 2),
                                  kSpacing * static_cast<float>(row), 0.0f);
            for (glm::vec3& position : mesh.positions)
                position = 2.0f * kRadius * position + place;
            Material m;
            m.name = std::string("Metallic ") + kValues[static_cast<std::size_t>(row)] +
                     ", Roughness " + kValues[static_cast<std::size_t>(column)];
            m.baseColor = {0.86f, 0.45f, 0.26f};
            m.metallic = static_cast<float>(row) / (kSteps - 1);
            m.perceptualRoughness = static_cast<float>(column) / (kSteps - 1);
            parts.push_back(makePart(m.name.c_str(), std::move(mesh), m));
        }
    return parts;
}

} // namespace patina::library
