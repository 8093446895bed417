#include "core/codec/model/GltfReader.h"

#include "core/base/Limits.h"
#include "core/codec/Codec.h"
#include "core/codec/model/GltfBuffers.h"
#include "core/codec/model/GltfContainer.h"
#include "core/codec/model/GltfExtensions.h"
#include "core/codec/model/GltfMaterials.h"
#include "core/codec/model/GltfNodes.h"
#include "core/codec/model/GltfPrimitive.h"
#include "core/codec/model/GltfShape.h"
#include "core/codec/model/ModelLimits.h"
#include "core/material/Material.h"
#include "core/mesh/MeshSource.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

namespace patina::codec {

namespace {

using nlohmann::json;

// Primitive modes.
constexpr int kTriangles = 4;
constexpr int kStrip = 5;
constexpr int kFan = 6;

// Strips and fans become triangles with the winding of glTF 2.0, section 3.7.2.1.
std::vector<std::uint32_t> triangulate(std::vector<std::uint32_t> source, int mode) {
    if (mode != kStrip && mode != kFan) {
        source.resize(source.size() / 3 * 3);
        return source;
    }
    std::vector<std::uint32_t> result;
    for (std::size_t i = 0; i + 2 < source.size(); ++i) {
        const std::size_t odd = i % 2;
        if (mode == kStrip)
            result.insert(result.end(), {source[i], source[i + 1 + odd], source[i + 2 - odd]});
        else
            result.insert(result.end(), {source[i + 1], source[i + 2], source[0]});
    }
    return result;
}

// Without normals a mesh is flat-shaded (glTF 2.0, section 3.7.2.1): each triangle gets vertices of
// its own. Tangents without normals are to be ignored. `origin` receives the vertices they repeat.
Mesh flatShaded(const Mesh& mesh, std::vector<std::uint32_t>& origin) {
    Mesh flat;
    flat.name = mesh.name;
    const std::size_t vertices = mesh.positions.size();
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::uint32_t* corner = mesh.indices.data() + i;
        const bool valid = std::all_of(corner, corner + 3, [&](auto k) { return k < vertices; });
        if (!valid) { // dropped and counted by the client
            flat.indices.insert(flat.indices.end(), 3, ~std::uint32_t{0});
            continue;
        }
        const auto at = [&](int k) { return mesh.positions[corner[k]]; };
        const glm::vec3 area = glm::cross(at(1) - at(0), at(2) - at(0));
        const float length = glm::length(area);
        for (int k = 0; k < 3; ++k) {
            flat.indices.push_back(static_cast<std::uint32_t>(flat.positions.size()));
            flat.positions.push_back(at(k));
            origin.push_back(corner[k]);
            flat.normals.push_back(length > 0.0f ? area / length : glm::vec3(0, 1, 0));
            if (!mesh.uvs.empty())
                flat.uvs.push_back(mesh.uvs[corner[k]]);
        }
    }
    return flat;
}

class Reader {
  public:
    Reader(const json& root, std::span<const std::byte> binary, const ModelFolder& folder)
        : m_root(root)
        , m_buffers(root, binary, folder)
        , m_shaper(root, m_buffers) {}

    ImportedModel read();

  private:
    struct Primitive {
        int mesh, material;
        bool skinned = false; // stands in the world, whatever its node's transform
    };

    const std::vector<Primitive>& primitives(const GltfShape& shape);
    [[nodiscard]] int textureSetOf(const json& primitive) const;
    std::optional<Mesh> primitive(const json& source, const std::string& name,
                                  const GltfShape& shape, std::vector<std::uint32_t>& origin,
                                  bool& skinned);
    void visit(std::size_t index, const glm::mat4& parent);
    void show(const json& node, std::size_t index, const glm::mat4& world);
    void warn(std::size_t count, const char* what) {
        if (count > 0)
            m_model.warnings.push_back(fmt::format("{} {}", count, what));
    }
    void light(const json& node, const glm::mat4& world);
    void camera(const json& node, const glm::mat4& world);
    int defaultMaterial();

