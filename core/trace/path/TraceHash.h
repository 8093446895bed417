// What a traced picture was made from, as hashes: whether two pictures are of the same scene.
#pragma once

#include "core/base/Hash.h"
#include "core/trace/path/TraceInputs.h"

#include <optional>
#include <string>

namespace patina {

// The same scene opened twice has the same hashes: ids, names and the places of files do not count.
struct TraceHash {
    Hash geometry;  // meshes and where they are
    Hash materials; // of those meshes, with their maps, and the shading model
    Hash lights;
    Hash environment;
    friend bool operator==(const TraceHash&, const TraceHash&) = default;
};

// Reads all vertices and texels: a second for some GiB.
[[nodiscard]] TraceHash hashTraceInputs(const TraceInputs& inputs);

// What differs, for the user: "the lights"; nothing when they are the same.
[[nodiscard]] std::optional<std::string> differingInputs(const TraceHash& there,
                                                         const TraceHash& here);

} // namespace patina
