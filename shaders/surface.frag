#version 450 core
// The metallic-roughness surface under image-based light and analytic lights. Every term of the
// reflection comes from shaders/shared; this file fetches maps and adds up. What a material does
// not use is left out by the HAS_… defines (render/pass/SurfacePass.cpp).
#include "include/frame.glsl"
#include "include/instance.glsl"
#include "include/material.glsl"
#include "include/model.glsl"
#ifdef HAS_SHADOWS
#include "include/shadow.glsl"
#endif
#include "shared/color.glsl"
#include "shared/ibl.glsl"
#include "include/dfg.glsl"
#include "include/prefiltered.glsl"
#include "shared/lights.glsl"
#include "shared/normalmap.glsl"

in vec3 v_position;
centroid in vec3 v_normal;
in vec4 v_tangent;
in vec2 v_uv;
#ifdef HAS_VERTEX_AO
centroid in float v_visibility;
#endif
#ifndef HAS_TEXEL_TRANSFER
#ifdef HAS_TRANSFER
centroid in vec3 v_exitRadiance;
#endif
#if defined(HAS_RADIOSITY) && defined(VIEWS)
flat in vec4 v_elementSent;
flat in vec4 v_elementUnshot;
#endif
#ifdef HAS_TRANSFER_CONE
centroid in vec4 v_visibleCone;
#ifdef VIEWS
centroid in vec2 v_bakeNumbers;
#endif
#endif
#endif

layout(binding = 6) uniform sampler2D u_visibilityTexture; // baked
#ifdef HAS_TEXEL_TRANSFER
layout(binding = 13) uniform sampler2D u_exitTexture;
layout(binding = 14) uniform sampler2D u_coneTexture;
layout(binding = 15) uniform sampler2D u_numbersTexture;
#endif
#ifdef HAS_LIGHT_MAP
#include "include/lightmap.glsl"
#endif
#ifdef HAS_AREA_LIGHTS
layout(binding = 9) uniform sampler2D u_lobes; // core/light/LobeTable.h
#endif

#ifdef VIEWS
#include "include/views.glsl"
#define CHOSEN_LIGHT u_viewLight
#else
#define CHOSEN_LIGHT 0
layout(location = 0) out vec4 o_radiance; // premultiplied by alpha
#endif

#ifndef LIGHT_ENDS
#define LIGHT_ENDS u_lightEnds
#endif

vec4 baseColorAt(vec2 uv) {
    vec4 color = u_baseColor;
#ifdef HAS_BASE_COLOR_MAP
    vec4 texel = texture(u_baseColorTexture, mapUv(u_baseColorMap, uv));
    color *= vec4(mapColor(u_baseColorMap, texel), texel.a);
#endif
#ifdef HAS_PLACEHOLDER
    color.rgb = mix(color.rgb, placeholderPattern(uv), u_placeholder);
#endif
    return color;
}

vec3 shadingNormal() {
    vec3 n = normalize(v_normal);
#ifdef HAS_NORMAL_MAP
    vec3 texel = texture(u_normalTexture, mapUv(u_normalMap, v_uv)).rgb;
    vec3 m = decodeNormalTs(texel, u_normalStrength, u_normalGreenUp);
#ifdef HAS_MOVED_MAPS
    m = vec3(dot(u_normalBasis.xy, m.xy), dot(u_normalBasis.zw, m.xy), m.z);
#endif
    n = normalTsToWorld(m, n, v_tangent);
#endif
#ifdef DOUBLE_SIDED
    if (!gl_FrontFacing)
        n = -n;
#endif
    return n;
}

#ifdef HAS_SH_IRRADIANCE
vec3 shIrradiance(vec3 n) {
    vec2 p[14];
    for (int i = 0; i < 14; ++i)
        p[i] = irradiancePair(u_irradianceSh[i / 4][i % 4]);
    vec3 sh[9];
    for (int i = 0; i < 9; ++i)
        for (int c = 0; c < 3; ++c)
            sh[i][c] = p[(3 * i + c) / 2][(3 * i + c) % 2];
    return u_irradianceScale * irradianceFromSh9(sh, n);
}
#endif

