// Names a content of the document without holding it: to know whether what was written is what is
// there.
#pragma once

#include "core/bake/domain/BakeArtifact.h"

#include <cstdint>
#include <vector>

namespace patina {

// Of two states that are equal the content is the same, navigation (the camera) aside. Undo leads
// back to a state, redo to a later one; what makes no undo step begins a new history.
struct DocumentState {
    std::uint64_t history = 0, step = 0;
    // By content: following bounces replaces a bake by an equal one when albedo is as it was.
    std::vector<BakeArtifactPtr> bakes;
};
[[nodiscard]] bool operator==(const DocumentState& a, const DocumentState& b);

} // namespace patina
