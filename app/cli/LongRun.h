// What the files of long runs have in common, whatever they compute: the checkpoint beside the
// output, and who may write it.
#pragma once

#include "app/cli/Options.h"
#include "app/cli/Session.h"
#include "core/base/FileLock.h"
#include "core/base/Result.h"

#include <filesystem>
#include <optional>
#include <string>

namespace patina::cli {

struct LongRun {
    std::filesystem::path checkpoint; // empty: the output is no file
    double everySeconds = 30.0;
    bool resume = false, keepWhenInterrupted = false;
};

// Usage errors: of --checkpoint; where a checkpoint is asked for and cannot lie beside the output.
Result<LongRun> planLongRun(const std::string& output, const LongBakeOptions& options);

// Locks the output for this process, removes what killed ones left, and says whether a checkpoint
// that is there is used; `work`: "bake". Error: CannotCreate when another process holds it.
Result<std::optional<FileLock>> beginLongRun(Session& session, const LongRun& run,
                                             const std::string& output, const char* work);

// What to open to go on, wherever that is done: an absolute path or builtin:NAME.
[[nodiscard]] std::string absoluteSource(const std::string& source);
// The same of --environment, which may be none.
[[nodiscard]] std::string environmentFromAnywhere(const std::string& environment);

} // namespace patina::cli
