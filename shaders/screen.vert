#version 450 core
// One triangle that covers the whole picture; drawn with three vertices and no attributes.
out vec2 v_uv; // (0, 0) bottom left of the picture

void main() {
    v_uv = vec2((gl_VertexID & 1) * 2, (gl_VertexID >> 1) * 2);
    gl_Position = vec4(v_uv * 2.0 - 1.0, 1.0, 1.0); // on the far plane
}
