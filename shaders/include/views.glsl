// Recording of terms for views, thumbnails and the explanation of a pixel: surface.frag says what
// it computes, and this keeps what is wanted. The C++ side is render/scene/Blocks.h and
// render/pass/ViewPass.h. Includer has frame.glsl.
#ifndef PT_INCLUDE_VIEWS_GLSL
#define PT_INCLUDE_VIEWS_GLSL

#include "generated/views.glsl"

layout(std140, binding = 6) uniform Views {
    ivec4 u_views[2];     // kView… of each output; -1: nothing
    ivec4 u_viewModes[2]; // 0 the factor's own value, 1 its contribution to the picture
    vec4 u_terms;         // 1 or 0: diffuse and specular image-based, direct diffuse and specular
    float u_emissionTerm;
    int u_viewLight;    // in LIGHTS; -1: the mirror direction stands for a light
    int u_flat;         // shading with the triangles' normals
    int u_halfFloats;   // the target takes no more
    vec4 u_furnace;     // rgb: radiance of a uniform environment; w: whether it is on
};

#ifdef INSPECT
struct LightRecord {
    vec4 toLight;  // w: share that is not in shadow
    vec4 arriving; // irradiance of a surface that faces the light
    vec4 diffuse, specular;
};

layout(early_fragment_tests) in;
layout(std430, binding = 2) writeonly buffer Records {
    vec4 b_values[kRecordCount];
    vec4 b_parts[kViewCount];
    LightRecord b_lights[]; // as many as LIGHTS
};
#else
layout(location = 0) out vec4 o_views[VIEW_OUTPUTS];
vec4 s_views[VIEW_OUTPUTS];
#endif

void recordAs(int kind, int mode, vec4 value) {
#ifdef INSPECT
    if (mode == 0)
        b_values[kind] = value;
    else
        b_parts[kind] = value;
#else
    for (int i = 0; i < VIEW_OUTPUTS; ++i)
        if (u_views[i / 4][i % 4] == kind && u_viewModes[i / 4][i % 4] == mode)
            s_views[i] = value;
#endif
}

void record(int kind, float value) {
    recordAs(kind, 0, vec4(vec3(value), 1.0));
}
void record(int kind, vec3 value) {
    recordAs(kind, 0, vec4(value, 1.0));
}
// Radiance is premultiplied by the surface's opacity, as the picture is.
void recordRadiance(int kind, vec3 value, float alpha) {
    recordAs(kind, 0, vec4(value * alpha, alpha));
}
void recordPart(int kind, vec3 value, float alpha) {
    recordAs(kind, 1, vec4(value * alpha, alpha));
}

// A board of sixteen fields: red grows along u, green along v, dark fields alternate with light
// ones, and every fourth line is marked.
vec3 uvBoard(vec2 uv) {
    vec2 cell = floor(uv * 16.0);
    float light = mod(cell.x + cell.y, 2.0) < 0.5 ? 1.0 : 0.45;
    vec2 line = abs(fract(uv * 4.0 + 0.5) - 0.5);
    vec2 wide = max(fwidth(uv) * 4.0, vec2(1e-6));
    float marked = 1.0 - min(min(line.x / wide.x, line.y / wide.y), 1.0);
    vec3 color = vec3(0.1 + 0.8 * fract(uv.x), 0.1 + 0.8 * fract(uv.y), 0.35) * light;
    return mix(color, vec3(1.0), marked);
}

#endif
