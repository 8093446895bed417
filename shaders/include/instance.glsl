// What is drawn with one call. The C++ side is render/scene/Blocks.h.
#ifndef PT_INSTANCE_GLSL
#define PT_INSTANCE_GLSL

layout(std140, binding = 1) uniform Instance {
    mat4 u_model;
    mat4 u_normalToWorld; // inverse transpose of the upper 3 × 3
    float u_handedness;   // -1 when the transform mirrors
    int u_instanceReserved;
    uint u_id;
    uint u_materialId;
};

#endif
