#include "core/light/Light.h"
#include "render/view/ExplanationParts.h"

#include "core/light/Lights.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace patina::render {
namespace {

using namespace shading;

const char* typeName(LightType type) {
    switch (type) {
    case LightType::Point:
        return "Point";
    case LightType::Directional:
        return "Directional";
    case LightType::Spot:
        return "Spot";
    case LightType::Sphere:
        return "Sphere";
    case LightType::Rectangle:
        return "Rectangle";
    }
    return "";
}

// Shares too small to be seen are compared by their difference: the tails of lobes lose digits.
float unseen(const Subject& subject) {
    const glm::vec4& picture = subject.pixel.radiance;
    return std::max(0.1f * std::max({picture.x, picture.y, picture.z}), kAgreement);
}

// How much light reaches a surface that faces the light.
ExplainedStep arrivingStep(const Light& light, const LightShare& share, const glm::vec3& position) {
    const glm::vec3 source = lightPower(light);
    const std::string unit(intensityUnit(light.type));
    ExplainedStep step{"arriving",
                       "Arriving Light",
                       {},
                       {},
                       color("arriving", "Facing the Light", "E", share.arriving, "lx"),
                       {},
                       true,
                       {}};
    const ExplainedValue shadow = scalar("shadow", "Not in Shadow", "S", share.shadow);
    if (light.type == LightType::Directional) {
        step.formula = "I · S";
        step.factors = {color("intensity", "Colour · Intensity", "I", source, unit), shadow};
        compare(step, source * share.shadow);
        return step;
    }
    const glm::vec3 toLight = light.position - position;
    const float distance2 = glm::dot(toLight, toLight);
    const float inverseRange2 = light.range > 0.0f ? 1.0f / (light.range * light.range) : 0.0f;
    step.formula = "I / d² · S";
    step.factors = {color("intensity", "Colour · Intensity", "I", source, unit),
                    scalar("distance", "Distance", "d", std::sqrt(distance2), "m")};
    float reaches = pointFalloff(distance2, inverseRange2);
    if (light.range > 0.0f) {
        step.formula = "I / d² · W · S";
        step.factors.push_back(
            scalar("rangeWindow", "End of Its Range", "W", rangeWindow(distance2, inverseRange2)));
    }
    if (light.type == LightType::Spot) {
        const auto [scale, offset] = coneScaleOffset(light);
        const float cone =
            spotFalloff(glm::dot(light.directionToLight(), share.toLight), scale, offset);
        step.formula.insert(step.formula.rfind(" · S"), " · C");
        step.factors.push_back(scalar("cone", "Cone", "C", cone));
        reaches *= cone;
    }
    step.factors.push_back(shadow);
    compare(step, source * reaches * share.shadow);
    return step;
}

// G = 4 N·L N·V V, which artists know from the literature; V is what is computed.
void addAngles(ExplainedSection& section, const RebuiltLight& light, const SurfaceTerms& s) {
    const auto add = [&](ViewKind kind, float value) {
        const ViewInfo& info = viewInfo(kind);
        section.values.push_back(scalar(std::string(info.id), std::string(info.label),
                                        std::string(info.symbol), value, std::string(info.unit)));
    };
    add(kViewNoL, light.NoL);
    add(kViewNoV, s.NoV);
    add(kViewNoH, light.NoH);
    add(kViewVoH, light.VoH);
    add(kViewD, light.D);
    add(kViewG, 4.0f * light.NoL * s.NoV * light.V);
    const ViewInfo& fresnel = viewInfo(kViewF);
    section.values.push_back(color(std::string(fresnel.id), std::string(fresnel.label),
                                   std::string(fresnel.symbol), light.F));
}

// Where transfer holds the diffuse part of lights, a light has no share of its own.
void sayWhereDiffuseIs(const Subject& subject, ExplainedSection& section) {
    section.values.push_back(
        words("diffuseInTransfer", "Diffuse",
              subject.rebuilt.radiosity
                  ? "In Diffuse IBL: radiosity has it, with its shadows."
                  : "In Diffuse IBL: the transfer lets it arrive, with its shadows."));
}

ExplainedStep diffuseOf(const Subject& subject, const RebuiltLight& light,
                        const LightShare& share) {
    const SurfaceTerms& s = subject.rebuilt.surface;
    ExplainedStep step{"diffuse",
                       "Diffuse",
                       "kD · fd · E · N·L",
                       {color("kd", "Share for Diffuse", "kD", s.transmission),
                        color("diffuseBrdf", "Diffuse BRDF", "fd", light.diffuseBrdf, "1/sr"),
                        color("arriving", "Arriving Light", "E", share.arriving, "lx"),
                        scalar("nol", "N·L", "N·L", light.NoL)},
                       color("diffuse", "Diffuse", "", share.diffuse, "cd/m²"),
                       {},
                       true,
                       {}};
    weigh(step, subject.rebuilt.mix.x);
    compare(step, light.diffuse, unseen(subject));
    return step;
}

ExplainedStep specularOf(const Subject& subject, const RebuiltLight& light,
                         const LightShare& share) {
    const SurfaceTerms& s = subject.rebuilt.surface;
    ExplainedStep step{
        "specular",
        "Specular",
        "D · V · F · gain · E · N·L",
        {scalar("d", "Normal Distribution", "D", light.D, "1/sr"),
         scalar("visibility", "G / (4 N·L N·V)", "V", light.V), color("f", "Fresnel", "F", light.F),
         color("multiScatterGain", "Multi-Scatter Gain", "gain", s.energyCompensation),
         color("arriving", "Arriving Light", "E", share.arriving, "lx"),
         scalar("nol", "N·L", "N·L", light.NoL)},
        color("specular", "Specular", "", share.specular, "cd/m²"),
        {},
        true,
        {}};
    weigh(step, subject.rebuilt.mix.y);
    compare(step, light.specular, unseen(subject));
    return step;
}

void explainArea(ExplainedSection& section, const Subject& subject, const Light& light,
                 const RebuiltLight& rebuilt, const LightShare& share) {
    const SurfaceTerms& s = subject.rebuilt.surface;
    const glm::vec3 radiance = lightPower(light);
    const ExplainedValue source = color("intensity", "Colour · Intensity", "L", radiance, "nit");
    section.values.push_back(scalar("distance", "Distance to Its Centre", "d",
                                    glm::distance(light.position, subject.vector(kRecordPosition)),
                                    "m"));
    if (subject.rebuilt.transfer) {
        sayWhereDiffuseIs(subject, section);
    } else {
        ExplainedStep diffuse{
            "diffuse",
            "Diffuse",
            "ρd · kD · L · FF",
            {color("diffuseAlbedo", "Diffuse Albedo · kD", "ρd · kD", s.diffuseAlbedo), source,
             scalar("formFactor", "Form Factor", "FF", rebuilt.diffuseShare)},
            color("diffuse", "Diffuse", "", share.diffuse, "cd/m²"),
            {},
            true,
            {}};
        weigh(diffuse, subject.rebuilt.mix.x);
        compare(diffuse, rebuilt.diffuse, unseen(subject));
        section.steps.push_back(std::move(diffuse));
    }
    ExplainedStep specular{
        "specular",
        "Specular",
        "ρs · L · FFlobe",
        {color("specularAlbedo", "Specular Albedo", "ρs", s.specularAlbedo), source,
         scalar("lobeFormFactor", "Share of the Lobe", "FFlobe", rebuilt.lobeShare)},
        color("specular", "Specular", "", share.specular, "cd/m²"),
        {},
        true,
        "The lobe is fitted by a linearly transformed cosine."};
    weigh(specular, subject.rebuilt.mix.y);
    compare(specular, rebuilt.specular, unseen(subject));
    section.steps.push_back(std::move(specular));
}

} // namespace

