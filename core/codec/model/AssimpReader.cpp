#include "core/codec/model/AssimpReader.h"

#include "core/base/Limits.h"
#include "core/codec/Codec.h"
#include "core/codec/TokenReader.h"
#include "core/codec/model/AssimpMaterials.h"
#include "core/codec/model/AssimpText.h"
#include "core/codec/model/ColladaScenes.h"
#include "core/codec/model/GltfNodes.h"
#include "core/codec/model/ModelLimits.h"
#include "core/codec/model/MtlText.h"
#include "core/codec/model/ObjMeshes.h"
#include "core/codec/model/Polygon.h"

#include <algorithm>
#include <array>
#include <assimp/BaseImporter.h>
#include <assimp/DefaultLogger.hpp>
#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <assimp/camera.h>
#include <assimp/config.h>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <optional>
#include <span>
#include <sstream>

namespace patina::codec {

namespace {

class Stream : public Assimp::IOStream {
  public:
    explicit Stream(MemoryFile file)
        : m_file(std::move(file)) {}

    std::size_t Read(void* buffer, std::size_t size, std::size_t count) override {
        const auto rest = m_file.bytes().subspan(m_position);
        const std::size_t whole = size == 0 ? 0 : std::min(count, rest.size() / size);
        if (whole > 0)
            std::memcpy(buffer, rest.data(), whole * size);
        m_position += whole * size;
        return whole;
    }
    std::size_t Write(const void*, std::size_t, std::size_t) override { return 0; }
    aiReturn Seek(std::size_t offset, aiOrigin origin) override {
        const std::size_t size = m_file.bytes().size();
        const std::size_t base = origin == aiOrigin_SET   ? 0
                                 : origin == aiOrigin_CUR ? m_position
                                                          : size;
        const std::size_t target = origin == aiOrigin_END ? base - offset : base + offset;
        if (target > size)
            return AI_FAILURE;
        m_position = target;
        return AI_SUCCESS;
    }
    [[nodiscard]] std::size_t Tell() const override { return m_position; }
    [[nodiscard]] std::size_t FileSize() const override { return m_file.bytes().size(); }
    void Flush() override {}

  private:
    MemoryFile m_file;
    std::size_t m_position = 0;
};

// All Assimp sees of the disk. `model` is read in place of the model's file, unless it is empty.
class FolderSystem : public Assimp::IOSystem {
  public:
    FolderSystem(const ModelFolder& folder, std::string format, std::string_view model,
                 MtlText& materials)
        : m_folder(folder)
        , m_format(std::move(format))
        , m_model(model)
        , m_materials(materials) {}

    bool Exists(const char* path) const override { return open(path).has_value(); }
    [[nodiscard]] char getOsSeparator() const override { return '/'; }
    Assimp::IOStream* Open(const char* path, const char* mode) override {
        if (mode == nullptr || mode[0] != 'r')
            return nullptr;
        auto file = !m_model.empty() && path == m_folder.modelPath()
                        ? MemoryFile::copyOf(std::as_bytes(std::span(m_model)))
                        : open(path);
        if (file)
            if (const auto text = spelledOut(path, file->text()))
                file = MemoryFile::copyOf(std::as_bytes(std::span(*text)));
        return file ? new Stream(std::move(*file)) : nullptr;
    }
    void Close(Assimp::IOStream* stream) override { delete stream; }

  private:
    // Of "mtllib" Assimp hands on quotes, and blanks at the end of the line.
    [[nodiscard]] std::optional<MemoryFile> open(const std::string& path) const {
        auto file = m_folder.open(path);
        if (file || m_format != "obj")
            return file;
        std::string plain = path.substr(0, path.find_last_not_of(" \t\r\"") + 1);
        plain.erase(std::remove(plain.begin(), plain.end(), '"'), plain.end());
        return m_folder.open(plain);
    }

