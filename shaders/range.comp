#version 450 core
// Smallest and largest value of a view where a surface is, from a grid of pixels.
layout(local_size_x = 256) in;
layout(binding = 0) uniform sampler2D u_values;
layout(std430, binding = 0) writeonly buffer Range { vec2 b_range; }; // min > max: nothing there
uniform int u_positive; // only values above 0 count

shared vec2 s_ranges[256];

void main() {
    uint own = gl_LocalInvocationIndex;
    ivec2 size = textureSize(u_values, 0);
    ivec2 cells = min(size, ivec2(256));
    vec2 range = vec2(3e38, -3e38);
    for (int i = int(own); i < cells.x * cells.y; i += 256) {
        ivec2 at = ivec2(i % cells.x, i / cells.x) * size / cells;
        vec4 c = texelFetch(u_values, at, 0);
        if (c.a > 0.0 && abs(c.r) < 1e30 && (u_positive == 0 || c.r > 0.0))
            range = vec2(min(range.x, c.r), max(range.y, c.r));
    }
    s_ranges[own] = range;
    barrier();
    for (uint half_ = 128u; half_ > 0u; half_ /= 2u) {
        if (own < half_)
            s_ranges[own] = vec2(min(s_ranges[own].x, s_ranges[own + half_].x),
                                 max(s_ranges[own].y, s_ranges[own + half_].y));
        barrier();
    }
    if (own == 0u)
        b_range = s_ranges[0];
}
