// Environments for tests: a picture of a radiance that is a function of the direction.
#pragma once

#include "core/image/Image.h"
#include "core/math/Shading.h"

#include <memory>

namespace patina::test {

// width × height, F32, 3 channels: radiance(direction) at the pixels' centres.
template <class Radiance>
ImagePtr latLong(int width, int height, Radiance&& radiance) {
    auto image = std::make_shared<Image>(width, height, 3, PixelType::F32, ColorEncoding::Linear);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::vec3 value = radiance(shading::directionFromLatLong(
                {(static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                 (static_cast<float>(y) + 0.5f) / static_cast<float>(height)}));
            for (int c = 0; c < 3; ++c)
                image->f32()[static_cast<std::size_t>((y * width + x) * 3 + c)] = value[c];
        }
    return image;
}

} // namespace patina::test
