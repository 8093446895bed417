// `patina bake radiosity` as farms run it: with checkpoints, or one part of the form factors; the
// parts joined; and what such files hold.
#pragma once

#include "app/cli/Options.h"
#include "app/cli/Session.h"
#include "core/radiosity/document/LitDocument.h"

#include <string>

namespace patina::cli {

// The whole, or a part of its form factors. Errors: Usage for options that exclude each other;
// CannotCreate when another process writes this file; those of solving and writing.
Result<void> bakeRadiosity(Session& session, const BakeRadiosityOptions& options,
                           const RadiositySettings& settings);

// `patina merge` of parts of a radiosity: solves and writes what their command would have.
Result<void> mergeRadiosity(Session& session, const MergeOptions& options);

// What `patina info` says of a part or checkpoint.
Result<void> describeUnfinishedRadiosity(Report& report, const std::string& file);

} // namespace patina::cli
