// The procedural materials, one function each, and the table that names them.
#pragma once

#include "core/library/Surface.h"

#include <span>

namespace patina::library {

struct MaterialRecipe {
    const char* name;
    const char* title;
    const char* help;
    Surface (*make)();
};

[[nodiscard]] std::span<const MaterialRecipe> materialRecipes();

inline constexpr int kMapSize = 512;

Surface wornPaintedMetal();
Surface copperPatina();
Surface gold();
Surface brushedSteel();
Surface roughPlastic();
Surface carbonFibre();
Surface ceramic();
Surface concrete();
Surface wood();
Surface leather();

} // namespace patina::library
