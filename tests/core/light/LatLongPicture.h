// Environments for tests: a picture of a radiance that is a function of the direction.
#pragma once

#include "core/image/Image.h"
#include "core/math/Shading.h"

#include <memory>

namespace patina::test {

// width × height, F32, 3 channels or 1 (the radiance's first): radiance(direction) at the pixels'
// centres.
template <class Radiance>
Image latLongImage(int width, int height, Radiance&& radiance, int channels = 3) {
    Image image(width, height, channels, PixelType::F32, ColorEncoding::Linear);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::vec3 value = radiance(shading::directionFromLatLong(
                {(static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                 (static_cast<float>(y) + 0.5f) / static_cast<float>(height)}));
            for (int c = 0; c < channels; ++c)
                image.f32()[static_cast<std::size_t>((y * width + x) * channels + c)] = value[c];
        }
    return image;
}

template <class Radiance>
ImagePtr latLong(int width, int height, Radiance&& radiance) {
    return std::make_shared<const Image>(latLongImage(width, height, radiance));
}

} // namespace patina::test
