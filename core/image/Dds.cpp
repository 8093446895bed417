#include "core/image/Dds.h"

#include "core/base/Check.h"
#include "core/image/LittleEndian.h"

namespace patina {
namespace {

constexpr std::uint32_t fourCc(const char (&name)[5]) {
    return static_cast<std::uint32_t>(name[0]) | static_cast<std::uint32_t>(name[1]) << 8 |
           static_cast<std::uint32_t>(name[2]) << 16 | static_cast<std::uint32_t>(name[3]) << 24;
}

// DDS_HEADER.dwFlags: what the header states. dwCaps, dwCaps2: what the file is.
constexpr std::uint32_t kFlagCaps = 0x1, kFlagHeight = 0x2, kFlagWidth = 0x4, kFlagPitch = 0x8,
                        kFlagPixelFormat = 0x1000, kFlagMipMapCount = 0x20000;
constexpr std::uint32_t kPixelFormatFourCc = 0x4;
constexpr std::uint32_t kCapsComplex = 0x8, kCapsTexture = 0x1000, kCapsMipMap = 0x400000;
constexpr std::uint32_t kCaps2CubeMapAllFaces = 0x200 | 0xfc00;
// DDS_HEADER_DXT10
constexpr std::uint32_t kDimensionTexture2D = 3, kMiscTextureCube = 0x4, kAlphaOpaque = 3;

std::uint32_t dxgiFormatOf(TexelFormat format) {
    switch (format) {
    case TexelFormat::Rgba16F:
        return 10; // DXGI_FORMAT_R16G16B16A16_FLOAT
    case TexelFormat::Rgba32F:
        return 2; // DXGI_FORMAT_R32G32B32A32_FLOAT
    case TexelFormat::Rgb9E5:
        return 67; // DXGI_FORMAT_R9G9B9E5_SHAREDEXP
    }
    return 0;
}

} // namespace

EncodedTexture encodeDds(const FloatTexture& texture, TexelFormat format) {
    CHECK(!texture.levels.empty());
    const PackedTexels packed = packTexels(texture, format);
    const bool cube = texture.faces == 6;
    const bool mips = packed.levels.size() > 1;

    EncodedTexture result;
    result.clamped = packed.clamped;
    Bytes& out = result.file;
    const auto u32 = [&](std::size_t value) {
        appendLittleEndian(out, static_cast<std::uint32_t>(value));
    };
    u32(fourCc("DDS "));
    u32(124); // size of the header
    u32(kFlagCaps | kFlagHeight | kFlagWidth | kFlagPitch | kFlagPixelFormat |
        (mips ? kFlagMipMapCount : 0));
    u32(static_cast<std::size_t>(texture.height));
    u32(static_cast<std::size_t>(texture.width));
    u32(static_cast<std::size_t>(texture.width) * texelBytes(format)); // pitch: bytes per row
    u32(0);                                                            // depth
    u32(packed.levels.size());
    for (int i = 0; i < 11; ++i)
        u32(0); // reserved
    u32(32);    // size of the pixel format
    u32(kPixelFormatFourCc);
    u32(fourCc("DX10"));
    for (int i = 0; i < 5; ++i)
        u32(0); // bit counts and masks, which the extension replaces
    u32(kCapsTexture | (cube || mips ? kCapsComplex : 0) | (mips ? kCapsMipMap : 0));
    u32(cube ? kCaps2CubeMapAllFaces : 0);
    for (int i = 0; i < 3; ++i)
        u32(0); // caps3, caps4, reserved

    u32(dxgiFormatOf(format));
    u32(kDimensionTexture2D);
    u32(cube ? kMiscTextureCube : 0);
    u32(1); // one texture, not an array
    u32(kAlphaOpaque);

    for (int face = 0; face < texture.faces; ++face)
        for (const Bytes& level : packed.levels) {
            const std::size_t faceBytes = level.size() / static_cast<std::size_t>(texture.faces);
            const auto begin = level.begin() + static_cast<std::ptrdiff_t>(face * faceBytes);
            out.insert(out.end(), begin, begin + static_cast<std::ptrdiff_t>(faceBytes));
        }
    return result;
}

} // namespace patina
