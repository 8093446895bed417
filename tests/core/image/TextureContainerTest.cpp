// KTX2 and DDS, byte by byte.
#include "core/image/Dds.h"
#include "core/image/Ktx2.h"
#include "tests/support/TextureFiles.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <gmock/gmock.h>

using namespace patina;
using namespace patina::test;
using testing::ElementsAre;

namespace {

// Every texel different: face, level, row and column can be read off it, exactly as a half.
glm::vec3 mark(int face, int level, int x, int y) {
    return {static_cast<float>(1 + face), static_cast<float>(level) + 0.5f,
            static_cast<float>(32 * y + x)};
}

FloatTexture marked(int faces, int width, int height, int levels) {
    FloatTexture texture;
    texture.faces = faces;
    texture.width = width;
    texture.height = height;
    for (int level = 0; level < levels; ++level) {
        std::vector<glm::vec3>& texels = texture.levels.emplace_back();
        for (int face = 0; face < faces; ++face)
            for (int y = 0; y < texture.levelHeight(level); ++y)
                for (int x = 0; x < texture.levelWidth(level); ++x)
                    texels.push_back(mark(face, level, x, y));
    }
    return texture;
}

} // namespace

TEST(HalfFloat, EveryHalfComesBackAsItself) {
    for (std::uint32_t bits = 0; bits < 0x10000; ++bits) {
        const double value = fromHalf(bits);
        if (!std::isfinite(value))
            continue;
        ASSERT_EQ(halfFromFloat(static_cast<float>(value)), bits) << value;
    }
}

// Between neighbours a and b: below the middle a, above it b, at the middle the even one.
TEST(HalfFloat, RoundsToNearestEven) {
    for (const std::uint32_t a :
         {0u, 1u, 2u, 0x3feu, 0x3ffu, 0x400u, 0x401u, 0x7ffu, 0x3bffu, 0x3c00u, 0x3c01u, 0x7bfeu}) {
        const auto middle = static_cast<float>(0.5 * (fromHalf(a) + fromHalf(a + 1)));
        EXPECT_EQ(halfFromFloat(middle), a + a % 2) << a;
        EXPECT_EQ(halfFromFloat(std::nextafter(middle, 0.0f)), a) << a;
        EXPECT_EQ(halfFromFloat(std::nextafter(middle, 1e9f)), a + 1) << a;
        EXPECT_EQ(halfFromFloat(-middle), 0x8000 + a + a % 2) << a;
    }
}

TEST(HalfFloat, ClampsWhatItCannotHold) {
    EXPECT_EQ(halfFromFloat(65504.0f), 0x7bff);
    EXPECT_EQ(halfFromFloat(65519.0f), 0x7bff);
    EXPECT_EQ(halfFromFloat(65520.0f), 0x7bff); // would round to infinity
    EXPECT_EQ(halfFromFloat(INFINITY), 0x7bff);
    EXPECT_EQ(halfFromFloat(-1e30f), 0xfbff);
    EXPECT_EQ(halfFromFloat(NAN), 0);
    EXPECT_EQ(halfFromFloat(1e-9f), 0);
}

TEST(SharedExponent, KnownValues) {
    // 1.0 = 256 · 2^(16 - 24)
    EXPECT_EQ(rgb9e5FromFloat({1, 1, 1}), 16u << 27 | 256u << 18 | 256u << 9 | 256u);
    EXPECT_EQ(rgb9e5FromFloat({0, 0, 0}), 0u);
    EXPECT_EQ(rgb9e5FromFloat({1, 0, 0}), 16u << 27 | 256u);
    EXPECT_EQ(rgb9e5FromFloat({0, 1, 0}), 16u << 27 | 256u << 9);
    EXPECT_EQ(rgb9e5FromFloat({-1, NAN, 2}), 17u << 27 | 256u << 18);
    EXPECT_EQ(rgb9e5FromFloat({65408, 0, 0}), 31u << 27 | 511u);
    EXPECT_EQ(rgb9e5FromFloat({INFINITY, 1e30f, 0}), 31u << 27 | 511u << 9 | 511u);
    // 511.5/512 rounds up to the next power of two
    EXPECT_EQ(rgb9e5FromFloat({0.9995f, 0, 0}), 16u << 27 | 256u);
    EXPECT_EQ(rgb9e5FromFloat({std::ldexp(1.0f, -24), 0, 0}), 1u); // the smallest
}

