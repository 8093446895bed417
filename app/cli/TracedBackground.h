// What stands behind a traced scene, as the viewport has it.
#pragma once

#include "app/cli/Session.h"
#include "core/document/Document.h"
#include "core/trace/path/PathTracer.h"

namespace patina::cli {

// Light from the environment, behind the scene. Errors: Cancelled.
Result<void> setBackground(Session& session, const Document& document, TraceView& view);

} // namespace patina::cli
