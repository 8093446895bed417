// What `patina bake light` and `patina merge` bake light maps of.
#pragma once

#include "app/cli/Session.h"
#include "core/bake/lightmap/LightMapBake.h"
#include "core/document/Document.h"

namespace patina::cli {

// With the maps of the environment that is shown, which take a moment. Errors: Cancelled.
Result<LightMapInputs> lightMapInputsOf(Session& session, const Document& document);

} // namespace patina::cli
