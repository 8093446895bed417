// Small pictures to compare.
#pragma once

#include "core/image/Image.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <initializer_list>
#include <random>

namespace patina::test {

inline Image floats(int width, int height, int channels, std::initializer_list<float> values,
                    ColorEncoding encoding = ColorEncoding::Linear) {
    Image image(width, height, channels, PixelType::F32, encoding);
    std::copy(values.begin(), values.end(), image.f32().begin());
    return image;
}

inline Image codes(int width, int height, int channels, std::initializer_list<std::uint8_t> values,
                   ColorEncoding encoding = ColorEncoding::Srgb) {
    Image image(width, height, channels, PixelType::U8, encoding);
    std::copy(values.begin(), values.end(), image.u8().begin());
    return image;
}

// Three channels: linear floats, or 8 bits of sRGB from codes 0…255.
inline Image linearPicture(int width, int height, const std::function<glm::vec3(int, int)>& color) {
    Image image(width, height, 3, PixelType::F32, ColorEncoding::Linear);
    std::size_t i = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c)
                image.f32()[i++] = color(x, y)[c];
    return image;
}

inline Image codedPicture(int width, int height, const std::function<glm::vec3(int, int)>& color) {
    Image image(width, height, 3, PixelType::U8, ColorEncoding::Srgb);
    std::size_t i = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c)
                image.u8()[i++] = static_cast<std::uint8_t>(std::lround(color(x, y)[c]));
    return image;
}

// Smooth colours, an edge, single bright pixels, and noise of the seed.
inline glm::vec3 testColor(int x, int y, unsigned seed) {
    std::seed_seq sequence{static_cast<unsigned>(x), static_cast<unsigned>(y), seed};
    std::minstd_rand random(sequence);
    const float noise = static_cast<float>(random() % 1000) / 1000.0f;
    const float s = static_cast<float>(x), t = static_cast<float>(y);
    glm::vec3 color(0.5f + 0.4f * std::sin(0.3f * s), 0.5f + 0.4f * std::cos(0.2f * t + 0.1f * s),
                    0.5f + 0.4f * std::sin(0.15f * (s + t)));
    if (x > y)
        color *= 0.4f;
    if (noise > 0.97f)
        color = glm::vec3(1.0f);
    return color * (0.9f + 0.1f * noise);
}

} // namespace patina::test
