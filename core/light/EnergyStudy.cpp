#include "core/light/EnergyStudy.h"

#include "core/material/MaterialInputs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>

namespace patina {

namespace {

constexpr double kMadeLight = 1.005;   // beyond what the quadratures themselves err
constexpr double kAlike = 0.005;       // channels that need no telling apart
constexpr double kDisagreement = 0.03; // more than exact Fresnel terms differ by

// A scalar map's channel. "RGB" of a scalar is read as red by the shader.
float pick(const glm::vec4& texel, MapChannel channel) {
    switch (channel) {
    case MapChannel::G:
        return texel.y;
    case MapChannel::B:
        return texel.z;
    case MapChannel::A:
        return texel.w;
    default:
        return texel.x;
    }
}

glm::vec3 pickColor(const glm::vec4& texel, MapChannel channel) {
    return channel == MapChannel::Rgb ? glm::vec3(texel) : glm::vec3(pick(texel, channel));
}

SurfacePoint limited(SurfacePoint point) {
    point.baseColor = glm::clamp(point.baseColor, 0.0f, 1.0f);
    return point;
}

EnergyPoint energyPoint(const ShadingModel& model, const SurfacePoint& point, float NoV) {
    return {returnedFromEnvironment(withCompensation(model, false), point, NoV),
            returnedFromEnvironment(withCompensation(model, true), point, NoV),
            returnedFromLights(model, point, NoV)};
}

EnergyPoint averageEnergy(const ShadingModel& model, const SurfacePoint& point) {
    const auto average = [&](const ShadingModel& of) {
        return averageReturned([&](float NoV) { return returnedFromEnvironment(of, point, NoV); });
    };
    return {average(withCompensation(model, false)), average(withCompensation(model, true)),
            averageReturned([&](float NoV) { return returnedFromLights(model, point, NoV); })};
}

// The channel farthest from 0; none when they are alike.
struct Worst {
    std::optional<int> channel;
    double value = 0.0;
};

Worst worstChannel(const glm::dvec3& rgb) {
    int worst = 0;
    for (int c = 1; c < 3; ++c)
        if (std::abs(rgb[c]) > std::abs(rgb[worst]))
            worst = c;
    double spread = 0.0;
    for (int c = 0; c < 3; ++c)
        spread = std::max(spread, std::abs(rgb[worst] - rgb[c]));
    return {spread > kAlike ? std::optional(worst) : std::nullopt, rgb[worst]};
}

// The brightest numbers the maps hold, over the roughnesses they hold: what reflects most shows
// what is made. `low` and `high` each bound a number, so that their corners bound the material.
void findFaults(EnergyStudy& study, const JobContext& job) {
    constexpr std::array<float, 10> kViews{0.02f, 0.05f, 0.1f, 0.2f, 0.3f,
                                           0.45f, 0.6f,  0.8f, 0.9f, 1.0f};
    const SurfacePoint low = limited(study.surface.low), high = limited(study.surface.high);
    EnergyFault most{EnergyFault::Kind::MakesLight, {}, kMadeLight, 1.0f, 0.0f};
    EnergyFault gap{EnergyFault::Kind::LightsDiffer, {}, 0.0, 1.0f, 0.0f};
    const int roughnesses = low.perceptualRoughness == high.perceptualRoughness ? 1 : 5;
    const int metallics = low.metallic == high.metallic ? 1 : 2;
    for (int r = 0; r < roughnesses && !job.cancelled(); ++r)
        for (int m = 0; m < metallics; ++m)
            for (const float NoV : kViews) {
                SurfacePoint point = high;
                if (roughnesses > 1)
                    point.perceptualRoughness =
                        glm::mix(low.perceptualRoughness, high.perceptualRoughness,
                                 static_cast<float>(r) / static_cast<float>(roughnesses - 1));
                point.metallic = m == 0 ? low.metallic : high.metallic;
                const glm::dvec3 lights = returnedFromLights(study.model, point, NoV).total();
                const glm::dvec3 difference =
                    lights - returnedFromEnvironment(study.model, point, NoV).total();
                const Worst made = worstChannel(lights);
                if (made.value > most.value)
                    most = {most.kind, made.channel, made.value, NoV, point.perceptualRoughness};
                const Worst apart = worstChannel(difference);
                if (std::abs(apart.value) > std::abs(gap.value))
                    gap = {gap.kind, apart.channel, apart.value, NoV, point.perceptualRoughness};
            }
    if (most.value > kMadeLight)
        study.faults.push_back(most);
    else if (std::abs(gap.value) > kDisagreement) // light that is made differs, too
        study.faults.push_back(gap);

    const Worst brightest = worstChannel(glm::dvec3(study.surface.high.baseColor));
    if (brightest.value > 1.0)
        study.faults.push_back(
            {EnergyFault::Kind::ColorAboveOne, brightest.channel, brightest.value, 1.0f, 0.0f});
}

} // namespace

SurfaceRange surfaceRange(const Material& material,
                          const std::function<TexelRange(const ImagePtr&)>& rangeOf) {
    SurfaceRange range;
    const auto rangeOfMap = [&](const MapSlot& map) {
        return map.image ? rangeOf(map.image) : TexelRange();
    };
    PerInput<TexelRange> maps;
    for (const MaterialInputInfo& info : kMaterialInputs)
        if (info.role == InputRole::Number || info.input == MaterialInput::BaseColor)
            maps[info.input] = rangeOfMap(material.*info.map);
    const auto fill = [&](SurfacePoint& point, glm::vec4 TexelRange::*part) {
        point.baseColor = material.baseColor * pickColor(maps[MaterialInput::BaseColor].*part,
                                                         material.baseColorMap.channel);
        for (const MaterialInputInfo& info : kMaterialInputs)
            if (info.role == InputRole::Number)
                point.*info.shown =
                    std::clamp(material.*info.number *
                                   pick(maps[info.input].*part, (material.*info.map).channel),
                               0.0f, 1.0f);
        point.diffuseRoughness = material.diffuseRoughness;
        point.ior = material.ior;
    };
    fill(range.low, &TexelRange::low);
    fill(range.mean, &TexelRange::mean);
    fill(range.high, &TexelRange::high);
    return range;
}

float cosineOfAngle(float angleDeg) {
    return std::max(std::cos(glm::radians(angleDeg)), 1e-3f);
}

std::optional<EnergyStudy> studyEnergy(const ShadingModel& model, const SurfaceRange& surface,
                                       float NoV, const JobContext& job) {
    EnergyStudy study;
    study.model = model;
    study.surface = surface;
    study.NoV = NoV;
    const SurfacePoint mean = limited(surface.mean);

    // The two cuts.
    for (int i = 0; i < EnergyStudy::kRoughnesses && !job.cancelled(); ++i) {
        SurfacePoint point = mean;
        point.perceptualRoughness =
            static_cast<float>(i) / static_cast<float>(EnergyStudy::kRoughnesses - 1);
        study.byRoughness.push_back(energyPoint(model, point, NoV));
    }
    for (int i = 0; i < EnergyStudy::kAngles && !job.cancelled(); ++i)
        study.byAngle.push_back(
            energyPoint(model, mean,
                        cosineOfAngle(90.0f * static_cast<float>(i) /
                                      static_cast<float>(EnergyStudy::kAngles - 1))));

    // Seen from all sides.
    study.average = averageEnergy(model, mean);
    SurfacePoint roughest = mean;
    roughest.perceptualRoughness = surface.high.perceptualRoughness;
    study.roughest = averageEnergy(model, roughest);

    // The plane that the cuts are taken from.
    constexpr int n = EnergyStudy::kMapSize;
    for (int y = 0; y < n && !job.cancelled(); ++y) {
        const float cosine = cosineOfAngle(90.0f * (static_cast<float>(y) + 0.5f) / n);
        for (int x = 0; x < n; ++x) {
            SurfacePoint point = mean;
            point.perceptualRoughness = (static_cast<float>(x) + 0.5f) / n;
            study.map.emplace_back(returnedFromEnvironment(model, point, cosine).total());
        }
    }
    findFaults(study, job);
    if (job.cancelled())
        return std::nullopt;
    return study;
}

} // namespace patina
