#include "core/codec/model/GltfContainer.h"

#include "core/codec/Codec.h"

#include <cstdint>
#include <cstring>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace patina::codec {

namespace {

constexpr std::uint32_t kGlbMagic = 0x46546C67;  // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A; // "JSON"
constexpr std::uint32_t kBinChunk = 0x004E4942;  // "BIN"

std::uint32_t word(std::span<const std::byte> bytes, std::size_t offset) {
    std::uint32_t value = 0;
    if (offset + sizeof value <= bytes.size())
        std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

} // namespace

GltfContainer openGltfContainer(const MemoryFile& file) {
    const auto bytes = file.bytes();
    if (word(bytes, 0) != kGlbMagic)
        return {file.text(), {}};
    if (word(bytes, 4) != 2)
        throw Refusal("only version 2 of glTF is supported; export it again as glTF 2.0",
                      fmt::format("GLB version {}", word(bytes, 4)));
    GltfContainer result;
    constexpr std::size_t kHeader = 12;
    constexpr std::size_t kChunkHeader = 8;
    for (std::size_t offset = kHeader; offset + kChunkHeader <= bytes.size();) {
        const std::size_t length = word(bytes, offset);
        const std::uint32_t type = word(bytes, offset + 4);
        offset += kChunkHeader;
        if (length > bytes.size() - offset)
            throw Refusal("the file is cut short; export or download it again", "GLB chunk");
        if (type == kJsonChunk && result.text.empty())
            result.text = file.text().substr(offset, length);
        else if (type == kBinChunk && result.binary.empty())
            result.binary = bytes.subspan(offset, length);
        offset += (length + 3) / 4 * 4;
    }
    return result;
}

nlohmann::json parseGltf(std::string_view text) {
    nlohmann::json root = nlohmann::json::parse(text, nullptr, false);
    if (!root.is_object())
        throw Refusal("the file is damaged or cut short; export or download it again",
                      "no valid JSON");
    return root;
}

} // namespace patina::codec
