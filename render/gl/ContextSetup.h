// Shared by the ways to come by a context; only for render/gl's own sources.
#pragma once

#include "render/gl/Context.h"

namespace patina::gl {

// Reads what the current context can do and, in Debug builds, sends its messages to the log.
// Error NoOpenGl when it is older than 4.5.
Result<ContextInfo> describeCurrentContext();

} // namespace patina::gl
