// What all passes of a frame share. The C++ side is render/scene/Blocks.h.
#ifndef PT_FRAME_GLSL
#define PT_FRAME_GLSL

struct Light {
    vec4 place;      // directional (w = 0): unit vector to the light; point (w = 1): position
    vec4 irradiance; // rgb: directional: of a surface facing it; point: intensity in W/sr
};

layout(std140, binding = 0) uniform Frame {
    mat4 u_worldToClip;
    mat4 u_clipToWorld;
    mat4 u_worldToEnvironment; // a rotation about +Y
    vec4 u_cameraPosition;
    vec4 u_viewport;         // width, height, 1 / width, 1 / height
    float u_radianceScale;   // 2^exposure of the environment
    int u_prefilteredLevels; // of the prefiltered cubemap
    int u_lightCount;
    int u_reserved;
    vec3 u_irradianceSh[9]; // world space, exposure included
    vec3 u_radianceSh[25];  // world space, exposure included
    Light u_lights[16];
};

#endif
