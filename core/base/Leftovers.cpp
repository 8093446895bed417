#include "core/base/Leftovers.h"

#include "core/base/TemporaryName.h"

#include <string>
#include <system_error>
#include <vector>

namespace patina {

namespace fs = std::filesystem;

namespace {

void removeAbandoned(const fs::path& folder, const std::string& finalName) {
    std::vector<fs::path> leftovers;
    std::error_code error; // what cannot be listed or removed stays: it harms nobody
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error))
        if (isAbandoned(entry->path().filename().string(), finalName))
            leftovers.push_back(entry->path());
    for (const fs::path& leftover : leftovers)
        fs::remove(leftover, error);
}

} // namespace

void removeLeftovers(const fs::path& path) {
    removeAbandoned(path.has_parent_path() ? path.parent_path() : fs::path("."),
                    path.filename().string());
}

void removeAllLeftovers(const fs::path& folder) {
    removeAbandoned(folder, {});
}

} // namespace patina
