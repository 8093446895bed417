#include "core/image/Ktx2.h"

#include "core/base/Check.h"
#include "core/image/LittleEndian.h"

#include <array>
#include <bit>
#include <numeric>

namespace patina {
namespace {

constexpr std::array<std::uint8_t, 12> kIdentifier = {0xab, 'K',  'T',  'X',  ' ',  '2',
                                                      '0',  0xbb, '\r', '\n', 0x1a, '\n'};
constexpr std::size_t kHeaderBytes = 80, kLevelIndexBytes = 24;

struct Format {
    std::uint32_t vkFormat, typeSize;
};

Format formatOf(TexelFormat format) {
    switch (format) {
    case TexelFormat::Rgba16F:
        return {97, 2}; // VK_FORMAT_R16G16B16A16_SFLOAT
    case TexelFormat::Rgba32F:
        return {109, 4}; // VK_FORMAT_R32G32B32A32_SFLOAT
    case TexelFormat::Rgb9E5:
        return {123, 4}; // VK_FORMAT_E5B9G9R9_UFLOAT_PACK32
    }
    return {};
}

// One sample of the data format descriptor: which bits of a texel are which channel.
struct Sample {
    std::uint32_t bitOffset, bits, channel, lower, upper;
};

// Channel ids and qualifiers of the Khronos Data Format Specification 1.3, section 5.
constexpr std::uint32_t kAlpha = 15, kExponent = 0x20, kSigned = 0x40, kFloat = 0x80;

std::vector<Sample> samplesOf(TexelFormat format) {
    std::vector<Sample> samples;
    if (format == TexelFormat::Rgb9E5) {
        // Mantissa and shared exponent for each channel. The upper end says what 1.0 is: mantissa
        // 256 with exponent 16 above it; the exponent's lower end is its bias.
        for (std::uint32_t c = 0; c < 3; ++c) {
            samples.push_back({9 * c, 9, c, 0, 16u << 9 | 256u});
            samples.push_back({27, 5, c | kExponent, 15, 31});
        }
        return samples;
    }
    const std::uint32_t bits = format == TexelFormat::Rgba16F ? 16 : 32;
    for (std::uint32_t c = 0; c < 4; ++c)
        samples.push_back({bits * c, bits, (c < 3 ? c : kAlpha) | kSigned | kFloat,
                           std::bit_cast<std::uint32_t>(-1.0f),
                           std::bit_cast<std::uint32_t>(1.0f)});
    return samples;
}

// A basic data format descriptor block, version 1.3: RGB of Rec. 709, linear, alpha straight.
Bytes dataFormatDescriptor(TexelFormat format) {
    constexpr std::uint32_t kModelRgbsda = 1, kPrimariesBt709 = 1, kTransferLinear = 1;
    const std::vector<Sample> samples = samplesOf(format);
    const auto blockBytes = static_cast<std::uint32_t>(24 + 16 * samples.size());
    Bytes out;
    appendLittleEndian(out, blockBytes + 4); // with this number itself
    appendLittleEndian(out, 0u);             // vendor Khronos, descriptor type basic
    appendLittleEndian(out, 2u | blockBytes << 16);
    appendLittleEndian(out, kModelRgbsda | kPrimariesBt709 << 8 | kTransferLinear << 16);
    appendLittleEndian(out, 0u);                                             // a block is one texel
    appendLittleEndian(out, static_cast<std::uint64_t>(texelBytes(format))); // bytesPlane0
    for (const Sample& sample : samples) {
        appendLittleEndian(out, sample.bitOffset | (sample.bits - 1) << 16 | sample.channel << 24);
        appendLittleEndian(out, 0u); // position within the block
        appendLittleEndian(out, sample.lower);
        appendLittleEndian(out, sample.upper);
    }
    return out;
}

void padTo(Bytes& out, std::size_t alignment) {
    out.resize((out.size() + alignment - 1) / alignment * alignment, std::byte{0});
}

// Entries sorted by key, as the specification wants them and std::map has them.
Bytes keyValueData(const std::map<std::string, std::string>& values) {
    Bytes out;
    for (const auto& [key, value] : values) {
        const std::string entry = key + '\0' + value + '\0';
        appendLittleEndian(out, static_cast<std::uint32_t>(entry.size()));
        const auto bytes = std::as_bytes(std::span(entry));
        out.insert(out.end(), bytes.begin(), bytes.end());
        padTo(out, 4);
    }
    return out;
}

} // namespace

EncodedTexture encodeKtx2(const FloatTexture& texture, TexelFormat format,
                          const std::map<std::string, std::string>& values) {
    CHECK(!texture.levels.empty());
    const PackedTexels packed = packTexels(texture, format);
    const std::size_t levelCount = packed.levels.size();
    const Bytes descriptor = dataFormatDescriptor(format);
    std::map<std::string, std::string> allValues = values;
    allValues["KTXorientation"] = "rd";
    allValues["KTXwriter"] = "Patina " PATINA_VERSION;
    const Bytes keyValues = keyValueData(allValues);

    // Where everything goes. The smallest level comes first in the file, each aligned to whole
    // texels and words.
    const std::size_t descriptorOffset = kHeaderBytes + kLevelIndexBytes * levelCount;
    const std::size_t keyValueOffset = descriptorOffset + descriptor.size();
    const std::size_t alignment = std::lcm(texelBytes(format), std::size_t{4});
    std::vector<std::size_t> offsets(levelCount);
    std::size_t end = keyValueOffset + keyValues.size();
    for (std::size_t i = levelCount; i-- > 0;) {
        offsets[i] = (end + alignment - 1) / alignment * alignment;
        end = offsets[i] + packed.levels[i].size();
    }

    EncodedTexture result;
    result.clamped = packed.clamped;
    Bytes& out = result.file;
    out.reserve(end);
    for (const std::uint8_t byte : kIdentifier)
        out.push_back(static_cast<std::byte>(byte));
    const auto u32 = [&](std::size_t value) {
        appendLittleEndian(out, static_cast<std::uint32_t>(value));
    };
    const auto u64 = [&](std::size_t value) {
        appendLittleEndian(out, static_cast<std::uint64_t>(value));
    };
    u32(formatOf(format).vkFormat);
    u32(formatOf(format).typeSize);
    u32(static_cast<std::size_t>(texture.width));
    u32(static_cast<std::size_t>(texture.height));
    u32(0); // depth: not a volume
    u32(0); // layers: not an array
    u32(static_cast<std::size_t>(texture.faces));
    u32(levelCount);
    u32(0); // no supercompression
    u32(descriptorOffset);
    u32(descriptor.size());
    u32(keyValueOffset);
    u32(keyValues.size());
    u64(0); // no global data of a supercompression
    u64(0);
    for (std::size_t i = 0; i < levelCount; ++i) {
        u64(offsets[i]);
        u64(packed.levels[i].size());
        u64(packed.levels[i].size()); // uncompressed: the same
    }
    CHECK_EQ(out.size(), descriptorOffset);
    out.insert(out.end(), descriptor.begin(), descriptor.end());
    out.insert(out.end(), keyValues.begin(), keyValues.end());
    for (std::size_t i = levelCount; i-- > 0;) {
        padTo(out, alignment);
        CHECK_EQ(out.size(), offsets[i]);
        out.insert(out.end(), packed.levels[i].begin(), packed.levels[i].end());
    }
    return result;
}

} // namespace patina
