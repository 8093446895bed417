// How much a COLLADA scene becomes when its nodes are written out: nodes may show others, which
// show others again, so that a few words stand for any number of copies. Assimp 5.2.5 writes them
// out before anybody can count them, and follows nodes that show themselves until it dies.
#pragma once

namespace pugi {
class xml_document;
class xml_node;
} // namespace pugi

namespace patina::codec {

// `scene`: the <visual_scene> that is read. Throws Refusal where it has more objects than are
// supported, a node contains itself, or nodes lie too deep within each other.
void checkColladaNodes(const pugi::xml_document& document, const pugi::xml_node& scene);

} // namespace patina::codec
