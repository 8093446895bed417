#include "core/radiosity/document/FilesTogether.h"

#include "core/base/DiskSpace.h"
#include "core/base/Limits.h"
#include "core/base/OwnFile.h"

#include <algorithm>
#include <cstdint>
#include <fmt/format.h>
#include <optional>
#include <utility>

namespace patina {
namespace {

namespace fs = std::filesystem;

// One that has been replaced or is new.
struct Replaced {
    fs::path path;
    std::optional<Bytes> before; // nullopt: there was none
};

} // namespace

void FilesTogether::add(fs::path file, Bytes data) {
    m_files.push_back({std::move(file), std::move(data)});
}

Result<std::vector<fs::path>> FilesTogether::write() const {
    std::uint64_t bytes = 0, largest = 0;
    for (const File& file : m_files) {
        bytes += file.data.size();
        largest = std::max<std::uint64_t>(largest, file.data.size());
    }
    if (Result<void> fits = checkDiskSpace(m_named, bytes, largest); !fits)
        return fits.error();

    std::vector<Replaced> done;
    const auto save = [&](const fs::path& path, const Bytes& data) {
        return path == m_named ? writeFileAtomically(path, data) : writeOwnFile(path, data);
    };
    const auto undo = [&](Error error) {
        for (auto file = done.rbegin(); file != done.rend(); ++file) {
            std::error_code failed;
            if (file->before ? !save(file->path, *file->before).ok()
                             : !fs::remove(file->path, failed))
                error.message +=
                    fmt::format("; {} is new and could not be put back", file->path.string());
        }
        return error;
    };
    std::vector<fs::path> paths;
    for (const File& file : m_files) {
        Replaced replaced{file.path, {}};
        std::error_code unknown;
        // Nothing comes after the last one that could fail.
        if (&file != &m_files.back() && fs::is_regular_file(file.path, unknown)) {
            Result<Bytes> before = readFile(file.path, limits::kMaxModelFileBytes);
            if (!before)
                return undo(before.error());
            replaced.before = *std::move(before);
        }
        if (file.path.parent_path() != m_named.parent_path()) // pictures in folders of their own
            fs::create_directories(file.path.parent_path(), unknown);
        if (Result<void> written = save(file.path, file.data); !written)
            return undo(written.error());
        done.push_back(std::move(replaced));
        paths.push_back(file.path);
    }
    return paths;
}

bool liesBeside(const fs::path& name) {
    return name.native().find('\0') == std::string::npos && name.has_filename() &&
           !name.is_absolute() && std::ranges::find(name, fs::path("..")) == name.end();
}

bool isSameFile(const fs::path& a, const fs::path& b) {
    std::error_code missing;
    return fs::equivalent(a, b, missing);
}

} // namespace patina
