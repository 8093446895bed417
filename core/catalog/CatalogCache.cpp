#include "core/catalog/CatalogCache.h"

#include "core/catalog/EnvironmentThumbnail.h"
#include "core/image/Qoi.h"
#include "core/math/SphericalHarmonics.h"

#include <cmath>
#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <utility>

namespace patina {
namespace {

namespace fs = std::filesystem;

// Changes whenever encodeEntry() writes something else.
constexpr char kEntryMagic[8] = {'P', 'T', 'E', 'N', 'V', '0', '0', '1'};
constexpr std::size_t kMaxEntryBytes = std::size_t{1} << 20;
constexpr std::uint32_t kMostNotices = 64;

class EntryWriter {
  public:
    template <class T>
    requires std::is_arithmetic_v<T>
    void value(T value) { bytes(std::as_bytes(std::span<const T>(&value, 1))); }
    void block(std::span<const std::byte> data) {
        value(static_cast<std::uint32_t>(data.size()));
        bytes(data);
    }
    void text(const std::string& text) { block(std::as_bytes(std::span<const char>(text))); }
    void bytes(std::span<const std::byte> data) {
        m_bytes.insert(m_bytes.end(), data.begin(), data.end());
    }
    [[nodiscard]] Bytes take() { return std::move(m_bytes); }

  private:
    Bytes m_bytes;
};

// Reads what the writer wrote; once something is missing, nothing is good any more.
class EntryReader {
  public:
    explicit EntryReader(std::span<const std::byte> data)
        : m_left(data) {}

    std::span<const std::byte> bytes(std::size_t count) {
        if (count > m_left.size()) {
            m_good = false;
            return {};
        }
        const auto taken = m_left.first(count);
        m_left = m_left.subspan(count);
        return taken;
    }
    template <class T>
    requires std::is_arithmetic_v<T>
    void value(T& value) {
        if (const auto taken = bytes(sizeof(T)); m_good)
            std::memcpy(&value, taken.data(), sizeof(T));
    }
    std::span<const std::byte> block() {
        std::uint32_t size = 0;
        value(size);
        return bytes(size);
    }
    void text(std::string& text) {
        const auto taken = block();
        text.assign(reinterpret_cast<const char*>(taken.data()), taken.size());
    }
    void fail() { m_good = false; }
    [[nodiscard]] bool isGood() const { return m_good; }
    [[nodiscard]] bool isAtEnd() const { return m_good && m_left.empty(); }

