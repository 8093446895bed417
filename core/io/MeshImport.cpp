#include "core/io/MeshImport.h"

#include "core/base/InputFile.h"
#include "core/base/Limits.h"
#include "core/base/LowerCase.h"
#include "core/base/Utf8.h"
#include "core/io/SpecularGlossiness.h"
#include "core/io/TexturePaths.h"
#include "core/material/Material.h"
#include "core/mesh/MeshSource.h"
#include "core/worker/ModelWire.h"
#include "core/worker/WorkerClient.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <set>

namespace patina {

namespace {

namespace fs = std::filesystem;

// The worker's name of the format; glTF and GLB are told apart by content.
std::string formatOf(const fs::path& file) {
    const std::string extension = extensionOf(file);
    const auto& known = modelExtensions();
    if (std::find(known.begin(), known.end(), extension) == known.end())
        return {};
    return extension == ".glb" ? "gltf" : extension.substr(1);
}

// A path as numbers.
nlohmann::json pathBytes(const fs::path& file) {
    auto path = nlohmann::json::array();
    for (const char c : file.native())
        path.push_back(static_cast<int>(static_cast<unsigned char>(c)));
    return path;
}

Result<ImportedModel> decode(WorkerClient& worker, const fs::path& file, const std::string& format,
                             const std::string& visualScene, int fd) {
    const fs::path readable = insideCanonicalFolder(file);
    const nlohmann::json header = {{"op", "importModel"},
                                   {"format", format},
                                   {"visualScene", makeValidUtf8(visualScene)},
                                   {"path", pathBytes(readable)}};
    const auto reply = worker.request(WorkerKind::Model, header.dump(), fd, file, {}, readable);
    if (!reply)
        return reply.error();
    auto model = readModel(reply->header, reply->payload.bytes());
    if (!model) {
        Error error = model.error();
        error.file = file;
        return error;
    }
    return model;
}

// Instances that cannot be drawn: no volume left, or numbers without end.
void dropFlatInstances(ImportedModel& model) {
    constexpr float kSmallestVolume = 1e-30f; // below, the normal matrix overflows
    const std::size_t before = model.instances.size();
    std::erase_if(model.instances, [](const ImportedInstance& instance) {
        const float volume = std::abs(glm::determinant(glm::mat3(instance.transform)));
        return !(volume > kSmallestVolume) || !std::isfinite(volume);
    });
    if (const std::size_t dropped = before - model.instances.size(); dropped > 0)
        model.warnings.push_back(
            fmt::format("{} objects scaled to nothing were left out.", dropped));
}

Mesh mirrored(const Mesh& mesh) {
    Mesh result = mesh;
    for (glm::vec3& p : result.positions)
        p.x = -p.x;
    for (glm::vec3& n : result.normals)
        n.x = -n.x;
    for (glm::vec4& t : result.tangents)
        t = {-t.x, t.y, t.z, -t.w};
    for (std::size_t i = 0; i + 2 < result.indices.size(); i += 3)
        std::swap(result.indices[i + 1], result.indices[i + 2]);
    return result;
}

MeshSource mirrored(MeshSource source) {
    source.mirrored = !source.mirrored;
    return source;
}

// A transform that mirrors would turn the winding around. The mirror is moved into a copy of the
// mesh, M = (M S) S with S = diag(-1, 1, 1), so that every transform keeps the handedness.
void resolveMirrors(ImportedModel& model) {
    std::map<int, int> copies; // mesh → its mirrored copy
    std::size_t count = 0;
    for (ImportedInstance& instance : model.instances) {
        if (glm::determinant(glm::mat3(instance.transform)) > 0.0f)
            continue;
        const auto [copy, isNew] =
            copies.try_emplace(instance.mesh, static_cast<int>(model.meshes.size()));
        if (isNew) {
            const std::shared_ptr<Mesh> mesh =
                model.meshes[static_cast<std::size_t>(instance.mesh)];
            const MeshSource* source = meshSource(mesh);
            model.meshes.push_back(source != nullptr
                                       ? withSource(mirrored(*mesh), mirrored(*source))
                                       : std::make_shared<Mesh>(mirrored(*mesh)));
        }
        instance.mesh = copy->second;
        instance.transform[0] = -instance.transform[0];
        ++count;
    }
    if (count > 0)
        model.warnings.push_back(
            fmt::format("{} mirrored objects were turned into meshes of their own.", count));
}

// Keeps the meshes somebody uses and still have triangles.
void dropUnused(ImportedModel& model) {
    std::erase_if(model.instances, [&](const ImportedInstance& instance) {
        return model.meshes[static_cast<std::size_t>(instance.mesh)]->indices.empty();
    });
    std::vector<int> newIndex(model.meshes.size(), -1);
    std::vector<std::shared_ptr<Mesh>> kept;
    for (ImportedInstance& instance : model.instances) {
        int& index = newIndex[static_cast<std::size_t>(instance.mesh)];
        if (index < 0) {
            index = static_cast<int>(kept.size());
            kept.push_back(model.meshes[static_cast<std::size_t>(instance.mesh)]);
        }
        instance.mesh = index;
    }
    model.meshes = std::move(kept);
}

void repair(ImportedModel& model) {
    MeshRepairs& sum = model.repairs;
    for (const std::shared_ptr<Mesh>& mesh : model.meshes) {
        const MeshRepairs repairs = sanitizeMesh(mesh);
        sum.droppedTriangles += repairs.droppedTriangles;
        sum.invalidTriangles += repairs.invalidTriangles;
        sum.repairedNormals += repairs.repairedNormals;
        sum.generatedNormals |= repairs.generatedNormals;
        sum.generatedTangents |= repairs.generatedTangents;
        sum.generatedUvs |= repairs.generatedUvs;
    }
    const auto warn = [&](bool when, std::string text) {
        if (when)
            model.warnings.push_back(std::move(text));
    };
    warn(sum.droppedTriangles > 0,
         fmt::format("{} degenerate triangles were dropped.", sum.droppedTriangles));
    warn(sum.invalidTriangles > 0,
         fmt::format("{} triangles with invalid vertices were dropped.", sum.invalidTriangles));
    warn(sum.repairedNormals > 0, fmt::format("{} normals were repaired.", sum.repairedNormals));
    warn(sum.generatedNormals, "Normals were generated, as the file has none.");
    warn(sum.generatedUvs, "Texture coordinates were generated, as the file has none.");
}

// Which nodes show a mesh, now that the list of instances is final.
void noteUses(const ImportedModel& model) {
    for (std::size_t i = 0; i < model.instances.size(); ++i)
        if (const ImportedInstance& instance = model.instances[i]; instance.node >= 0)
            addUse(model.meshes[static_cast<std::size_t>(instance.mesh)],
                   {static_cast<int>(i), instance.node});
}

void resolveTextures(ImportedModel& model, const fs::path& folder, bool outsideAllowed) {
    TexturePaths paths(folder);
    std::set<std::string> missing;
    std::set<std::string> outside;
    const auto resolve = [&](std::optional<ImportedTexture>& map) {
        if (!map)
            return;
        if (map->embedded >= 0) {
            if (model.embeddedImages[static_cast<std::size_t>(map->embedded)].empty())
                missing.insert(fmt::format("embedded image {}", map->embedded + 1));
            return;
        }
        const std::string name = map->file.string();
        const auto found = paths.find(name);
        if (!found)
            missing.insert(name);
        map->file = found ? *found : paths.expected(name);
        if (found && !outsideAllowed && !paths.isInside(*found))
            outside.insert(map->file.string());
    };
    for (ImportedMaterial& material : model.materials) {
        for (std::optional<ImportedTexture>& map : material.maps.values)
            resolve(map);
        if (material.glossiness)
            resolve(material.glossiness->map);
    }
    model.missingTextures.assign(missing.begin(), missing.end());
    model.outsideTextures.assign(outside.begin(), outside.end());
}

// After resolveTextures(). What is not has been listed there.
bool isReadable(const ImportedModel& model, const ImportedTexture& texture) {
    if (texture.embedded >= 0)
        return !model.embeddedImages[static_cast<std::size_t>(texture.embedded)].empty();
    const std::string file = texture.file.string();
    std::error_code error;
    return std::find(model.outsideTextures.begin(), model.outsideTextures.end(), file) ==
               model.outsideTextures.end() &&
           fs::is_regular_file(texture.file, error);
}

} // namespace

const std::vector<std::string>& modelExtensions() {
    static const std::vector<std::string> extensions{".gltf", ".glb", ".obj", ".fbx",
                                                     ".dae",  ".ply", ".stl"};
    return extensions;
}

Result<std::vector<ModelKey>> gltfKeys(WorkerClient& worker, const fs::path& file) {
    const auto input = openInputFile(file, limits::kMaxModelFileBytes);
    if (!input)
        return input.error();
    const fs::path readable = insideCanonicalFolder(file);
    const nlohmann::json header = {{"op", "listGltfKeys"}, {"path", pathBytes(readable)}};
    const auto reply =
        worker.request(WorkerKind::Model, header.dump(), input->fd.get(), file, {}, readable);
    if (!reply)
        return reply.error();
    try {
        std::vector<ModelKey> keys;
        const nlohmann::json answer = nlohmann::json::parse(reply->header);
        for (const nlohmann::json& row : answer.at("keys")) {
            const int use = row.at(1);
            if (use < 0 || use > static_cast<int>(KeyUse::LeftOut))
                throw std::runtime_error("a use that there is not");
            keys.push_back(
                {row.at(0), static_cast<KeyUse>(use), row.at(2), row.at(3).get<std::size_t>()});
        }
        return keys;
    } catch (const std::exception& exception) {
        return Error{ErrorKind::InputBroken,
                     "the decoder gave an answer that makes no sense; the file is damaged", file,
                     exception.what()};
    }
}

Result<ImportedModel> importModel(WorkerClient& worker, const fs::path& file,
                                  const std::string& visualScene) {
    const auto input = openInputFile(file, limits::kMaxModelFileBytes);
    if (!input)
        return input.error();
    const std::string format = formatOf(file);
    if (format.empty())
        return Error{ErrorKind::InputBroken,
                     "this is no model of a supported kind (glTF, GLB, OBJ, FBX, COLLADA, PLY, "
                     "STL)",
                     file,
                     {}};
    auto decoded = decode(worker, file, format, visualScene, input->fd.get());
    if (!decoded)
        return decoded;
    ImportedModel model = std::move(*decoded);
    try {
        dropFlatInstances(model);
        resolveMirrors(model);
        repair(model);
        dropUnused(model);
        noteUses(model);
        if (model.instances.empty())
            return Error{ErrorKind::InputBroken,
                         "the model has no faces; export it with geometry",
                         file,
                         {}};
        for (const ImportedInstance& instance : model.instances)
            model.triangleCount +=
                model.meshes[static_cast<std::size_t>(instance.mesh)]->triangleCount();
        if (model.triangleCount > limits::kMaxTriangles)
            return Error{ErrorKind::InputBroken,
                         "the model is larger than the supported 50 million triangles",
                         file,
                         {}};
        std::error_code ignored;
        resolveTextures(model, fs::absolute(file, ignored).parent_path(),
                        worker.outsideAllowed(file));
        convertSpecularGlossiness(worker, model, [&](const ImportedTexture& texture) {
            return isReadable(model, texture);
        });
    } catch (const std::bad_alloc&) {
        return Error{ErrorKind::Internal, "there is not enough memory for the model", file, {}};
    }
    return model;
}

} // namespace patina
