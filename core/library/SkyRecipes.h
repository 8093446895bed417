// The procedural environments, one function each, and the table that names them.
#pragma once

#include "core/image/Image.h"

#include <span>

namespace patina::library {

struct SkyRecipe {
    const char* name;
    const char* title;
    const char* help;
    // Radiance of a perfectly white surface facing up: how bright the environment is at EV 0.
    double whiteFacingUp;
    ImagePtr (*make)(double whiteFacingUp);
};

[[nodiscard]] std::span<const SkyRecipe> skyRecipes();

ImagePtr whiteSky(double whiteFacingUp);
ImagePtr clearSky(double whiteFacingUp);
ImagePtr overcastSky(double whiteFacingUp);
ImagePtr studioSky(double whiteFacingUp);
ImagePtr sunsetSky(double whiteFacingUp);
ImagePtr nightSky(double whiteFacingUp);

} // namespace patina::library
