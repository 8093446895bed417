#version 450 core
// A lobe on the surface: from the frame of its point to the world.
#include "include/frame.glsl"

layout(location = 0) in vec3 a_position; // the peak is 1 from the point
layout(location = 1) in vec3 a_normal;
layout(location = 2) in vec3 a_color;

uniform vec3 u_position;
uniform vec3 u_tangent;
uniform vec3 u_bitangent;
uniform vec3 u_normal;
uniform float u_reach; // metres

out vec3 v_world;
out vec3 v_normal;
out vec3 v_color;
out float v_radius;

vec3 toWorld(vec3 p) {
    return p.x * u_tangent + p.y * u_bitangent + p.z * u_normal;
}

void main() {
    v_world = u_position + u_reach * toWorld(a_position);
    v_normal = toWorld(a_normal);
    v_color = a_color;
    v_radius = length(a_position);
    gl_Position = u_worldToClip * vec4(v_world, 1.0);
}
