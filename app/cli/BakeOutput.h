// Writing what a bake made: one OpenEXR file, or a picture for each material.
#pragma once

#include "app/cli/Session.h"
#include "core/bake/domain/BakeArtifact.h"
#include "core/bake/domain/BakeStorage.h"
#include "core/base/AtomicFile.h"
#include "core/document/Document.h"
#include "core/export/Names.h"

#include <filesystem>
#include <utility>

namespace patina::cli {

// Usage error unless the name's extension is one that this kind of bake can be written to;
// CannotCreate when it cannot be written there.
Result<void> checkBakeOutput(const std::filesystem::path& output, BakeKind kind);

// Errors: those of encoding and of writeFileAtomically(); Cancelled.
Result<void> writeBake(Session& session, const Document& document, const BakeArtifact& artifact,
                       const std::filesystem::path& output, const BakeFileOptions& storage);

// The pictures of an AoTexel bake: OUT.png, or OUT-<material>.png where there are several.
class PictureWriter {
  public:
    PictureWriter(Session& session, const Document& document, std::filesystem::path output,
                  bool several)
        : m_session(session)
        , m_document(document)
        , m_output(std::move(output))
        , m_several(several) {}

    // Errors: those of encoding and of writeFileAtomically(); Cancelled.
    Result<void> write(const TexelBake& texel);
    // Where the next picture goes, and what it holds.
    Result<std::pair<std::filesystem::path, Bytes>> encode(const TexelBake& texel);

  private:
    Session& m_session;
    const Document& m_document;
    std::filesystem::path m_output;
    bool m_several;
    UniqueNames m_names;
};

} // namespace patina::cli
