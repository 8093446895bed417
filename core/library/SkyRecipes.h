// The procedural environments, one function each, and the table that names them.
#pragma once

#include "core/image/Image.h"
#include "core/job/JobContext.h"

#include <span>

namespace patina::library {

struct SkyRecipe {
    const char* name;
    const char* title;
    const char* help;
    // Radiance of a perfectly white surface facing up: how bright the environment is at EV 0.
    double whiteFacingUp;
    ImagePtr (*make)(double whiteFacingUp, const JobContext& job);
};

[[nodiscard]] std::span<const SkyRecipe> skyRecipes();

// Null after a cancel.
ImagePtr whiteSky(double whiteFacingUp, const JobContext& job);
ImagePtr clearSky(double whiteFacingUp, const JobContext& job);
ImagePtr overcastSky(double whiteFacingUp, const JobContext& job);
ImagePtr studioSky(double whiteFacingUp, const JobContext& job);
ImagePtr sunsetSky(double whiteFacingUp, const JobContext& job);
ImagePtr nightSky(double whiteFacingUp, const JobContext& job);

} // namespace patina::library