  private:
    std::span<const std::byte> m_left;
    bool m_good = true;
};

// Each number of an entry, in the order of the file, for both ways.
template <class Numbers, class Visit>
void eachNumber(Numbers& m, const Visit& visit) {
    visit(m.meanLuminance);
    visit(m.meanColor.x);
    visit(m.meanColor.y);
    visit(m.meanColor.z);
    visit(m.rangeStops);
    visit(m.keyToFill);
    visit(m.keyAzimuthDeg);
    visit(m.keyElevationDeg);
    visit(m.dominantAzimuthDeg);
    visit(m.dominantElevationDeg);
    visit(m.directionality);
    visit(m.medianLuminance);
    visit(m.clippedShare);
}

Bytes encodeEntry(const CatalogEntry& entry) {
    EntryWriter out;
    out.bytes(std::as_bytes(std::span(kEntryMagic)));
    out.text(entry.source);
    out.text(entry.title);
    out.value(entry.fileBytes);
    out.value(static_cast<std::int32_t>(entry.width));
    out.value(static_cast<std::int32_t>(entry.height));
    out.text(entry.layout);
    const EnvironmentMeasures& m = entry.measures;
    eachNumber(m, [&](double number) { out.value(number); });
    out.value(static_cast<std::uint8_t>(m.temperature ? 1 : 0));
    const ColorTemperature temperature = m.temperature.value_or(ColorTemperature());
    out.value(temperature.kelvin);
    out.value(temperature.distance);
    out.value(static_cast<std::uint8_t>(m.source ? 1 : 0));
    const BrightestSource source = m.source.value_or(BrightestSource());
    for (const double number :
         {source.share, source.azimuthDeg, source.elevationDeg, source.diameterDeg})
        out.value(number);
    out.value(static_cast<std::uint8_t>(source.isClear ? 1 : 0));
    out.value(static_cast<std::uint32_t>(entry.notices.size()));
    for (const std::string& notice : entry.notices)
        out.text(notice);
    for (const glm::vec3& coefficient : entry.harmonics)
        for (int c = 0; c < 3; ++c)
            out.value(coefficient[c]);
    out.value(entry.texels.high);
    out.value(entry.texels.low);
    out.block(encodeQoi(entry.thumbnail));
    return out.take();
}

void decodeMeasures(EntryReader& in, EnvironmentMeasures& m) {
    eachNumber(m, [&](double& number) { in.value(number); });
    std::uint8_t flag = 0;
    in.value(flag);
    ColorTemperature temperature;
    in.value(temperature.kelvin);
    in.value(temperature.distance);
    if (flag != 0)
        m.temperature = temperature;
    in.value(flag);
    BrightestSource source;
    for (double* number :
         {&source.share, &source.azimuthDeg, &source.elevationDeg, &source.diameterDeg})
        in.value(*number);
    std::uint8_t clear = 0;
    in.value(clear);
    source.isClear = clear != 0;
    if (flag != 0)
        m.source = source;
}

// Nothing when the bytes are not what encodeEntry() writes.
std::optional<CatalogEntry> decodeEntry(std::span<const std::byte> bytes) {
    EntryReader in(bytes);
    const auto magic = in.bytes(sizeof(kEntryMagic));
    if (!in.isGood() || std::memcmp(magic.data(), kEntryMagic, sizeof(kEntryMagic)) != 0)
        return std::nullopt;
    CatalogEntry entry;
    in.text(entry.source);
    in.text(entry.title);
    in.value(entry.fileBytes);
    std::int32_t width = 0, height = 0;
    in.value(width);
    in.value(height);
    entry.width = width;
    entry.height = height;
    in.text(entry.layout);
    decodeMeasures(in, entry.measures);
    std::uint32_t notices = 0;
    in.value(notices);
    if (notices > kMostNotices)
        in.fail();
    for (std::uint32_t i = 0; i < notices && in.isGood(); ++i)
        in.text(entry.notices.emplace_back());
    entry.harmonics.resize(static_cast<std::size_t>(shCount(kMaxShOrder)));
    for (glm::vec3& coefficient : entry.harmonics)
        for (int c = 0; c < 3; ++c)
            in.value(coefficient[c]);
    in.value(entry.texels.high);
    in.value(entry.texels.low);
    const std::optional<Image> thumbnail = decodeQoi(in.block(), kThumbnailWidth);
    if (!in.isAtEnd() || !thumbnail || thumbnail->width() != kThumbnailWidth ||
        thumbnail->height() != kThumbnailHeight)
        return std::nullopt;
    entry.thumbnail = *thumbnail;
    return entry;
}

} // namespace

CatalogCache::CatalogCache(fs::path folder, std::uint64_t maxBytes)
    : m_files(std::move(folder), ".environment", "library entry", maxBytes, kMaxEntryBytes) {}

std::optional<CatalogEntry> CatalogCache::find(const Hash& key) const {
    const std::optional<Bytes> content = m_files.find(key);
    if (!content)
        return std::nullopt;
    std::optional<CatalogEntry> entry = decodeEntry(*content);
    if (!entry)
        m_files.drop(key);
    return entry;
}

Result<void> CatalogCache::store(const Hash& key, const CatalogEntry& entry) const {
    return m_files.store(key, encodeEntry(entry));
}

} // namespace patina
