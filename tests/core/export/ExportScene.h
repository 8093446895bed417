// Small documents and images to export, and a reader for what came out.
#pragma once

#include "core/document/Document.h"
#include "core/export/ExportContents.h"
#include "core/export/GltfWriter.h"
#include "core/material/Material.h"

#include <cstring>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace patina::test {

using Json = nlohmann::json;

// A unit square in the xy plane, facing +Z, of two triangles.
inline MeshPtr squareMesh(const std::string& name = "square") {
    Mesh mesh;
    mesh.name = name;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.normals.assign(4, {0, 0, 1});
    mesh.tangents.assign(4, {1, 0, 0, 1});
    mesh.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return std::make_shared<const Mesh>(std::move(mesh));
}

inline ImagePtr codes(int width, int height, int channels, const std::vector<int>& values,
                      ColorEncoding encoding = ColorEncoding::Data) {
    Image image(width, height, channels, PixelType::U8, encoding);
    for (std::size_t i = 0; i < image.u8().size(); ++i)
        image.u8()[i] = static_cast<std::uint8_t>(values[i % values.size()]);
    return std::make_shared<const Image>(std::move(image));
}

inline MapSlot map(ImagePtr image, MapChannel channel = MapChannel::Rgb) {
    MapSlot slot;
    slot.source = "/textures/map.png";
    slot.image = std::move(image);
    slot.channel = channel;
    return slot;
}

inline Material& addMaterial(Document& document, const std::string& name) {
    Material material;
    material.id = document.takeId();
    material.name = name;
    document.materials.push_back(material);
    return document.materials.back();
}

inline MeshInstance& addSquare(Document& document, Id material, MeshPtr mesh = squareMesh()) {
    MeshInstance instance;
    instance.id = document.takeId();
    instance.name = mesh->name;
    instance.mesh = std::move(mesh);
    instance.material = material;
    document.meshes.push_back(instance);
    return document.meshes.back();
}

inline ExportSettings glbSettings() {
    ExportSettings settings;
    settings.output = "/nowhere/out.glb";
    return settings;
}

// What a glTF reader sees.
struct ReadGltf {
    Json json;
    Bytes buffer;

    template <class T>
    [[nodiscard]] std::vector<T> values(int accessor) const {
        const Json& a = json.at("accessors").at(static_cast<std::size_t>(accessor));
        const Json& view = json.at("bufferViews").at(a.at("bufferView").get<std::size_t>());
        const auto offset = view.at("byteOffset").get<std::size_t>();
        std::vector<T> result(a.at("count").get<std::size_t>());
        EXPECT_EQ(view.at("byteLength").get<std::size_t>(), result.size() * sizeof(T));
        EXPECT_EQ(offset % 4, 0u);
        std::memcpy(result.data(), buffer.data() + offset, result.size() * sizeof(T));
        return result;
    }
    template <class T>
    [[nodiscard]] std::vector<T> attribute(std::size_t mesh, const char* name) const {
        const Json& primitive = json.at("meshes").at(mesh).at("primitives").at(0);
        return values<T>(primitive.at("attributes").at(name).get<int>());
    }
};

// Writes without encoding: each image stands as four bytes.
inline ReadGltf write(const Document& document, const ExportSettings& settings = glbSettings()) {
    const ExportContents contents = gatherContents(document, settings);
    const std::vector<Bytes> images(contents.textures.textures.size(), Bytes(5, std::byte{7}));
    Result<GltfOutput> output = writeGltf(contents, settings, images);
    EXPECT_TRUE(output.ok());
    return {Json::parse(output->json), output->buffer};
}

} // namespace patina::test
