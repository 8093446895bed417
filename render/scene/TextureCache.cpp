#include "render/scene/TextureCache.h"

#include <algorithm>
#include <array>
#include <span>

namespace patina::render {

namespace {

using gl::PixelFormat;
using gl::SampleType;
using gl::Swizzle;

constexpr float kAnisotropy = 8.0f;

PixelFormat integerFormat(int channels, bool wide) {
    switch (channels) {
    case 1:
        return wide ? PixelFormat::R16 : PixelFormat::R8;
    case 2:
        return wide ? PixelFormat::Rg16 : PixelFormat::Rg8;
    default:
        return wide ? PixelFormat::Rgba16 : PixelFormat::Rgba8;
    }
}

// Half floats come in fours.
PixelFormat textureFormat(TexelPrecision precision, int channels) {
    switch (precision) {
    case TexelPrecision::U8:
        return integerFormat(channels, false);
    case TexelPrecision::U16:
        return integerFormat(channels, true);
    case TexelPrecision::F16:
        return PixelFormat::Rgba16f;
    case TexelPrecision::F32:
        return channels == 1   ? PixelFormat::R32f
               : channels == 2 ? PixelFormat::Rg32f
                               : PixelFormat::Rgba32f;
    }
    return PixelFormat::Rgba8;
}

// The first four channels: bake files may have many more.
template <class T>
std::vector<T> firstFour(std::span<const T> values, std::size_t channels) {
    std::vector<T> result(values.size() / channels * 4);
    for (std::size_t pixel = 0; pixel < result.size() / 4; ++pixel)
        for (std::size_t c = 0; c < 4; ++c)
            result[pixel * 4 + c] = values[pixel * channels + c];
    return result;
}

// Grey sRGB has no texture format of its own: it becomes RGBA.
std::vector<std::uint8_t> greyToRgba(const Image& image) {
    const auto values = image.u8();
    const auto channels = static_cast<std::size_t>(image.channels());
    std::vector<std::uint8_t> result(values.size() / channels * 4);
    for (std::size_t pixel = 0; pixel < result.size() / 4; ++pixel) {
        const std::uint8_t grey = values[pixel * channels];
        const std::uint8_t alpha = channels == 2 ? values[pixel * channels + 1] : std::uint8_t{255};
        const std::array<std::uint8_t, 4> rgba{grey, grey, grey, alpha};
        std::copy(rgba.begin(), rgba.end(),
                  result.begin() + static_cast<std::ptrdiff_t>(pixel * 4));
    }
    return result;
}

gl::Texture emptyTexture(gl::Context& context, const Image& sizedLike, PixelFormat format) {
    return {
        context,
        "material map",
        {.format = format, .width = sizedLike.width(), .height = sizedLike.height(), .levels = 0}};
}

// When level 0 is there.
void finish(gl::Context& context, gl::Texture& texture) {
    texture.generateMipmaps();
    texture.setSampling(gl::Filter::Trilinear, gl::Wrap::Repeat);
    if (!context.info().software) // costs a software renderer several times the fetches
        texture.setAnisotropy(kAnisotropy);
}

gl::Texture upload(gl::Context& context, const Image& image, PixelFormat format, int channels,
                   SampleType type, const void* data) {
    gl::Texture texture = emptyTexture(context, image, format);
    texture.upload(0, channels, type, data);
    if (channels == 1)
        texture.setSwizzle({Swizzle::Red, Swizzle::Red, Swizzle::Red, Swizzle::One});
    else if (channels == 2)
        texture.setSwizzle({Swizzle::Red, Swizzle::Red, Swizzle::Red, Swizzle::Green});
    finish(context, texture);
    return texture;
}

std::span<const std::uint8_t> samples(const Image& image, std::uint8_t) {
    return image.u8();
}
std::span<const std::uint16_t> samples(const Image& image, std::uint16_t) {
    return image.u16();
}
std::span<const float> samples(const Image& image, float) {
    return image.f32();
}

// Band by band: what is interleaved stays in the processor's cache, and needs little memory. Of
// `stored` channels per texel, which is what drivers copy as they are, those after the last are 0.
template <class T>
void uploadPacked(gl::Texture& texture, const std::vector<ImageChannel>& channels,
                  std::size_t stored, SampleType type) {
    constexpr std::size_t kBandBytes = std::size_t{256} << 10;
    const auto width = static_cast<std::size_t>(texture.width());
    const auto height = static_cast<std::size_t>(texture.height());
    const std::size_t rowBytes = width * stored * sizeof(T);
    const std::size_t bandRows = std::clamp<std::size_t>(kBandBytes / rowBytes, 1, height);
    std::vector<T> band(bandRows * width * stored);
    for (std::size_t row = 0; row < height; row += bandRows) {
        const std::size_t rows = std::min(bandRows, height - row);
        for (std::size_t c = 0; c < channels.size(); ++c) {
            const Image& image = *channels[c].image;
            const auto step = static_cast<std::size_t>(image.channels());
            const T* source = samples(image, T{}).data() + row * width * step +
                              static_cast<std::size_t>(channels[c].channel);
            for (std::size_t i = 0; i < rows * width; ++i)
                band[i * stored + c] = source[i * step];
        }
        texture.uploadRows(0, static_cast<int>(row), static_cast<int>(rows),
                           static_cast<int>(stored), type, band.data());
    }
}

} // namespace

gl::Texture makeTexture(gl::Context& context, const Image& image) {
    const int limit = context.info().maxTextureSize;
    if (image.width() > limit || image.height() > limit)
        return makeTexture(context, shrinkImage(image, limit));
    // Only 8-bit sRGB exists as a texture format.
    const bool srgb = image.encoding() == ColorEncoding::Srgb;
    if (srgb && image.type() == PixelType::U16)
        return makeTexture(context, convertImage(image, PixelType::F32, ColorEncoding::Linear));

    const int channels = std::min(image.channels(), 4);
    const bool extra = image.channels() > 4;
    const auto n = static_cast<std::size_t>(image.channels());
    switch (image.type()) {
    case PixelType::U8: {
        if (srgb && channels <= 2)
            return upload(context, image, PixelFormat::Srgb8Alpha8, 4, SampleType::U8,
                          greyToRgba(image).data());
        const PixelFormat format = srgb ? PixelFormat::Srgb8Alpha8 : integerFormat(channels, false);
        return upload(context, image, format, channels, SampleType::U8,
                      extra ? static_cast<const void*>(firstFour(image.u8(), n).data())
                            : image.u8().data());
    }
    case PixelType::U16: {
        return upload(context, image, integerFormat(channels, true), channels, SampleType::U16,
                      extra ? static_cast<const void*>(firstFour(image.u16(), n).data())
                            : image.u16().data());
    }
    case PixelType::F32:
        // Of whole floats there are no more than two: see texelPrecision().
        return upload(context, image, textureFormat(texelPrecision(image), channels), channels,
                      SampleType::F32,
                      extra ? static_cast<const void*>(firstFour(image.f32(), n).data())
                            : image.f32().data());
    }
    return {};
}

gl::Texture makePackedTexture(gl::Context& context, const std::vector<ImageChannel>& channels) {
    const Image& first = *channels.front().image;
    const int limit = context.info().maxTextureSize;
    if (first.width() > limit || first.height() > limit) {
        std::vector<ImageChannel> reduced;
        for (const auto& [image, channel] : channels)
            reduced.push_back({std::make_shared<const Image>(shrinkImage(*image, limit)), channel});
        return makePackedTexture(context, reduced);
    }
    const TexelPrecision precision = texelPrecision(first);
    const int stored = channels.size() == 2 ? 2 : 4;
    gl::Texture texture = emptyTexture(context, first, textureFormat(precision, stored));
    const auto n = static_cast<std::size_t>(stored);
    switch (first.type()) {
    case PixelType::U8:
        uploadPacked<std::uint8_t>(texture, channels, n, SampleType::U8);
        break;
    case PixelType::U16:
        uploadPacked<std::uint16_t>(texture, channels, n, SampleType::U16);
        break;
    case PixelType::F32:
        uploadPacked<float>(texture, channels, n, SampleType::F32);
        break;
    }
    finish(context, texture);
    return texture;
}

TextureCache::Key TextureCache::keyOf(const TexelSource& source) {
    if (source.image)
        return {{source.image.get(), -1}};
    Key key;
    for (const auto& [image, channel] : source.packed)
        key.emplace_back(image.get(), channel);
    return key;
}

TexturePtr TextureCache::texture(const TexelSource& source) {
    const Key key = keyOf(source);
    const auto found = m_entries.find(key);
    std::shared_ptr<const Entry> entry = found != m_entries.end() ? found->second.lock() : nullptr;
    if (!entry) {
        std::erase_if(m_entries, [](const auto& known) { return known.second.expired(); });
        entry = std::make_shared<const Entry>(
            Entry{source, source.image ? makeTexture(m_context, *source.image)
                                       : makePackedTexture(m_context, source.packed)});
        m_entries.emplace(key, entry);
    }
    return {entry, &entry->texture};
}

std::size_t TextureCache::size() const {
    return static_cast<std::size_t>(std::ranges::count_if(
        m_entries, [](const auto& known) { return !known.second.expired(); }));
}

} // namespace patina::render
