#include "core/export/GltfWriter.h"

#include "core/export/GltfEnvironment.h"
#include "core/export/GltfGeometry.h"
#include "core/export/Names.h"
#include "core/export/ShFile.h"
#include "core/light/Light.h"
#include "core/light/Lights.h"
#include "core/material/MaterialInputs.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <glm/trigonometric.hpp>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

namespace patina {
namespace {

using Json = nlohmann::ordered_json;

// Values of the glTF and GLB specifications.
constexpr int kRepeat = 10497, kLinear = 9729, kLinearMipmapLinear = 9987;
constexpr std::uint32_t kGlbMagic = 0x46546c67, kGlbJson = 0x4e4f534a, kGlbBinary = 0x004e4942;
constexpr std::uint64_t kMaxBytes = 0xffffffffu;
constexpr const char* kVariants = "KHR_materials_variants";
constexpr const char* kUnlit = "KHR_materials_unlit";
constexpr const char* kSpecular = "KHR_materials_specular";

template <class Vector>
Json toJson(const Vector& v) {
    Json array = Json::array();
    for (glm::length_t i = 0; i < v.length(); ++i)
        array.push_back(v[i]);
    return array;
}

class Writer {
  public:
    Writer(const ExportContents& contents, const ExportSettings& settings,
           const GltfEnvironment* environment)
        : m_contents(contents)
        , m_settings(settings)
        , m_environment(environment) {}

    GltfOutput write(const std::vector<Bytes>& images) {
        for (std::size_t i = 0; i < m_contents.materials.size(); ++i)
            m_materials.push_back(material(*m_contents.materials[i],
                                           m_contents.textures.materials[i], static_cast<int>(i)));
        writeInstances();
        writeLights();
        writeTextures(images);
        if (m_environment != nullptr)
            writeEnvironment(*m_environment);
        return {assemble(), m_geometry.takeBuffer()};
    }

  private:
    void writeInstances() {
        // A mesh is written once for each material it is seen with, and for each place whose light
        // is baked; its numbers only once.
        std::map<
            std::tuple<const Mesh*, int, const VertexBake*, const LitVertices*, std::vector<int>>,
            int>
            known;
        std::set<const Mesh*> needTangents;
        const auto hasNormalMap = [&](int material) {
            return material >= 0 && textures(material)[MaterialInput::Normal].texture >= 0;
        };
        for (const ExportedInstance& exported : m_contents.instances)
            if (hasNormalMap(exported.material) ||
                std::ranges::any_of(exported.variants, hasNormalMap))
                needTangents.insert(exported.instance->mesh.get());

        std::map<const Mesh*, int> places;
        for (const ExportedInstance& exported : m_contents.instances)
            ++places[exported.instance->mesh.get()];

        UniqueNames nodeNames, meshNames;
        for (const ExportedInstance& exported : m_contents.instances) {
            const MeshInstance& instance = *exported.instance;
            const Mesh& mesh = *instance.mesh;
            const auto [entry, isNew] = known.try_emplace(
                {&mesh, exported.material, exported.transfer, exported.light, exported.variants},
                static_cast<int>(m_meshes.size()));
            if (isNew) {
                Json primitive = m_geometry.primitive(mesh, needTangents.contains(&mesh));
                if (exported.material >= 0)
                    primitive["material"] = exported.material;
                addVariants(primitive, exported.variants);
                if (exported.transfer != nullptr)
                    addTransfer(primitive["attributes"], *exported.transfer);
                if (exported.light != nullptr && !exported.light->lightMapUvs.empty()) {
                    primitive["attributes"]["TEXCOORD_1"] =
                        m_geometry.addAttribute(exported.light->lightMapUvs);
                } else if (exported.light != nullptr) {
                    Json& attributes = primitive["attributes"];
                    attributes["COLOR_0"] = m_geometry.addAttribute(exported.light->colors);
                    attributes["_RADIANCE"] = m_geometry.addAttribute(exported.light->radiance);
                    if (!exported.light->whiteRadiance.empty())
                        attributes["_WHITE_RADIANCE"] =
                            m_geometry.addAttribute(exported.light->whiteRadiance);
                }
                // A mesh that stands in one place alone is called as the user calls it there.
                const std::string own = cleanName(instance.name, "Mesh");
                const std::string name = places[&mesh] == 1 ? own : cleanName(mesh.name, own);
                m_meshes.push_back(
                    {{"name", meshNames.take(name)}, {"primitives", Json::array({primitive})}});
            }
            const Json node = {{"name", nodeNames.take(cleanName(instance.name, "Mesh"))}};
            addNode(node, exported.transform, {{"mesh", entry->second}});
        }
        m_nodeNames = std::move(nodeNames);
    }

