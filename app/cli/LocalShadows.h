// Shadows of local lights for `patina render`.
#pragma once

#include "app/cli/Session.h"
#include "core/bake/local/NearShadows.h"
#include "core/document/Document.h"
#include "render/view/ViewSettings.h"

namespace patina::cli {

// Traced where a picture of these options is lit by a bake and the document has local lights; null
// where there is nothing to trace. Where they cannot be traced (memory) that is a warning, and
// null: then the picture shows what the bake's bands know. Errors: Usage (--max-memory), Cancelled.
[[nodiscard]] Result<NearShadowsPtr> traceLocalShadows(Session& session,
                                                       const RenderOptions& options,
                                                       const Document& document,
                                                       const render::ViewSettings& shown);

} // namespace patina::cli
