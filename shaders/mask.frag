#version 450 core
layout(location = 0) out float o_mask;

void main() {
    o_mask = 1.0;
}