ExplainedSection explainLight(const Subject& subject, std::size_t index) {
    const RebuiltLight& rebuilt = subject.rebuilt.lights[index];
    const auto share = std::find_if(subject.pixel.lights.begin(), subject.pixel.lights.end(),
                                    [&](const LightShare& s) { return s.light == rebuilt.light; });
    const Light& light = *subject.document.light(rebuilt.light);
    ExplainedSection section{fmt::format("light{}", light.id), "Light: " + light.name, {}, {}};
    section.values.push_back(words("type", "Type", typeName(light.type)));
    section.values.push_back(vector3("toLight", "To the Light", "l", share->toLight));
    if (light.type == LightType::Sphere || light.type == LightType::Rectangle) {
        explainArea(section, subject, light, rebuilt, *share);
        return section;
    }
    addAngles(section, rebuilt, subject.rebuilt.surface);
    section.steps.push_back(arrivingStep(light, *share, subject.vector(kRecordPosition)));
    if (rebuilt.NoL <= 0.0f) {
        section.values.push_back(words("below", "", "The light stands behind the surface."));
        return section;
    }
    if (subject.rebuilt.transfer)
        sayWhereDiffuseIs(subject, section);
    else
        section.steps.push_back(diffuseOf(subject, rebuilt, *share));
    section.steps.push_back(specularOf(subject, rebuilt, *share));
    return section;
}

} // namespace patina::render
