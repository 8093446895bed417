#include "core/trace/path/TraceHash.h"

#include <cstdint>
#include <map>
#include <vector>

namespace patina {
namespace {

void hashVector(Hasher& hasher, const glm::vec3& v) {
    hasher.value(v.x).value(v.y).value(v.z);
}

template <class Enum>
void hashChoice(Hasher& hasher, Enum choice) {
    hasher.value(static_cast<std::int32_t>(choice));
}

void hashSlot(Hasher& hasher, const MapSlot& slot, bool matters = true) {
    const bool there = matters && slot.image != nullptr;
    hasher.value(static_cast<std::int32_t>(there));
    if (!there)
        return;
    hasher.value(hashImage(*slot.image));
    hashChoice(hasher, slot.channel);
    hasher.value(slot.uvScale.x).value(slot.uvScale.y);
    hasher.value(slot.uvOffset.x).value(slot.uvOffset.y).value(slot.uvRotationDeg);
}

// Occlusion is left out: paths find it by themselves.
void hashMaterial(Hasher& hasher, const Material& m) {
    hashVector(hasher, m.baseColor);
    hashSlot(hasher, m.baseColorMap);
    hasher.value(m.metallic);
    hashSlot(hasher, m.metallicMap);
    hasher.value(m.perceptualRoughness).value(m.diffuseRoughness);
    hashSlot(hasher, m.perceptualRoughnessMap);
    hasher.value(m.normalStrength);
    hashSlot(hasher, m.normalMap);
    hashChoice(hasher, m.normalConvention);
    hashVector(hasher, m.emissive);
    hashSlot(hasher, m.emissiveMap);
    hasher.value(m.emissiveStrength).value(m.opacity);
    hashChoice(hasher, m.alphaMode);
    hasher.value(m.alphaCutoff);
    hasher.value(static_cast<std::int32_t>(m.doubleSided));
    // Where a material has what materials had before: pictures traced then still fit.
    if (m.transmission == 0.0f && m.ior == Material().ior)
        return;
    hasher.value(m.transmission).value(m.ior);
    hashSlot(hasher, m.transmissionMap);
    hasher.value(static_cast<std::int32_t>(m.thinWalled));
    hashVector(hasher, m.attenuationColor);
    hasher.value(m.attenuationDistance);
}

void hashModel(Hasher& hasher, const ShadingModel& model) {
    hashChoice(hasher, model.distribution);
    hashChoice(hasher, model.visibility);
    hashChoice(hasher, model.fresnel);
    hashChoice(hasher, model.diffuse);
    hasher.value(static_cast<std::int32_t>(model.multiScatter));
    hasher.value(model.f90).value(model.ior);
    hashVector(hasher, model.conductorN);
    hashVector(hasher, model.conductorK);
}

void hashLight(Hasher& hasher, const Light& light) {
    hashChoice(hasher, light.type);
    hasher.value(static_cast<std::int32_t>(light.usesTemperature));
    hashVector(hasher, light.color);
    hasher.value(light.temperatureK).value(light.intensity).value(light.gainEv);
    hashVector(hasher, light.tint);
    hashVector(hasher, light.position);
    for (const float value :
         {light.azimuthDeg, light.elevationDeg, light.rollDeg, light.range, light.innerConeDeg,
          light.outerConeDeg, light.radius, light.width, light.height, light.shadowSoftness})
        hasher.value(value);
    hasher.value(static_cast<std::int32_t>(light.castsShadow));
}

} // namespace

TraceHash hashTraceInputs(const TraceInputs& inputs) {
    Hasher geometry, materials, lights, environment;
    // Materials count by the order of their first use.
    std::map<std::size_t, std::uint32_t> used;
    for (const TraceMesh& mesh : inputs.meshes) {
        geometry.value(mesh.mesh ? hashMesh(*mesh.mesh) : Hash{});
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 4; ++row)
                geometry.value(mesh.transform[column][row]);
        const auto next = static_cast<std::uint32_t>(used.size());
        const auto [material, isNew] = used.try_emplace(mesh.material, next);
        materials.value(material->second);
        if (isNew)
            hashMaterial(materials, inputs.materials[mesh.material]);
    }
    hashModel(materials, inputs.model);
    for (const Light& light : inputs.lights)
        hashLight(lights, light);
    for (const TraceEnvironment& one : inputs.environments) {
        environment.value(one.image ? hashImage(*one.image) : Hash{});
        environment.value(one.orientation.rotationDeg);
        if (!one.orientation.isLevel()) { // films of before know neither
            environment.value(one.orientation.tiltDeg);
            environment.value(one.orientation.rollDeg);
        }
        hashVector(environment, one.scale);
    }
    return {geometry.finish(), materials.finish(), lights.finish(), environment.finish()};
}

std::optional<std::string> differingInputs(const TraceHash& there, const TraceHash& here) {
    if (there.geometry != here.geometry)
        return "the geometry";
    if (there.materials != here.materials)
        return "the materials or the shading model";
    if (there.lights != here.lights)
        return "the lights";
    if (there.environment != here.environment)
        return "the environment";
    return std::nullopt;
}

} // namespace patina
