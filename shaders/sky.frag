#version 450 core
// The surroundings behind the scene: BLURRED reads the prefiltered cubemap, else the lat-long map.
#include "include/frame.glsl"
#include "shared/ibl.glsl"

in vec2 v_uv;

layout(binding = 0) uniform sampler2D u_environment;
layout(binding = 7) uniform samplerCube u_prefiltered;

#ifdef BLURRED
uniform float u_blur; // perceptual roughness of the level that is shown
#endif

layout(location = 0) out vec4 o_radiance;

void main() {
    vec4 far = u_clipToWorld * vec4(v_uv * 2.0 - 1.0, 1.0, 1.0);
    vec3 d = mat3(u_worldToEnvironment) * normalize(far.xyz / far.w - u_cameraPosition.xyz);
#ifdef BLURRED
    vec3 radiance = textureLod(u_prefiltered, d, prefilteredLevel(u_blur, u_prefilteredLevels)).rgb;
#else
    vec2 uv = latLongFromDirection(d);
    // Where u wraps around, neighbours differ by almost one: without the wrap in the derivatives
    // a line of the coarsest mipmap would show.
    vec2 dx = dFdx(uv);
    vec2 dy = dFdy(uv);
    dx.x -= round(dx.x);
    dy.x -= round(dy.x);
    vec3 radiance = textureGrad(u_environment, uv, dx, dy).rgb;
#endif
    o_radiance = vec4(min(u_radianceScale * radiance, vec3(65504.0)), 1.0);
}
