#include "render/scene/TextureCache.h"

#include <algorithm>
#include <array>

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

PixelFormat floatFormat(int channels) {
    return channels == 1   ? PixelFormat::R32f
           : channels == 2 ? PixelFormat::Rg32f
                           : PixelFormat::Rgba16f;
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

gl::Texture upload(gl::Context& context, const Image& image, PixelFormat format, int channels,
                   SampleType type, const void* data) {
    gl::Texture texture(
        context, "material map",
        {.format = format, .width = image.width(), .height = image.height(), .levels = 0});
    texture.upload(0, channels, type, data);
    if (channels == 1)
        texture.setSwizzle({Swizzle::Red, Swizzle::Red, Swizzle::Red, Swizzle::One});
    else if (channels == 2)
        texture.setSwizzle({Swizzle::Red, Swizzle::Red, Swizzle::Red, Swizzle::Green});
    texture.generateMipmaps();
    texture.setSampling(gl::Filter::Trilinear, gl::Wrap::Repeat);
    if (!context.info().software) // costs a software renderer several times the fetches
        texture.setAnisotropy(kAnisotropy);
    return texture;
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
        return upload(context, image, floatFormat(channels), channels, SampleType::F32,
                      extra ? static_cast<const void*>(firstFour(image.f32(), n).data())
                            : image.f32().data());
    }
    return {};
}

const gl::Texture* TextureCache::texture(const ImagePtr& image) {
    const auto found = m_textures.find(image);
    if (found != m_textures.end())
        return &found->second;
    return &m_textures.emplace(image, makeTexture(m_context, *image)).first->second;
}

void TextureCache::keepOnly(const std::set<ImagePtr>& used) {
    std::erase_if(m_textures, [&](const auto& entry) { return !used.contains(entry.first); });
}

} // namespace patina::render