    [[nodiscard]] std::optional<std::string> spelledOut(const char* path, std::string_view text) {
        if (m_format == "dae")
            return colladaForAssimp(text);
        if (m_format == "obj")
            return path == m_folder.modelPath() ? objForAssimp(text) : m_materials.rewritten(text);
        return std::nullopt;
    }

    const ModelFolder& m_folder;
    std::string m_format;
    std::string_view m_model;
    MtlText& m_materials;
};

void keepOnlyImporter(Assimp::Importer& importer, const std::string& extension) {
    for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
        std::istringstream extensions(importer.GetImporterInfo(i)->mFileExtensions);
        bool wanted = false;
        for (std::string word; extensions >> word;)
            wanted = wanted || word == extension;
        if (wanted)
            continue;
        Assimp::BaseImporter* unwanted = importer.GetImporter(i);
        importer.UnregisterLoader(unwanted); // which leaves it to us
        delete unwanted;
    }
}

glm::mat4 toMatrix(const aiMatrix4x4& m) { // Assimp stores rows
    return {{m.a1, m.b1, m.c1, m.d1},
            {m.a2, m.b2, m.c2, m.d2},
            {m.a3, m.b3, m.c3, m.d3},
            {m.a4, m.b4, m.c4, m.d4}};
}

// FBX files say which of their axes point right, up and front, and how many centimetres a unit is;
// Assimp 5.2.5 hands that on as metadata without applying it. (COLLADA's unit and axes it applies.)
glm::mat4 fbxToWorld(const aiScene& scene) {
    if (scene.mMetaData == nullptr)
        return glm::mat4(0.01f);
    const auto axis = [&](const char* key, const char* signKey, int fallback) {
        int index = fallback;
        int sign = 1;
        scene.mMetaData->Get(key, index);
        scene.mMetaData->Get(signKey, sign);
        glm::vec3 direction(0.0f);
        direction[std::clamp(index, 0, 2)] = sign < 0 ? -1.0f : 1.0f;
        return direction;
    };
    double centimetres = 1.0;
    if (float single = 1.0f; !scene.mMetaData->Get("UnitScaleFactor", centimetres) &&
                             scene.mMetaData->Get("UnitScaleFactor", single))
        centimetres = static_cast<double>(single);
    if (!(centimetres > 0.0) || !std::isfinite(centimetres))
        centimetres = 1.0;

    const glm::vec3 right = axis("CoordAxis", "CoordAxisSign", 0);
    const glm::vec3 up = axis("UpAxis", "UpAxisSign", 1);
    const glm::vec3 front = axis("FrontAxis", "FrontAxisSign", 2);
    const auto scale = static_cast<float>(centimetres * 0.01);
    glm::mat4 result(1.0f);
    for (int column = 0; column < 3; ++column)
        result[column] =
            glm::vec4(right[column] * scale, up[column] * scale, front[column] * scale, 0.0f);
    return std::abs(glm::determinant(glm::mat3(result))) > 0.0f ? result
                                                                : glm::mat4(glm::mat3(scale));
}

// 7400 for FBX 7.4, by either spelling of the format; 0 where the file does not say.
unsigned int fbxVersion(std::string_view text) {
    constexpr std::string_view kMagic("Kaydara FBX Binary  \0\x1a\0", 23), kKey = "FBXVersion:";
    unsigned int version = 0;
    if (text.starts_with(kMagic)) {
        if (text.size() >= kMagic.size() + sizeof version)
            std::memcpy(&version, text.data() + kMagic.size(), sizeof version);
        return version;
    }
    constexpr std::size_t kHeader = 65536; // it stands at the beginning
    text = text.substr(0, kHeader);
    if (const std::size_t key = text.find(kKey); key != std::string_view::npos)
        version = static_cast<unsigned int>(std::clamp(
            TokenReader(text.substr(key + kKey.size())).number().value_or(0.0), 0.0, 1e6));
    return version;
}

// Assimp reads FBX 2011 and later; of older files it says what it says of damaged ones.
void checkFbxVersion(std::string_view text) {
    constexpr unsigned int kOldest = 7100;
    if (const unsigned int version = fbxVersion(text); version > 0 && version < kOldest)
        throw Refusal(
            fmt::format("this is FBX {}.{}, which is too old: FBX 2011 (7.1) and later are read. "
                        "Convert it with Autodesk's FBX Converter, or export it again as a newer "
                        "FBX or as glTF",
                        version / 1000, version / 100 % 10),
            fmt::format("FBX version {}", version));
}

std::string meshName(const aiMesh& source, std::size_t index) {
    return source.mName.length > 0 ? source.mName.C_Str() : fmt::format("mesh {}", index + 1);
}

std::optional<Mesh> readMesh(const aiMesh& source, std::size_t index, unsigned int textureSet) {
    if ((source.mPrimitiveTypes & aiPrimitiveType_TRIANGLE) == 0 || source.mNumFaces == 0)
        return std::nullopt;
    Mesh mesh;
    mesh.name = meshName(source, index);
    const std::size_t count = source.mNumVertices;
    const auto copy3 = [&](std::vector<glm::vec3>& target, const aiVector3D* from) {
        target.reserve(count);
        for (std::size_t i = 0; i < count; ++i)
            target.emplace_back(from[i].x, from[i].y, from[i].z);
    };
    copy3(mesh.positions, source.mVertices);
    if (source.HasNormals())
        copy3(mesh.normals, source.mNormals);
    if (!source.HasTextureCoords(textureSet))
        textureSet = 0;
    if (source.HasTextureCoords(textureSet))
        for (std::size_t i = 0; i < count; ++i)
            mesh.uvs.emplace_back(source.mTextureCoords[textureSet][i].x,
                                  source.mTextureCoords[textureSet][i].y);
    if (source.HasNormals() && source.HasTangentsAndBitangents())
        for (std::size_t i = 0; i < count; ++i) {
            const aiVector3D n = source.mNormals[i];
            const aiVector3D t = source.mTangents[i];
            const aiVector3D b = source.mBitangents[i];
            // A file's bitangent is the direction of growing v where v grows up: ours as well.
            const float w = (n ^ t) * b < 0.0f ? -1.0f : 1.0f;
            mesh.tangents.emplace_back(t.x, t.y, t.z, w);
        }
    mesh.indices.reserve(static_cast<std::size_t>(source.mNumFaces) * 3);
    for (unsigned int f = 0; f < source.mNumFaces; ++f)
        if (const aiFace& face = source.mFaces[f]; face.mNumIndices == 3)
            mesh.indices.insert(mesh.indices.end(), face.mIndices, face.mIndices + 3);
    return mesh;
}

// Nothing where it looks nowhere. Assimp's angle is that of the whole width (of its formats with
// cameras that this is used for: COLLADA and FBX).
std::optional<ImportedCamera> cameraAt(const aiCamera& source, const glm::mat4& world) {
    const auto vectorOf = [](const aiVector3D& v) { return glm::vec3(v.x, v.y, v.z); };
    ImportedCamera camera;
    camera.name = source.mName.C_Str();
    camera.position = glm::vec3(world * glm::vec4(vectorOf(source.mPosition), 1.0f));
    const glm::vec3 forward = glm::mat3(world) * vectorOf(source.mLookAt);
    const glm::vec3 right = glm::cross(forward, glm::mat3(world) * vectorOf(source.mUp));
    const float half = std::tan(0.5f * source.mHorizontalFOV);
    const float aspect = source.mAspect > 0.0f ? source.mAspect : 1.0f;
    if (!(glm::length(right) > 0.0f) || !(half > 0.0f) || !std::isfinite(half / aspect))
        return std::nullopt;
    camera.forward = glm::normalize(forward);
    camera.up = glm::normalize(glm::cross(right, forward));
    camera.fovDeg = glm::degrees(2.0f * std::atan(half / aspect));
    return camera;
}

void readNodes(const aiScene& scene, const glm::mat4& root, const std::vector<int>& meshOf,
               ImportedModel& model) {
    std::size_t nowhere = 0; // objects whose transform is not finite
    std::vector<std::pair<const aiNode*, glm::mat4>> pending{{scene.mRootNode, root}};
    while (!pending.empty()) {
        const auto [node, above] = pending.back();
        pending.pop_back();
        const glm::mat4 world = above * toMatrix(node->mTransformation);
        const bool somewhere = isFinite(world);
        nowhere += somewhere ? 0 : node->mNumMeshes;
        for (unsigned int i = 0; somewhere && i < node->mNumMeshes; ++i) {
            const unsigned int source = node->mMeshes[i];
            if (source >= scene.mNumMeshes || meshOf[source] < 0)
                continue;
            if (model.instances.size() == limits::kMaxInstances)
                throw Refusal(tooManyObjects());
            ImportedInstance instance;
            instance.mesh = meshOf[source];
            instance.material = static_cast<int>(scene.mMeshes[source]->mMaterialIndex);
            const std::string& meshName =
                model.meshes[static_cast<std::size_t>(instance.mesh)]->name;
            instance.name =
                node->mName.length > 0 && node != scene.mRootNode ? node->mName.C_Str() : meshName;
            instance.transform = world;
            model.instances.push_back(std::move(instance));
        }
        for (unsigned int i = 0; i < scene.mNumCameras; ++i)
            if (somewhere && scene.mCameras[i]->mName == node->mName)
                if (const auto camera = cameraAt(*scene.mCameras[i], world))
                    model.cameras.push_back(*camera);
        for (unsigned int i = 0; i < scene.mNumLights; ++i) {
            const aiLight& source = *scene.mLights[i];
            if (!somewhere || source.mName != node->mName ||
                (source.mType != aiLightSource_DIRECTIONAL && source.mType != aiLightSource_POINT &&
                 source.mType != aiLightSource_SPOT))
                continue;
            ImportedLight light;
            light.name = source.mName.C_Str();
            using Type = ImportedLight::Type;
            light.type = source.mType == aiLightSource_DIRECTIONAL ? Type::Directional
                         : source.mType == aiLightSource_SPOT      ? Type::Spot
                                                                   : Type::Point;
            if (light.type == Type::Spot) { // Assimp has full angles
                light.innerConeDeg = 0.5f * glm::degrees(source.mAngleInnerCone);
                light.outerConeDeg = 0.5f * glm::degrees(source.mAngleOuterCone);
            }
            light.position = glm::vec3(
                world * glm::vec4(source.mPosition.x, source.mPosition.y, source.mPosition.z, 1));
            const glm::vec3 direction =
                glm::mat3(world) *
                glm::vec3(source.mDirection.x, source.mDirection.y, source.mDirection.z);
            if (glm::dot(direction, direction) > 0.0f)
                light.direction = glm::normalize(direction);
            light.color = {source.mColorDiffuse.r, source.mColorDiffuse.g, source.mColorDiffuse.b};
            model.lights.push_back(light);
        }
        for (unsigned int i = node->mNumChildren; i-- > 0;)
            pending.emplace_back(node->mChildren[i], world);
    }
    if (nowhere > 0)
        model.warnings.push_back(
            fmt::format("{} objects whose transforms are not finite were left out.", nowhere));
}

const aiScene& readFile(Assimp::Importer& importer, const ModelFolder& folder,
                        const std::string& format, std::string_view model, MtlText& materials) {
    keepOnlyImporter(importer, format);
    importer.SetIOHandler(
        new FolderSystem(folder, format, model, materials)); // the importer's from now on
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                                aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_ANIMATIONS, false);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, true);

    const aiScene* scene = importer.ReadFile(folder.modelPath().string(), 0);
    if (scene == nullptr)
        throw Refusal("the file is damaged, cut short or not of the kind its name says",
                      importer.GetErrorString());
    return *scene;
}