TEST(SharedExponent, IsWithinHalfAStepOfTheBrightestComponent) {
    std::uint32_t state = 1;
    const auto random = [&] { // 2^-8 … 2^8
        state = state * 1664525 + 1013904223;
        return std::exp2(static_cast<float>(state >> 8) / 1048576.0f - 8.0f);
    };
    for (int i = 0; i < 20000; ++i) {
        const glm::vec3 color(random(), random(), random());
        const glm::dvec3 back = fromRgb9E5(rgb9e5FromFloat(color));
        const double step = std::max({color.x, color.y, color.z}) / 256.0;
        for (int c = 0; c < 3; ++c)
            ASSERT_LE(std::abs(back[c] - color[c]), 0.5 * step) << i;
    }
}

TEST(PackTexels, CountsTexelsThatAreTooBright) {
    FloatTexture texture;
    texture.width = 2;
    texture.height = 2;
    texture.levels = {{{70000, 70000, 1}, {65504, 0, 0}, {65450, 0, 0}, {0, 0, 1e9f}}};
    EXPECT_EQ(packTexels(texture, TexelFormat::Rgba16F).clamped, 2u);
    EXPECT_EQ(packTexels(texture, TexelFormat::Rgb9E5).clamped, 4u);
    const PackedTexels floats = packTexels(texture, TexelFormat::Rgba32F);
    EXPECT_EQ(floats.clamped, 0u);
    EXPECT_EQ(texelAt(floats.levels[0], 48, 16), glm::dvec3(0, 0, 1e9f));
    const PackedTexels halfs = packTexels(texture, TexelFormat::Rgba16F);
    EXPECT_EQ(texelAt(halfs.levels[0], 0, 8), glm::dvec3(65504, 65504, 1));
}

struct Container : testing::TestWithParam<TexelFormat> {
    [[nodiscard]] std::size_t bytes() const { return GetParam() == TexelFormat::Rgba16F ? 8 : 16; }
};

INSTANTIATE_TEST_SUITE_P(Formats, Container,
                         testing::Values(TexelFormat::Rgba16F, TexelFormat::Rgba32F));

TEST_P(Container, Ktx2HoldsEveryTexelWhereTheIndexSays) {
    const Bytes file = encodeKtx2(marked(6, 8, 8, 4), GetParam()).file;
    const std::string magic("\xabKTX 20\xbb\r\n\x1a\n", 12);
    EXPECT_EQ(std::memcmp(file.data(), magic.data(), 12), 0);
    EXPECT_EQ(u32(file, 12), GetParam() == TexelFormat::Rgba16F ? 97u : 109u); // vkFormat
    EXPECT_EQ(u32(file, 16), GetParam() == TexelFormat::Rgba16F ? 2u : 4u);    // typeSize
    EXPECT_EQ(u32(file, 20), 8u);                                              // width
    EXPECT_EQ(u32(file, 24), 8u);                                              // height
    EXPECT_EQ(u32(file, 28), 0u);                                              // depth
    EXPECT_EQ(u32(file, 32), 0u);                                              // layers
    EXPECT_EQ(u32(file, 36), 6u);                                              // faces
    EXPECT_EQ(u32(file, 40), 4u);                                              // levels
    EXPECT_EQ(u32(file, 44), 0u);                                              // supercompression
    EXPECT_EQ(u64(file, 64), 0u);                                              // and its data
    EXPECT_EQ(u64(file, 72), 0u);

    std::size_t next = file.size();
    for (int level = 0; level < 4; ++level) {
        const std::size_t entry = 80 + 24 * static_cast<std::size_t>(level);
        const std::uint64_t offset = u64(file, entry), length = u64(file, entry + 8);
        const int size = 8 >> level;
        EXPECT_EQ(length, 6u * static_cast<unsigned>(size * size) * bytes());
        EXPECT_EQ(u64(file, entry + 16), length);
        EXPECT_EQ(offset % bytes(), 0u); // lcm(texel, 4)
        EXPECT_LE(offset + length, next) << "levels run from small to large";
        EXPECT_LT(next - (offset + length), bytes()) << "no gap but padding";
        next = offset;
        std::size_t at = offset;
        for (int face = 0; face < 6; ++face)
            for (int y = 0; y < size; ++y)
                for (int x = 0; x < size; ++x, at += bytes()) {
                    ASSERT_EQ(texelAt(file, at, bytes()), glm::dvec3(mark(face, level, x, y)));
                    const double alpha = GetParam() == TexelFormat::Rgba16F
                                             ? fromHalf(u32(file, at + 4) >> 16)
                                             : std::bit_cast<float>(u32(file, at + 12));
                    ASSERT_EQ(alpha, 1.0);
                }
    }
    EXPECT_EQ(u32(file, 48), 80u + 4 * 24); // descriptor right behind the level index
    EXPECT_EQ(u32(file, 56), u32(file, 48) + u32(file, 52)); // key/values right behind that
    EXPECT_LE(u32(file, 56) + u32(file, 60), next);
}

