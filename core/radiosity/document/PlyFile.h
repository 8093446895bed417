// Lit meshes as one Stanford PLY: vertex colours for whatever shows them, and the light itself.
#pragma once

#include "core/base/AtomicFile.h"
#include "core/radiosity/document/LitDocument.h"

namespace patina {

// Little-endian. Per vertex: x y z, nx ny nz, s t (floats; glTF's texture coordinates), red green
// blue (bytes, sRGB curve: the radiance exposed), radiance_r _g _b (floats, not clamped).
[[nodiscard]] Bytes litPly(const LitDocument& lit);

} // namespace patina
