#include "core/radiosity/document/PlyFile.h"

#include "core/math/Shading.h"
#include "core/radiosity/document/Reexpose.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <fmt/format.h>

namespace patina {

static_assert(std::endian::native == std::endian::little, "the file is written as memory has it");

Bytes litPly(const LitDocument& lit) {
    std::size_t vertices = 0, triangles = 0;
    for (const MeshInstance& instance : lit.document.meshes) {
        vertices += instance.mesh->vertexCount();
        triangles += instance.mesh->triangleCount();
    }
    std::string header = fmt::format("ply\nformat binary_little_endian 1.0\n"
                                     "comment radiosity by Patina\nelement vertex {}\n",
                                     vertices);
    for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "s", "t"})
        header += fmt::format("property float {}\n", name);
    for (const char* name : {"red", "green", "blue"})
        header += fmt::format("property uchar {}\n", name);
    for (const char* name : {"radiance_r", "radiance_g", "radiance_b"})
        header += fmt::format("property float {}\n", name);
    header += fmt::format("element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
                          triangles);
    Bytes file;
    const auto add = [&file](const auto& value) {
        const auto* bytes = reinterpret_cast<const std::byte*>(&value);
        file.insert(file.end(), bytes, bytes + sizeof value);
    };
    for (const char c : header)
        file.push_back(static_cast<std::byte>(c));
    for (const MeshInstance& instance : lit.document.meshes) {
        const LitVertices& light = lit.lit->at(instance.id);
        // There are no textures in it, so that all colours show what leaves.
        const std::vector<glm::vec3> colors =
            exposedColors(light.radiance, lit.exposure.value_or(0.0));
        for (std::size_t v = 0; v < instance.mesh->vertexCount(); ++v) {
            add(instance.mesh->positions[v]);
            add(instance.mesh->normals[v]);
            add(instance.mesh->uvs[v]);
            for (int c = 0; c < 3; ++c)
                add(static_cast<std::uint8_t>(
                    std::lround(255.0f * shading::srgbEncode(colors[v][c]))));
            add(light.radiance[v]);
        }
    }
    std::uint32_t first = 0;
    for (const MeshInstance& instance : lit.document.meshes) {
        const std::vector<std::uint32_t>& indices = instance.mesh->indices;
        for (std::size_t i = 0; i < indices.size(); i += 3) {
            add(std::uint8_t{3});
            for (std::size_t k = 0; k < 3; ++k)
                add(first + indices[i + k]);
        }
        first += static_cast<std::uint32_t>(instance.mesh->vertexCount());
    }
    return file;
}

} // namespace patina
