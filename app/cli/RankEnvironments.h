// The environments that `patina rank` ranks: named ones and those of folders, read one after the
// other and kept as what a sweep needs of them.
#pragma once

#include "app/cli/Session.h"
#include "core/rank/SweepEnvironment.h"

#include <string>
#include <vector>

namespace patina::cli {

struct RankedEnvironment {
    std::string file; // path or builtin:NAME
    SweepEnvironment measured;
};

struct BrokenEnvironment {
    std::string file, problem;
};

struct RankEnvironments {
    std::vector<RankedEnvironment> good; // in their order on the command line, folders by name
    std::vector<BrokenEnvironment> broken;
};

// Files of a folder that cannot be read are listed; those named one by one end the command, unless
// broken ones are skipped. Errors: Usage for a folder without .hdr and .exr; those of reading;
// InputBroken where nothing can be read; Cancelled.
Result<RankEnvironments> readRankEnvironments(Session& session, const RankOptions& options);

} // namespace patina::cli
