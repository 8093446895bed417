#include "core/codec/model/ModelCodec.h"
#include "core/codec/model/AssimpReader.h"
#include "core/codec/model/GltfContainer.h"
#include "core/codec/model/GltfKeys.h"
#include "core/codec/model/GltfReader.h"
#include "core/codec/model/ObjReader.h"
#include "core/codec/model/PlyReader.h"
#include "core/codec/model/StlReader.h"
#include "core/material/Material.h"
#include "core/worker/ModelWire.h"

#include <nlohmann/json.hpp>

namespace patina::codec {
namespace {

// What an OBJ file gives no name is called by Assimp's: the file's own is better, as of STL and
// PLY.
void nameByFile(ImportedModel& model, const std::string& stem) {
    constexpr std::string_view kUnnamed = "defaultobject";
    const auto rename = [&](std::string& name) {
        if (name.starts_with(kUnnamed))
            name.replace(0, kUnnamed.size(), stem);
    };
    for (const std::shared_ptr<Mesh>& mesh : model.meshes)
        rename(mesh->name);
    for (ImportedInstance& instance : model.instances)
        rename(instance.name);
}

// The path travels as numbers: it is bytes, not text.
std::filesystem::path pathOf(const nlohmann::json& request) {
    std::string bytes;
    for (const int byte : request.at("path"))
        bytes += static_cast<char>(byte);
    return bytes;
}

ModelFolder folderOf(const std::filesystem::path& path, const std::string& format, int payloadFd) {
    return {path.parent_path(), path.stem().string() + "." + format, payloadFd};
}

} // namespace

Reply listGltfKeys(const nlohmann::json& request, int payloadFd) {
    const ModelFolder folder = folderOf(pathOf(request), "gltf", payloadFd);
    const auto file = folder.open(folder.modelPath());
    if (!file)
        throw Refusal("the file cannot be read");
    auto rows = nlohmann::json::array();
    try {
        for (const ModelKey& key : gltfKeys(parseGltf(openGltfContainer(*file).text)))
            rows.push_back({key.key, static_cast<int>(key.use), key.why, key.count});
    } catch (const nlohmann::json::exception& exception) {
        throw Refusal("the file is damaged; export it again", exception.what());
    }
    Reply reply;
    reply.header = toJsonText({{"keys", std::move(rows)}});
    reply.payload = allocate(0);
    return reply;
}

Reply importModel(const nlohmann::json& request, int payloadFd) {
    const auto format = request.at("format").get<std::string>();
    const std::filesystem::path path = pathOf(request);
    const ModelFolder folder = folderOf(path, format, payloadFd);

    ImportedModel model =
        format == "gltf"  ? readGltf(folder)
        : format == "ply" ? readPly(folder)
        : format == "stl" ? readStl(folder)
        : format == "obj"
            ? readObj(folder)
            : readWithAssimp(folder, format, request.at("visualScene").get<std::string>());
    if (format == "obj")
        nameByFile(model, path.stem().string());
    if (model.materials.empty()) {
        model.materials.emplace_back();
        model.materials.back().name = "default";
    }
    if (model.meshes.empty() || model.instances.empty())
        throw Refusal("the model has no faces; export it with geometry");

    Reply reply;
    std::size_t size = 0;
    reply.header = writeModelHeader(model, size);
    reply.payload = allocate(size);
    writeModelPayload(model, reply.payload.writable());
    return reply;
}

} // namespace patina::codec
