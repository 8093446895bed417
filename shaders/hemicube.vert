#version 450 core
// A face of the scene onto a face of a hemicube.
layout(location = 0) in vec3 a_position;
layout(location = 1) in vec2 a_uv;

uniform vec3 u_eye;
uniform mat4 u_viewToClip; // the hemicube's axes and projection, from the eye

flat out uint v_face;
out vec2 v_uv;

void main() {
    v_face = uint(gl_VertexID) / 4u; // four corners each
    v_uv = a_uv;
    gl_Position = u_viewToClip * vec4(a_position - u_eye, 1.0);
}
