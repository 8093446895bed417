#version 450 core
// Meshes of the scene. HAS_TRANSFER: exit radiance of unit albedo, which relight.comp made of the
// light and of transfer, or that radiosity has found (HAS_RADIOSITY). HAS_TRANSFER_CONE: what a bake says of occlusion. HAS_TEXEL_TRANSFER: both are
// looked up for each pixel instead.
#include "include/frame.glsl"
#include "include/instance.glsl"

layout(location = 0) in vec3 a_position;
layout(location = 1) in vec3 a_normal;
layout(location = 2) in vec4 a_tangent;
layout(location = 3) in vec2 a_uv;

// At a silhouette the pixel's centre may lie outside the triangle, where interpolation would run
// away: centroid keeps to the covered part. Not for v_uv, whose derivatives choose mipmaps.
out vec3 v_position;
centroid out vec3 v_normal;
out vec4 v_tangent;
out vec2 v_uv;

#ifdef HAS_VERTEX_AO
layout(std430, binding = 0) readonly buffer VertexVisibility {
    float b_visibility[];
};
centroid out float v_visibility;
#endif

#ifndef HAS_TEXEL_TRANSFER
#ifdef HAS_TRANSFER
layout(location = 4) in vec3 a_exitRadiance;
centroid out vec3 v_exitRadiance;
#endif
#if defined(HAS_RADIOSITY) && defined(VIEWS)
layout(location = 5) in vec4 a_elementSent;   // radiance, area
layout(location = 6) in vec4 a_elementUnshot; // radiance, form factor
flat out vec4 v_elementSent;
flat out vec4 v_elementUnshot;
#endif
#ifdef HAS_TRANSFER_CONE
layout(location = 5) in vec4 a_visibleCone;
centroid out vec4 v_visibleCone;
#ifdef VIEWS
layout(location = 6) in vec2 a_bakeNumbers;
centroid out vec2 v_bakeNumbers;
#endif
#endif
#endif

// Passes over the same mesh meet at the same depth.
invariant gl_Position;

void main() {
    vec4 position = u_model * vec4(a_position, 1.0);
    v_position = position.xyz;
    v_normal = mat3(u_normalToWorld) * a_normal;
    v_tangent = vec4(mat3(u_model) * a_tangent.xyz, a_tangent.w * u_handedness);
    v_uv = a_uv;
    gl_Position = u_worldToClip * position;

#ifdef HAS_VERTEX_AO
    v_visibility = b_visibility[gl_VertexID];
#endif
#ifndef HAS_TEXEL_TRANSFER
#ifdef HAS_TRANSFER
    v_exitRadiance = a_exitRadiance;
#endif
#if defined(HAS_RADIOSITY) && defined(VIEWS)
    v_elementSent = a_elementSent;
    v_elementUnshot = a_elementUnshot;
#endif
#ifdef HAS_TRANSFER_CONE
    v_visibleCone = a_visibleCone;
#ifdef VIEWS
    v_bakeNumbers = a_bakeNumbers;
#endif
#endif
#endif
}