TEST_P(Container, Ktx2DescribesItsTexels) {
    const Bytes file = encodeKtx2(marked(6, 4, 4, 1), GetParam()).file;
    const std::size_t dfd = u32(file, 48);
    const std::uint32_t bits = GetParam() == TexelFormat::Rgba16F ? 16 : 32;
    EXPECT_EQ(u32(file, dfd), 4u + 24 + 4 * 16); // total
    EXPECT_EQ(u32(file, 52), u32(file, dfd));
    EXPECT_EQ(u32(file, dfd + 4), 0u);                     // Khronos, basic
    EXPECT_EQ(u32(file, dfd + 8), 2u | (24 + 64) << 16);   // version 1.3, block size
    EXPECT_EQ(u32(file, dfd + 12), 1u | 1 << 8 | 1 << 16); // RGBSDA, BT.709, linear, straight
    EXPECT_EQ(u32(file, dfd + 16), 0u);
    EXPECT_EQ(u32(file, dfd + 20), bytes());
    for (std::uint32_t c = 0; c < 4; ++c) {
        const std::size_t sample = dfd + 28 + 16 * c;
        const std::uint32_t channel = (c == 3 ? 15 : c) | 0xc0; // float and signed
        EXPECT_EQ(u32(file, sample), bits * c | (bits - 1) << 16 | channel << 24);
        EXPECT_EQ(u32(file, sample + 4), 0u);
        EXPECT_EQ(u32(file, sample + 8), 0xbf800000u);  // -1
        EXPECT_EQ(u32(file, sample + 12), 0x3f800000u); // +1
    }
}

TEST_P(Container, DdsHoldsFaceAfterFace) {
    const Bytes file = encodeDds(marked(6, 8, 8, 4), GetParam()).file;
    EXPECT_EQ(std::memcmp(file.data(), "DDS ", 4), 0);
    EXPECT_EQ(u32(file, 4), 124u);
    EXPECT_EQ(u32(file, 8), 0x1u | 0x2 | 0x4 | 0x8 | 0x1000 | 0x20000);
    EXPECT_EQ(u32(file, 12), 8u);
    EXPECT_EQ(u32(file, 16), 8u);
    EXPECT_EQ(u32(file, 20), 8 * bytes()); // pitch
    EXPECT_EQ(u32(file, 28), 4u);          // levels
    EXPECT_EQ(u32(file, 76), 32u);
    EXPECT_EQ(u32(file, 80), 4u);
    EXPECT_EQ(std::memcmp(file.data() + 84, "DX10", 4), 0);
    EXPECT_EQ(u32(file, 108), 0x401008u); // complex, texture, mipmaps
    EXPECT_EQ(u32(file, 112), 0xfe00u);   // cubemap, all faces
    EXPECT_EQ(u32(file, 128), GetParam() == TexelFormat::Rgba16F ? 10u : 2u); // DXGI_FORMAT
    EXPECT_EQ(u32(file, 132), 3u);                                            // 2D
    EXPECT_EQ(u32(file, 136), 4u);                                            // cube
    EXPECT_EQ(u32(file, 140), 1u);                                            // one of them
    std::size_t at = 148;
    for (int face = 0; face < 6; ++face)
        for (int level = 0; level < 4; ++level)
            for (int y = 0; y < 8 >> level; ++y)
                for (int x = 0; x < 8 >> level; ++x, at += bytes())
                    ASSERT_EQ(texelAt(file, at, bytes()), glm::dvec3(mark(face, level, x, y)));
    EXPECT_EQ(at, file.size());
}