#ifdef HAS_TRANSFER
vec3 exitRadiance() {
#ifdef HAS_TEXEL_TRANSFER
    return texture(u_exitTexture, v_uv).rgb;
#else
    return v_exitRadiance;
#endif
}
#endif

// Along the bent normal, and ambient visibility.
#ifdef HAS_TRANSFER_CONE
vec4 visibleCone() {
#ifdef HAS_TEXEL_TRANSFER
    return texture(u_coneTexture, v_uv);
#else
    return v_visibleCone;
#endif
}
#endif

// Diffuse light against reflections, as the view weighs them.
ShadedLight mixed(ShadedLight light) {
    light.diffuse *= u_mix.x;
    light.specular *= u_mix.y;
    return light;
}

// Direct light, mixed. Transfer has its diffuse part already, with soft shadows.
ShadedLight mixedDirect(ShadedLight light) {
#ifdef HAS_TRANSFER
    light.diffuse = vec3(0.0);
#endif
    return mixed(light);
}

#ifdef HAS_AREA_LIGHTS
// As lobeFit() of core/light/LobeTable.h. Texture filters of graphics cards have weights of 8 bits:
// at low roughness that would be off by .2 %.
vec4 lobeFit(float angle, float perceptualRoughness) {
    ivec2 last = textureSize(u_lobes, 0) - 1;
    vec2 at = clamp(vec2(angle, perceptualRoughness), 0.0, 1.0) * vec2(last);
    ivec2 low = min(ivec2(at), last - 1);
    vec2 share = at - vec2(low);
    vec4 smoother = mix(texelFetch(u_lobes, low, 0),
                        texelFetch(u_lobes, low + ivec2(1, 0), 0), share.x);
    vec4 rougher = mix(texelFetch(u_lobes, low + ivec2(0, 1), 0),
                       texelFetch(u_lobes, low + ivec2(1, 1), 0), share.x);
    return mix(smoother, rougher, share.y);
}
#endif

// Half floats end at 65504, and one NaN would spread over its pixel in the resolve.
#ifdef FLOATS
const float kBrightest = 3.4e38;
#else
const float kBrightest = 65504.0;
#endif
vec3 storable(vec3 c) {
    return vec3(isnan(c.x) ? 0.0 : clamp(c.x, 0.0, kBrightest),
                isnan(c.y) ? 0.0 : clamp(c.y, 0.0, kBrightest),
                isnan(c.z) ? 0.0 : clamp(c.z, 0.0, kBrightest));
}

#include "generated/surface-inputs.glsl"
#ifdef VIEWS
#include "include/records.glsl"
#endif

