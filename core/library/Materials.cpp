#include "core/library/MaterialRecipes.h"

#include <array>

namespace patina::library {

std::span<const MaterialRecipe> materialRecipes() {
    static constexpr std::array<MaterialRecipe, 10> kRecipes = {{
        {"worn-painted-metal", "Worn Painted Metal",
         "Teal enamel, chipped down to steel, with rust creeping in from the edges.",
         wornPaintedMetal},
        {"copper-patina", "Copper Patina", "Brown copper under green verdigris that runs down.",
         copperPatina},
        {"gold", "Gold", "Hammered, polished gold with fine scratches.", gold},
        {"brushed-steel", "Brushed Steel", "Stainless steel with a fine brush finish along u.",
         brushedSteel},
        {"rough-plastic", "Rough Plastic", "Charcoal plastic with a fine moulded grain.",
         roughPlastic},
        {"carbon-fibre", "Carbon Fibre", "A 2 × 2 twill of black fibres under lacquer.",
         carbonFibre},
        {"ceramic", "Ceramic", "A glossy celadon glaze with a fine crackle.", ceramic},
        {"concrete", "Concrete", "Cast concrete with bubbles, stains and hairline cracks.",
         concrete},
        {"wood", "Wood", "Oiled oak boards along u.", wood},
        {"leather", "Leather", "Cognac leather with a pebbled grain.", leather},
    }};
    return kRecipes;
}

} // namespace patina::library
