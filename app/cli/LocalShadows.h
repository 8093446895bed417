// Shadows of local lights for pictures.
#pragma once

#include "app/cli/Session.h"
#include "core/bake/local/NearShadows.h"
#include "core/document/Document.h"

namespace patina::cli {

// Traced where the picture is lit by a bake (`readsTransfer`) and the document has local lights, as
// far as `before` does not hold them; null where there is nothing to trace. Where they cannot be
// traced (memory) that is a warning, and null: then the picture shows what the bake's bands know.
// Errors: Usage (--max-memory), Cancelled.
[[nodiscard]] Result<NearShadowsPtr> traceLocalShadows(Session& session,
                                                       const PictureOptions& options,
                                                       const Document& document, bool readsTransfer,
                                                       const NearShadowsPtr& before = nullptr);

} // namespace patina::cli
