// What all passes of a frame share. The C++ side is render/scene/Blocks.h.
#ifndef PT_FRAME_GLSL
#define PT_FRAME_GLSL

// Sorted by type: u_lightEnds says where the directional lights end, the points and spots, the
// spheres, the rectangles.
struct Light {
    vec4 place; // position, directional: unit vector to the light; w: shadow map, -1 for none
    vec4 color; // rgb: lux, candela or nit by type; w: 1 / range², 0 without end
    vec4 axis;  // point, spot: unit vector to the light times the cone's scale, w: its offset;
                // sphere: radius; rectangle: half of its width
    vec4 side;  // rectangle: half of its height
};

layout(std140, binding = 0) uniform Frame {
    mat4 u_worldToClip;
    mat4 u_clipToWorld;
    mat4 u_worldToEnvironment; // a rotation
    vec4 u_cameraPosition;
    vec4 u_viewport;         // width, height, 1 / width, 1 / height
    vec3 u_radianceScale;    // tint and 2^exposure of the environment
    float u_irradianceScale; // of u_irradianceSh
    int u_prefilteredLevels; // of the prefiltered cubemap
    float u_prefilteredSide; // of a face of its level 0
    float u_irradianceSide;  // of a face of the irradiance below it, and the row of its border
    float u_irradianceTop;
    // World space, exposure included: 27 numbers r g b r g b …, two to a word, the first in the upper
    // half, as signed integers.
    uvec4 u_irradianceSh[4];
    vec4 u_dominantLight;            // unit vector to the dominant light of the environment
    vec4 u_dominantIrradiance;  // of a surface that faces it
    vec2 u_mix;             // weights of diffuse light and of reflections
    ivec4 u_lightEnds;
    Light u_lights[64]; // nothing where there are more
};

// MANY_LIGHTS: more than the block holds. The C++ side is render/scene/ManyLights.h.
#ifdef MANY_LIGHTS
layout(std430, binding = 5) readonly buffer Lights {
    ivec4 b_lightEnds;      // as u_lightEnds
    ivec4 b_lightCellCount; // along x, y, z; w: where points and spots begin that cells list
    vec4 b_lightCellGrid;   // corner; w: cells per metre
    Light b_manyLights[];
};
// Where each cell's list begins, and where the last one ends; then the lists of lights.
layout(std430, binding = 7) readonly buffer LightCells {
    uint b_lightCells[];
};
#define LIGHTS b_manyLights
#define LIGHT_ENDS b_lightEnds

// The beginning and the end of the list for a position.
ivec2 lightsOfCell(vec3 position) {
    ivec3 count = b_lightCellCount.xyz;
    vec3 at = clamp((position - b_lightCellGrid.xyz) * b_lightCellGrid.w, vec3(0.0),
                    vec3(count) - 0.5);
    ivec3 cell = clamp(ivec3(at), ivec3(0), count - 1); // positions may be no numbers
    int number = (cell.z * count.y + cell.y) * count.x + cell.x;
    return ivec2(b_lightCells[number], b_lightCells[number + 1]);
}
#else
#define LIGHTS u_lights
#endif

// Two of the numbers of u_irradianceSh. Software OpenGL takes longer to read a uniform than to
// unpack it; what is lost is 1 / 65534 of the largest coefficient.
vec2 irradiancePair(uint word) {
    return vec2(float(int(word) >> 16), float(int(word << 16) >> 16));
}

// World direction to a direction of the environment's picture.
vec3 toEnvironment(vec3 d) {
    return mat3(u_worldToEnvironment) * d;
}

#endif
