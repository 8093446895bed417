// An image: a value of width × height pixels with any number of interleaved channels, row 0 at the
// top. What the numbers mean is part of the value: see ColorEncoding.
#pragma once

#include "core/base/Hash.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec4.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace patina {

enum class PixelType { U8, U16, F32 }; // half floats are widened to F32 when read

// Policy: base colour and emissive maps stored in 8 or 16 bits are Srgb (Rec.709 primaries, sRGB
// curve on RGB, alpha linear); all other maps are Data; floating-point files are Linear. The user
// of a map decides (core/edit/Parameters.h), never the file's name or embedded profile.
enum class ColorEncoding { Linear, Srgb, Data };

class Image {
  public:
    Image() = default; // empty: 0 × 0
    // Zero-filled. Sizes must be positive and within core/base/Limits.h.
    Image(int width, int height, int channels, PixelType type, ColorEncoding encoding);

    [[nodiscard]] int width() const { return m_width; }
    [[nodiscard]] int height() const { return m_height; }
    [[nodiscard]] int channels() const { return m_channels; }
    [[nodiscard]] PixelType type() const { return m_type; }
    [[nodiscard]] ColorEncoding encoding() const { return m_encoding; }
    void setEncoding(ColorEncoding encoding) { m_encoding = encoding; }
    [[nodiscard]] bool empty() const { return m_data.empty(); }

    // Names of the channels as in the file ("R", "sh.l1m0.G"); empty means R, RG, RGB, RGBA.
    [[nodiscard]] const std::vector<std::string>& channelNames() const { return m_channelNames; }
    void setChannelNames(std::vector<std::string> names);

    [[nodiscard]] std::size_t bytesPerPixel() const;
    [[nodiscard]] std::span<std::byte> bytes() { return m_data; }
    [[nodiscard]] std::span<const std::byte> bytes() const { return m_data; }

    // Interleaved samples of the stored type; CHECKs that the type fits.
    [[nodiscard]] std::span<std::uint8_t> u8();
    [[nodiscard]] std::span<const std::uint8_t> u8() const;
    [[nodiscard]] std::span<std::uint16_t> u16();
    [[nodiscard]] std::span<const std::uint16_t> u16() const;
    [[nodiscard]] std::span<float> f32();
    [[nodiscard]] std::span<const float> f32() const;

    // One stored sample: integers scaled to 0…1, the encoding not undone. No bounds are clamped.
    [[nodiscard]] float sample(int x, int y, int channel) const;
    // One pixel as linear RGBA: one channel is grey, two are grey + alpha, missing alpha is 1;
    // Srgb is decoded.
    [[nodiscard]] glm::vec4 linear(int x, int y) const;

    friend bool operator==(const Image&, const Image&) = default;

  private:
    int m_width = 0, m_height = 0, m_channels = 0;
    PixelType m_type = PixelType::U8;
    ColorEncoding m_encoding = ColorEncoding::Data;
    std::vector<std::string> m_channelNames;
    std::vector<std::byte> m_data;
};

using ImagePtr = std::shared_ptr<const Image>;

[[nodiscard]] Hash hashImage(const Image& image);

// The same picture with other storage. Integers are rounded to nearest and clamped to 0…1; the
// encoding's curve is applied when it changes between Srgb and Linear.
[[nodiscard]] Image convertImage(const Image& image, PixelType type, ColorEncoding encoding);

// Bilinear lookup of a linear RGBA value at (u, v), texel centres at (i + 0.5) / n; v = 0 is the
// top row; coordinates repeat.
[[nodiscard]] glm::vec4 sampleBilinear(const Image& image, float u, float v);

// Area-averaged reduction so that neither side exceeds `maxSide`, averaged in linear light.
[[nodiscard]] Image shrinkImage(const Image& image, int maxSide);

// Non-finite and negative samples of a float image: NaN and negative become 0, +Inf the largest
// finite half (65504). Returns how many samples changed.
std::size_t sanitizeHdr(Image& image);

} // namespace patina
