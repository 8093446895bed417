// Portable float maps (.pfm), in which light probes were first handed on: Debevec, "Light Probe
// Image Gallery"; netpbm, pfm(5). "PF" has three channels, "Pf" one; then width, height, and a
// number that is negative where the samples are little endian; rows from the bottom. The size of
// that number is a unit that nobody agreed on: it is left alone, as by other readers.
#include "core/codec/image/ImageCodec.h"
#include "core/image/AreaFilter.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace patina::codec {
namespace {

using nlohmann::json;

constexpr std::size_t kLongestHeader = 128;

[[noreturn]] void damagedPfm(const char* what) {
    throw Refusal("the image is damaged or cut short", what);
}

struct PfmHeader {
    int width = 0, height = 0, channels = 0;
    bool littleEndian = false;
    std::size_t pixels = 0; // where they begin
};

bool isPfmSpace(char c) {
    return c == ' ' || c == '\n' || c == '\r' || c == '\t';
}

PfmHeader readPfmHeader(std::span<const std::byte> file) {
    const std::string_view text(reinterpret_cast<const char*>(file.data()),
                                std::min(file.size(), kLongestHeader));
    std::size_t at = 2;
    const auto word = [&] {
        while (at < text.size() && isPfmSpace(text[at]))
            ++at;
        const std::size_t from = at;
        while (at < text.size() && !isPfmSpace(text[at]))
            ++at;
        if (at >= text.size())
            damagedPfm("pfm: its header has no end");
        return text.substr(from, at - from);
    };
    const auto number = [](std::string_view digits, auto& value) {
        const auto [end, error] = std::from_chars(digits.begin(), digits.end(), value);
        if (error != std::errc() || end != digits.end())
            damagedPfm("pfm: its header has no numbers");
    };
    PfmHeader header;
    header.channels = text.starts_with("PF") ? 3 : 1;
    number(word(), header.width);
    number(word(), header.height);
    float scale = 0.0f;
    number(word(), scale);
    if (!(scale < 0.0f) && !(scale > 0.0f))
        damagedPfm("pfm: its byte order is not said");
    header.littleEndian = scale < 0.0f;
    header.pixels = at + 1; // one white space ends the header
    return header;
}

void readRow(std::span<const std::byte> from, bool littleEndian, std::span<float> to) {
    for (std::size_t i = 0; i < to.size(); ++i) {
        std::uint32_t bits = 0;
        for (std::size_t b = 0; b < 4; ++b)
            bits |= std::to_integer<std::uint32_t>(from[4 * i + b])
                    << (8 * (littleEndian ? b : 3 - b));
        to[i] = std::bit_cast<float>(bits);
    }
}

} // namespace

Reply decodePfm(const json& request, int payloadFd) {
    const MemoryFile file = mapFile(payloadFd);
    const PfmHeader header = readPfmHeader(file.bytes());
    if (header.width <= 0 || header.height <= 0)
        damagedPfm("pfm: it has no pixels");
    checkImageSize(header.width, header.height, header.channels, sizeof(float));
    const std::size_t samples =
        static_cast<std::size_t>(header.width) * static_cast<std::size_t>(header.channels);
    const auto rows = static_cast<std::size_t>(header.height);
    if ((file.bytes().size() - header.pixels) / sizeof(float) < samples * rows)
        damagedPfm("pfm: pixels are missing");

    const bool inspect = request.value("inspect", false);
    const ImageSize size = reducedSize({header.width, header.height}, request.value("maxSide", 0));
    const json names = header.channels == 3 ? json{"R", "G", "B"} : json{"Y"};
    const json part = {{"name", ""},
                       {"width", inspect ? header.width : size.width},
                       {"height", inspect ? header.height : size.height},
                       {"channels", header.channels},
                       {"channelNames", names},
                       {"stored", "float"},
                       {"attributes", json::object()},
                       {"type", "f32"},
                       {"offset", 0}};
    Reply reply;
    reply.header = toJsonText({{"format", "pfm"}, {"parts", json::array({part})}});
    if (inspect) {
        reply.payload = allocate(0);
        return reply;
    }
    const bool whole = size == ImageSize{header.width, header.height};
    std::vector<float> pixels(whole ? samples * rows : 0);
    std::optional<RowReducer> reducer;
    if (!whole)
        reducer.emplace(header.width, header.height, size.width, size.height, header.channels);
    std::vector<float> row(samples);
    for (std::size_t y = 0; y < rows; ++y) {
        const auto from = file.bytes().subspan(
            header.pixels + (rows - 1 - y) * samples * sizeof(float), samples * sizeof(float));
        if (whole) {
            readRow(from, header.littleEndian, std::span(pixels).subspan(y * samples, samples));
        } else {
            readRow(from, header.littleEndian, row);
            reducer->addRow(row);
        }
    }
    const std::span<const float> result =
        whole ? std::span<const float>(pixels) : reducer->result();
    reply.payload = allocate(result.size_bytes());
    std::memcpy(reply.payload.writable().data(), result.data(), result.size_bytes());
    return reply;
}

} // namespace patina::codec
