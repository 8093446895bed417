// What surface.frag records about a pixel, by view. Part of surface.frag, split off for its length:
// it reads that file's inputs, uniforms and maps.

// What the lights add up to, for views of shadow and of the chosen light.
struct LightSums {
    vec3 diffuse, specular; // of the chosen light
    vec3 toLight;           // the chosen one
    vec3 arriving;          // irradiance of a surface that faces it, before its shadow
    float casting;          // lights that have a shadow map
    float lit;              // the sum of their shares that are not in shadow
    float chosenLit;        // that of the chosen one
    vec3 shadowed;          // radiance that shadows take away
};

LightSums noLights() {
    return LightSums(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), 0.0, 0.0, 1.0, vec3(0.0));
}

void recordShare(int i, vec3 l, float lit, vec3 arriving, ShadedLight light) {
#ifdef INSPECT
    b_lights[i] = LightRecord(vec4(l, lit), vec4(arriving, 0.0), vec4(light.diffuse, 0.0),
                              vec4(light.specular, 0.0));
#endif
}

// `E`: irradiance of a surface that faces the light, without shadow; `light`: with it.
void recordLight(inout LightSums sums, SurfaceTerms s, int i, vec3 l, vec3 E, float lit,
                 ShadedLight light) {
    ShadedLight all = mixedDirect(shadeDirect(s, l, E));
    sums.shadowed += (1.0 - lit) * (all.diffuse + all.specular);
    float casts = LIGHTS[i].place.w < 0.0 ? 0.0 : 1.0;
    sums.casting += casts;
    sums.lit += casts * lit;
    if (i == u_viewLight) {
        sums.diffuse = light.diffuse;
        sums.specular = light.specular;
        sums.toLight = l;
        sums.chosenLit = lit;
    }
    if (i == u_viewLight || u_viewLight < 0)
        sums.arriving += E;
    recordShare(i, l, lit, E * lit, light);
}

// Area lights cast no shadow. Their centre stands for the direction.
void recordAreaLight(inout LightSums sums, int i, ShadedLight light) {
    vec3 l = normalize(LIGHTS[i].place.xyz - v_position);
    if (i == u_viewLight) {
        sums.diffuse = light.diffuse;
        sums.specular = light.specular;
        sums.toLight = l;
    }
    recordShare(i, l, 1.0, vec3(0.0), light);
}

float texelsPerMetre(vec2 uv) {
#ifdef HAS_BASE_COLOR_MAP
    vec2 size = vec2(textureSize(u_baseColorTexture, 0));
#else
    vec2 size = vec2(1024.0);
#endif
    vec2 across = dFdx(uv) * size;
    vec2 up = dFdy(uv) * size;
    float texels = abs(across.x * up.y - across.y * up.x);
    float area = length(cross(dFdx(v_position), dFdy(v_position)));
    return sqrt(texels / max(area, 1e-20));
}

void recordSurface(SurfaceInputs inputs, SurfaceTerms s, float ao, vec3 dfg, float alpha,
                   vec3 triangle) {
    record(kViewBaseColor, inputs.baseColor);
    recordNumbers(inputs);
    record(kViewF0, s.f0);
    record(kViewAo, ao);
    vec3 mapped = vec3(0.0, 0.0, 1.0);
#ifdef HAS_NORMAL_MAP
    mapped = decodeNormalTs(texture(u_normalTexture, mapUv(u_normalMap, v_uv)).rgb, 1.0,
                            u_normalGreenUp);
#endif
    record(kViewNormalMap, mapped);
    record(kViewAlpha, alpha);
    record(kViewShadingNormal, s.n);
    record(kViewGeometricNormal, triangle);
    vec3 t = v_tangent.xyz * inversesqrt(max(dot(v_tangent.xyz, v_tangent.xyz), 1e-30));
    record(kViewTangent, t);
    record(kViewBitangent, cross(normalize(v_normal), t) * v_tangent.w);
    record(kViewUvChecker, uvBoard(v_uv));
    record(kViewTexelDensity, texelsPerMetre(v_uv));
    record(kViewMaterialId, float(u_materialId));
    record(kViewMeshId, float(u_id));
    record(kViewDepth, 1.0 / gl_FragCoord.w);
    record(kViewNoV, s.NoV);

    record(kRecordPosition, v_position);
    record(kRecordToViewer, s.v);
    record(kRecordUv, vec3(v_uv, 0.0));
    record(kRecordDiffuseColor, s.diffuseColor);
    record(kRecordSpecularAlbedo, s.specularAlbedo);
    record(kRecordDfgMean, dfg.z);
    record(kRecordLobeDirection, lobeDirection(s, dfg.z));
}

