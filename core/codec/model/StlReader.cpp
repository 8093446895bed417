#include "core/codec/model/StlReader.h"

#include "core/base/Limits.h"
#include "core/codec/Codec.h"
#include "core/codec/TokenReader.h"
#include "core/mesh/MeshSource.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace patina::codec {

namespace {

constexpr std::size_t kBinaryHeader = 84;
constexpr std::size_t kBinaryTriangle = 50; // normal, three corners, 16 bits of attributes

[[noreturn]] void refuseStl(const char* detail) {
    throw Refusal("the file is damaged or cut short; export or download it again", detail);
}

// The normals in the file are often zero or wrong; the order of the corners is what counts.
void addTriangle(Mesh& mesh, const std::array<glm::vec3, 3>& corners) {
    const glm::vec3 area = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const float length = glm::length(area);
    for (const glm::vec3& corner : corners) {
        mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
        mesh.positions.push_back(corner);
        mesh.normals.push_back(length > 0.0f ? area / length : glm::vec3(0, 1, 0));
    }
}

std::size_t binaryCount(std::span<const std::byte> bytes) {
    std::uint32_t count = 0;
    if (bytes.size() >= kBinaryHeader)
        std::memcpy(&count, bytes.data() + kBinaryHeader - sizeof count, sizeof count);
    return count;
}

Mesh readBinary(std::span<const std::byte> bytes) {
    const std::size_t count = binaryCount(bytes);
    if (bytes.size() < kBinaryHeader || count > (bytes.size() - kBinaryHeader) / kBinaryTriangle)
        refuseStl("stl: fewer triangles than announced");
    if (count > limits::kMaxTriangles)
        throw Refusal("the model is larger than the supported 50 million triangles");
    Mesh mesh;
    mesh.positions.reserve(count * 3);
    mesh.normals.reserve(count * 3);
    mesh.indices.reserve(count * 3);
    for (std::size_t i = 0; i < count; ++i) {
        std::array<glm::vec3, 3> corners{};
        std::memcpy(corners.data(),
                    bytes.data() + kBinaryHeader + i * kBinaryTriangle + sizeof(glm::vec3),
                    sizeof corners);
        addTriangle(mesh, corners);
    }
    return mesh;
}

// Solids become meshes of their own.
std::vector<Mesh> readText(std::string_view text) {
    std::vector<Mesh> solids;
    TokenReader reader(text);
    std::array<glm::vec3, 3> corners{};
    std::size_t corner = 0;
    bool open = false;
    for (std::string_view word = reader.word(); !word.empty(); word = reader.word()) {
        if (word == "solid") {
            std::string_view name = reader.line();
            name.remove_prefix(std::min(name.find_first_not_of(" \t"), name.size()));
            solids.emplace_back().name = name;
            open = true;
        } else if (word == "endsolid") {
            reader.line();
            open = false;
        } else if (word == "facet") {
            corner = 0;
        } else if (word == "vertex") {
            glm::vec3 position(0.0f);
            for (int c = 0; c < 3; ++c) {
                const auto value = reader.number();
                if (!value)
                    refuseStl("stl: a corner without three numbers");
                position[c] = static_cast<float>(*value);
            }
            if (corner >= 3 || solids.empty())
                refuseStl("stl: a facet with more than three corners");
            corners[corner++] = position;
        } else if (word == "endfacet") {
            if (corner != 3 || solids.empty())
                refuseStl("stl: a facet without three corners");
            addTriangle(solids.back(), corners);
        }
    }
    if (open)
        refuseStl("stl: no endsolid");
    return solids;
}

} // namespace

ImportedModel readStl(const ModelFolder& folder) {
    const auto file = folder.open(folder.modelPath());
    if (!file)
        throw Refusal("the file cannot be read");
    // Binary files may begin with "solid", too; their size gives them away.
    const auto bytes = file->bytes();
    const bool exact = bytes.size() >= kBinaryHeader &&
                       bytes.size() == kBinaryHeader + kBinaryTriangle * binaryCount(bytes);
    constexpr std::size_t kBeginning = 1024;
    const std::string_view beginning = file->text().substr(0, kBeginning);
    const bool text = !exact && beginning.starts_with("solid") &&
                      (beginning.find("facet") != std::string_view::npos ||
                       beginning.find("endsolid") != std::string_view::npos);
    std::vector<Mesh> meshes;
    if (text)
        meshes = readText(file->text());
    else
        meshes.push_back(readBinary(bytes));

    ImportedModel model;
    model.format = "stl";
    for (std::size_t solid = 0; solid < meshes.size(); ++solid) {
        Mesh& mesh = meshes[solid];
        if (mesh.indices.empty())
            continue;
        if (mesh.name.empty())
            mesh.name = folder.modelPath().stem().string();
        ImportedInstance instance;
        instance.name = mesh.name;
        instance.mesh = static_cast<int>(model.meshes.size());
        model.instances.push_back(instance);
        model.meshes.push_back(withOwnVertices(std::move(mesh), static_cast<int>(solid)));
    }
    return model;
}

} // namespace patina::codec