    // A mapping for each material: the variants that show it. One that is in none of them shows
    // the primitive's own.
    void addVariants(Json& primitive, const std::vector<int>& materials) {
        std::map<int, Json> variants;
        for (std::size_t i = 0; i < materials.size() && !m_contents.variants.empty(); ++i)
            if (materials[i] >= 0)
                variants[materials[i]].push_back(i);
        if (variants.empty())
            return;
        Json mappings = Json::array();
        for (auto& [material, of] : variants)
            mappings.push_back({{"material", material}, {"variants", std::move(of)}});
        primitive["extensions"][kVariants]["mappings"] = std::move(mappings);
        m_extensions.insert(kVariants);
    }

    void addTransfer(Json& attributes, const VertexBake& bake) {
        const auto values = transferAttributes(bake, m_contents.transferLayout);
        for (std::size_t i = 0; i < values.size(); ++i)
            attributes[fmt::format("_PRT_{}", i)] = m_geometry.addAttribute(values[i]);
    }

    // Nested nodes for a chain of transforms; `payload` belongs to the innermost.
    void addNode(const Json& outermost, const std::vector<NodeTransform>& chain,
                 const Json& payload) {
        m_roots.push_back(static_cast<int>(m_nodes.size()));
        for (std::size_t i = 0; i < chain.size(); ++i) {
            const NodeTransform& t = chain[i];
            Json node = i == 0 ? outermost : Json::object();
            if (t.translation != glm::dvec3(0.0))
                node["translation"] = toJson(t.translation);
            if (t.rotation != glm::dquat(1.0, 0.0, 0.0, 0.0))
                node["rotation"] = {t.rotation.x, t.rotation.y, t.rotation.z, t.rotation.w};
            if (t.scale != glm::dvec3(1.0))
                node["scale"] = toJson(t.scale);
            if (i + 1 < chain.size())
                node["children"] = Json::array({m_nodes.size() + 1});
            else
                node.update(payload);
            m_nodes.push_back(std::move(node));
        }
    }

    void writeLights() {
        UniqueNames names;
        for (const Light* light : m_contents.lights) {
            // The extension wants colours within 0…1: what is brighter goes into the intensity.
            const glm::vec3 color = lightColor(*light) * light->tint;
            const float peak = std::max({color.r, color.g, color.b, 1.0f});
            const std::string name = cleanName(light->name, "Light");
            NodeTransform transform;
            if (hasDirection(light->type))
                transform.rotation = rotationFromMinusZ(-glm::dvec3(light->directionToLight()));
            if (hasPosition(light->type))
                transform.translation = light->position;
            const Json reference = {
                {"KHR_lights_punctual", {{"light", static_cast<int>(m_lights.size())}}}};
            Json json = {{"name", names.take(name)},
                         {"type", light->type == LightType::Directional ? "directional"
                                  : light->type == LightType::Spot      ? "spot"
                                                                        : "point"},
                         {"color", toJson(color / peak)},
                         {"intensity", lightIntensity(*light) * peak}};
            if (hasRange(light->type) && light->range > 0.0f)
                json["range"] = light->range;
            if (light->type == LightType::Spot) {
                // The extension wants the inner cone to be smaller; ours ends at the outer one.
                const double outer = glm::radians(static_cast<double>(light->outerConeDeg));
                const double inner = glm::radians(static_cast<double>(light->innerConeDeg));
                json["spot"] = {{"innerConeAngle", std::min(inner, 0.999 * outer)},
                                {"outerConeAngle", outer}};
            }
            m_lights.push_back(std::move(json));
            addNode({{"name", m_nodeNames.take(name)}}, {transform}, {{"extensions", reference}});
        }
        if (!m_lights.empty())
            m_extensions.insert("KHR_lights_punctual");
    }

