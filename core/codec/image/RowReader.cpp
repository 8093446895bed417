#include "core/codec/image/RowReader.h"

#include <cstring>

namespace patina::codec {

void RowReader::read(int, Channels channels, std::span<std::byte> pixels) {
    const auto width = static_cast<std::size_t>(m_spec.width);
    const std::size_t sample = sizeOf(m_spec.kind);
    const std::size_t whole = sample * static_cast<std::size_t>(m_spec.channels());
    const std::size_t wanted = sample * static_cast<std::size_t>(channels.count);
    const std::size_t offset = sample * static_cast<std::size_t>(channels.first);
    std::vector<std::byte> row(whole == wanted ? 0 : whole * width);
    for (std::size_t y = 0; y < static_cast<std::size_t>(m_spec.height); ++y) {
        std::byte* target = pixels.data() + y * width * wanted;
        if (whole == wanted) {
            nextRow(target);
            continue;
        }
        nextRow(row.data());
        for (std::size_t x = 0; x < width; ++x)
            std::memcpy(target + x * wanted, row.data() + x * whole + offset, wanted);
    }
}

} // namespace patina::codec
