#include "tests/core/trace/TraceBall.h"

#include <cmath>
#include <numbers>

namespace patina::test {

ImagePtr uniformSky(float radiance) {
    Image image(8, 4, 3, PixelType::F32, ColorEncoding::Linear);
    for (float& sample : image.f32())
        sample = radiance;
    return std::make_shared<const Image>(std::move(image));
}

MeshPtr ball(int rings) {
    Mesh mesh;
    for (int j = 0; j <= rings; ++j)
        for (int i = 0; i <= 2 * rings; ++i) {
            const double theta = std::numbers::pi * j / rings, phi = std::numbers::pi * i / rings;
            const glm::vec3 n(glm::dvec3(std::sin(theta) * std::sin(phi), std::cos(theta),
                                         std::sin(theta) * std::cos(phi)));
            mesh.positions.push_back(n);
            mesh.normals.push_back(n);
            mesh.tangents.emplace_back(std::cos(phi), 0.0f, -std::sin(phi), 1.0f);
            mesh.uvs.emplace_back(static_cast<float>(i) / (2.0f * static_cast<float>(rings)),
                                  static_cast<float>(j) / static_cast<float>(rings));
        }
    const auto row = static_cast<std::uint32_t>(2 * rings + 1);
    for (std::uint32_t j = 0; j < static_cast<std::uint32_t>(rings); ++j)
        for (std::uint32_t i = 0; i + 1 < row; ++i) {
            const std::uint32_t a = j * row + i, b = a + row;
            if (j > 0)
                mesh.indices.insert(mesh.indices.end(), {a, b + 1, a + 1});
            if (j + 1 < static_cast<std::uint32_t>(rings))
                mesh.indices.insert(mesh.indices.end(), {a, b, b + 1});
        }
    return std::make_shared<const Mesh>(std::move(mesh));
}

TraceInputs ballUnderSky(const Material& material, float radiance) {
    TraceInputs inputs;
    inputs.materials = {material};
    inputs.meshes = {{1, ball(96), glm::mat4(1.0f), 0}};
    inputs.environments = {{uniformSky(radiance), 0.0f, glm::vec3(1.0f)}};
    return inputs;
}

} // namespace patina::test
