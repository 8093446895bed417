// Which map of a material a picture is, by the plain words in its file's name: "rust_Normal.png",
// "wood-basecolor.jpg", "T_Brick_AO_2k.tga".
#pragma once

#include "core/edit/Parameters.h"

#include <string_view>

namespace patina {

// A parameter of type Map and scope Material, one of those with the usual names; null where no word
// says one, or where words say several, as files do that hold several maps in their channels.
[[nodiscard]] const ParameterInfo* mapForFileName(std::string_view fileName);

} // namespace patina
