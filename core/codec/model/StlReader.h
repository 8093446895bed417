// STL, text and binary. Read here because Assimp 5.2.5 takes seconds over a file of zeros and
// cannot tell a file that was cut short.
#pragma once

#include "core/codec/model/ModelFolder.h"
#include "core/mesh/ImportedModel.h"

namespace patina::codec {

// Flat-shaded: each triangle has vertices and a normal of its own. Throws Refusal, std::bad_alloc.
ImportedModel readStl(const ModelFolder& folder);

} // namespace patina::codec
