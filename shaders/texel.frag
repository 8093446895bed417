#version 450 core
// A picture as it is into one of the same size; blending makes means of it.
layout(binding = 0) uniform sampler2D u_picture;
layout(location = 0) out vec4 o_color;

void main() {
    o_color = texelFetch(u_picture, ivec2(gl_FragCoord.xy), 0);
}
