#include "core/image/Image.h"

#include "core/base/Check.h"
#include "core/base/Limits.h"
#include "core/image/Srgb.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace patina {

namespace {

std::size_t sampleSize(PixelType type) {
    switch (type) {
    case PixelType::U8:
        return 1;
    case PixelType::U16:
        return 2;
    case PixelType::F32:
        break;
    }
    return 4;
}

template <class T, class Byte>
std::span<T> samplesOf(std::span<Byte> bytes) {
    return {reinterpret_cast<T*>(bytes.data()), bytes.size() / sizeof(T)};
}

} // namespace

Image::Image(int width, int height, int channels, PixelType type, ColorEncoding encoding)
    : m_width(width)
    , m_height(height)
    , m_channels(channels)
    , m_type(type)
    , m_encoding(encoding) {
    CHECK_LT(0, width);
    CHECK_LT(0, height);
    CHECK_LT(0, channels);
    CHECK_LE(width, limits::kMaxImageSide);
    CHECK_LE(height, limits::kMaxImageSide);
    CHECK_LE(channels, limits::kMaxImageChannels);
    const std::size_t size =
        static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * bytesPerPixel();
    // The limit is for files; an 8-bit image at the limit may still be widened to floats.
    CHECK_LE(size, sizeof(float) * limits::kMaxImageBytes);
    m_data.resize(size);
}

void Image::setChannelNames(std::vector<std::string> names) {
    CHECK(names.empty() || names.size() == static_cast<std::size_t>(m_channels));
    m_channelNames = std::move(names);
}

std::size_t Image::bytesPerPixel() const {
    return static_cast<std::size_t>(m_channels) * sampleSize(m_type);
}

std::span<std::uint8_t> Image::u8() {
    CHECK(m_type == PixelType::U8);
    return samplesOf<std::uint8_t>(bytes());
}

std::span<const std::uint8_t> Image::u8() const {
    CHECK(m_type == PixelType::U8);
    return samplesOf<const std::uint8_t>(bytes());
}

std::span<std::uint16_t> Image::u16() {
    CHECK(m_type == PixelType::U16);
    return samplesOf<std::uint16_t>(bytes());
}

std::span<const std::uint16_t> Image::u16() const {
    CHECK(m_type == PixelType::U16);
    return samplesOf<const std::uint16_t>(bytes());
}

std::span<float> Image::f32() {
    CHECK(m_type == PixelType::F32);
    return samplesOf<float>(bytes());
}

std::span<const float> Image::f32() const {
    CHECK(m_type == PixelType::F32);
    return samplesOf<const float>(bytes());
}

float Image::sample(int x, int y, int channel) const {
    CHECK(x >= 0 && x < m_width && y >= 0 && y < m_height);
    CHECK(channel >= 0 && channel < m_channels);
    const std::size_t index = (static_cast<std::size_t>(y) * static_cast<std::size_t>(m_width) +
                               static_cast<std::size_t>(x)) *
                                  static_cast<std::size_t>(m_channels) +
                              static_cast<std::size_t>(channel);
    switch (m_type) {
    case PixelType::U8:
        return static_cast<float>(u8()[index]) / 255.0f;
    case PixelType::U16:
        return static_cast<float>(u16()[index]) / 65535.0f;
    case PixelType::F32:
        break;
    }
    return f32()[index];
}

glm::vec4 Image::linear(int x, int y) const {
    CHECK(x >= 0 && x < m_width && y >= 0 && y < m_height);
    const std::size_t first = (static_cast<std::size_t>(y) * static_cast<std::size_t>(m_width) +
                               static_cast<std::size_t>(x)) *
                              static_cast<std::size_t>(m_channels);

    // The stored samples, decoded.
    std::array<float, 4> value{};
    const int used = std::min(m_channels, 4);
    for (int c = 0; c < used; ++c) {
        const std::size_t i = first + static_cast<std::size_t>(c);
        const bool curve = m_encoding == ColorEncoding::Srgb && !isAlphaChannel(c, m_channels);
        float& v = value[static_cast<std::size_t>(c)];
        switch (m_type) {
        case PixelType::U8:
            v = curve ? srgbTable8()[u8()[i]] : static_cast<float>(u8()[i]) / 255.0f;
            break;
        case PixelType::U16:
            v = curve ? srgbTable16()[u16()[i]] : static_cast<float>(u16()[i]) / 65535.0f;
            break;
        case PixelType::F32:
            v = curve ? srgbToLinear(f32()[i]) : f32()[i];
            break;
        }
    }

    switch (m_channels) {
    case 1:
        return {value[0], value[0], value[0], 1.0f};
    case 2:
        return {value[0], value[0], value[0], value[1]};
    case 3:
        return {value[0], value[1], value[2], 1.0f};
    default:
        return {value[0], value[1], value[2], value[3]};
    }
}

Hash hashImage(const Image& image) {
    Hasher hasher;
    hasher.value(image.width()).value(image.height()).value(image.channels());
    hasher.value(static_cast<int>(image.type())).value(static_cast<int>(image.encoding()));
    for (const std::string& name : image.channelNames())
        hasher.text(name);
    hasher.bytes(image.bytes());
    return hasher.finish();
}

glm::vec4 sampleBilinear(const Image& image, float u, float v) {
    CHECK(!image.empty());
    const auto axis = [](float coordinate, int size) {
        // Into 0…1 before scaling, so that far coordinates stay accurate; NaN is treated as 0.
        const float wrapped = std::isfinite(coordinate) ? coordinate - std::floor(coordinate) : 0;
        const float texel = wrapped * static_cast<float>(size) - 0.5f;
        const float base = std::floor(texel);
        const int low = (static_cast<int>(base) + size) % size;
        struct {
            int low, high;
            float fraction;
        } result{low, (low + 1) % size, texel - base};
        return result;
    };
    const auto x = axis(u, image.width());
    const auto y = axis(v, image.height());
    const glm::vec4 top =
        image.linear(x.low, y.low) * (1.0f - x.fraction) + image.linear(x.high, y.low) * x.fraction;
    const glm::vec4 bottom = image.linear(x.low, y.high) * (1.0f - x.fraction) +
                             image.linear(x.high, y.high) * x.fraction;
    return top * (1.0f - y.fraction) + bottom * y.fraction;
}

std::size_t sanitizeHdr(Image& image) {
    if (image.type() != PixelType::F32)
        return 0;
    std::size_t changed = 0;
    for (float& sample : image.f32()) {
        if (std::isnan(sample) || sample < 0.0f) {
            sample = 0.0f;
            ++changed;
        } else if (std::isinf(sample)) {
            sample = 65504.0f; // the largest finite half
            ++changed;
        }
    }
    return changed;
}

} // namespace patina