    Json material(const Material& m, const MaterialTextures& t, int index) {
        Json pbr = {{"baseColorFactor", {m.baseColor.r, m.baseColor.g, m.baseColor.b, m.opacity}}};
        for (const MaterialInputInfo& info : kMaterialInputs)
            if (info.gltf.object == kGltfPbr && !info.gltf.factor.empty())
                pbr[std::string(info.gltf.factor)] = m.*info.number;
        for (const MaterialInputInfo& info : kMaterialInputs)
            if (info.gltf.object == kGltfPbr)
                addTexture(pbr, info.gltf.texture, t[info.input]);

        Json result = {{"name", m_materialNames.take(cleanName(m.name, "Material"))},
                       {"pbrMetallicRoughness", std::move(pbr)}};
        for (const MaterialInputInfo& info : kMaterialInputs)
            if (info.gltf.object.empty() && addTexture(result, info.gltf.texture, t[info.input]) &&
                !info.gltf.scale.empty() && m.*info.number != info.gltf.absent)
                result[std::string(info.gltf.texture)][std::string(info.gltf.scale)] =
                    m.*info.number;
        addEmission(result, m);
        addExtensions(result, m, t);
        if (m_settings.lit == nullptr)
            addVolume(result, m, index);
        if (m.alphaMode == AlphaMode::Mask) {
            result["alphaMode"] = "MASK";
            result["alphaCutoff"] = m.alphaCutoff;
        } else if (m.alphaMode == AlphaMode::Blend) {
            result["alphaMode"] = "BLEND";
        }
        if (m.doubleSided)
            result["doubleSided"] = true;
        for (const ExportedLightMap& map : m_contents.lightMaps)
            if (map.material == index)
                for (std::size_t i = 0; i < kLightMapParts.size(); ++i)
                    result["extras"]["patinaBakedLight"][std::string(kLightMapParts[i].key)] =
                        map.paths[i].filename().string();
        if (m_settings.lightMap != nullptr) {
            takeLightMap(result);
        } else if (m_settings.lit != nullptr) {
            result["extensions"][kUnlit] = Json::object();
            m_extensions.insert(kUnlit);
        }
        return result;
    }

    // The emissive texture is the light map. Beside it the surface shows nothing, whatever lights
    // it: black is not enough, as all but metals reflect 4 % without KHR_materials_specular.
    // (KHR_materials_unlit would show the base colour in place of the emission.) Blender 3.4 reads
    // the colour alone, others the factor.
    void takeLightMap(Json& result) {
        if (result.contains("emissiveTexture"))
            result["emissiveTexture"]["texCoord"] = 1;
        result["extensions"][kSpecular] = {{"specularFactor", 0.0},
                                           {"specularColorFactor", {0.0, 0.0, 0.0}}};
        m_extensions.insert(kSpecular);
    }

