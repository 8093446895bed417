// Where a new light is put: where it is seen, beside the one before.
#pragma once

#include "core/document/Document.h"

namespace patina {

// `light` as a new one of this document. With a position: beside the last light that has one, else
// where it is, and within the view of the document's camera; no nearer to another light than both
// are large; turned to the scene's centre, and as bright there as before. Directional: not from
// where another one comes.
[[nodiscard]] Light placedInView(const Light& light, const Document& document);

} // namespace patina