constexpr const char* kVertexColors = "Vertex colours are not read.";

void checkSize(std::size_t faces, std::size_t meshes) {
    if (faces > limits::kMaxTriangles || meshes > limits::kMaxMeshes)
        throw Refusal("the model is larger than the supported 50 million triangles");
}

// Assimp 5.2.5 loses or overlaps parts of concave polygons that have points on their edges. Quads
// it divides well, and as ObjMeshes does.
void triangulatePolygons(aiMesh& mesh) {
    std::vector<glm::vec3> corners;
    std::vector<std::array<unsigned int, 3>> triangles; // of all polygons
    std::vector<std::size_t> ends(mesh.mNumFaces);      // of those of each face
    bool quads = false;
    for (unsigned int f = 0; f < mesh.mNumFaces; ++f) {
        const aiFace& face = mesh.mFaces[f];
        quads = quads || face.mNumIndices == 4;
        if (face.mNumIndices > 4) {
            corners.clear();
            for (const unsigned int i : std::span(face.mIndices, face.mNumIndices))
                corners.emplace_back(mesh.mVertices[i].x, mesh.mVertices[i].y, mesh.mVertices[i].z);
            for (const auto& t : triangulatePolygon(corners))
                triangles.push_back(
                    {face.mIndices[t[0]], face.mIndices[t[1]], face.mIndices[t[2]]});
        }
        ends[f] = triangles.size();
    }
    if (std::none_of(mesh.mFaces, mesh.mFaces + mesh.mNumFaces,
                     [](const aiFace& face) { return face.mNumIndices > 4; }))
        return;

    std::vector<aiFace> faces;
    faces.reserve(mesh.mNumFaces + triangles.size());
    for (unsigned int f = 0; f < mesh.mNumFaces; ++f)
        if (aiFace& face = mesh.mFaces[f]; face.mNumIndices <= 4) {
            std::swap(faces.emplace_back().mIndices, face.mIndices);
            std::swap(faces.back().mNumIndices, face.mNumIndices);
        } else {
            for (std::size_t t = f == 0 ? 0 : ends[f - 1]; t < ends[f]; ++t) {
                aiFace& triangle = faces.emplace_back();
                triangle.mNumIndices = 3;
                triangle.mIndices = new unsigned int[3]; // the face's
                std::copy(triangles[t].begin(), triangles[t].end(), triangle.mIndices);
            }
        }
    checkSize(faces.size(), 0);
    delete[] mesh.mFaces;
    mesh.mFaces = new aiFace[faces.size()]; // the mesh's
    mesh.mNumFaces = static_cast<unsigned int>(faces.size());
    for (std::size_t f = 0; f < faces.size(); ++f) {
        std::swap(mesh.mFaces[f].mIndices, faces[f].mIndices);
        std::swap(mesh.mFaces[f].mNumIndices, faces[f].mNumIndices);
    }
    mesh.mPrimitiveTypes |= aiPrimitiveType_TRIANGLE;
    if (!quads)
        mesh.mPrimitiveTypes &= ~static_cast<unsigned int>(aiPrimitiveType_POLYGON);
}

} // namespace