    // emissiveFactor stays within 0…1; what is brighter is KHR_materials_emissive_strength's.
    void addEmission(Json& result, const Material& m) {
        glm::vec3 factor = m.emissive;
        float strength = m.emissiveStrength;
        const float peak = std::max({factor.r, factor.g, factor.b});
        if (peak > 1.0f || strength < 1.0f) {
            const float brightest = std::max(peak * strength, 1.0f);
            factor = factor * strength / brightest;
            strength = brightest;
        }
        if (factor == glm::vec3(0.0f))
            return;
        result["emissiveFactor"] = toJson(factor);
        if (strength > 1.0f) {
            result["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = strength;
            m_extensions.insert("KHR_materials_emissive_strength");
        }
    }

    // Inputs that glTF keeps in extensions: those that are not as without the extension.
    void addExtensions(Json& result, const Material& m, const MaterialTextures& t) {
        for (const MaterialInputInfo& info : kMaterialInputs) {
            if (info.gltf.object.empty() || info.gltf.object == kGltfPbr)
                continue;
            Json object = Json::object();
            if (m.*info.number != info.gltf.absent)
                object[std::string(info.gltf.factor)] = m.*info.number;
            addTexture(object, info.gltf.texture, t[info.input]);
            if (object.empty())
                continue;
            const std::string name(info.gltf.object);
            result["extensions"][name].update(object);
            m_extensions.insert(name);
        }
    }

    void addVolume(Json& result, const Material& m, int index) {
        const auto add = [&](const char* name, Json object) {
            result["extensions"][name] = std::move(object);
            m_extensions.insert(name);
        };
        if (m.ior != Material().ior)
            add("KHR_materials_ior", {{"ior", m.ior}});
        if (m.thinWalled)
            return; // as without a thickness
        Json volume = {{"thicknessFactor", bodyThickness(index)}};
        if (m.attenuationDistance > 0.0f) {
            volume["attenuationDistance"] = m.attenuationDistance;
            volume["attenuationColor"] = toJson(m.attenuationColor);
        }
        add("KHR_materials_volume", std::move(volume));
    }

    // Patina finds the thickness of a body by its mesh; programs that do not take a number, in the
    // mesh's units. That of the flattest of them, as its box has it.
    [[nodiscard]] float bodyThickness(int material) const {
        float thinnest = std::numeric_limits<float>::infinity();
        for (const ExportedInstance& exported : m_contents.instances)
            if (exported.material == material ||
                std::ranges::find(exported.variants, material) != exported.variants.end()) {
                const Bounds bounds = exported.instance->mesh->bounds();
                const glm::vec3 size = bounds.max - bounds.min;
                thinnest = std::min({thinnest, size.x, size.y, size.z});
            }
        // Above 0: that is what tells a body from a wall.
        return std::isfinite(thinnest) ? std::max(thinnest, 1e-3f) : 1.0f;
    }

    bool addTexture(Json& parent, std::string_view key, const TextureUse& use) {
        if (use.texture < 0)
            return false;
        Json info = {{"index", use.texture}};
        Json transform = Json::object();
        if (use.offset != glm::vec2(0.0f))
            transform["offset"] = toJson(use.offset);
        if (use.rotationDeg != 0.0f)
            transform["rotation"] = glm::radians(use.rotationDeg);
        if (use.scale != glm::vec2(1.0f))
            transform["scale"] = toJson(use.scale);
        if (!transform.empty()) {
            info["extensions"]["KHR_texture_transform"] = std::move(transform);
            m_extensions.insert("KHR_texture_transform");
        }
        parent[std::string(key)] = std::move(info);
        return true;
    }

    void writeTextures(const std::vector<Bytes>& images) {
        for (std::size_t i = 0; i < m_contents.textures.textures.size(); ++i) {
            const PackedTexture& texture = m_contents.textures.textures[i];
            Json image = {{"name", texture.name}};
            if (m_settings.format == ExportFormat::Glb) {
                image["bufferView"] = m_geometry.addImage(images.at(i));
                image["mimeType"] = texture.mimeType();
            } else {
                image["uri"] = texture.name + texture.extension();
            }
            m_images.push_back(std::move(image));
            m_textures.push_back({{"sampler", 0}, {"source", static_cast<int>(i)}});
        }
    }

    void writeEnvironment(const GltfEnvironment& environment) {
        Json irradiance = Json::array(), levels = Json::array(), roughness = Json::array();
        for (const glm::vec3& coefficient : environment.irradiance)
            irradiance.push_back(toJson(coefficient));
        for (const std::array<Bytes, 6>& faces : environment.images) {
            Json indices = Json::array();
            for (const Bytes& face : faces) {
                indices.push_back(m_images.size());
                m_images.push_back(
                    {{"bufferView", m_geometry.addImage(face)}, {"mimeType", "image/png"}});
            }
            roughness.push_back(static_cast<double>(levels.size()) /
                                static_cast<double>(environment.images.size() - 1));
            levels.push_back(std::move(indices));
        }
        const glm::dquat& q = environment.rotation;
        // The intensity is optional, but Babylon.js makes NaN of the light without it.
        m_environmentLight = {{"name", cleanName(environment.name, "Environment")},
                              {"rotation", {q.x, q.y, q.z, q.w}},
                              {"intensity", environment.intensity},
                              {"irradianceCoefficients", std::move(irradiance)},
                              {"specularImageSize", kGltfEnvironmentSize},
                              {"specularImages", std::move(levels)},
                              // The extension does not say which roughness an image is for.
                              {"extras", {{"perceptualRoughness", std::move(roughness)}}}};
        m_extensions.insert("EXT_lights_image_based");
    }

    std::string assemble() {
        Json root;
        root["asset"] = {{"version", "2.0"}, {"generator", "Patina " PATINA_VERSION}};
        if (!m_extensions.empty())
            root["extensionsUsed"] = m_extensions;
        root["scene"] = 0;
        root["scenes"] = Json::array({{{"nodes", m_roots}}});
        root["nodes"] = m_nodes;
        root["meshes"] = m_meshes;
        // Empty arrays are not allowed: what there is none of is left out.
        if (!m_materials.empty())
            root["materials"] = m_materials;
        if (!m_textures.empty()) {
            root["textures"] = m_textures;
            root["samplers"] = Json::array({{{"magFilter", kLinear},
                                             {"minFilter", kLinearMipmapLinear},
                                             {"wrapS", kRepeat},
                                             {"wrapT", kRepeat}}});
        }
        if (!m_images.empty())
            root["images"] = m_images;
        root["accessors"] = m_geometry.accessors();
        root["bufferViews"] = m_geometry.bufferViews();
        Json buffer;
        if (m_settings.format == ExportFormat::Gltf)
            buffer["uri"] = m_contents.buffer.filename().string();
        buffer["byteLength"] = m_geometry.byteLength();
        root["buffers"] = Json::array({buffer});
        if (!m_lights.empty())
            root["extensions"]["KHR_lights_punctual"]["lights"] = m_lights;
        if (!m_contents.variants.empty()) {
            Json variants = Json::array();
            UniqueNames names;
            for (const std::string& name : m_contents.variants)
                variants.push_back({{"name", names.take(cleanName(name, "Snapshot"))}});
            root["extensions"][kVariants]["variants"] = std::move(variants);
        }
        if (!m_environmentLight.is_null()) {
            root["extensions"]["EXT_lights_image_based"]["lights"] =
                Json::array({m_environmentLight});
            root["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 0;
        }
        if (m_contents.transfer != nullptr) {
            const TransferLayout& layout = m_contents.transferLayout;
            root["extras"]["patinaTransfer"] = {
                {"bands", layout.bands},
                {"colors", layout.colored ? 3 : 1},
                {"attributes", layout.attributes()},
                {"light", m_contents.transferLightPath(m_settings).filename().string()},
                {"shader", m_contents.transferShaderPath(m_settings).filename().string()},
                {"formula", "radiance = base colour * max(0, sum L_i t_i); t_i four to a _PRT_n; "
                            "of three colours red first, then green, then blue"},
                {"basis", kShBasisText}};
        }
        if (!m_contents.lightMaps.empty())
            root["extras"]["patinaBakedLight"] = {
                {"texCoord", 0},
                {"shader", m_contents.lightMapShaderPath(m_settings).filename().string()},
                {"irradiance", "W/m^2, to be added to the environment's; may be negative"},
                {"reflections",
                 "3 x 3 harmonics of the mirror direction, row by row: RGB to be "
                 "added to the prefiltered radiance, A the share of it to leave out"},
                {"bentNormal", "world, +Y up; its length is the ambient visibility"},
                {"basis", kShBasisText}};
        if (m_settings.lightMap != nullptr) {
            const std::optional<double>& k = m_settings.lightMap->exposure;
            root["extras"]["patinaLightMap"] = {
                {"texCoord", 1},
                {"radiance", lightMapPath(m_settings.output, ".exr").filename().string()},
                {"unit", "W/(m^2 sr)"},
                {"exposure", k ? Json(*k) : Json()}};
        }
        return root.dump(m_settings.format == ExportFormat::Gltf ? 2 : -1);
    }

    [[nodiscard]] const MaterialTextures& textures(int material) const {
        return m_contents.textures.materials[static_cast<std::size_t>(material)];
    }

    const ExportContents& m_contents;
    const ExportSettings& m_settings;
    const GltfEnvironment* m_environment;
    GltfGeometry m_geometry;
    UniqueNames m_nodeNames, m_materialNames;
    std::set<std::string> m_extensions;
    std::vector<int> m_roots;
    std::vector<Json> m_nodes, m_meshes, m_materials, m_textures, m_images, m_lights;
    Json m_environmentLight;
};

void append(Bytes& out, std::uint32_t value) {
    for (int shift = 0; shift < 32; shift += 8)
        out.push_back(static_cast<std::byte>(value >> shift));
}

} // namespace

Result<GltfOutput> writeGltf(const ExportContents& contents, const ExportSettings& settings,
                             const std::vector<Bytes>& images, const GltfEnvironment* environment) {
    GltfOutput output = Writer(contents, settings, environment).write(images);
    // GLB counts in 32 bits, and few readers take larger buffers from a .gltf.
    if (output.json.size() + output.buffer.size() + 64 > kMaxBytes)
        return Error{ErrorKind::Usage,
                     "the scene is larger than the 4 GiB a glTF file can hold; export fewer meshes "
                     "or smaller textures",
                     settings.output,
                     {}};
    return output;
}

Bytes packGlb(const GltfOutput& gltf) {
    const auto padded = [](std::size_t size) { return (size + 3) / 4 * 4; };
    const std::size_t jsonSize = padded(gltf.json.size());
    const std::size_t bufferSize = padded(gltf.buffer.size());
    Bytes out;
    out.reserve(28 + jsonSize + bufferSize);
    append(out, kGlbMagic);
    append(out, 2);
    append(out, static_cast<std::uint32_t>(28 + jsonSize + bufferSize));
    append(out, static_cast<std::uint32_t>(jsonSize));
    append(out, kGlbJson);
    const auto json = std::as_bytes(std::span(gltf.json));
    out.insert(out.end(), json.begin(), json.end());
    out.resize(20 + jsonSize, std::byte{' '});
    append(out, static_cast<std::uint32_t>(bufferSize));
    append(out, kGlbBinary);
    out.insert(out.end(), gltf.buffer.begin(), gltf.buffer.end());
    out.resize(28 + jsonSize + bufferSize, std::byte{0});
    return out;
}

} // namespace patina
