#include "core/scene/FolderEnvironments.h"

#include "core/base/LowerCase.h"
#include "core/scene/EnvironmentFile.h"

#include <algorithm>
#include <string>
#include <system_error>

namespace patina {

namespace fs = std::filesystem;

Result<std::vector<fs::path>> environmentFilesOf(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        const std::string extension = extensionOf(entry->path());
        std::error_code unknown;
        if ((extension != ".hdr" && extension != ".exr") || entry->is_directory(unknown))
            continue;
        const std::vector<fs::path> faces = sixFaceFiles(entry->path());
        if (!faces.empty() && faces.front() != entry->path() && fs::exists(faces.front(), unknown))
            continue;
        files.push_back(entry->path());
    }
    if (error)
        return Error{ErrorKind::InputMissing, "the folder cannot be read", folder, error.message()};
    if (files.empty())
        return Error{ErrorKind::Usage, "there is no .hdr and no .exr in this folder", folder, {}};
    std::ranges::sort(files);
    return files;
}

} // namespace patina
