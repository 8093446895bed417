// What `patina render --inspect` says about a pixel's point under a transfer bake: the Transfer
// dock's numbers.
#pragma once

#include "app/cli/Session.h"
#include "core/bake/local/NearShadows.h"
#include "core/document/Document.h"

#include <glm/vec3.hpp>

namespace patina::cli {

// Adds "transfer" to the report. Does nothing without a transfer bake; a bake that has no values
// for the mesh is a warning. `position`: on the mesh, world; `shadows`: of local lights, as the
// picture has them. Errors: Cancelled.
Result<void> describeTransfer(Session& session, const Document& document,
                              const NearShadowsPtr& shadows, Id mesh, const glm::vec3& position);

} // namespace patina::cli
