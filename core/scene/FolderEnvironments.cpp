#include "core/scene/FolderEnvironments.h"

#include "core/base/LowerCase.h"
#include "core/scene/EnvironmentFile.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace patina {
namespace {

namespace fs = std::filesystem;

bool isEnvironmentName(const fs::path& file) {
    const std::string extension = extensionOf(file);
    return extension == ".hdr" || extension == ".exr" || extension == ".pfm";
}

// One of six faces whose first one is there, but not that.
bool isFurtherFace(const fs::path& file) {
    const std::vector<fs::path> faces = sixFaceFiles(file);
    std::error_code unknown;
    return !faces.empty() && faces.front() != file && fs::exists(faces.front(), unknown);
}

} // namespace

Result<FolderEnvironments> environmentFilesOf(const fs::path& folder, const FolderSearch& search,
                                              const JobContext& job) {
    FolderEnvironments found;
    std::vector<fs::path> level{folder};
    std::size_t entries = 0;
    for (int depth = 0; depth < search.levels && !level.empty() && found.complete; ++depth) {
        std::vector<fs::path> below;
        for (const fs::path& each : level) {
            std::error_code error;
            fs::directory_iterator entry(each, error);
            for (const fs::directory_iterator end; !error && entry != end; entry.increment(error)) {
                if (job.cancelled())
                    return Error{ErrorKind::Cancelled, "the search was cancelled", folder, {}};
                if (++entries > search.mostEntries) {
                    found.complete = false;
                    break;
                }
                std::error_code unknown;
                if (entry->is_directory(unknown)) {
                    if (!entry->is_symlink(unknown))
                        below.push_back(entry->path());
                } else if (isEnvironmentName(entry->path()) && !isFurtherFace(entry->path())) {
                    found.files.push_back(entry->path());
                }
            }
            if (error && depth == 0)
                return Error{ErrorKind::InputMissing, "the folder cannot be read", folder,
                             error.message()};
            if (error)
                found.unreadable.push_back(each);
        }
        level = std::move(below);
    }
    std::ranges::sort(found.files);
    if (found.files.size() > search.mostFiles) {
        found.complete = false;
        found.files.resize(search.mostFiles);
    }
    return found;
}

} // namespace patina