ImportedModel readWithAssimp(const ModelFolder& folder, const std::string& format,
                             const std::string& visualScene) {
    ColladaScenes scenes;
    if (format == "dae")
        if (const auto file = folder.open(folder.modelPath().string()))
            scenes = colladaScenes(file->bytes(), visualScene);
    bool animated = false;
    if (format == "fbx")
        if (const auto file = folder.open(folder.modelPath().string())) {
            checkFbxVersion(file->text());
            // Assimp is told to skip it, and says nothing of it.
            animated = file->text().find("AnimationCurve") != std::string_view::npos;
        }
    MtlText materials(folder);
    Assimp::Importer importer;
    const aiScene* scene = &readFile(importer, folder, format, scenes.text, materials);
    std::size_t faces = 0;
    std::size_t others = 0;
    for (unsigned int i = 0; i < scene->mNumMeshes; ++i)
        for (unsigned int f = 0; f < scene->mMeshes[i]->mNumFaces; ++f)
            ++(scene->mMeshes[i]->mFaces[f].mNumIndices >= 3 ? faces : others);
    if (faces == 0)
        throw Refusal("the model has no faces; export it with geometry");
    checkSize(faces, scene->mNumMeshes);

    // The importer's scene is ours to change before it goes on.
    for (unsigned int i = 0; i < scene->mNumMeshes; ++i)
        triangulatePolygons(const_cast<aiMesh&>(*scene->mMeshes[i]));
    scene = importer.ApplyPostProcessing(aiProcess_Triangulate | aiProcess_JoinIdenticalVertices |
                                         aiProcess_SortByPType | aiProcess_FlipUVs);
    if (scene == nullptr || scene->mRootNode == nullptr)
        throw Refusal("the file is damaged; export it again", importer.GetErrorString());

    ImportedModel model;
    model.format = format == "dae" ? "collada" : format;
    model.scenes = std::move(scenes.titles);
    model.scene = scenes.taken;
    readAssimpMaterials(*scene, format, materials, model);
    std::vector<int> meshOf(scene->mNumMeshes, -1);
    for (unsigned int i = 0; i < scene->mNumMeshes; ++i)
        if (auto mesh =
                readMesh(*scene->mMeshes[i], i,
                         assimpTextureSet(*scene->mMaterials[scene->mMeshes[i]->mMaterialIndex]))) {
            meshOf[i] = static_cast<int>(model.meshes.size());
            model.meshes.push_back(std::make_shared<Mesh>(std::move(*mesh)));
        }
    readNodes(*scene, format == "fbx" ? fbxToWorld(*scene) : glm::mat4(1.0f), meshOf, model);
    if (others > 0)
        model.warnings.push_back(fmt::format("{} lines and points were left out.", others));
    const bool skinned = std::any_of(scene->mMeshes, scene->mMeshes + scene->mNumMeshes,
                                     [](const aiMesh* mesh) { return mesh->HasBones(); });
    if (skinned)
        model.warnings.emplace_back("Skins are read from glTF alone; meshes are shown in the shape "
                                    "that the file stores, not "
                                    "in the pose of their joints.");
    if (std::any_of(scene->mMeshes, scene->mMeshes + scene->mNumMeshes,
                    [](const aiMesh* mesh) { return mesh->HasVertexColors(0); }))
        model.warnings.emplace_back(kVertexColors);
    if (animated || scene->mNumAnimations > 0)
        model.warnings.emplace_back("Animation is not read; the model is shown at rest.");
    return model;
}

