#include "core/edit/ViewReasons.h"

#include "core/base/ById.h"
#include "core/document/Equation.h"
#include "core/document/Lighting.h"
#include "core/document/ViewChoices.h"
#include "core/edit/Edit.h"
#include "core/light/Light.h"
#include "core/light/Lights.h"
#include "core/material/Material.h"
#include "core/mix/LightMix.h"

#include <algorithm>
#include <set>
#include <unordered_set>
#include <utility>

namespace patina {
namespace {

using namespace shading;

template <class Has>
bool anyActive(const Document& document, Has has) {
    return std::any_of(document.lights.begin(), document.lights.end(),
                       [&](const Light& light) { return isActive(document, light) && has(light); });
}

bool anyActive(const Document& document) {
    return anyActive(document, [](const Light&) { return true; });
}

template <class Has>
bool anyMesh(const Document& document, Has has) {
    return std::any_of(
        document.meshes.begin(), document.meshes.end(),
        [&](const MeshInstance& mesh) { return mesh.visible && mesh.mesh && has(mesh); });
}

template <class Has>
bool anyMaterial(const Document& document, Has has) {
    const ById materials(document.materials);
    return anyMesh(document, [&](const MeshInstance& mesh) {
        const Material* material = materials.find(mesh.material);
        return material != nullptr && has(*material);
    });
}

bool environmentIsActive(const Document& document) {
    return shownEnvironment(document).scale != glm::vec3(0.0f);
}

constexpr const char* kNoLight = "No light is on: add one, or switch one on.";
constexpr const char* kNoEnvironment =
    "No environment is on: switch one on, or turn its brightness, tint or fade up.";
constexpr const char* kNoTransfer = "Needs a finished radiance transfer bake.";
constexpr const char* kNoBounces = "Needs a radiance transfer bake with bounces.";
constexpr const char* kOtherMeshes =
    "The radiance transfer bake fits none of the visible meshes: bake once more.";

// Which visible meshes have values that fit them in a transfer bake, of those that `holds` accepts.
struct BakedShare {
    bool some = false, all = true;
};

template <class Holds>
BakedShare bakedShare(const Document& document, Holds holds) {
    std::unordered_set<Id> materials;
    std::set<std::pair<Id, std::size_t>> vertices;
    for (const BakeArtifactPtr& bake : document.bakes) {
        if (!holdsTransfer(bake->kind))
            continue;
        for (const VertexBake& element : bake->vertices)
            if (!element.values.empty() && holds(*bake, element))
                vertices.emplace(element.mesh,
                                 element.values.size() / static_cast<std::size_t>(element.stride));
        for (const TexelBake& element : bake->texels)
            if (!element.values.empty() && holds(*bake, element))
                materials.insert(element.material);
    }
    BakedShare share;
    for (const MeshInstance& mesh : document.meshes) {
        if (!mesh.visible || !mesh.mesh)
            continue;
        const bool baked = materials.count(mesh.material) > 0 ||
                           vertices.count({mesh.id, mesh.mesh->vertexCount()}) > 0;
        share.some |= baked;
        share.all &= baked;
    }
    return share;
}

constexpr auto kAnything = [](const BakeArtifact&, const auto&) { return true; };

// Whether transfer lights every mesh, and so holds the diffuse light of the lights.
bool transferHoldsLights(const Document& document) {
    if (!readsBake(document.view.lighting))
        return document.view.lighting == LightingMode::Unshadowed;
    return bakedShare(document, kAnything).all;
}

// Whether transfer lights some mesh, with the lights of the scene in it.
bool transferIsUsed(const Document& document) {
    if (!readsBake(document.view.lighting))
        return document.view.lighting == LightingMode::Unshadowed;
    return bakedShare(document, kAnything).some;
}

std::string whyNoTransfer(const Document& document) {
    if (!hasTransfer(document))
        return kNoTransfer;
    return bakedShare(document, kAnything).some ? "" : kOtherMeshes;
}

// Views of what a transfer bake knows besides light.
std::string whyNotBaked(ViewKind kind, const Document& document) {
    if (document.view.lighting == LightingMode::Unshadowed)
        return "Unshadowed light reads no bake: light the scene in another way.";
    if (document.view.lighting == LightingMode::Radiosity)
        return "Radiosity reads no bake: light the scene in another way.";
    if (std::string why = whyNoTransfer(document); !why.empty())
        return why;
    const auto holds = [kind](const BakeArtifact&, const auto& element) {
        return kind == kViewBentNormal  ? element.stride >= 4
               : kind == kViewBakeError ? !element.error.empty()
                                        : !element.sky.empty();
    };
    if (bakedShare(document, holds).some)
        return {};
    return kind == kViewBentNormal ? "A bent normal needs a transfer bake of two bands or more."
                                   : "This bake does not hold it: bake once more.";
}

std::string whyNoBounces(const Document& document) {
    if (!hasTransfer(document))
        return kNoBounces;
    if (std::string why = whyNoTransfer(document); !why.empty())
        return why;
    const auto bounces = [](const BakeArtifact& bake, const auto&) {
        return bake.transfer == TransferKind::Interreflected;
    };
    return bakedShare(document, bounces).some ? "" : kNoBounces;
}

// `chosen`: null for all lights together.
std::string whyNoLightArrives(const Document& document, const Light* chosen) {
    if (!anyActive(document))
        return kNoLight;
    const auto factors = [](const Light& light) { return hasFactors(light.type); };
    if (chosen ? factors(*chosen) : anyActive(document, factors))
        return {};
    return "The light of an area light arrives from all over its surface, not from one direction.";
}

std::string whyNoShadow(const Document& document, const Light* chosen) {
    const auto casts = [](const Light& light) {
        return light.castsShadow && canCastShadow(light.type);
    };
    if (chosen)
        return casts(*chosen) ? "" : "The chosen light casts no shadow.";
    return anyActive(document, casts)
               ? ""
               : "No light casts a shadow: directional lights and spots can.";
}

} // namespace

std::string whyEmpty(ViewKind kind, const Document& document) {
    return whyEmpty(kind, document, 0);
}

std::string whyEmpty(ViewKind kind, const Document& document, Id light) {
    const Light* chosen = document.light(light);
    if (chosen && !isActive(document, *chosen))
        chosen = nullptr; // as without a choice
    switch (kind) {
    case kViewDirectDiffuse:
    case kViewLightDiffuse:
        if (anyActive(document) && document.view.lighting == LightingMode::Radiosity)
            return "Radiosity holds the diffuse part of lights: see Diffuse IBL.";
        if (anyActive(document) && transferHoldsLights(document))
            return "Transfer holds the diffuse part of lights: see Diffuse IBL.";
        [[fallthrough]];
    case kViewDirect:
    case kViewDirectSpecular:
    case kViewLightSpecular:
        return anyActive(document) ? "" : kNoLight;
    case kViewLightArriving:
        return whyNoLightArrives(document, chosen);
    case kViewShadow:
        return whyNoShadow(document, chosen);
    case kViewIrradiance:
    case kViewDiffuseIbl:
    case kViewAmbient:
        if (document.view.lighting == LightingMode::Radiosity ||
            (anyActive(document) && transferIsUsed(document)))
            return {}; // that of lights, too
        [[fallthrough]];
    case kViewPrefiltered:
    case kViewSpecularIbl:
    case kViewCosineLight:
    case kViewShLight:
        return environmentIsActive(document) ? "" : kNoEnvironment;
    case kViewEmissive:
        return anyMaterial(document,
                           [](const Material& m) {
                               return m.emissiveStrength > 0.0f && m.emissive != glm::vec3(0.0f);
                           })
                   ? ""
                   : "No material emits light.";
    case kViewTransmissive:
    case kViewThrough:
        return anyMaterial(document,
                           [](const Material& m) {
                               return m.transmission > 0.0f &&
                                      (m.metallic < 1.0f || m.metallicMap.assigned());
                           })
                   ? ""
                   : "No material transmits light.";
    case kViewUvChecker:
    case kViewTexelDensity:
    case kViewTangent:
    case kViewBitangent:
        return anyMesh(document, [](const MeshInstance& mesh) { return !mesh.mesh->uvs.empty(); })
                   ? ""
                   : "No mesh has texture coordinates.";
    case kViewBentNormal:
    case kViewSkyVisibility:
    case kViewBakeError:
        return whyNotBaked(kind, document);
    case kViewUnshadowedLight:
        return environmentIsActive(document) || anyActive(document) ? "" : kNoEnvironment;
    case kViewShadowedLight:
        return whyNoTransfer(document);
    case kViewInterreflectedLight:
        return whyNoBounces(document);
    case kViewRadiosityLight:
    case kViewElementLight:
    case kViewUnshot:
    case kViewElementArea:
    case kViewFormFactor:
        return document.triangleCount() > 0 ? "" : "Radiosity needs a visible mesh to light.";
    case kViewNormalMap:
        return anyMaterial(document, [](const Material& m) { return m.normalMap.image != nullptr; })
                   ? ""
                   : "No material has a normal map.";
    default:
        return "";
    }
}

ViewRemedy viewRemedy(ViewKind kind, const Document& document) {
    const std::string reason = whyEmpty(kind, document);
    if (reason == kNoLight)
        return ViewRemedy::AddLight;
    if (reason == kNoTransfer || reason == kOtherMeshes)
        return kind == kViewInterreflectedLight ? ViewRemedy::BakeBounces
                                                : ViewRemedy::BakeTransfer;
    return reason == kNoBounces ? ViewRemedy::BakeBounces : ViewRemedy::None;
}

} // namespace patina
