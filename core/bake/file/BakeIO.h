// Bake files: OpenEXR with a documented layout (docs/prt-format.md).
#pragma once

#include "core/bake/domain/BakeArtifact.h"
#include "core/bake/domain/BakeStorage.h"
#include "core/base/AtomicFile.h"
#include "core/base/Result.h"

#include <filesystem>

namespace patina {

class WorkerClient;
struct Document;

// Vertex bakes: one part per mesh, vertices row by row in an image at most 4096 wide, channel names
// "sh.l1m-1" …, "ao". Texel bakes: one part per material. Where those are too many for a file,
// several share a part (BakePacking.h). The same artifact gives the same bytes.
Result<Bytes> encodeBake(WorkerClient& worker, const BakeArtifact& artifact,
                         const Document& document, const BakeFileOptions& options = {});
// Parts are matched to `document` by name and order; a bake of other geometry is an InputBroken
// error that says what differs.
Result<BakeArtifact> loadBake(WorkerClient& worker, const std::filesystem::path& file,
                              const Document& document);

} // namespace patina
