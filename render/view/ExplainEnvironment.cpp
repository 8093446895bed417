#include "core/light/Light.h"
#include "render/view/ExplanationParts.h"

#include "core/document/Lighting.h"
#include "core/edit/Edit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

namespace patina::render {
namespace {

using namespace shading;

const char* albedoFormula(Fresnel fresnel) {
    switch (fresnel) {
    case Fresnel::Schlick:
        return "min((F0 · A + B) · gain, 1)";
    case Fresnel::SchlickF90:
        return "min((F0 · A + F90 · B) · gain, 1)";
    case Fresnel::Dielectric:
    case Fresnel::Conductor:
        break;
    }
    return "min((A + B) · F(θ) · gain, 1), cos θ = 1 − (B / (A + B))^⅕";
}

std::vector<ExplainedValue> lookups(const Subject& subject) {
    std::vector<ExplainedValue> values;
    const Inspection& pixel = subject.pixel;
    const auto add = [&](ExplainedValue value) { values.push_back(std::move(value)); };

    add(ofView(subject, kViewIrradiance));
    add(ofView(subject, kViewAo));

    add(vector3("mirrorDirection", "Mirror Direction", "",
                glm::reflect(-subject.rebuilt.surface.v, subject.rebuilt.surface.n)));
    const glm::vec3 lobe = subject.vector(kRecordLobeDirection);
    const float length = glm::length(lobe);
    const glm::vec3 direction = length > 0.0f ? lobe / length : subject.rebuilt.surface.n;
    add(vector3("lobeDirection", "Looked Up Along", "", direction));
    addEnvironmentPosition(values, shownEnvironment(subject.document), direction);
    add(ofView(subject, kViewPrefilteredLevel));
    const float level = subject.number(kViewPrefilteredLevel), fine = std::floor(level);
    add(words("levels", "Between Levels",
              level == fine ? fmt::format("{:.0f} (100 %)", fine)
                            : fmt::format("{:.0f} ({:.0f} %) and {:.0f} ({:.0f} %)", fine,
                                          100.0f * (1.0f - level + fine), fine + 1.0f,
                                          100.0f * (level - fine))));
    add(ofView(subject, kViewPrefiltered));

    const glm::vec2 at(subject.number(kViewNoV), subject.number(kViewPerceptualRoughness));
    add(vector2("dfgPosition", "DFG Table at N·V, r", "", at));
    add(vector2("dfgTexel", fmt::format("Texel of {0:.0f} × {0:.0f}", kDfgTableSize), "",
                dfgTableUv(at.x, at.y) * kDfgTableSize - 0.5f));
    add(ofView(subject, kViewDfgScale));
    add(ofView(subject, kViewDfgBias));
    add(scalar("dfgMean", "Mean Direction's Tilt", "", pixel.value(kRecordDfgMean).x));
    return values;
}

ExplainedStep gainStep(const Subject& subject) {
    const SurfaceTerms& s = subject.rebuilt.surface;
    ExplainedStep step{
        "multiScatterGain",
        "Multi-Scatter Gain",
        subject.document.model.multiScatter ? "1 + F0 · (1 / (A + B) − 1)" : "1",
        {color("f0", "F0", "F0", s.f0), ofView(subject, kViewDfgScale),
         ofView(subject, kViewDfgBias)},
        color("multiScatterGain", "Gain", "gain", subject.vector(kViewMultiScatterGain)),
        {},
        true,
        {}};
    compare(step, s.energyCompensation);
    if (!subject.document.model.multiScatter)
        step.note = "The model leaves multiple scattering out.";
    return step;
}

ExplainedStep albedoStep(const Subject& subject) {
    const SurfaceTerms& s = subject.rebuilt.surface;
    ExplainedStep step{
        "specularAlbedo",
        "Specular Albedo",
        albedoFormula(subject.document.model.fresnel),
        {color("f0", "F0", "F0", s.f0), ofView(subject, kViewDfgScale),
         ofView(subject, kViewDfgBias),
         color("multiScatterGain", "Gain", "gain", s.energyCompensation)},
        color("specularAlbedo", "Specular Albedo", "ρs", subject.vector(kRecordSpecularAlbedo)),
        {},
        true,
        {}};
    if (subject.document.model.fresnel == Fresnel::SchlickF90)
        step.factors.push_back(scalar("f90", "F90", "F90", subject.document.model.f90));
    compare(step, s.specularAlbedo);
    return step;
}

ExplainedStep transmissionStep(const Subject& subject) {
    const glm::vec3 albedo = subject.vector(kRecordSpecularAlbedo);
    ExplainedStep step{std::string(viewInfo(kViewTransmission).id),
                       std::string(viewInfo(kViewTransmission).label),
                       "1 − ρs",
                       {color("specularAlbedo", "Specular Albedo", "ρs", albedo)},
                       ofView(subject, kViewTransmission),
                       {},
                       true,
                       {}};
    // Reflections that the mix leaves out take nothing.
    const float shown = subject.rebuilt.mix.y;
    if (shown != 1.0f) {
        step.formula = "1 − mix · ρs";
        step.factors.push_back(scalar("mix", "Reflections of the Mix", "mix", shown));
    }
    compare(step, glm::vec3(1.0f) - shown * albedo);
    return step;
}

// Whose visibility darkens the irradiance.
std::string occlusionNote(const Subject& subject) {
    const Document& document = subject.document;
    if (const BakeArtifactPtr bake = findBake(document, BakeKind::AoTexel))
        for (const TexelBake& texels : bake->texels)
            if (texels.material == subject.pixel.material)
                return "AO is the baked texture's.";
    if (const BakeArtifactPtr bake = findBake(document, BakeKind::AoVertex))
        for (const VertexBake& vertices : bake->vertices)
            if (vertices.mesh == subject.pixel.mesh)
                return "AO is that of the baked vertices.";
    return {};
}

ExplainedStep diffuseStep(const Subject& subject) {
    const SurfaceTerms& s = subject.rebuilt.surface;
    const bool lambert = subject.document.model.diffuse == Diffuse::Lambert;
    const glm::vec3 albedo = diffuseReflectance(s.model, s.diffuseColor, s.perceptualRoughness,
                                                s.diffuseRoughness, s.NoV);
    const glm::vec3 kd = subject.vector(kViewTransmission);
    const glm::vec3 irradiance = subject.radiance(kViewIrradiance);
    const float ao = subject.rebuilt.ao;
    const ViewInfo& info = viewInfo(kViewDiffuseIbl);
    ExplainedStep step{
        std::string(info.id),
        std::string(info.label),
        lambert ? "ρd · kD · AO · E(n) / π" : "ρd(N·V) · kD · AO · E(n) / π",
        {color("diffuseAlbedo", "Diffuse Albedo", lambert ? "ρd" : "ρd(N·V)", albedo),
         ofView(subject, kViewTransmission), scalar("ao", "Ambient Occlusion", "AO", ao),
         ofView(subject, kViewIrradiance)},
        ofView(subject, kViewDiffuseIbl),
        {},
        true,
        occlusionNote(subject)};
    if (subject.rebuilt.transfer)
        step.note =
            subject.pixel.lights.empty()
                ? "E(n) comes from the transfer, which includes the shadows; AO is left out."
                : "E(n) comes from the transfer, which includes the shadows and the "
                  "diffuse light of all lights; AO is left out.";
    if (subject.rebuilt.radiosity)
        step.note = "E(n) comes from radiosity, which includes all light of all sources and "
                    "surfaces, and its shadows; AO is left out.";
    if (subject.rebuilt.lightMap)
        step.note =
            "E(n) has the light map's correction, which includes the shadows; AO is left out.";
    weigh(step, subject.rebuilt.mix.x);
    glm::vec3 sum = subject.rebuilt.mix.x * albedo * kd * (ao / glm::pi<float>()) * irradiance;
    if (s.clearColor != glm::vec3(0.0f)) {
        step.formula += " + Lₜ";
        step.factors.push_back(ofView(subject, kViewThrough));
        sum += subject.radiance(kViewThrough);
    }
    compare(step, sum);
    return step;
}

// Of a surface that transmits light.
ExplainedStep throughStep(const Subject& subject) {
    const SurfaceTerms& s = subject.rebuilt.surface;
    const glm::vec3 behind = subject.radiance(kRecordBehind);
    ExplainedStep step{
        std::string(viewInfo(kViewThrough).id),
        std::string(viewInfo(kViewThrough).label),
        "t · c · (1 − m) · kD · Lᵦ",
        {color("clearColor", "Colour That Goes Through", "t · c · (1 − m)", s.clearColor),
         ofView(subject, kViewTransmission), vector3("behind", "Radiance Behind", "Lᵦ", behind)},
        ofView(subject, kViewThrough),
        {},
        true,
        {}};
    weigh(step, subject.rebuilt.mix.x);
    compare(step,
            subject.rebuilt.mix.x * s.clearColor * subject.vector(kViewTransmission) * behind);
    return step;
}

ExplainedStep openStep(const Subject& subject) {
    ExplainedStep step{"specularOcclusion",
                       "Specular Occlusion",
                       "(N·V + AO)^(2^(−16 α − 1)) − 1 + AO",
                       {ofView(subject, kViewNoV), ofView(subject, kViewAo),
                        scalar("alphaRoughness", "α", "α", subject.rebuilt.surface.alpha)},
                       scalar("specularOcclusion", "Specular Occlusion", "SO",
                              subject.number(kViewSpecularOcclusion)),
                       {},
                       true,
                       {}};
    if (subject.rebuilt.transfer && readsBake(subject.document.view.lighting)) {
        const glm::vec4 cone = subject.pixel.value(kRecordVisibleCone);
        step.formula = "visible cone ∩ lobe, of what is open above the surface";
        step.factors = {ofView(subject, kViewBentNormal),
                        scalar("visibility", "Visibility of the Bake", "AO", cone.w),
                        scalar("alphaRoughness", "α", "α", subject.rebuilt.surface.alpha)};
    }
    if (subject.rebuilt.lightMap) {
        step.formula = "what the light map leaves of the prefiltered radiance";
        step.factors.clear();
        return step;
    }
    compare(step, subject.rebuilt.open);
    return step;
}

ExplainedStep specularStep(const Subject& subject) {
    const glm::vec3 albedo = subject.vector(kRecordSpecularAlbedo);
    const float open = subject.number(kViewSpecularOcclusion);
    const ViewInfo& info = viewInfo(kViewSpecularIbl);
    ExplainedStep step{std::string(info.id),
                       std::string(info.label),
                       "Lₚ · ρs · SO",
                       {ofView(subject, kViewPrefiltered),
                        color("specularAlbedo", "Specular Albedo", "ρs", albedo),
                        scalar("specularOcclusion", "Specular Occlusion", "SO", open)},
                       ofView(subject, kViewSpecularIbl),
                       {},
                       true,
                       {}};
    if (subject.rebuilt.lightMap) {
        step.formula = "max(Lₚ · SO + Lₘ, 0) · ρs";
        step.factors.push_back(vector3("lightMap", "Correction by the Light Map", "Lₘ",
                                       glm::vec3(subject.pixel.value(kRecordLightMap))));
    }
    weigh(step, subject.rebuilt.mix.y);
    compare(step, subject.rebuilt.mix.y * subject.rebuilt.reflected * albedo);
    return step;
}

} // namespace

void addEnvironmentPosition(std::vector<ExplainedValue>& values, const EnvironmentPart& environment,
                            const glm::vec3& direction) {
    static constexpr std::array kFaces{"+X", "−X", "+Y", "−Y", "+Z", "−Z"};
    const glm::vec3 d = environment.orientation.toPicture(direction);
    const glm::vec3 at = cubeFacePosition(d);
    const auto face = std::min(static_cast<std::size_t>(std::max(at.x, 0.0f)), kFaces.size() - 1);
    values.push_back(words("cubeFace", "Cube Face",
                           fmt::format("{} at {:.3f}, {:.3f}", kFaces[face], at.y, at.z)));
    const glm::vec2 uv = latLongFromDirection(d);
    values.push_back(vector2("latLong", "Environment Map", "uv", uv));
    if (const ImagePtr& image = environment.image) {
        const auto texel = [](float position, int size) {
            return std::clamp(static_cast<int>(position * static_cast<float>(size)), 0, size - 1);
        };
        values.push_back(
            words("latLongTexel", "Its Pixel",
                  fmt::format("{}, {} of {} × {}", texel(uv.x, image->width()),
                              texel(uv.y, image->height()), image->width(), image->height())));
    }
}

ExplainedSection explainEnvironment(const Subject& subject) {
    ExplainedSection section{"environment", "Image-Based Light", lookups(subject), {}};
    section.steps.push_back(gainStep(subject));
    section.steps.push_back(albedoStep(subject));
    section.steps.push_back(transmissionStep(subject));
    section.steps.push_back(openStep(subject));
    if (subject.rebuilt.surface.clearColor != glm::vec3(0.0f))
        section.steps.push_back(throughStep(subject));
    section.steps.push_back(diffuseStep(subject));
    section.steps.push_back(specularStep(subject));
    return section;
}

} // namespace patina::render
