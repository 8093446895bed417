// Whether the numbers that a COLLADA file speaks of are there: Assimp 5.2.5 believes what an
// <accessor> says of its array, and reads beyond the end of one that is shorter.
#pragma once

namespace pugi {
class xml_document;
} // namespace pugi

namespace patina::codec {

// Throws Refusal where an <accessor> asks for more numbers than its array has.
void checkColladaArrays(const pugi::xml_document& document);

} // namespace patina::codec
