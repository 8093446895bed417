#include "app/cli/RankEnvironments.h"

#include "app/cli/Report.h"
#include "app/cli/SceneSetup.h"
#include "core/document/Document.h"
#include "core/document/EnvironmentTitle.h"
#include "core/document/Source.h"
#include "core/scene/EnvironmentFile.h"
#include "core/scene/FolderEnvironments.h"

#include <filesystem>
#include <fmt/format.h>
#include <system_error>
#include <utility>

namespace patina::cli {
namespace {

namespace fs = std::filesystem;

struct Candidate {
    std::string file;
    bool ofFolder = false;
};

// The environments of a folder by name, not of folders in it.
Result<std::vector<Candidate>> filesOf(const fs::path& folder) {
    const Result<FolderEnvironments> found = environmentFilesOf(folder);
    if (!found)
        return found.error();
    if (found->files.empty())
        return Error{ErrorKind::Usage, "there is no .hdr, .exr or .pfm in this folder", folder, {}};
    std::vector<Candidate> candidates;
    for (const fs::path& file : found->files)
        candidates.push_back({file.string(), true});
    return candidates;
}

Result<std::vector<Candidate>> candidatesOf(const RankOptions& options) {
    std::vector<Candidate> candidates;
    for (const std::string& name : options.environments) {
        std::error_code unknown;
        if (isBuiltin(name) || !fs::is_directory(name, unknown)) {
            candidates.push_back({name, false});
            continue;
        }
        const Result<std::vector<Candidate>> files = filesOf(name);
        if (!files)
            return files.error();
        candidates.insert(candidates.end(), files->begin(), files->end());
    }
    return candidates;
}

} // namespace

Result<RankEnvironments> readRankEnvironments(Session& session, const RankOptions& options) {
    const Result<EnvironmentLayout> layout = parseLayout(options.environmentLayout);
    if (!layout)
        return layout.error();
    const Result<std::vector<Candidate>> candidates = candidatesOf(options);
    if (!candidates)
        return candidates.error();
    RankEnvironments result;
    session.beginPhase();
    for (std::size_t i = 0; i < candidates->size(); ++i) {
        const Candidate& candidate = (*candidates)[i];
        // Of reading one the progress is not shown, but of all of them.
        session.job().setActivity(
            fmt::format("reading environments ({} of {})", i + 1, candidates->size()));
        Environment environment;
        Result<void> read = setEnvironment(session, environment, candidate.file, *layout);
        session.job().setProgress(static_cast<double>(i + 1) /
                                  static_cast<double>(candidates->size()));
        if (!read) {
            Error error = read.error();
            if (error.kind == ErrorKind::Cancelled || error.kind == ErrorKind::Internal)
                return error;
            if (!candidate.ofFolder && !options.skipBroken) {
                error.message += "; --skip-broken ranks the others";
                return error;
            }
            session.report().warn(fmt::format("{}: {}", candidate.file, error.message));
            result.broken.push_back({candidate.file, error.message});
            continue;
        }
        SweepEnvironment measured =
            measureEnvironment(environmentTitle(environment), *environment.image, session.job());
        if (session.job().cancelled())
            return Error{ErrorKind::Cancelled, "cancelled", {}, {}};
        result.good.push_back({environment.source, std::move(measured)});
    }
    if (result.good.empty())
        return Error{ErrorKind::InputBroken, "none of the environments can be read", {}, {}};
    return result;
}

} // namespace patina::cli
