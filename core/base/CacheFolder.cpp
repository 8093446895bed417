#include "core/base/CacheFolder.h"

#include "core/base/Log.h"
#include "core/base/OwnFile.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <system_error>
#include <utility>
#include <vector>

namespace patina {

namespace fs = std::filesystem;

CacheFolder::CacheFolder(fs::path folder, std::string extension, std::string what,
                         std::uint64_t maxBytes, std::size_t maxFileBytes)
    : m_folder(std::move(folder))
    , m_extension(std::move(extension))
    , m_what(std::move(what))
    , m_maxBytes(maxBytes)
    , m_maxFileBytes(maxFileBytes) {}

fs::path CacheFolder::file(const Hash& key) const {
    return m_folder / (key.hex() + m_extension);
}

// The content, and its hash behind it.
std::optional<Bytes> CacheFolder::find(const Hash& key) const {
    const fs::path path = file(key);
    std::error_code error;
    if (!fs::exists(path, error))
        return std::nullopt;
    Result<Bytes> bytes = readFile(path, m_maxFileBytes);
    Hash hash;
    if (!bytes || bytes->size() < sizeof(hash)) {
        drop(key);
        return std::nullopt;
    }
    Bytes content = std::move(bytes).value();
    std::memcpy(&hash, content.data() + content.size() - sizeof(hash), sizeof(hash));
    content.resize(content.size() - sizeof(hash));
    if (hashBytes(content) != hash) {
        drop(key);
        return std::nullopt;
    }
    fs::last_write_time(path, fs::file_time_type::clock::now(), error); // best effort: used now
    return content;
}

void CacheFolder::drop(const Hash& key) const {
    const fs::path path = file(key);
    logWarning("The cached {} {} is damaged; it is computed again.", m_what, path.string());
    std::error_code error;
    fs::remove(path, error);
}

Result<void> CacheFolder::store(const Hash& key, const Bytes& content) const {
    std::error_code error;
    fs::create_directories(m_folder, error); // what fails here, fails with a better message below
    const Hash hash = hashBytes(content);
    const std::array<std::span<const std::byte>, 2> pieces{
        std::span<const std::byte>(content), std::as_bytes(std::span<const Hash>(&hash, 1))};
    const fs::path path = file(key);
    if (Result<void> written = writeOwnPieces(path, pieces); !written)
        return written;
    evict(path);
    return {};
}

void CacheFolder::evict(const fs::path& keep) const {
    struct Entry {
        fs::file_time_type used;
        std::uint64_t size;
        fs::path path;
    };
    std::vector<Entry> entries;
    std::uint64_t total = 0;
    std::error_code error;
    // Another process may remove files meanwhile: what cannot be asked is skipped.
    for (fs::directory_iterator it(m_folder, error), end; !error && it != end;
         it.increment(error)) {
        if (it->path().extension() != m_extension)
            continue;
        std::error_code gone;
        const std::uint64_t size = fs::file_size(it->path(), gone);
        const fs::file_time_type used =
            gone ? fs::file_time_type() : fs::last_write_time(it->path(), gone);
        if (gone)
            continue;
        total += size;
        entries.push_back({used, size, it->path()});
    }
    std::ranges::sort(entries, {}, &Entry::used);
    for (const Entry& entry : entries) {
        if (total <= m_maxBytes)
            break;
        if (entry.path == keep)
            continue;
        fs::remove(entry.path, error);
        total -= entry.size;
    }
}

} // namespace patina
