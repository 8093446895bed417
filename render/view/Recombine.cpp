#include "render/view/Recombine.h"

#include "core/base/Check.h"
#include "core/document/Lighting.h"
#include "core/document/ToneResponse.h"
#include "core/document/ViewChoices.h"
#include "core/edit/Edit.h"
#include "core/light/Light.h"
#include "core/light/Lights.h"
#include "core/light/LobeTable.h"
#include "core/material/BrdfModel.h"
#include "core/material/MaterialInputs.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace patina::render {
namespace {

using namespace shading;

SurfaceTerms surfaceOf(const Inspection& pixel, const Document& document) {
    const Material* material = document.material(pixel.material);
    const SurfaceTerms s =
        makeSurface(brdfModel(document.model),
                    surfaceInputs(pixel, material != nullptr ? *material : Material()),
                    pixel.value(kViewShadingNormal), pixel.value(kRecordToViewer),
                    {pixel.value(kViewDfgScale).x, pixel.value(kViewDfgBias).x});
    return fadeSpecularLayer(s, mixWeights(document.view.reflectionMix).y);
}

void shadePunctual(RebuiltLight& light, const SurfaceTerms& s, const LightShare& share) {
    const ShadedLight shaded = shadeDirect(s, share.toLight, share.arriving);
    light.diffuse = shaded.diffuse;
    light.specular = shaded.specular;
    // The terms one by one, with the precautions of shadeDirect().
    light.NoL = std::min(glm::dot(s.n, share.toLight), 1.0f);
    const glm::vec3 sum = s.v + share.toLight;
    const float length2 = glm::dot(sum, sum);
    if (light.NoL <= 0.0f || length2 < 1e-12f)
        return;
    const glm::vec3 h = sum / std::sqrt(length2);
    const glm::vec3 nxh = glm::cross(s.n, h);
    light.NoH = std::clamp(glm::dot(s.n, h), 0.0f, 1.0f);
    light.VoH = std::clamp(glm::dot(s.v, h), 0.0f, 1.0f);
    light.D = distribution(s.model, light.NoH, std::min(glm::dot(nxh, nxh), 1.0f), s.alpha);
    light.V = visibility(s.model, s.NoV, light.NoL, light.VoH, s.alpha);
    light.F = fresnel(s.model, s.f0, s.metallic, light.VoH);
    light.diffuseBrdf = diffuse(s.model, s.diffuseColor, s.perceptualRoughness, s.diffuseRoughness,
                                s.NoV, light.NoL, light.VoH);
}

void shadeArea(RebuiltLight& light, const SurfaceTerms& s, const Light& source,
               const glm::vec3& position) {
    // A surface that reflects everything shows the form factors themselves.
    SurfaceTerms white = s;
    white.diffuseAlbedo = white.specularAlbedo = glm::vec3(1.0f);
    const glm::vec4 fit = lobeFit(s.perceptualRoughness, s.NoV);
    const glm::vec3 toCenter = source.position - position;
    ShadedLight shares;
    if (source.type == LightType::Sphere)
        shares = shadeSphere(white, fit, toCenter, source.radius, glm::vec3(1.0f));
    else {
        const RectangleAxes axes = rectangleAxes(source);
        shares = shadeRectangle(white, fit, toCenter, 0.5f * source.width * axes.x,
                                0.5f * source.height * axes.y, glm::vec3(1.0f));
    }
    light.NoL = glm::dot(s.n, glm::normalize(toCenter));
    light.diffuseShare = shares.diffuse.x;
    light.lobeShare = shares.specular.x;
    const glm::vec3 radiance = lightPower(source);
    light.diffuse = s.diffuseAlbedo * radiance * light.diffuseShare;
    light.specular = s.specularAlbedo * radiance * light.lobeShare;
}

// The part of the picture that is seen through the surface.
glm::vec3 restOf(const Inspection& pixel) {
    glm::vec3 parts(0.0f);
    for (std::size_t i = 0; i < kTermCount; ++i)
        if (pixel.view.terms[i])
            parts += glm::vec3(pixel.contributions[static_cast<std::size_t>(kTermViews[i])]);
    return glm::vec3(pixel.radiance) - parts;
}

} // namespace

