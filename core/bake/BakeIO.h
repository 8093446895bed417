// Bake files: OpenEXR with a documented layout (docs/prt-format.md).
#pragma once

#include "core/bake/BakeArtifact.h"
#include "core/base/AtomicFile.h"
#include "core/base/Result.h"

#include <filesystem>

namespace patina {

class WorkerClient;
struct Document;

// Vertex bakes: one part per mesh, vertices row by row in an image at most 4096 wide, channel names
// "sh.l1m-1" …, "ao". Texel bakes: one part per material.
Result<Bytes> encodeBake(WorkerClient& worker, const BakeArtifact& artifact,
                         const Document& document);
// Parts are matched to `document` by name and order; a bake of other geometry is an InputBroken
// error that says so.
Result<BakeArtifact> loadBake(WorkerClient& worker, const std::filesystem::path& file,
                              const Document& document);

} // namespace patina