    const json& m_root;
    GltfBuffers m_buffers;
    GltfShaper m_shaper;
    ImportedModel m_model;
    std::map<GltfShape, std::vector<Primitive>> m_primitives;
    std::vector<bool> m_visited; // per node
    int m_defaultMaterial = -1;
    std::size_t m_linesAndPoints = 0;
    std::size_t m_triangles = 0;
    std::size_t m_vertices = 0;   // that were read, also when no triangle uses them
    std::size_t m_nowhere = 0;    // objects whose transform is not finite
    bool m_holdsColors = false;   // of vertices
    bool m_holdsTransfer = false; // attributes of core/export/TransferExport.h
};

int Reader::defaultMaterial() {
    if (m_defaultMaterial < 0) {
        m_defaultMaterial = static_cast<int>(m_model.materials.size());
        // As one that is empty: white, metallic and rough (glTF 2.0, 3.9.6).
        ImportedMaterial material;
        material.name = "default";
        material.baseColor = glm::vec4(1.0f);
        material.numbers[MaterialInput::Metallic] = 1.0f;
        material.numbers[MaterialInput::PerceptualRoughness] = 1.0f;
        m_model.materials.push_back(material);
    }
    return m_defaultMaterial;
}

// That of the material's textures.
int Reader::textureSetOf(const json& primitive) const {
    const int material = primitive.value("material", -1);
    return material < 0
               ? 0
               : gltfTextureSet(element(m_root, "materials", static_cast<std::size_t>(material)));
}

// `origin` receives, for each vertex of the mesh, that of the primitive.
std::optional<Mesh> Reader::primitive(const json& source, const std::string& name,
                                      const GltfShape& shape, std::vector<std::uint32_t>& origin,
                                      bool& skinned) {
    const int mode = source.value("mode", kTriangles);
    const json& attributes = source.at("attributes");
    if (mode < kTriangles || mode > kFan) {
        ++m_linesAndPoints;
        return std::nullopt;
    }
    if (!attributes.contains("POSITION"))
        return std::nullopt;
    m_holdsTransfer = m_holdsTransfer || attributes.contains("_PRT_0");
    m_holdsColors = m_holdsColors || attributes.contains("COLOR_0");

    Mesh mesh;
    mesh.name = name;
    const GltfPrimitive arrays(source, m_buffers);
    mesh.positions = arrays.vectors<glm::vec3>("POSITION");
    m_vertices += mesh.positions.size(); // primitives may share an accessor
    if (m_vertices > 3 * limits::kMaxTriangles)
        throw Refusal("the model is larger than the supported 50 million triangles");
    const auto take = [&]<class T>(std::vector<T>& values, const char* key) {
        values = arrays.vectors<T>(key);
        if (!values.empty() && values.size() != mesh.positions.size())
            throw Refusal("the file is damaged; export it again",
                          fmt::format("{} and POSITION differ in length", key));
    };
    take(mesh.normals, "NORMAL");
    const std::string set = fmt::format("TEXCOORD_{}", textureSetOf(source));
    take(mesh.uvs, attributes.contains(set) ? set.c_str() : "TEXCOORD_0");
    take(mesh.tangents, "TANGENT");
    std::vector<std::uint32_t> indices = arrays.indices();
    if (indices.empty() && !source.contains("indices")) {
        indices.resize(mesh.positions.size());
        std::iota(indices.begin(), indices.end(), 0u);
    }
    mesh.indices = triangulate(std::move(indices), arrays.compressed() ? kTriangles : mode);
    m_shaper.morph(mesh, arrays, shape);
    skinned = m_shaper.skin(mesh, arrays, shape);

    if (mesh.normals.empty()) {
        mesh = flatShaded(mesh, origin);
        m_model.repairs.generatedNormals = true;
    } else {
        origin.resize(mesh.positions.size());
        std::iota(origin.begin(), origin.end(), 0u);
    }
    return mesh;
}

const std::vector<Reader::Primitive>& Reader::primitives(const GltfShape& shape) {
    if (const auto known = m_primitives.find(shape); known != m_primitives.end())
        return known->second;
    std::vector<Primitive> result;
    const json& source = element(m_root, "meshes", shape.mesh);
    const json& parts = source.at("primitives");
    const std::string name = source.value("name", fmt::format("mesh {}", shape.mesh + 1));
    for (std::size_t i = 0; i < parts.size(); ++i) {
        MeshSource from;
        from.mesh = static_cast<int>(shape.mesh);
        from.primitive = static_cast<int>(i);
        bool skinned = false;
        auto mesh = primitive(parts[i], i == 0 ? name : fmt::format("{} {}", name, i + 1), shape,
                              from.vertices, skinned);
        if (!mesh || mesh->indices.empty())
            continue;
        m_triangles += mesh->triangleCount();
        if (m_triangles > limits::kMaxTriangles || m_model.meshes.size() >= limits::kMaxMeshes)
            throw Refusal("the model is larger than the supported 50 million triangles");
        const int material = parts[i].value("material", -1);
        if (material >= 0)
            (void)element(m_root, "materials", static_cast<std::size_t>(material));
        result.push_back({static_cast<int>(m_model.meshes.size()),
                          material >= 0 ? material : defaultMaterial(), skinned});
        m_model.meshes.push_back(withSource(std::move(*mesh), std::move(from)));
    }
    return m_primitives[shape] = std::move(result);
}

// The mesh of a node, once or as often as it has copies.
void Reader::show(const json& node, std::size_t index, const glm::mat4& world) {
    const std::vector<Primitive>& parts = primitives(m_shaper.shapeOf(node));
    const auto copies = gltfCopies(node, m_buffers);
    const std::size_t count = copies ? copies->size() : 1;
    if (count * parts.size() > limits::kMaxInstances - m_model.instances.size())
        throw Refusal(tooManyObjects());
    for (std::size_t copy = 0; copy < count; ++copy)
        for (const Primitive& part : parts) {
            ImportedInstance instance;
            instance.name =
                node.value("name", m_model.meshes[static_cast<std::size_t>(part.mesh)]->name);
            if (count > 1)
                instance.name += fmt::format(" {}", copy + 1);
            instance.mesh = part.mesh;
            instance.material = part.material;
            instance.transform = part.skinned ? glm::mat4(1.0f) : world;
            if (copies)
                instance.transform *= (*copies)[copy];
            instance.node = static_cast<int>(index);
            if (isFinite(instance.transform))
                m_model.instances.push_back(std::move(instance));
            else
                ++m_nowhere;
        }
}

// KHR_lights_punctual: lights shine along their node's -Z.
void Reader::light(const json& node, const glm::mat4& world) {
    const auto extensions = node.find("extensions");
    if (extensions == node.end() || !extensions->contains("KHR_lights_punctual"))
        return;
    const auto index = (*extensions)["KHR_lights_punctual"].at("light").get<std::size_t>();
    const json all =
        m_root.value("extensions", json::object()).value("KHR_lights_punctual", json::object());
    const json& source = element(all, "lights", index);
    const std::string type = source.at("type");
    ImportedLight light;
    light.name = source.value("name", node.value("name", std::string("light")));
    using Type = ImportedLight::Type;
    if (type != "directional" && type != "point" && type != "spot") {
        m_model.warnings.push_back(
            fmt::format("The light \"{}\" is of an unknown type and was left out.", light.name));
        return;
    }
    light.type = type == "directional" ? Type::Directional
                 : type == "spot"      ? Type::Spot
                                       : Type::Point;
    if (!isFinite(world)) {
        ++m_nowhere;
        return;
    }
    light.position = glm::vec3(world[3]);
    const glm::vec3 axis = -glm::vec3(world[2]);
    if (glm::dot(axis, axis) > 0.0f)
        light.direction = glm::normalize(axis);
    const json color = source.value("color", json::array({1.0f, 1.0f, 1.0f}));
    for (int i = 0; i < 3; ++i)
        light.color[i] =
            color.at(static_cast<std::size_t>(i)).get<float>() * source.value("intensity", 1.0f);
    light.range = source.value("range", 0.0f);
    if (light.type == Type::Spot) {
        const json cone = source.value("spot", json::object());
        light.innerConeDeg = glm::degrees(cone.value("innerConeAngle", 0.0f));
        light.outerConeDeg = glm::degrees(cone.value("outerConeAngle", glm::quarter_pi<float>()));
    }
    m_model.lights.push_back(light);
}

// Cameras look along their node's -Z, with +Y up (glTF 2.0, 3.10.2).
void Reader::camera(const json& node, const glm::mat4& world) {
    const auto index = node.find("camera");
    if (index == node.end())
        return;
    const auto number = index->get<std::size_t>();
    const json& source = element(m_root, "cameras", number);
    ImportedCamera camera;
    // The node's name is what the program that wrote the file shows.
    camera.name = node.value("name", source.value("name", fmt::format("camera {}", number + 1)));
    if (source.at("type") != "perspective") {
        m_model.warnings.push_back(fmt::format(
            "The camera \"{}\" has no perspective, which view cameras have; it was left out.",
            camera.name));
        return;
    }
    const glm::vec3 back(world[2]), up(world[1]);
    const float yfov = source.at("perspective").at("yfov").get<float>();
    if (!isFinite(world) || !(glm::dot(back, back) > 0.0f) ||
        !(glm::length(glm::cross(up, back)) > 0.0f) || !(yfov > 0.0f && yfov < glm::pi<float>())) {
        ++m_nowhere;
        return;
    }
    camera.position = glm::vec3(world[3]);
    camera.forward = -glm::normalize(back);
    camera.up = glm::normalize(glm::cross(back, glm::cross(up, back)));
    camera.fovDeg = glm::degrees(yfov);
    m_model.cameras.push_back(camera);
}

// Depth first with a stack of our own: a damaged file may nest as deeply as it likes.
void Reader::visit(std::size_t rootIndex, const glm::mat4& parent) {
    std::vector<std::pair<std::size_t, glm::mat4>> pending{{rootIndex, parent}};
    while (!pending.empty()) {
        const auto [index, above] = pending.back();
        pending.pop_back();
        const json& node = element(m_root, "nodes", index);
        if (m_visited[index])
            throw Refusal("the file is damaged: a node has two parents; export it again");
        m_visited[index] = true;
        const glm::mat4 world = above * gltfTransform(node);
        if (node.contains("mesh"))
            show(node, index, world);
        light(node, world);
        camera(node, world);
        if (const auto children = node.find("children"); children != node.end())
            for (auto it = children->rbegin(); it != children->rend(); ++it)
                pending.emplace_back(it->get<std::size_t>(), world);
    }
}

ImportedModel Reader::read() {
    const json asset = m_root.value("asset", json::object());
    if (const std::string version = asset.value("version", std::string("?"));
        !version.starts_with("2."))
        throw Refusal("only version 2 of glTF is supported; export it again as glTF 2.0",
                      "version " + version);
    checkRequiredExtensions(m_root);
    m_model.format = "gltf2";
    readGltfMaterials(m_root, m_buffers, m_model);
    if (const auto nodes = m_root.find("nodes"); nodes != m_root.end())
        m_visited.resize(nodes->size());

    // The default scene, or all that has no parent.
    if (const auto scenes = m_root.find("scenes"); scenes != m_root.end() && !scenes->empty()) {
        const json& scene = element(m_root, "scenes", m_root.value("scene", std::size_t{0}));
        for (const json& node : scene.value("nodes", json::array()))
            visit(node.get<std::size_t>(), glm::mat4(1.0f));
    } else {
        std::vector<bool> child(m_visited.size(), false);
        for (std::size_t i = 0; i < m_visited.size(); ++i)
            for (const json& c : m_root["nodes"][i].value("children", json::array()))
                if (c.get<std::size_t>() < child.size())
                    child[c.get<std::size_t>()] = true;
        for (std::size_t i = 0; i < m_visited.size(); ++i)
            if (!child[i])
                visit(i, glm::mat4(1.0f));
    }
    warn(m_linesAndPoints, "parts made of lines or points were left out.");
    warn(m_nowhere, "objects whose transforms are not finite were left out.");
    m_model.warnings.insert(m_model.warnings.end(), m_shaper.notes().begin(),
                            m_shaper.notes().end());
    for (std::string& sentence : unusedExtensions(m_root))
        m_model.warnings.push_back(std::move(sentence));
    if (!m_root.value("animations", json::array()).empty())
        m_model.warnings.emplace_back(
            "Animation is not read; the model is shown in the pose that the file stores.");
    if (m_holdsColors)
        m_model.warnings.emplace_back("Vertex colours (attribute COLOR_0) are not read; bake them "
                                      "into a base colour map to see them.");
    if (m_holdsTransfer)
        m_model.warnings.emplace_back(
            "The radiance transfer in this file (attributes _PRT_n) is for engines and is not read "
            "back; open the project it was exported from, or bake once more.");
    return std::move(m_model);
}

} // namespace

ImportedModel readGltf(const ModelFolder& folder) {
    const auto file = folder.open(folder.modelPath());
    if (!file)
        throw Refusal("the file cannot be read");
    const GltfContainer container = openGltfContainer(*file);
    const json root = parseGltf(container.text);
    try {
        return Reader(root, container.binary, folder).read();
    } catch (const json::exception& exception) {
        throw Refusal("the file is damaged; export it again", exception.what());
    }
}

} // namespace patina::codec
