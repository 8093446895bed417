#include "core/io/TexturePaths.h"
#include "core/base/LowerCase.h"

#include <algorithm>
#include <cctype>

namespace patina {

namespace {

namespace fs = std::filesystem;

std::string withSlashes(std::string name) {
    std::replace(name.begin(), name.end(), '\\', '/');
    return name;
}

bool usable(const fs::path& file) {
    std::error_code error;
    return fs::is_regular_file(file, error) && fs::file_size(file, error) > 0 && !error;
}

// "C:/art/wood.png" is absolute somewhere else; here it would be a relative path.
bool foreignAbsolute(const std::string& name) {
    return name.size() > 1 && name[1] == ':' &&
           std::isalpha(static_cast<unsigned char>(name[0])) != 0;
}

} // namespace

const TexturePaths::Listing& TexturePaths::listing(const fs::path& folder) {
    const auto [entry, isNew] = m_listings.try_emplace(folder);
    if (isNew) {
        std::error_code error;
        for (fs::directory_iterator it(folder, error), end; !error && it != end;
             it.increment(error))
            entry->second.try_emplace(lowerCase(it->path().filename().string()), it->path());
    }
    return entry->second;
}

fs::path TexturePaths::expected(const std::string& name) const {
    const std::string path = withSlashes(name);
    if (foreignAbsolute(path))
        return m_folder / fs::path(path).filename();
    return (m_folder / path).lexically_normal();
}

std::optional<fs::path> TexturePaths::find(const std::string& name) {
    if (name.empty() || name.find("://") != std::string::npos)
        return std::nullopt;
    // Some file names really hold a backslash.
    std::optional<fs::path> outside;
    for (const fs::path& spelled : {expected(name), m_folder / name}) {
        if (!usable(spelled))
            continue;
        if (isInside(spelled))
            return spelled;
        if (!outside)
            outside = spelled;
    }

    const std::string base = lowerCase(fs::path(withSlashes(name)).filename().string());
    const auto inFolder = [&](const fs::path& folder) -> std::optional<fs::path> {
        const Listing& files = listing(folder);
        const auto it = files.find(base);
        return it != files.end() && usable(it->second) ? std::optional(it->second) : std::nullopt;
    };
    if (auto beside = inFolder(m_folder))
        return beside;
    const Listing& around = listing(m_folder);
    if (const auto textures = around.find("textures"); textures != around.end())
        if (auto within = inFolder(textures->second))
            return within;
    return outside;
}

bool TexturePaths::isInside(const fs::path& file) const {
    std::error_code failed;
    const fs::path folder = fs::weakly_canonical(m_folder, failed);
    const fs::path full = failed ? fs::path() : fs::weakly_canonical(file, failed);
    return !failed && std::mismatch(folder.begin(), folder.end(), full.begin(), full.end()).first ==
                          folder.end();
}

} // namespace patina