#ifdef HAS_TRANSFER_CONE
void recordBake(vec4 cone) {
#ifdef HAS_TEXEL_TRANSFER
    vec2 numbers = texture(u_numbersTexture, v_uv).rg;
#else
    vec2 numbers = v_bakeNumbers;
#endif
    record(kViewBentNormal, cone.xyz * inversesqrt(max(dot(cone.xyz, cone.xyz), 1e-20)));
    record(kViewBakeError, numbers.x);
    record(kViewSkyVisibility, numbers.y);
    recordAs(kRecordVisibleCone, 0, cone);
}
#endif

#ifdef HAS_RADIOSITY
void recordElement(float alpha) {
    recordAs(kViewElementLight, 0, vec4(v_elementSent.rgb * alpha, alpha));
    recordAs(kViewUnshot, 0, vec4(v_elementUnshot.rgb * alpha, alpha));
    record(kViewElementArea, v_elementSent.a);
    record(kViewFormFactor, v_elementUnshot.a);
}
#endif

// D, G, F for the chosen light, or for the direction of a mirror's reflection.
void recordChosenDirection(SurfaceTerms s, LightSums sums, vec3 specularIbl, float alpha) {
    bool mirror = u_viewLight < 0;
    vec3 l = mirror ? reflect(-s.v, s.n) : sums.toLight;
    vec3 specular = mirror ? specularIbl : sums.specular;
    vec3 h = s.v + l;
    h *= inversesqrt(max(dot(h, h), 1e-12));
    vec3 nxh = cross(s.n, h);
    float NoL = clamp(dot(s.n, l), 0.0, 1.0);
    float NoH = clamp(dot(s.n, h), 0.0, 1.0);
    float VoH = clamp(dot(s.v, h), 0.0, 1.0);
    float D = distribution(s.model, NoH, min(dot(nxh, nxh), 1.0), s.alpha);
    // V = G / (4 N·L N·V)
    float V = NoL > 0.0 ? visibility(s.model, s.NoV, NoL, VoH, s.alpha) : 0.0;
    float G = V * 4.0 * NoL * s.NoV;
    vec3 F = fresnel(s.model, s.f0, s.metallic, VoH);
    record(kViewD, NoL > 0.0 ? D : 0.0);
    record(kViewG, G);
    record(kViewF, F);
    record(kViewDGF, luminance(F) * D * V);
    record(kViewDiffuseLobe, NoL > 0.0 ? kPi * diffuse(s.model, s.diffuseColor, s.perceptualRoughness,
                                                       s.diffuseRoughness, s.NoV, NoL, VoH)
                                       : vec3(0.0));
    record(kViewNoL, NoL);
    record(kViewNoH, NoH);
    record(kViewVoH, VoH);
    record(kRecordToLight, l);
    recordPart(kViewD, specular, alpha);
    recordPart(kViewG, specular * (1.0 / max(G, 1e-4) - 1.0), alpha);
    recordPart(kViewF, specular * (1.0 - min(s.f0 / max(F, vec3(1e-4)), vec3(1.0))), alpha);
    recordPart(kViewDGF, specular, alpha);
    recordPart(kViewNoL, mirror ? specular : sums.diffuse + specular, alpha);
    record(kViewShadow, !mirror ? sums.chosenLit : sums.casting > 0.0 ? sums.lit / sums.casting : 1.0);
}

