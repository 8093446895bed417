// How a traced scene is looked at, as the viewport has it.
#pragma once

#include "app/cli/Session.h"
#include "core/document/Document.h"
#include "core/trace/path/PathTracer.h"
#include "render/view/FrameSettings.h"

namespace patina::cli {

// Where rays start, at the frame's size, and what is behind the scene. Errors: Cancelled.
Result<TraceView> traceView(Session& session, const Document& document,
                            const render::FrameSettings& frame);

} // namespace patina::cli
