#include "core/light/IblCache.h"

#include "core/base/Check.h"

#include <bit>
#include <cstring>
#include <utility>

namespace patina {

namespace {

namespace fs = std::filesystem;

// Changes whenever computeIbl() would compute something else.
constexpr std::uint32_t kAlgorithm = 7;
constexpr char kMagic[8] = {'P', 'T', 'I', 'B', 'L', '0', '0', '4'};
constexpr const char* kExtension = ".ibl";
constexpr std::size_t kMaxFile = std::size_t{1} << 30;
constexpr std::uint32_t kMostCachedLevels = 32, kMaxSize = 4096;

struct Header {
    char magic[8];
    std::uint32_t levels;
    std::uint32_t size;    // of level 0
    std::uint32_t spacing; // LevelSpacing: gives the sizes of the others
    std::uint32_t irradianceSize;
};

std::size_t texelsOf(std::size_t size) {
    return 6 * size * size;
}

template <class T>
void append(Bytes& bytes, const T* values, std::size_t count) {
    if (count == 0)
        return; // an empty vector's data may be null
    const std::size_t before = bytes.size();
    bytes.resize(before + count * sizeof(T));
    std::memcpy(bytes.data() + before, values, count * sizeof(T));
}

Bytes encode(const IblMaps& maps) {
    Header header{};
    std::memcpy(header.magic, kMagic, sizeof(kMagic));
    header.levels = static_cast<std::uint32_t>(maps.prefiltered.size());
    header.size = static_cast<std::uint32_t>(maps.prefiltered.front().size);
    header.spacing = static_cast<std::uint32_t>(maps.spacing);
    header.irradianceSize = static_cast<std::uint32_t>(maps.irradiance.size);
    Bytes bytes;
    bytes.reserve(memoryBytes(maps) + sizeof(Header));
    append(bytes, &header, 1);
    append(bytes, maps.irradianceSh.data(), maps.irradianceSh.size());
    append(bytes, maps.radianceSh.data(), maps.radianceSh.size());
    for (const CubeLevel& level : maps.prefiltered)
        append(bytes, level.texels.data(), level.texels.size());
    append(bytes, maps.irradiance.texels.data(), maps.irradiance.texels.size());
    return bytes;
}

// Nothing when the bytes are not what encode() writes.
std::optional<IblMaps> decode(const Bytes& bytes) {
    Header header;
    if (bytes.size() < sizeof(header))
        return std::nullopt;
    const std::size_t content = bytes.size();
    std::memcpy(&header, bytes.data(), sizeof(header));
    if (std::memcmp(header.magic, kMagic, sizeof(kMagic)) != 0)
        return std::nullopt;
    if (header.levels < 1 || header.levels > kMostCachedLevels || header.size > kMaxSize ||
        !std::has_single_bit(header.size) ||
        header.spacing > static_cast<std::uint32_t>(LevelSpacing::Even) ||
        header.irradianceSize > kMaxSize)
        return std::nullopt;

    IblMaps maps;
    maps.spacing = static_cast<LevelSpacing>(header.spacing);
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
        complete = takeLevel(maps.prefiltered.emplace_back(),
                             static_cast<std::size_t>(levelSide(maps.spacing, static_cast<int>(i),
                                                                static_cast<int>(header.size))));
    if (complete && header.irradianceSize > 0)
        complete = takeLevel(maps.irradiance, header.irradianceSize);
    if (!complete || at != content)
        return std::nullopt;
    return maps;
}

} // namespace

IblCache::IblCache(fs::path folder, std::uint64_t maxBytes)
    : m_files(std::move(folder), kExtension, "light", maxBytes, kMaxFile) {}

Hash IblCache::key(const Image& environment, const IblSettings& settings) {
    CHECK(environment.type() == PixelType::F32);
    return Hasher()
        .value(kAlgorithm)
        .value(settings.cubeSize)
        .value(settings.levels)
        .value(settings.spacing)
        .value(settings.irradianceSize)
        .value(settings.cellSize)
        .value(environment.width())
        .value(environment.height())
        .value(environment.channels())
        .array(environment.f32())
        .finish();
}

fs::path IblCache::file(const Hash& key) const {
    return m_files.file(key);
}

std::optional<IblMaps> IblCache::find(const Hash& key) const {
    const std::optional<Bytes> content = m_files.find(key);
    if (!content)
        return std::nullopt;
    std::optional<IblMaps> maps = decode(*content);
    if (!maps)
        m_files.drop(key);
    return maps;
}

Result<void> IblCache::store(const Hash& key, const IblMaps& maps) const {
    CHECK(!maps.prefiltered.empty());
    return m_files.store(key, encode(maps));
}

} // namespace patina
