#include "core/radiosity/document/RadiositySources.h"

#include "core/light/Lights.h"

#include <algorithm>

namespace patina {
namespace {

Light atUnitPower(const Light& light) {
    Light result = light;
    result.name.clear();
    result.enabled = true;
    result.solo = result.usesTemperature = false;
    result.color = result.tint = glm::vec3(1.0f);
    result.intensity = 1.0f;
    result.gainEv = 0.0f;
    result.temperatureK = Light().temperatureK;
    return result;
}

} // namespace

bool sameSource(const RadiositySource& a, const RadiositySource& b) {
    return a.kind == b.kind && a.lights == b.lights && a.environments == b.environments;
}

bool sameSides(const TraceInputs& a, const TraceInputs& b) {
    return a.meshes.size() == b.meshes.size() &&
           std::ranges::equal(a.meshes, b.meshes, [&](const TraceMesh& m, const TraceMesh& n) {
               return a.materials.at(m.material).doubleSided ==
                      b.materials.at(n.material).doubleSided;
           });
}

bool sameGlow(const TraceInputs& a, const TraceInputs& b) {
    return std::ranges::equal(a.meshes, b.meshes, [&](const TraceMesh& m, const TraceMesh& n) {
        const Material &x = a.materials.at(m.material), &y = b.materials.at(n.material);
        return x.emissive == y.emissive && x.emissiveStrength == y.emissiveStrength &&
               x.emissiveMap == y.emissiveMap;
    });
}

LightSources lightSourcesOf(const TraceInputs& inputs) {
    LightSources result{inputs, {}};
    if (!inputs.environments.empty()) {
        RadiositySource& sky = result.sources.emplace_back();
        sky.kind = RadiositySource::Kind::Sky;
        if (inputs.environments.size() == 1) {
            sky.power = glm::dvec3(inputs.environments.front().scale);
            result.inputs.environments.front().scale = glm::vec3(1.0f);
        }
        sky.environments = result.inputs.environments;
    }
    const std::size_t alone =
        inputs.lights.size() <= kMaxAloneSources ? inputs.lights.size() : kMaxAloneSources - 1;
    for (std::size_t i = 0; i < alone; ++i) {
        RadiositySource& source = result.sources.emplace_back();
        source.id = inputs.lights[i].id;
        source.power = glm::dvec3(lightPower(inputs.lights[i]));
        result.inputs.lights[i] = atUnitPower(inputs.lights[i]);
        source.lights = {result.inputs.lights[i]};
    }
    if (alone < inputs.lights.size()) {
        RadiositySource& rest = result.sources.emplace_back();
        rest.kind = RadiositySource::Kind::Lights;
        rest.lights.assign(inputs.lights.begin() + static_cast<std::ptrdiff_t>(alone),
                           inputs.lights.end());
    }
    return result;
}

} // namespace patina
