// What a procedural material computes, and how it becomes the five maps. The normal and occlusion
// maps are derived from the one height field, so that all maps agree.
#pragma once

#include "core/image/Image.h"
#include "core/library/Field.h"

#include <glm/vec3.hpp>

namespace patina::library {

struct Surface {
    explicit Surface(int size)
        : height(size)
        , red(size)
        , green(size)
        , blue(size)
        , roughness(size)
        , metallic(size) {}

    Field height;           // in units of the tile's side
    Field red, green, blue; // linear sRGB
    Field roughness;        // perceptual
    Field metallic;         // all 0 or all 1: no map is made, the number suffices
    float cavityStrength = 1.0f;
    int cavityRadius = 12; // pixels: how far a bump darkens its surroundings

    void setColor(int x, int y, const glm::vec3& color) {
        red.row(y)[x] = color.r;
        green.row(y)[x] = color.g;
        blue.row(y)[x] = color.b;
    }
};

struct SurfaceMaps {
    ImagePtr baseColor;           // U8 sRGB, 3 channels
    ImagePtr normal;              // U8 data, 3 channels, OpenGL convention (green up)
    ImagePtr perceptualRoughness; // U8 data, 1 channel
    ImagePtr metallic;            // U8 data, 1 channel; null when constant
    ImagePtr occlusion;           // U8 data, 1 channel
    float constantMetallic = 0.0f;
};

SurfaceMaps finishSurface(const Surface& surface);

} // namespace patina::library
