// OBJ: by a reader of our own where the file is written as nearly all are, else through Assimp.
#pragma once

#include "core/codec/model/ModelFolder.h"
#include "core/mesh/ImportedModel.h"

namespace patina::codec {

// As readWithAssimp(folder, "obj"), to the bit, in a third of the time: Assimp allocates memory for
// each face and looks for equal vertices in a tree of nodes.
ImportedModel readObj(const ModelFolder& folder);

} // namespace patina::codec
