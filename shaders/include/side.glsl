// Which side of the limit between two views a pixel lies on.
#ifndef PT_SIDE_GLSL
#define PT_SIDE_GLSL

uniform vec3 u_side; // drawn where the dot product with (pixel, 1) is not negative; zeros: everywhere

void keepToSide(vec2 pixel) {
    if (dot(u_side, vec3(pixel, 1.0)) < 0.0)
        discard;
}

#endif