ImportedModel readObjParts(const ModelFolder& folder, const ObjText& text) {
    checkSize(text.cornerCounts.size(), 0);
    MtlText materials(folder);
    Assimp::Importer importer;
    const aiScene& scene = readFile(importer, folder, "obj", text.outline, materials);
    checkSize(0, scene.mNumMeshes);

    ImportedModel model;
    model.format = "obj";
    readAssimpMaterials(scene, model.format, materials, model);
    std::vector<int> meshOf(scene.mNumMeshes);
    ObjMeshes meshes(text);
    for (unsigned int i = 0; i < scene.mNumMeshes; ++i) {
        const aiMesh& part = *scene.mMeshes[i];
        std::vector<std::size_t> runs; // of one triangle each
        for (unsigned int v = 0; v < part.mNumVertices; v += 3)
            runs.push_back(static_cast<std::size_t>(part.mVertices[v].x));
        Mesh mesh = meshes.join(runs);
        mesh.name = meshName(part, i);
        meshOf[i] = static_cast<int>(i);
        model.meshes.push_back(std::make_shared<Mesh>(std::move(mesh)));
    }
    readNodes(scene, glm::mat4(1.0f), meshOf, model);
    if (text.vertexColors)
        model.warnings.emplace_back(kVertexColors);
    return model;
}

} // namespace patina::codec
