#include "core/worker/ModelWire.h"

#include "core/base/Limits.h"
#include "core/material/Material.h"
#include "core/material/MaterialInputs.h"
#include "core/mesh/MeshSource.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

namespace patina {

namespace {

using nlohmann::json;

constexpr std::size_t kAlignment = 16;

std::size_t aligned(std::size_t size) {
    return (size + kAlignment - 1) / kAlignment * kAlignment;
}

// Paths are bytes in any encoding; in JSON they travel as hexadecimal digits.
std::string toHex(std::string_view bytes) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string hex;
    hex.reserve(bytes.size() * 2);
    for (const char c : bytes) {
        hex += kDigits[static_cast<unsigned char>(c) >> 4];
        hex += kDigits[static_cast<unsigned char>(c) & 15];
    }
    return hex;
}

std::string fromHex(const std::string& hex) {
    std::string bytes;
    for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
        bytes += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
    return bytes;
}

template <int N>
json array(const glm::vec<N, float>& v) {
    json result = json::array();
    for (int i = 0; i < N; ++i)
        result.push_back(v[i]);
    return result;
}

// JSON has no NaN: nlohmann writes null for it, and reading null as a number throws.
float number(const json& value) {
    const float f = value.get<float>();
    if (!std::isfinite(f))
        throw std::runtime_error("a number is not finite");
    return f;
}

template <int N>
glm::vec<N, float> vector(const json& value) {
    if (value.size() != N)
        throw std::runtime_error("a vector has the wrong size");
    glm::vec<N, float> v(0.0f);
    for (int i = 0; i < N; ++i)
        v[i] = number(value.at(static_cast<std::size_t>(i)));
    return v;
}

glm::vec3 direction(const json& value) {
    const glm::vec3 v = vector<3>(value);
    const float length = glm::length(v);
    if (!(length > 0.5f && length < 2.0f))
        throw std::runtime_error("a direction is no unit vector");
    return v / length;
}

json write(const ImportedTexture& texture) {
    return {{"file", toHex(texture.file.native())},
            {"embedded", texture.embedded},
            {"channel", std::string(texture.channel != 0 ? 1 : 0, texture.channel)},
            {"scale", array<2>(texture.uvScale)},
            {"offset", array<2>(texture.uvOffset)},
            {"rotationDeg", texture.uvRotationDeg}};
}

ImportedTexture readTexture(const json& value) {
    ImportedTexture texture;
    texture.file = fromHex(value.at("file"));
    texture.embedded = value.at("embedded");
    const std::string channel = value.at("channel");
    if (!channel.empty() && std::string_view("rgba").find(channel[0]) == std::string_view::npos)
        throw std::runtime_error("a texture names no channel");
    texture.channel = channel.empty() ? '\0' : channel[0];
    texture.uvScale = vector<2>(value.at("scale"));
    texture.uvOffset = vector<2>(value.at("offset"));
    texture.uvRotationDeg = number(value.at("rotationDeg"));
    return texture;
}

json write(const ImportedMaterial& material) {
    json result = {{"name", material.name},
                   {"baseColor", array<4>(material.baseColor)},
                   {"emissive", array<3>(material.emissive)},
                   {"doubleSided", material.doubleSided},
                   {"alphaMask", material.alphaMask},
                   {"alphaBlend", material.alphaBlend},
                   {"alphaCutoff", material.alphaCutoff},
                   {"ior", material.ior},
                   {"thinWalled", material.thinWalled},
                   {"attenuationColor", array<3>(material.attenuationColor)},
                   {"attenuationDistance", material.attenuationDistance}};
    json& numbers = result["numbers"] = json::object();
    json& maps = result["maps"] = json::object();
    for (const MaterialInputInfo& info : kMaterialInputs) {
        if (info.number != nullptr)
            numbers[std::string(info.id)] = material.numbers[info.input];
        if (const auto& map = material.maps[info.input])
            maps[std::string(info.id)] = write(*map);
    }
    if (const auto& glossiness = material.glossiness) {
        json& rest = result["glossiness"] = {{"specular", array<3>(glossiness->specular)},
                                             {"factor", glossiness->glossiness}};
        if (glossiness->map)
            rest["map"] = write(*glossiness->map);
    }
    return result;
}

ImportedMaterial readMaterial(const json& value) {
    ImportedMaterial material;
    material.name = value.at("name");
    material.baseColor = glm::clamp(vector<4>(value.at("baseColor")), 0.0f, 1.0f);
    material.emissive = glm::max(vector<3>(value.at("emissive")), glm::vec3(0.0f));
    material.doubleSided = value.at("doubleSided");
    material.alphaMask = value.at("alphaMask");
    material.alphaBlend = value.at("alphaBlend");
    material.alphaCutoff = glm::clamp(number(value.at("alphaCutoff")), 0.0f, 1.0f);
    material.ior = std::max(number(value.at("ior")), 1.0f);
    material.thinWalled = value.at("thinWalled");
    material.attenuationColor = glm::clamp(vector<3>(value.at("attenuationColor")), 0.0f, 1.0f);
    material.attenuationDistance = std::max(number(value.at("attenuationDistance")), 0.0f);
    const json& numbers = value.at("numbers");
    const json& maps = value.at("maps");
    for (const MaterialInputInfo& info : kMaterialInputs) {
        const std::string key(info.id);
        if (info.number != nullptr) {
            const float read = number(numbers.at(key));
            material.numbers[info.input] =
                info.role == InputRole::Normal ? read : glm::clamp(read, 0.0f, 1.0f);
        }
        if (const auto it = maps.find(key); it != maps.end())
            material.maps[info.input] = readTexture(*it);
    }
    if (const auto it = value.find("glossiness"); it != value.end()) {
        ImportedGlossiness& glossiness = material.glossiness.emplace();
        glossiness.specular = glm::clamp(vector<3>(it->at("specular")), 0.0f, 1.0f);
        glossiness.glossiness = glm::clamp(number(it->at("factor")), 0.0f, 1.0f);
        if (it->contains("map"))
            glossiness.map = readTexture(it->at("map"));
    }
    return material;
}

// The arrays of a mesh in the order in which they travel.
template <class MeshType, class Visit>
void forEachArray(MeshType& mesh, Visit visit) {
    visit(mesh.positions);
    visit(mesh.normals);
    visit(mesh.tangents);
    visit(mesh.uvs);
    visit(mesh.indices);
}

class PayloadReader {
  public:
    explicit PayloadReader(std::span<const std::byte> payload)
        : m_rest(payload) {}

