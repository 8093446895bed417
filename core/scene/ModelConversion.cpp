#include "core/scene/ModelConversion.h"

#include "core/base/Check.h"
#include "core/base/Utf8.h"
#include "core/edit/Parameters.h"
#include "core/light/Light.h"
#include "core/light/Lights.h"
#include "core/material/MaterialInputs.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace patina {
namespace {

std::string nameOr(const std::string& name, const std::string& fallback) {
    return name.empty() ? fallback : makeValidUtf8(name);
}

MapSlot convertTexture(const std::optional<ImportedTexture>& texture, const std::string& model,
                       MapChannel wholeImage) {
    if (!texture)
        return {};
    MapSlot slot;
    slot.channel = wholeImage;
    slot.source = texture->embedded >= 0 ? formatEmbeddedSource({model, texture->embedded})
                                         : normalizeSource(texture->file.string());
    switch (texture->channel) {
    case 'r':
        slot.channel = MapChannel::R;
        break;
    case 'g':
        slot.channel = MapChannel::G;
        break;
    case 'b':
        slot.channel = MapChannel::B;
        break;
    case 'a':
        slot.channel = MapChannel::A;
        break;
    default:
        break;
    }
    slot.uvScale = texture->uvScale;
    slot.uvOffset = texture->uvOffset;
    slot.uvRotationDeg = texture->uvRotationDeg;
    return slot;
}

// A colour of any brightness as a colour within 0…1 and a factor of at least `least`.
std::pair<glm::vec3, float> splitBrightness(const glm::vec3& color, float least) {
    const float brightest = std::max({color.r, color.g, color.b, least});
    return {brightest > 0.0f ? color / brightest : glm::vec3(1.0f), brightest};
}

// Every number into the range of its parameter: files hold anything.
template <class Elements>
void clampAll(Elements& elements, Elements Document::*list, Scope scope) {
    Document scratch;
    for (auto& element : elements) {
        (scratch.*list).assign(1, std::move(element));
        (scratch.*list).front().id = 1;
        for (const ParameterInfo& info : parameters())
            if (info.scope == scope)
                info.set(scratch, 1, clampToRange(info, info.get(scratch, 1)));
        element = std::move((scratch.*list).front());
        element.id = 0;
    }
}

Material convertMaterial(const ImportedMaterial& imported, const std::string& model) {
    Material material;
    material.name = nameOr(imported.name, "Material");
    material.baseColor = glm::vec3(imported.baseColor);
    material.opacity = imported.baseColor.a;
    for (const MaterialInputInfo& info : kMaterialInputs) {
        if (info.number != nullptr)
            material.*info.number = imported.numbers[info.input];
        material.*info.map = convertTexture(imported.maps[info.input], model, info.channel);
    }
    std::tie(material.emissive, material.emissiveStrength) =
        splitBrightness(imported.emissive, 1.0f);
    material.alphaMode = imported.alphaMask    ? AlphaMode::Mask
                         : imported.alphaBlend ? AlphaMode::Blend
                                               : AlphaMode::Opaque;
    material.alphaCutoff = imported.alphaCutoff;
    material.doubleSided = imported.doubleSided;
    material.ior = imported.ior;
    material.thinWalled = imported.thinWalled;
    material.attenuationColor = imported.attenuationColor;
    material.attenuationDistance = imported.attenuationDistance;
    return material;
}

Light convertLight(const ImportedLight& imported) {
    Light light;
    light.name = nameOr(imported.name, "Light");
    using Type = ImportedLight::Type;
    light.type = imported.type == Type::Directional ? LightType::Directional
                 : imported.type == Type::Spot      ? LightType::Spot
                                                    : LightType::Point;
    std::tie(light.color, light.intensity) = splitBrightness(imported.color, 0.0f);
    light.position = imported.position;
    setDirectionToLight(light, -imported.direction);
    light.range = imported.range;
    light.innerConeDeg = imported.innerConeDeg;
    light.outerConeDeg = imported.outerConeDeg;
    return light;
}

} // namespace

SceneLoader::Model convertModel(ImportedModel imported, const std::string& source) {
    SceneLoader::Model model;
    for (const ImportedMaterial& material : imported.materials)
        model.materials.push_back(convertMaterial(material, source));
    clampAll(model.materials, &Document::materials, Scope::Material);
    for (const ImportedLight& light : imported.lights)
        model.lights.push_back(convertLight(light));
    clampAll(model.lights, &Document::lights, Scope::Light);
    for (const ImportedCamera& camera : imported.cameras)
        model.cameras.push_back({nameOr(camera.name, "Camera"), camera.position, camera.forward,
                                 camera.up, camera.fovDeg});
    const std::string stem = std::filesystem::path(source).stem().string();
    for (const ImportedInstance& instance : imported.instances) {
        const std::size_t index = static_cast<std::size_t>(instance.mesh);
        CHECK_LT(index, imported.meshes.size());
        const MeshPtr& mesh = imported.meshes[index];
        const std::string& name = instance.name.empty() ? mesh->name : instance.name;
        model.parts.push_back({nameOr(name, makeValidUtf8(stem)), mesh, instance.transform,
                               static_cast<std::size_t>(instance.material)});
    }
    model.embeddedImages = std::move(imported.embeddedImages);
    return model;
}

SceneLoader::Model convertModel(const std::vector<library::ModelPart>& parts) {
    SceneLoader::Model model;
    for (const library::ModelPart& part : parts) {
        const auto known = std::find_if(
            model.materials.begin(), model.materials.end(),
            [&](const Material& material) { return material.name == part.materialName; });
        const auto index = static_cast<std::size_t>(known - model.materials.begin());
        if (known == model.materials.end()) {
            Material& material = model.materials.emplace_back(part.material);
            material.name = part.materialName;
        }
        model.parts.push_back({part.name, part.mesh, glm::mat4(1.0f), index});
    }
    return model;
}

} // namespace patina