TEST(Ktx2, SharedExponentsAreDescribed) {
    const Bytes file = encodeKtx2(marked(6, 2, 2, 2), TexelFormat::Rgb9E5).file;
    EXPECT_EQ(u32(file, 12), 123u);
    EXPECT_EQ(u32(file, 16), 4u);
    const std::size_t dfd = u32(file, 48);
    EXPECT_EQ(u32(file, dfd + 8) >> 16, 24u + 6 * 16);
    EXPECT_EQ(u32(file, dfd + 20), 4u);
    for (std::uint32_t c = 0; c < 3; ++c) {
        const std::size_t mantissa = dfd + 28 + 32 * c, exponent = mantissa + 16;
        EXPECT_EQ(u32(file, mantissa), 9 * c | 8 << 16 | c << 24);
        EXPECT_EQ(u32(file, mantissa + 12), 8448u); // Khronos Data Format 1.3, table of E5B9G9R9
        EXPECT_EQ(u32(file, exponent), 27u | 4 << 16 | (c | 0x20) << 24);
        EXPECT_EQ(u32(file, exponent + 8), 15u);
        EXPECT_EQ(u32(file, exponent + 12), 31u);
    }
    const std::uint64_t offset = u64(file, 80);
    EXPECT_EQ(fromRgb9E5(u32(file, offset + 4 * 3)), glm::dvec3(mark(0, 0, 1, 1)));
}

TEST(Ktx2, KeysAreSortedAndPadded) {
    const Bytes file = encodeKtx2(marked(1, 4, 2, 1), TexelFormat::Rgba16F, {{"Zed", "z"}}).file;
    EXPECT_EQ(u32(file, 36), 1u); // faces
    std::size_t at = u32(file, 56);
    const std::size_t end = at + u32(file, 60);
    std::vector<std::string> keys, values;
    while (at < end) {
        const std::size_t length = u32(file, at);
        const std::string entry(reinterpret_cast<const char*>(file.data()) + at + 4, length);
        keys.push_back(entry.substr(0, entry.find('\0')));
        values.push_back(entry.substr(entry.find('\0') + 1));
        at = (at + 4 + length + 3) / 4 * 4;
    }
    EXPECT_EQ(at, end);
    EXPECT_THAT(keys, ElementsAre("KTXorientation", "KTXwriter", "Zed"));
    EXPECT_EQ(values[0], std::string("rd\0", 3));
    EXPECT_TRUE(values[1].starts_with("Patina "));
}

TEST(Dds, APlainTextureIsNoCubemap) {
    const Bytes file = encodeDds(marked(1, 4, 2, 1), TexelFormat::Rgb9E5).file;
    EXPECT_EQ(u32(file, 8), 0x1u | 0x2 | 0x4 | 0x8 | 0x1000);
    EXPECT_EQ(u32(file, 12), 2u); // height first
    EXPECT_EQ(u32(file, 16), 4u);
    EXPECT_EQ(u32(file, 108), 0x1000u);
    EXPECT_EQ(u32(file, 112), 0u);
    EXPECT_EQ(u32(file, 128), 67u); // R9G9B9E5
    EXPECT_EQ(u32(file, 136), 0u);
    EXPECT_EQ(file.size(), 148u + 4 * 8);
}