    template <class T>
    void take(std::vector<T>& values, std::size_t count) {
        if (count > m_rest.size() / sizeof(T))
            throw std::runtime_error("an array is longer than the answer");
        static_assert(std::is_trivially_copyable_v<T> && alignof(T) <= kAlignment);
        const T* const first = reinterpret_cast<const T*>(m_rest.data());
        values.assign(first, first + count); // not resize(): that would write all memory twice
        m_rest = m_rest.subspan(std::min(m_rest.size(), aligned(count * sizeof(T))));
    }
    [[nodiscard]] bool atEnd() const { return m_rest.empty(); }

  private:
    std::span<const std::byte> m_rest;
};

void checkIndex(int index, std::size_t size) {
    if (index < 0 || static_cast<std::size_t>(index) >= size)
        throw std::runtime_error("an index points nowhere");
}

std::shared_ptr<Mesh> readMesh(const json& value, PayloadReader& payload) {
    Mesh mesh;
    mesh.name = value.at("name");
    const std::size_t vertices = value.at("vertices");
    const std::size_t indices = value.at("indices");
    if (indices % 3 != 0)
        throw std::runtime_error("the triangles are incomplete");
    payload.take(mesh.positions, vertices);
    payload.take(mesh.normals, value.at("normals").get<bool>() ? vertices : 0);
    payload.take(mesh.tangents, value.at("tangents").get<bool>() ? vertices : 0);
    payload.take(mesh.uvs, value.at("uvs").get<bool>() ? vertices : 0);
    payload.take(mesh.indices, indices);
    const auto source = value.find("source");
    if (source == value.end())
        return std::make_shared<Mesh>(std::move(mesh));
    MeshSource known;
    known.mesh = source->at("mesh");
    known.primitive = source->at("primitive");
    payload.take(known.vertices, vertices);
    return withSource(std::move(mesh), std::move(known));
}

ImportedModel readUnchecked(const json& header, std::span<const std::byte> bytes) {
    ImportedModel model;
    PayloadReader payload(bytes);
    model.format = header.at("format");
    const json& meshes = header.at("meshes");
    if (meshes.size() > limits::kMaxMeshes)
        throw std::runtime_error("too many meshes");
    for (const json& mesh : meshes)
        model.meshes.push_back(readMesh(mesh, payload));
    for (const json& size : header.at("embedded"))
        payload.take(model.embeddedImages.emplace_back(), size.get<std::size_t>());
    if (!payload.atEnd())
        throw std::runtime_error("the answer is longer than announced");

    for (const json& material : header.at("materials"))
        model.materials.push_back(readMaterial(material));
    const auto checkMap = [&](const std::optional<ImportedTexture>& map) {
        if (map && map->embedded != -1)
            checkIndex(map->embedded, model.embeddedImages.size());
    };
    for (const ImportedMaterial& material : model.materials) {
        for (const auto& map : material.maps.values)
            checkMap(map);
        if (material.glossiness)
            checkMap(material.glossiness->map);
    }
    for (const json& value : header.at("instances")) {
        ImportedInstance instance;
        instance.name = value.at("name");
        instance.mesh = value.at("mesh");
        instance.material = value.at("material");
        instance.node = value.at("node");
        checkIndex(instance.mesh, model.meshes.size());
        checkIndex(instance.material, model.materials.size());
        const json& transform = value.at("transform");
        if (transform.size() != 16)
            throw std::runtime_error("a transform has no 16 numbers");
        for (int i = 0; i < 16; ++i)
            instance.transform[i / 4][i % 4] = number(transform[static_cast<std::size_t>(i)]);
        model.instances.push_back(std::move(instance));
    }
    for (const json& value : header.at("lights")) {
        ImportedLight light;
        light.name = value.at("name");
        const int type = value.at("type");
        if (type < 0 || type > static_cast<int>(ImportedLight::Type::Spot))
            throw std::runtime_error("a light of unknown type");
        light.type = static_cast<ImportedLight::Type>(type);
        light.position = vector<3>(value.at("position"));
        light.direction = vector<3>(value.at("direction"));
        light.color = glm::max(vector<3>(value.at("color")), glm::vec3(0.0f));
        light.range = number(value.at("range"));
        light.innerConeDeg = number(value.at("innerConeDeg"));
        light.outerConeDeg = number(value.at("outerConeDeg"));
        model.lights.push_back(light);
    }
    for (const json& value : header.at("cameras")) {
        ImportedCamera& camera = model.cameras.emplace_back();
        camera.name = value.at("name");
        camera.position = vector<3>(value.at("position"));
        camera.forward = direction(value.at("forward"));
        camera.up = direction(value.at("up"));
        camera.fovDeg = number(value.at("fovDeg"));
    }
    for (const json& warning : header.at("warnings"))
        model.warnings.push_back(warning);
    for (const json& title : header.at("scenes"))
        model.scenes.push_back(title);
    const int scene = header.at("scene");
    if (!model.scenes.empty())
        checkIndex(scene, model.scenes.size());
    model.scene = static_cast<std::size_t>(std::max(scene, 0));
    model.repairs.generatedNormals = header.at("generatedNormals");
    return model;
}

} // namespace

