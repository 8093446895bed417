// The subcommands. Each works through the session and leaves its result in the session's report.
#pragma once

#include "app/cli/Session.h"

namespace patina::cli {

Result<void> run(Session& session, const InfoOptions& options);
Result<void> run(Session& session, const RenderOptions& options);
Result<void> run(Session& session, const LadderOptions& options);
Result<void> run(Session& session, const SheetOptions& options);
Result<void> run(Session& session, const RankOptions& options);
Result<void> run(Session& session, const BakeAoOptions& options);
Result<void> run(Session& session, const BakePrtOptions& options);
Result<void> run(Session& session, const BakeLightOptions& options);
Result<void> run(Session& session, const BakeRadiosityOptions& options);
Result<void> run(Session& session, const BakeIblOptions& options);
Result<void> run(Session& session, const MergeOptions& options);
Result<void> run(Session& session, const EnvironmentOptions& options);
Result<void> run(Session& session, const BracketCommandOptions& options);
Result<void> run(Session& session, const ExportOptions& options);
Result<void> run(Session& session, const RefineOptions& options);
Result<void> run(Session& session, const CompareOptions& options);
Result<void> run(Session& session, const CertificateOptions& options);
Result<void> run(Session& session, const ParametersOptions& options);

} // namespace patina::cli