void main() {
#if defined(VIEWS) && !defined(INSPECT)
    for (int i = 0; i < VIEW_OUTPUTS; ++i)
        s_views[i] = vec4(0.0); // of a surface that has no such number
#endif
    vec4 baseColor = baseColorAt(v_uv);
#ifdef ALPHA_MASK
    if (baseColor.a < u_emissive.a)
        discard;
#endif

    MapNumbers map = mapNumbers(v_uv);
    SurfaceInputs inputs;
    inputs.baseColor = clamp(baseColor.rgb, 0.0, 1.0);
    inputs.diffuseRoughness = u_diffuseRoughness;
#ifdef HAS_IOR
    inputs.ior = u_ior;
#else
    inputs.ior = kDielectricIor;
#endif
    setNumbers(inputs, map);

    // Ambient visibility: a texel bake, else a vertex bake, else the material's map. A bake has
    // been made for this very scene, so it replaces the map instead of darkening twice.
#if defined(HAS_TEXEL_AO) || defined(HAS_VERTEX_AO) || defined(HAS_OCCLUSION_MAP)
    float visible;
#if defined(HAS_TEXEL_AO)
    visible = texture(u_visibilityTexture, v_uv).r;
#elif defined(HAS_VERTEX_AO)
    visible = v_visibility;
#else
    visible = map.occlusion;
#endif
    float ao = mix(1.0, clamp(visible, 0.0, 1.0), u_occlusionStrength);
#else
    const float ao = 1.0;
#endif

    // The surface.
    vec3 n = shadingNormal();
#ifdef VIEWS
    vec3 triangle = normalize(cross(dFdx(v_position), dFdy(v_position)));
    if (u_flat != 0)
        n = triangle;
#endif
    vec3 v = normalize(u_cameraPosition.xyz - v_position);
    float NoV = clamp(dot(n, v), kMinNoV, 1.0);
#ifdef CONSTANT_DFG
    vec3 dfg = vec3(0.9, 0.05, 0.5);
#else
    vec3 dfg = dfgEntry(NoV, inputs.perceptualRoughness);
#endif
    SurfaceTerms s = makeSurface(shadingModel(), inputs, n, v, dfg.xy);
    s = fadeSpecularLayer(s, u_mix.y); // reflections that are not shown take nothing

    // Light from the environment. Transfer coefficients know the shadows already.
#ifdef CONSTANT_REFLECTION
    vec3 prefiltered = vec3(0.5);
#else
    vec3 prefiltered = prefilteredRadiance(lobeDirection(s, dfg.z), s.perceptualRoughness);
#endif
#ifdef HAS_TRANSFER_CONE
    vec4 cone = visibleCone();
#endif
    // Before occlusion, and with it.
#if defined(CONSTANT_IRRADIANCE)
    vec3 arriving = vec3(0.5);
#elif defined(HAS_TRANSFER)
    vec3 arriving = kPi * max(exitRadiance(), vec3(0.0));
#elif defined(HAS_DOMINANT_LIGHT)
    vec3 arriving = u_dominantIrradiance.rgb * max(dot(n, u_dominantLight.xyz), 0.0);
#elif defined(HAS_SH_IRRADIANCE)
    vec3 arriving = shIrradiance(n);
#else
    vec3 arriving = environmentIrradiance(n);
#endif
#ifdef HAS_LIGHT_MAP
    LightMapTexel mapped = lightMapTexel(v_uv, reflect(-v, n));
#ifdef VIEWS
    if (u_furnace.w > 0.0)
        mapped = noLightMap();
#endif
    arriving = max(arriving + mapped.irradiance, vec3(0.0));
#endif
    float unoccluded = ao;
#ifdef VIEWS
    if (u_furnace.w > 0.0) {
        arriving = kPi * u_furnace.rgb;
        prefiltered = u_furnace.rgb;
        unoccluded = 1.0; // what hides the environment is as bright as it is
    }
#endif
#ifdef HAS_TRANSFER
    const float diffuseOpen = 1.0;
#else
    float diffuseOpen = unoccluded;
#endif
    ShadedLight ambient = mixed(shadeEnvironment(s, diffuseOpen * arriving, prefiltered));
#if defined(HAS_TRANSFER) && defined(HAS_TRANSFER_CONE)
    float open = coneOcclusion(cone, s.n, normalize(lobeDirection(s, dfg.z)), s.alpha);
#ifdef VIEWS
    if (u_furnace.w > 0.0)
        open = 1.0;
#endif
#else
    float open = specularOcclusion(s.NoV, unoccluded, s.alpha);
#endif
#ifdef HAS_LIGHT_MAP
    open = 1.0 - mapped.hidden;
    vec3 specularIbl =
        u_mix.y * shadePrefiltered(s, max(open * prefiltered + mapped.radiance, vec3(0.0)));
#else
    vec3 specularIbl = ambient.specular * open;
#endif

    // What is seen through the surface: of the scene the environment alone.
#ifdef HAS_TRANSMISSION
#ifdef THIN_WALLED
    vec3 behind = prefilteredRadiance(-v, s.perceptualRoughness);
#else
    // The colour of the body tints light where it enters and where it leaves.
    vec3 behind = inputs.baseColor *
                  prefilteredRadiance(throughDirection(n, v, s.model.ior),
                                      throughRoughness(s.perceptualRoughness, s.model.ior));
#endif
#ifdef VIEWS
    if (u_furnace.w > 0.0)
        behind = u_furnace.rgb;
#endif
    vec3 through = u_mix.x * shadeThrough(s, behind);
#endif

    // Analytic lights, one loop for each kind. Where LIGHT_ENDS is known it is unrolled.
#ifdef HAS_SHADOWS
    // By slot, with constant indices: a software rasteriser gathers what is indexed by a variable.
    vec3 face = cross(dFdx(v_position), dFdy(v_position));
    face *= inversesqrt(max(dot(face, face), 1e-30));
    vec4 visibility = vec4(1.0);
    visibility.x = shadowVisibility(u_shadows[0], v_position, face, n);
#ifdef HAS_SHADOWS_2
    visibility.y = shadowVisibility(u_shadows[1], v_position, face, n);
#endif
#ifdef HAS_SHADOWS_3
    visibility.z = shadowVisibility(u_shadows[2], v_position, face, n);
#endif
#ifdef HAS_SHADOWS_4
    visibility.w = shadowVisibility(u_shadows[3], v_position, face, n);
#endif
#endif
    vec3 directDiffuse = vec3(0.0);
    vec3 directSpecular = vec3(0.0);
#ifdef VIEWS
    LightSums sums = noLights();
#endif
#ifdef HAS_PUNCTUAL_LIGHTS
    for (int i = 0; i < LIGHT_ENDS.x; ++i) {
        vec3 E = LIGHTS[i].color.rgb;
        float shadow = 1.0;
#ifdef HAS_SHADOWS
        shadow = LIGHTS[i].place.w < 0.0 ? 1.0 : visibility[int(LIGHTS[i].place.w)];
        E *= shadow;
#endif
        ShadedLight light = mixedDirect(shadeDirect(s, LIGHTS[i].place.xyz, E));
        directDiffuse += light.diffuse;
        directSpecular += light.specular;
#ifdef VIEWS
        recordLight(sums, s, i, LIGHTS[i].place.xyz, LIGHTS[i].color.rgb, shadow, light);
#endif
    }
#ifdef MANY_LIGHTS
    // Those without a range, then those that reach this cell. What does not is black there.
#ifdef INSPECT
    int endless = LIGHT_ENDS.y;
    ivec2 listed = ivec2(0);
#else
    int endless = b_lightCellCount.w;
    ivec2 listed = lightsOfCell(v_position);
#endif
    int last = endless + listed.y - listed.x;
#if defined(VIEWS) && !defined(INSPECT)
    // The chosen light is looked at wherever it reaches.
    bool missing = u_viewLight >= endless && u_viewLight < LIGHT_ENDS.y;
    for (int k = listed.x; k < listed.y; ++k)
        missing = missing && int(b_lightCells[k]) != u_viewLight;
    last += missing ? 1 : 0;
#endif
    for (int k = LIGHT_ENDS.x; k < last; ++k) {
        int at = listed.x + k - endless;
        int i = k < endless ? k : at < listed.y ? int(b_lightCells[at]) : CHOSEN_LIGHT;
#else
    for (int i = LIGHT_ENDS.x; i < LIGHT_ENDS.y; ++i) {
#endif
        vec3 toLight = LIGHTS[i].place.xyz - v_position;
        float distance2 = dot(toLight, toLight);
        vec3 l = toLight * inversesqrt(max(distance2, 1e-12));
        float reaches = pointFalloff(distance2, LIGHTS[i].color.w) *
                        spotFalloff(dot(LIGHTS[i].axis.xyz, l), 1.0, LIGHTS[i].axis.w);
        float shadow = 1.0;
#ifdef HAS_SHADOWS
        shadow = LIGHTS[i].place.w < 0.0 ? 1.0 : visibility[int(LIGHTS[i].place.w)];
#endif
        ShadedLight light =
            mixedDirect(shadeDirect(s, l, LIGHTS[i].color.rgb * (reaches * shadow)));
        directDiffuse += light.diffuse;
        directSpecular += light.specular;
#ifdef VIEWS
        recordLight(sums, s, i, l, LIGHTS[i].color.rgb * reaches, shadow, light);
#endif
    }
#endif

#ifdef HAS_AREA_LIGHTS
    vec4 fit = lobeFit(lobeAngle(s.NoV), s.perceptualRoughness);
    for (int i = LIGHT_ENDS.y; i < LIGHT_ENDS.z; ++i) {
        ShadedLight light = mixedDirect(shadeSphere(s, fit, LIGHTS[i].place.xyz - v_position,
                                                  LIGHTS[i].axis.x, LIGHTS[i].color.rgb));
        directDiffuse += light.diffuse;
        directSpecular += light.specular;
#ifdef VIEWS
        recordAreaLight(sums, i, light);
#endif
    }
    for (int i = LIGHT_ENDS.z; i < LIGHT_ENDS.w; ++i) {
        ShadedLight light =
            mixedDirect(shadeRectangle(s, fit, LIGHTS[i].place.xyz - v_position,
                                     LIGHTS[i].axis.xyz, LIGHTS[i].side.xyz,
                                     LIGHTS[i].color.rgb));
        directDiffuse += light.diffuse;
        directSpecular += light.specular;
#ifdef VIEWS
        recordAreaLight(sums, i, light);
#endif
    }
#endif

    // Emission.
    vec3 emission = u_emissive.rgb;
#ifdef HAS_EMISSIVE_MAP
    emission *= mapColor(u_emissiveMap, texture(u_emissiveTexture, mapUv(u_emissiveMap, v_uv)));
#endif

#ifdef ALPHA_BLEND
    float alpha = clamp(baseColor.a, 0.0, 1.0);
#else
    float alpha = 1.0;
#endif
#ifdef VIEWS
    recordSurface(inputs, s, ao, dfg, alpha, triangle);
#ifdef HAS_TRANSFER_CONE
    recordBake(cone);
#endif
#ifdef HAS_RADIOSITY
    recordElement(alpha);
#endif
#ifdef HAS_TRANSFER
#ifdef HAS_RADIOSITY
    record(kRecordTransfer, 2.0);
#else
    record(kRecordTransfer, 1.0);
#endif
#endif
#ifdef HAS_LIGHT_MAP
    recordAs(kRecordLightMap, 0, vec4(mapped.radiance, 1.0));
#endif
    recordChosenDirection(s, sums, specularIbl, alpha);
    recordIbl(s, dfg, arriving, prefiltered, ambient.diffuse, specularIbl, diffuseOpen, open, alpha);
#ifdef HAS_TRANSMISSION
    recordThrough(s, behind, through, alpha);
    ambient.diffuse += through;
#else
    recordThrough(s, vec3(0.0), vec3(0.0), alpha);
#endif
    recordSum(s, ambient.diffuse, specularIbl, directDiffuse, directSpecular, emission, sums, alpha);
#ifndef INSPECT
    for (int i = 0; i < VIEW_OUTPUTS; ++i)
        o_views[i] = u_halfFloats != 0 ? vec4(storable(s_views[i].rgb), s_views[i].a) : s_views[i];
#endif
#else
#ifdef HAS_TRANSMISSION
    ambient.diffuse += through;
#endif
    vec3 radiance = ambient.diffuse + specularIbl + directDiffuse + directSpecular + emission;
    o_radiance = vec4(storable(radiance) * alpha, alpha);
#endif
}