SurfaceInputs surfaceInputs(const Inspection& pixel, const Material& material) {
    SurfaceInputs inputs;
    inputs.baseColor = glm::clamp(glm::vec3(pixel.value(kViewBaseColor)), 0.0f, 1.0f);
    inputs.diffuseRoughness = material.diffuseRoughness;
    inputs.ior = material.ior;
    for (const MaterialInputInfo& info : kMaterialInputs)
        if (info.role == InputRole::Number)
            inputs.*info.shown = pixel.value(viewOf(info.input)).x;
    return inputs;
}

RebuiltPixel recombine(const Inspection& pixel, const Document& document) {
    CHECK(pixel.onSurface());
    RebuiltPixel result;
    SurfaceTerms& s = result.surface;
    const Material* material = document.material(pixel.material);
    s = surfaceOf(pixel, document);
    result.alpha = pixel.value(kViewAlpha).x;

    const float ao = pixel.value(kViewAo).x;
    result.lightMap = pixel.value(kRecordLightMap).w > 0.0f;
    result.transfer = pixel.value(kRecordTransfer).x > 0.0f;
    result.radiosity = pixel.value(kRecordTransfer).x > 1.5f;
    result.ao = result.transfer ? 1.0f : ao;
    result.open =
        result.transfer && readsBake(document.view.lighting)
            ? coneOcclusion(pixel.value(kRecordVisibleCone), s.n,
                            glm::normalize(glm::vec3(pixel.value(kRecordLobeDirection))), s.alpha)
        : result.lightMap ? pixel.value(kViewSpecularOcclusion).x
                          : specularOcclusion(s.NoV, ao, s.alpha);
    result.mix = mixWeights(document.view.reflectionMix);
    result.terms[0] =
        result.mix.x * (shadeIrradiance(s, result.ao * straight(pixel.value(kViewIrradiance))) +
                        shadeThrough(s, straight(pixel.value(kRecordBehind))));
    result.reflected = result.open * straight(pixel.value(kViewPrefiltered));
    if (result.lightMap)
        result.reflected =
            glm::max(result.reflected + glm::vec3(pixel.value(kRecordLightMap)), glm::vec3(0.0f));
    result.terms[1] = result.mix.y * shadePrefiltered(s, result.reflected);

    for (const LightShare& share : pixel.lights) {
        RebuiltLight light;
        light.light = share.light;
        const Light* source = document.light(share.light);
        if (source == nullptr) // taken away since the pixel was looked at
            continue;
        if (source->type == LightType::Sphere || source->type == LightType::Rectangle)
            shadeArea(light, s, *source, pixel.value(kRecordPosition));
        else
            shadePunctual(light, s, share);
        light.diffuse *= result.transfer ? 0.0f : result.mix.x;
        light.specular *= result.mix.y;
        result.terms[2] += light.diffuse;
        result.terms[3] += light.specular;
        result.lights.push_back(light);
    }
    result.terms[4] = straight(pixel.value(kViewEmissive));

    for (std::size_t i = 0; i < kTermCount; ++i)
        if (pixel.view.terms[i])
            result.sum += result.terms[i];
    if (material && material->alphaMode == AlphaMode::Blend)
        result.rest = restOf(pixel);
    const float cover = pixel.radiance.w;
    const glm::vec3 premultiplied = result.sum * result.alpha + result.rest;
    result.radiance = cover > 0.0f ? premultiplied / cover : glm::vec3(0.0f);
    expose(result, pixel, document);
    return result;
}

void expose(RebuiltPixel& rebuilt, const Inspection& pixel, const Document& document) {
    const View& view = document.view;
    rebuilt.exposed = rebuilt.radiance * exposureScale(view, pixel.luminance);
    rebuilt.displayed.reset();
    if (view.toneMap != ToneMap::OpenColorIo)
        rebuilt.displayed =
            displayEncode(toneMap(rebuilt.exposed, toneCurve(view, pixel.luminance)),
                          static_cast<int>(view.displayTransfer), view.displayGamma);
}

} // namespace patina::render
