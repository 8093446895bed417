// Writing what a bake made: one OpenEXR file, or a picture for each material.
#pragma once

#include "app/cli/Session.h"
#include "core/bake/BakeArtifact.h"
#include "core/bake/BakeStorage.h"
#include "core/document/Document.h"

#include <filesystem>

namespace patina::cli {

// Usage error unless the name's extension is one that this kind of bake can be written to;
// CannotCreate when it cannot be written there.
Result<void> checkBakeOutput(const std::filesystem::path& output, BakeKind kind);

// Errors: those of encoding and of writeFileAtomically(); Cancelled.
Result<void> writeBake(Session& session, const Document& document, const BakeArtifact& artifact,
                       const std::filesystem::path& output, const BakeFileOptions& storage);

} // namespace patina::cli