std::string writeModelHeader(const ImportedModel& model, std::size_t& payloadSize) {
    payloadSize = 0;
    json header;
    header["format"] = model.format;
    json& meshes = header["meshes"] = json::array();
    for (const auto& mesh : model.meshes) {
        meshes.push_back({{"name", mesh->name},
                          {"vertices", mesh->positions.size()},
                          {"indices", mesh->indices.size()},
                          {"normals", !mesh->normals.empty()},
                          {"tangents", !mesh->tangents.empty()},
                          {"uvs", !mesh->uvs.empty()}});
        forEachArray(*mesh, [&](const auto& values) {
            payloadSize += aligned(values.size() * sizeof(values[0]));
        });
        if (const MeshSource* source = meshSource(mesh)) {
            meshes.back()["source"] = {{"mesh", source->mesh}, {"primitive", source->primitive}};
            payloadSize += aligned(source->vertices.size() * sizeof(std::uint32_t));
        }
    }
    json& embedded = header["embedded"] = json::array();
    for (const Bytes& image : model.embeddedImages) {
        embedded.push_back(image.size());
        payloadSize += aligned(image.size());
    }
    json& materials = header["materials"] = json::array();
    for (const ImportedMaterial& material : model.materials)
        materials.push_back(write(material));
    json& instances = header["instances"] = json::array();
    for (const ImportedInstance& instance : model.instances) {
        json transform = json::array();
        for (int i = 0; i < 16; ++i)
            transform.push_back(instance.transform[i / 4][i % 4]);
        instances.push_back({{"name", instance.name},
                             {"mesh", instance.mesh},
                             {"material", instance.material},
                             {"node", instance.node},
                             {"transform", std::move(transform)}});
    }
    json& lights = header["lights"] = json::array();
    for (const ImportedLight& light : model.lights)
        lights.push_back({{"name", light.name},
                          {"type", static_cast<int>(light.type)},
                          {"range", light.range},
                          {"innerConeDeg", light.innerConeDeg},
                          {"outerConeDeg", light.outerConeDeg},
                          {"position", array<3>(light.position)},
                          {"direction", array<3>(light.direction)},
                          {"color", array<3>(light.color)}});
    json& cameras = header["cameras"] = json::array();
    for (const ImportedCamera& camera : model.cameras)
        cameras.push_back({{"name", camera.name},
                           {"position", array<3>(camera.position)},
                           {"forward", array<3>(camera.forward)},
                           {"up", array<3>(camera.up)},
                           {"fovDeg", camera.fovDeg}});
    header["warnings"] = model.warnings;
    header["scenes"] = model.scenes;
    header["scene"] = model.scene;
    header["generatedNormals"] = model.repairs.generatedNormals;
    return header.dump(-1, ' ', false, json::error_handler_t::replace);
}

void writeModelPayload(const ImportedModel& model, std::span<std::byte> payload) {
    const auto put = [&](const auto& values) {
        const std::size_t size = values.size() * sizeof(values[0]);
        if (size > 0)
            std::memcpy(payload.data(), values.data(), size);
        payload = payload.subspan(aligned(size));
    };
    for (const auto& mesh : model.meshes) {
        forEachArray(*mesh, put);
        if (const MeshSource* source = meshSource(mesh))
            put(source->vertices);
    }
    for (const Bytes& image : model.embeddedImages)
        put(image);
}

Result<ImportedModel> readModel(const std::string& header, std::span<const std::byte> payload) {
    try {
        return readUnchecked(json::parse(header), payload);
    } catch (const std::bad_alloc&) {
        return Error{ErrorKind::Internal, "there is not enough memory for the model", {}, {}};
    } catch (const std::exception& exception) {
        return Error{ErrorKind::InputBroken,
                     "the decoder gave an answer that makes no sense; the file is damaged",
                     {},
                     exception.what()};
    }
}

} // namespace patina
