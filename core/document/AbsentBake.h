// A bake that a project names but whose file could not be read: moved away, damaged, or of a model
// that is missing. It holds no values, yet keeps its place in Document::bakes, so that saving the
// project again loses nothing; the same as a mesh whose model is missing. findBake() and
// hasTransfer() do not see it.
#pragma once

#include "core/bake/domain/BakeArtifact.h"

#include <string>

namespace patina {

[[nodiscard]] BakeArtifactPtr absentBake(BakeKind kind, const std::string& file); // absolute path
[[nodiscard]] bool isAbsent(const BakeArtifact& bake);

} // namespace patina
