#include "core/export/TexturePacking.h"
#include "core/job/Parallel.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace patina {
namespace {

// The image at another size: area-averaged on the way down, bilinear on the way up.
Image resized(const Image& image, int width, int height) {
    if (image.width() == width && image.height() == height)
        return image;
    Image source = image;
    if (image.width() > width || image.height() > height)
        source = shrinkImage(image, std::max(width, height));
    if (source.width() == width && source.height() == height)
        return source;
    // Bilinear lookups are linear light; data stays data.
    Image result(width, height, 4, PixelType::F32,
                 image.encoding() == ColorEncoding::Data ? ColorEncoding::Data
                                                         : ColorEncoding::Linear);
    const std::span<float> out = result.f32();
    std::size_t i = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 4; ++c, ++i)
                out[i] = sampleBilinear(source, (static_cast<float>(x) + 0.5f) / width,
                                        (static_cast<float>(y) + 0.5f) / height)[c];
    return result;
}

// One channel as stored. Grey images answer for every colour; a missing alpha is 1.
float channelSample(const Image& image, int x, int y, MapChannel channel) {
    const int colors = image.channels() <= 2 ? 1 : 3;
    if (channel == MapChannel::A)
        return image.channels() == colors ? 1.0f : image.sample(x, y, colors);
    const int wanted = channel == MapChannel::G ? 1 : channel == MapChannel::B ? 2 : 0;
    return image.sample(x, y, std::min(wanted, colors - 1));
}

template <class T>
T quantize(float value, float maximum) {
    const float bounded = value > 0.0f ? std::min(value, 1.0f) : 0.0f; // NaN becomes 0
    return static_cast<T>(std::lround(bounded * maximum));
}

// Of 8 or 16 bits.
void store(Image& image, std::size_t i, float value) {
    if (image.type() == PixelType::U8)
        image.u8()[i] = quantize<std::uint8_t>(value, 255.0f);
    else
        image.u16()[i] = quantize<std::uint16_t>(value, 65535.0f);
}

Image packColor(const PackedTexture& texture, const JobContext& job) {
    const Image source = convertImage(resized(*texture.color.image, texture.width, texture.height),
                                      texture.type, ColorEncoding::Srgb);
    Image result(texture.width, texture.height, texture.channels, texture.type,
                 ColorEncoding::Srgb);
    const auto rowLength = static_cast<std::size_t>(texture.width * texture.channels);
    const MapChannel only = texture.color.channel;
    constexpr MapChannel kRgba[] = {MapChannel::R, MapChannel::G, MapChannel::B, MapChannel::A};
    parallelFor(job, static_cast<std::size_t>(texture.height), 16,
                [&](std::size_t begin, std::size_t end) {
                    std::size_t i = begin * rowLength;
                    for (auto y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
                        for (int x = 0; x < texture.width; ++x)
                            for (int c = 0; c < texture.channels; ++c, ++i)
                                store(result, i,
                                      channelSample(source, x, y,
                                                    only == MapChannel::Rgb ? kRgba[c] : only));
                });
    return result;
}

Image packNormal(const PackedTexture& texture, const JobContext& job) {
    const Image source = resized(*texture.color.image, texture.width, texture.height);
    const bool averaged = source.width() != texture.color.image->width() ||
                          source.height() != texture.color.image->height();
    Image result(texture.width, texture.height, 3, texture.type, ColorEncoding::Data);
    const auto width = static_cast<std::size_t>(texture.width);
    parallelFor(job, static_cast<std::size_t>(texture.height), 16,
                [&](std::size_t begin, std::size_t end) {
                    for (std::size_t i = begin * width; i < end * width; ++i) {
                        const int x = static_cast<int>(i % width), y = static_cast<int>(i / width);
                        glm::vec3 value(channelSample(source, x, y, MapChannel::R),
                                        channelSample(source, x, y, MapChannel::G),
                                        channelSample(source, x, y, MapChannel::B));
                        if (texture.flipGreen)
                            value.g = 1.0f - value.g;
                        // The mean of unit vectors is shorter than they are.
                        const glm::vec3 normal = value * 2.0f - 1.0f;
                        if (averaged && glm::length(normal) > 1e-6f)
                            value = glm::normalize(normal) * 0.5f + 0.5f;
                        for (int c = 0; c < 3; ++c)
                            store(result, 3 * i + static_cast<std::size_t>(c), value[c]);
                    }
                });
    return result;
}

Image packChannels(const PackedTexture& texture, const JobContext& job) {
    const auto fitted = [&](const ImagePtr& image) {
        return image == nullptr ? Image() : resized(*image, texture.width, texture.height);
    };
    std::array<Image, 4> images;
    for (std::size_t c = 0; c < images.size(); ++c)
        images[c] = fitted(texture.channel[c].image);

    // Absent maps are 1: the material's numbers then count alone.
    const auto valueOf = [](const Image& image, const MapSlot& slot, int x, int y) {
        return image.empty() ? 1.0f : channelSample(image, x, y, slot.channel);
    };

    Image result(texture.width, texture.height, texture.channels, texture.type,
                 ColorEncoding::Data);
    const auto width = static_cast<std::size_t>(texture.width);
    parallelFor(
        job, static_cast<std::size_t>(texture.height), 16, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin * width; i < end * width; ++i) {
                const int x = static_cast<int>(i % width), y = static_cast<int>(i / width);
                const auto channels = static_cast<std::size_t>(texture.channels);
                for (std::size_t c = 0; c < channels; ++c)
                    store(result, i * channels + c, valueOf(images[c], texture.channel[c], x, y));
            }
        });
    return result;
}

} // namespace

Image packTexture(const PackedTexture& texture, const JobContext& job) {
    Image result = texture.kind == PackKind::Color    ? packColor(texture, job)
                   : texture.kind == PackKind::Normal ? packNormal(texture, job)
                                                      : packChannels(texture, job);
    return job.cancelled() ? Image() : result;
}

} // namespace patina