// `diffuseOpen`, `open`: what occlusion leaves of the light of the diffuse and the specular lobe.
void recordIbl(SurfaceTerms s, vec3 dfg, vec3 arriving, vec3 prefiltered, vec3 diffuse, vec3 specular,
               float diffuseOpen, float open, float alpha) {
    vec3 single = singleScatterAlbedo(s.model, s.f0, s.metallic, dfg.xy);
    vec3 meanFresnel = single / max(dfg.x + dfg.y, 1e-3);
    recordRadiance(kViewIrradiance, arriving, 1.0);
    record(kViewDiffuseAlbedo, diffuseReflectance(s.model, s.diffuseColor, s.perceptualRoughness,
                                                  s.diffuseRoughness, s.NoV));
    record(kViewDiffuseOcclusion, diffuseOpen);
    recordRadiance(kViewPrefiltered, prefiltered, 1.0);
    record(kViewPrefilteredLevel, prefilteredLevel(s.perceptualRoughness, u_prefilteredLevels, u_prefilteredSide));
    record(kViewDfgScale, dfg.x);
    record(kViewDfgBias, dfg.y);
    record(kViewIblFresnel, meanFresnel);
    record(kViewTransmission, s.transmission);
    // As used: what a lobe returns in excess is cut.
    record(kViewSingleScatterAlbedo, min(single, 1.0 / max(s.energyCompensation, vec3(1e-4))));
    record(kViewMultiScatterGain, s.energyCompensation);
    record(kViewSpecularOcclusion, open);
    ShadedLight unhidden = mixed(shadeEnvironment(s, arriving, prefiltered));
    recordPart(kViewAo, unhidden.diffuse + unhidden.specular - diffuse - specular, alpha);
    recordPart(kViewDiffuseOcclusion, unhidden.diffuse - diffuse, alpha);
    recordPart(kViewSpecularOcclusion, unhidden.specular - specular, alpha);
    recordPart(kViewIblFresnel, specular * (1.0 - min(s.f0 / max(meanFresnel, vec3(1e-4)), vec3(1.0))),
               alpha);
    recordPart(kViewTransmission,
               diffuse * (vec3(1.0) / max(s.transmission, vec3(1e-4)) - vec3(1.0)), alpha);
    recordPart(kViewMultiScatterGain,
               specular * (vec3(1.0) - vec3(1.0) / max(s.energyCompensation, vec3(1e-4))), alpha);

    // A uniform environment of radiance 1.
    ShadedLight even = mixed(shadeEnvironment(s, vec3(kPi), vec3(1.0)));
    vec3 returned = even.diffuse + even.specular + u_mix.x * shadeThrough(s, vec3(1.0));
    record(kViewFurnace, max(returned.r, max(returned.g, returned.b)));
}

void recordThrough(SurfaceTerms s, vec3 behind, vec3 through, float alpha) {
    recordRadiance(kRecordBehind, behind, 1.0);
    recordRadiance(kViewThrough, through, alpha);
    recordPart(kViewTransmissive, through, alpha);
}

void recordSum(SurfaceTerms s, vec3 diffuseIbl, vec3 specularIbl, vec3 directDiffuse,
               vec3 directSpecular, vec3 emission, LightSums sums, float alpha) {
    vec3 total = u_terms.x * diffuseIbl + u_terms.y * specularIbl + u_terms.z * directDiffuse +
                 u_terms.w * directSpecular + u_emissionTerm * emission;
    recordRadiance(kViewFinal, total, alpha);
    recordRadiance(kViewEmissive, emission, alpha);
    recordRadiance(kViewDirect, directDiffuse + directSpecular, alpha);
    recordRadiance(kViewDirectDiffuse, directDiffuse, alpha);
    recordRadiance(kViewDirectSpecular, directSpecular, alpha);
    recordRadiance(kViewLightArriving, sums.arriving, 1.0);
    recordRadiance(kViewLightDiffuse, u_viewLight < 0 ? directDiffuse : sums.diffuse, alpha);
    recordRadiance(kViewLightSpecular, u_viewLight < 0 ? directSpecular : sums.specular, alpha);
    recordRadiance(kViewDiffuseIbl, diffuseIbl, alpha);
    recordRadiance(kViewSpecularIbl, specularIbl, alpha);
    recordRadiance(kViewAmbient, diffuseIbl + specularIbl, alpha);

    vec3 diffuse = diffuseIbl + directDiffuse;
    vec3 specular = specularIbl + directSpecular;
    recordPart(kViewBaseColor, diffuse + s.metallic * specular, alpha);
    recordPart(kViewMetallic, s.metallic * specular, alpha);
    recordPart(kViewPerceptualRoughness, specular, alpha);
    recordPart(kViewEmissive, emission, alpha);
    recordPart(kViewDirectDiffuse, directDiffuse, alpha);
    recordPart(kViewDirectSpecular, directSpecular, alpha);
    recordPart(kViewDiffuseIbl, diffuseIbl, alpha);
    recordPart(kViewSpecularIbl, specularIbl, alpha);
    recordPart(kViewShadow, sums.shadowed, alpha);
}
