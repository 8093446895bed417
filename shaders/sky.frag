#version 450 core
// The environment behind the scene: BLURRED reads the prefiltered cubemap, else the lat-long map.
#include "include/frame.glsl"
#include "shared/ibl.glsl"
#include "include/prefiltered.glsl"

in vec2 v_uv;

layout(binding = 0) uniform sampler2D u_environment;

#ifdef BLURRED
uniform float u_blur; // perceptual roughness of the level that is shown
#endif

layout(location = 0) out vec4 o_radiance;

void main() {
    vec4 far = u_clipToWorld * vec4(v_uv * 2.0 - 1.0, 1.0, 1.0);
    vec3 d = normalize(far.xyz / far.w - u_cameraPosition.xyz);
#ifdef BLURRED
    vec3 radiance = prefilteredRadiance(d, u_blur);
#else
    vec2 uv = latLongFromDirection(toEnvironment(d));
    // Where u wraps around, neighbours differ by almost one: without the wrap in the derivatives
    // a line of the coarsest mipmap would show.
    vec2 dx = dFdx(uv);
    vec2 dy = dFdy(uv);
    dx.x -= round(dx.x);
    dy.x -= round(dy.x);
    vec3 radiance = u_radianceScale * textureGrad(u_environment, uv, dx, dy).rgb;
#endif
#ifdef FLOATS
    o_radiance = vec4(radiance, 1.0);
#else
    o_radiance = vec4(min(radiance, vec3(65504.0)), 1.0);
#endif
}
