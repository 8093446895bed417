#include "core/image/Channels.h"

#include "core/base/Check.h"

#include <algorithm>
#include <cstddef>

namespace patina {

Image withoutAlpha(const Image& image) {
    CHECK(image.channels() >= 3);
    Image result(image.width(), image.height(), 3, image.type(), image.encoding());
    const std::size_t pixels =
        static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height());
    const std::size_t bytes = result.bytesPerPixel();
    for (std::size_t i = 0; i < pixels; ++i)
        std::copy_n(image.bytes().begin() + static_cast<std::ptrdiff_t>(i * image.bytesPerPixel()),
                    bytes, result.bytes().begin() + static_cast<std::ptrdiff_t>(i * bytes));
    return result;
}

} // namespace patina
