// Changing how an image stores its picture: type, encoding and size.
#include "core/base/Check.h"
#include "core/image/AreaFilter.h"
#include "core/image/Image.h"
#include "core/image/Srgb.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace patina {

namespace {

enum class Curve { None, Decode, Encode };

Curve curveBetween(ColorEncoding from, ColorEncoding to) {
    if (from == ColorEncoding::Srgb && to == ColorEncoding::Linear)
        return Curve::Decode;
    if (from == ColorEncoding::Linear && to == ColorEncoding::Srgb)
        return Curve::Encode;
    return Curve::None;
}

// NaN becomes 0: the comparison in max() is false for it.
template <class T>
T quantize(float value) {
    constexpr float kMax = static_cast<float>(std::numeric_limits<T>::max());
    const float clamped = std::min(std::max(0.0f, value), 1.0f);
    return static_cast<T>(clamped * kMax + 0.5f);
}

float toFloat(std::uint8_t v) {
    return static_cast<float>(v) / 255.0f;
}
float toFloat(std::uint16_t v) {
    return static_cast<float>(v) / 65535.0f;
}
float toFloat(float v) {
    return v;
}

float decoded(std::uint8_t v) {
    return srgbTable8()[v];
}
float decoded(std::uint16_t v) {
    return srgbTable16()[v];
}
float decoded(float v) {
    return srgbToLinear(v);
}

template <class T>
T fromFloat(float v) {
    return quantize<T>(v);
}
template <>
float fromFloat<float>(float v) {
    return v;
}

template <class T>
T encoded(float v) {
    return fromFloat<T>(linearToSrgb(v));
}
template <>
std::uint8_t encoded<std::uint8_t>(float v) {
    return linearToSrgb8(v);
}

template <class From, class To>
To convertSample(From v, Curve curve) {
    switch (curve) {
    case Curve::Decode:
        return fromFloat<To>(decoded(v));
    case Curve::Encode:
        return encoded<To>(toFloat(v));
    case Curve::None:
        break;
    }
    return fromFloat<To>(toFloat(v));
}

template <class From, class To>
void convertSamples(std::span<const From> from, std::span<To> to, int channels, Curve curve) {
    const auto step = static_cast<std::size_t>(channels);
    for (std::size_t c = 0; c < step; ++c) {
        const Curve used = isAlphaChannel(static_cast<int>(c), channels) ? Curve::None : curve;
        for (std::size_t i = c; i < from.size(); i += step)
            to[i] = convertSample<From, To>(from[i], used);
    }
}

template <class From>
void convertFrom(std::span<const From> from, Image& result, int channels, Curve curve) {
    switch (result.type()) {
    case PixelType::U8:
        return convertSamples<From, std::uint8_t>(from, result.u8(), channels, curve);
    case PixelType::U16:
        return convertSamples<From, std::uint16_t>(from, result.u16(), channels, curve);
    case PixelType::F32:
        return convertSamples<From, float>(from, result.f32(), channels, curve);
    }
}

} // namespace

Image convertImage(const Image& image, PixelType type, ColorEncoding encoding) {
    if (image.empty())
        return image;
    const Curve curve = curveBetween(image.encoding(), encoding);
    if (type == image.type() && curve == Curve::None) {
        Image copy = image;
        copy.setEncoding(encoding);
        return copy;
    }
    Image result(image.width(), image.height(), image.channels(), type, encoding);
    result.setChannelNames(image.channelNames());
    switch (image.type()) {
    case PixelType::U8:
        convertFrom(image.u8(), result, image.channels(), curve);
        break;
    case PixelType::U16:
        convertFrom(image.u16(), result, image.channels(), curve);
        break;
    case PixelType::F32:
        convertFrom(image.f32(), result, image.channels(), curve);
        break;
    }
    return result;
}

Image shrinkImage(const Image& image, int maxSide) {
    CHECK_LT(0, maxSide);
    const int longSide = std::max(image.width(), image.height());
    if (image.empty() || longSide <= maxSide)
        return image;
    const auto scaled = [&](int side) {
        return std::max(
            1, static_cast<int>(std::lround(static_cast<double>(side) * maxSide / longSide)));
    };
    const int width = scaled(image.width());
    const int height = scaled(image.height());

    // A row of source texels at a time is decoded and added to the rows it touches.
    const bool decode = image.encoding() == ColorEncoding::Srgb;
    const ColorEncoding workEncoding = decode ? ColorEncoding::Linear : image.encoding();
    const std::size_t sourceRowBytes =
        static_cast<std::size_t>(image.width()) * image.bytesPerPixel();
    Image sourceRow(image.width(), 1, image.channels(), image.type(), image.encoding());
    RowReducer reducer(image.width(), image.height(), width, height, image.channels());
    for (int y = 0; y < image.height(); ++y) {
        std::memcpy(sourceRow.bytes().data(),
                    image.bytes().data() + static_cast<std::size_t>(y) * sourceRowBytes,
                    sourceRowBytes);
        reducer.addRow(convertImage(sourceRow, PixelType::F32, workEncoding).f32());
    }
    Image work(width, height, image.channels(), PixelType::F32, workEncoding);
    work.setChannelNames(image.channelNames());
    std::ranges::copy(reducer.result(), work.f32().begin());
    return convertImage(work, image.type(), image.encoding());
}

} // namespace patina
