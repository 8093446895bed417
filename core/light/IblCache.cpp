#include "core/light/IblCache.h"

#include "core/base/AtomicFile.h"
#include "core/base/Check.h"
#include "core/base/Log.h"

#include <algorithm>
#include <cstring>
#include <system_error>
#include <utility>

namespace patina {

namespace {

namespace fs = std::filesystem;

// Changes whenever computeIbl() would compute something else.
constexpr std::uint32_t kAlgorithm = 4;
constexpr char kMagic[8] = {'P', 'T', 'I', 'B', 'L', '0', '0', '1'};
constexpr const char* kExtension = ".ibl";
constexpr std::size_t kMaxFile = std::size_t{1} << 30;
constexpr std::uint32_t kMaxLevels = 16, kMaxSize = 4096;

struct Header {
    char magic[8];
    std::uint32_t levels;
    std::uint32_t size;     // of level 0; the others halve…
    std::uint32_t smallest; // …down to this
    std::uint32_t irradianceSize;
};

std::size_t texelsOf(std::size_t size) {
    return 6 * size * size;
}

template <class T>
void append(Bytes& bytes, const T* values, std::size_t count) {
    const auto* first = reinterpret_cast<const std::byte*>(values);
    bytes.insert(bytes.end(), first, first + count * sizeof(T));
}

Bytes encode(const IblMaps& maps) {
    Header header{};
    std::memcpy(header.magic, kMagic, sizeof(kMagic));
    header.levels = static_cast<std::uint32_t>(maps.prefiltered.size());
    header.size = static_cast<std::uint32_t>(maps.prefiltered.front().size);
    header.smallest = static_cast<std::uint32_t>(maps.prefiltered.back().size);
    header.irradianceSize = static_cast<std::uint32_t>(maps.irradiance.size);
    Bytes bytes;
    bytes.reserve(memoryBytes(maps) + sizeof(Header) + sizeof(Hash));
    append(bytes, &header, 1);
    append(bytes, maps.irradianceSh.data(), maps.irradianceSh.size());
    append(bytes, maps.radianceSh.data(), maps.radianceSh.size());
    for (const CubeLevel& level : maps.prefiltered)
        append(bytes, level.texels.data(), level.texels.size());
    append(bytes, maps.irradiance.texels.data(), maps.irradiance.texels.size());
    const Hash hash = hashBytes(bytes);
    append(bytes, &hash, 1);
    return bytes;
}

// Nothing when the bytes are not what encode() writes.
std::optional<IblMaps> decode(const Bytes& bytes) {
    Header header;
    Hash hash;
    if (bytes.size() < sizeof(header) + sizeof(hash))
        return std::nullopt;
    const std::size_t content = bytes.size() - sizeof(hash);
    std::memcpy(&hash, bytes.data() + content, sizeof(hash));
    std::memcpy(&header, bytes.data(), sizeof(header));
    if (std::memcmp(header.magic, kMagic, sizeof(kMagic)) != 0 ||
        hashBytes(std::span(bytes).first(content)) != hash)
        return std::nullopt;
    if (header.levels < 1 || header.levels > kMaxLevels || header.size > kMaxSize ||
        header.smallest == 0 || header.smallest > header.size || header.irradianceSize > kMaxSize)
        return std::nullopt;

    IblMaps maps;
    std::size_t at = sizeof(header);
    const auto take = [&](glm::vec3* to, std::size_t count) {
        const std::size_t size = count * sizeof(glm::vec3);
        if (content - at < size)
            return false;
        std::memcpy(to, bytes.data() + at, size);
        at += size;
        return true;
    };
    const auto takeLevel = [&](CubeLevel& level, std::size_t size) {
        if ((content - at) / sizeof(glm::vec3) < texelsOf(size))
            return false;
        level.size = static_cast<int>(size);
        level.texels.resize(texelsOf(size));
        return take(level.texels.data(), level.texels.size());
    };
    bool complete = take(maps.irradianceSh.data(), maps.irradianceSh.size()) &&
                    take(maps.radianceSh.data(), maps.radianceSh.size());
    for (std::uint32_t i = 0; i < header.levels && complete; ++i)
        complete =
            takeLevel(maps.prefiltered.emplace_back(), std::max(header.size >> i, header.smallest));
    if (complete && header.irradianceSize > 0)
        complete = takeLevel(maps.irradiance, header.irradianceSize);
    if (!complete || at != content)
        return std::nullopt;
    return maps;
}

} // namespace

IblCache::IblCache(fs::path folder, std::uint64_t maxBytes)
    : m_folder(std::move(folder))
    , m_maxBytes(maxBytes) {}

Hash IblCache::key(const Image& environment, const IblSettings& settings) {
    CHECK(environment.type() == PixelType::F32);
    return Hasher()
        .value(kAlgorithm)
        .value(settings.cubeSize)
        .value(settings.levels)
        .value(settings.smallestLevel)
        .value(settings.irradianceSize)
        .value(settings.cellSize)
        .value(environment.width())
        .value(environment.height())
        .value(environment.channels())
        .array(environment.f32())
        .finish();
}

fs::path IblCache::file(const Hash& key) const {
    return m_folder / (key.hex() + kExtension);
}

std::optional<IblMaps> IblCache::find(const Hash& key) const {
    const fs::path path = file(key);
    std::error_code error;
    if (!fs::exists(path, error))
        return std::nullopt;
    const Result<Bytes> bytes = readFile(path, kMaxFile);
    std::optional<IblMaps> maps = bytes ? decode(*bytes) : std::nullopt;
    if (!maps) {
        logWarning("The cached light {} is damaged; it is computed again.", path.string());
        fs::remove(path, error);
        return std::nullopt;
    }
    fs::last_write_time(path, fs::file_time_type::clock::now(), error); // best effort: used now
    return maps;
}

Result<void> IblCache::store(const Hash& key, const IblMaps& maps) const {
    CHECK(!maps.prefiltered.empty());
    std::error_code error;
    fs::create_directories(m_folder, error); // what fails here, fails with a better message below
    const fs::path path = file(key);
    if (Result<void> written = writeFileAtomically(path, encode(maps)); !written)
        return written;
    evict(path);
    return {};
}

void IblCache::evict(const fs::path& keep) const {
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
        if (it->path().extension() != kExtension)
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
