#version 450 core
// A rectangle in pixels, drawn as a strip of four vertices without attributes.
#include "include/frame.glsl"

uniform vec2 u_center; // pixels from the bottom left
uniform vec2 u_axisX;  // half of each side, in pixels
uniform vec2 u_axisY;

out vec2 v_local; // pixels along the two axes, from the centre

void main() {
    vec2 corner = vec2((gl_VertexID & 1) * 2 - 1, (gl_VertexID >> 1) * 2 - 1);
    v_local = corner * vec2(length(u_axisX), length(u_axisY));
    vec2 position = u_center + corner.x * u_axisX + corner.y * u_axisY;
    gl_Position = vec4(position * u_viewport.zw * 2.0 - 1.0, 0.0, 1.0);
}
