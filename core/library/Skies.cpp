#include "core/library/SkyRecipes.h"

#include <array>

namespace patina::library {

std::span<const SkyRecipe> skyRecipes() {
    static constexpr std::array<SkyRecipe, 6> kRecipes = {{
        {"white", "White",
         "Light of the same strength from everywhere: shows shape by nothing but "
         "the material (a furnace test).",
         1.0, whiteSky},
        {"clear-sky", "Clear Sky",
         "A cloudless morning with a sharp sun (Preetham's daylight model).", 1.00, clearSky},
        {"overcast", "Overcast", "Soft light from a closed cloud cover (CIE overcast sky).", 0.80,
         overcastSky},
        {"studio", "Studio",
         "A dark room with soft boxes: a key, rim strips, a fill and a bank "
         "overhead.",
         0.95, studioSky},
        {"sunset", "Sunset",
         "A low sun behind thin clouds, warm on one side and blue on the other.", 0.60, sunsetSky},
        {"night", "Night", "A city after dark: small lamps in many colours over a dark blue sky.",
         0.12, nightSky},
    }};
    return kRecipes;
}

} // namespace patina::library
