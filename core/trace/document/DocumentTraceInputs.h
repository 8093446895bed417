// What a picture of a document that is traced by rays depends on.
#pragma once

#include "core/trace/path/TraceInputs.h"

namespace patina {

struct Document;

// The visible meshes, the lights and environments that take part in the mix.
[[nodiscard]] TraceInputs traceInputs(const Document& document);

} // namespace patina
