// OBJ, COLLADA and FBX through Assimp 5.2.5.
#pragma once

#include "core/codec/model/ModelFolder.h"
#include "core/codec/model/ObjText.h"
#include "core/mesh/ImportedModel.h"

#include <string>

namespace patina::codec {

// `format` is "obj", "dae" or "fbx": only that importer is registered, so that
// Assimp never guesses. Transforms come out in metres with +Y up, texture coordinates as in glTF.
// ImportedTexture::file is the path as the file spells it. `visualScene`: of "dae", as of
// colladaScenes(). Throws Refusal and std::bad_alloc.
ImportedModel readWithAssimp(const ModelFolder& folder, const std::string& format,
                             const std::string& visualScene = {});

// What readWithAssimp() makes of an OBJ file whose geometry has been read already: Assimp sees the
// outline alone, and says which runs of faces are one part, under which name and material.
ImportedModel readObjParts(const ModelFolder& folder, const ObjText& text);

} // namespace patina::codec
