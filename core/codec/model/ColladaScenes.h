// What is looked at in a COLLADA file before Assimp reads it: whether its numbers are there
// (ColladaArrays.h), how much its nodes stand for (ColladaNodes.h), and which visual scene is read.
// Assimp takes the one that the file's <scene> names, so that another one is chosen by a copy of
// the file that names that; and it reads UTF-8 alone, so that other encodings are handed on as a
// copy, too.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace patina::codec {

struct ColladaScenes {
    std::vector<std::string> titles; // visualSceneTitles(); empty: the file has one scene, or none
    std::size_t taken = 0;           // of them
    std::string text;                // the copy, UTF-8; empty: the file as it is
};

// `wanted`: a title; empty: the scene that the file names, or the first. Throws Refusal with
// kind Usage where there is no such scene, those of checkColladaArrays() and checkColladaNodes(),
// and std::bad_alloc.
ColladaScenes colladaScenes(std::span<const std::byte> file, const std::string& wanted);

} // namespace patina::codec
