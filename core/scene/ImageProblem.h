// What is wrong with images that could not be read.
#pragma once

#include "core/document/Document.h"

#include <string>
#include <string_view>
#include <vector>

namespace patina {

// In a word, from why it could not be read (MapSlot::problem): "missing" where there is no such
// file, "unreadable" where it may not be read, else "damaged".
[[nodiscard]] std::string problemWord(std::string_view problem);

// "night.hdr is missing"; empty where the environment shows its file, or none.
[[nodiscard]] std::string environmentProblem(const Environment& environment);

// Sources of the maps that are there and could not be read, each once, in the order of materials.
[[nodiscard]] std::vector<std::string> damagedMaps(const Document& document);

// "Roughness map is damaged: rough.png", a line for each map of a material that could not be read.
[[nodiscard]] std::vector<std::string> mapProblems(const Document& document, Id material);

} // namespace patina
