// PLY (Stanford), text and binary of both byte orders. Read here because Assimp 5.2.5 crashes or
// hangs on one damaged PLY file in seven.
#pragma once

#include "core/codec/model/ModelFolder.h"
#include "core/mesh/ImportedModel.h"

namespace patina::codec {

// Positions, normals, texture coordinates and polygons (as fans); "comment TextureFile" names the
// base colour. Other elements and properties are skipped. Throws Refusal, std::bad_alloc.
ImportedModel readPly(const ModelFolder& folder);

} // namespace patina::codec
