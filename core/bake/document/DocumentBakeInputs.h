// What a document's bakes depend on.
#pragma once

#include "core/trace/BakeInputs.h"

namespace patina {

struct Document;

[[nodiscard]] BakeInputs bakeInputs(const Document& document); // of the visible meshes

} // namespace patina
