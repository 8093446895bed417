#version 450 core
// Which face of the scene a cell of a hemicube shows: radiosity::DrawnHemicubes.
flat in uint v_face;
in vec2 v_uv;
layout(location = 0) out uint o_item;

uniform int u_back; // backs absorb, whichever they are of

#ifdef ALPHA_TEST
layout(binding = 0) uniform sampler2D u_alpha;
uniform float u_opacity, u_cutoff; // below 0: blended, which stops a cell by chance
uniform uint u_seed;

// core/math/Sampling.h
uint hash32(uint x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    x ^= x >> 16;
    return x;
}
#endif

void main() {
#ifdef ALPHA_TEST
    float alpha = u_opacity * textureLod(u_alpha, v_uv, 0.0).r;
    if (u_cutoff >= 0.0) {
        if (alpha < u_cutoff)
            discard;
    } else {
        uint cell = uint(gl_FragCoord.y) * 65536u + uint(gl_FragCoord.x);
        uint chance = hash32(u_seed ^ hash32(cell ^ hash32(v_face)));
        if (float(chance >> 8) / 16777216.0 >= alpha)
            discard;
    }
#endif
    o_item = u_back != 0 ? 0xfffffffeu : v_face;
}
