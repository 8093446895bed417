#include "app/cli/LongRun.h"

#include "app/cli/LongBake.h"
#include "app/cli/Report.h"
#include "app/cli/SceneSetup.h"
#include "core/base/Leftovers.h"
#include "core/document/Source.h"

#include <fmt/format.h>
#include <utility>

namespace patina::cli {

namespace fs = std::filesystem;

Result<LongRun> planLongRun(const std::string& output, const LongBakeOptions& options) {
    LongRun run;
    run.resume = options.resume;
    run.keepWhenInterrupted = options.resume || !options.checkpoint.empty();
    if (!options.checkpoint.empty()) {
        const Result<double> seconds = parseInterval(options.checkpoint);
        if (!seconds)
            return seconds.error();
        run.everySeconds = *seconds;
    }
    std::error_code ignored;
    if (const fs::file_status status = fs::status(output, ignored);
        !fs::exists(status) || fs::is_regular_file(status))
        run.checkpoint = output + ".checkpoint";
    else if (run.keepWhenInterrupted)
        return usageError(
            fmt::format("checkpoints lie beside the output, and {} is no file", output));
    return run;
}

Result<std::optional<FileLock>> beginLongRun(Session& session, const LongRun& run,
                                             const std::string& output, const char* work) {
    std::optional<FileLock> lock;
    if (run.checkpoint.empty())
        return lock;
    Result<FileLock> taken = FileLock::take(output);
    if (!taken)
        return taken.error();
    lock.emplace(std::move(taken).value());
    removeLeftovers(output);
    removeLeftovers(run.checkpoint);
    std::error_code ignored;
    if (!fs::is_regular_file(run.checkpoint, ignored))
        return lock;
    if (run.resume) {
        session.keptCheckpoint(run.checkpoint); // whatever comes: it is not touched before
        session.expectCheckpoint(run.checkpoint, false);
    } else {
        session.report().warn(fmt::format("{}: this checkpoint of an earlier {} will be replaced; "
                                          "--resume would have gone on from it",
                                          run.checkpoint.string(), work));
    }
    return lock;
}

std::string absoluteSource(const std::string& source) {
    return isBuiltin(source) ? source : fs::absolute(source).lexically_normal().string();
}

std::string environmentFromAnywhere(const std::string& environment) {
    return environment == kNoEnvironment ? environment : absoluteSource(environment);
}

} // namespace patina::cli
