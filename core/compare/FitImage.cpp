#include "core/compare/FitImage.h"

#include "core/base/Check.h"
#include "core/image/AreaFilter.h"

#include <algorithm>
#include <cmath>

namespace patina {
namespace {

// What each target pixel along a side takes from the source.
std::vector<Footprint> fitted(int from, int to) {
    if (to <= from)
        return footprints(from, to);
    std::vector<Footprint> result(static_cast<std::size_t>(to));
    for (int i = 0; i < to; ++i) {
        // Centre on centre; beyond the outermost ones their pixels are repeated.
        const double at =
            std::clamp((i + 0.5) * from / to - 0.5, 0.0, static_cast<double>(from - 1));
        Footprint& footprint = result[static_cast<std::size_t>(i)];
        footprint.first = std::min(static_cast<int>(at), std::max(from - 2, 0));
        const auto second = static_cast<float>(at - footprint.first);
        footprint.weights = {1.0f - second};
        if (from > 1)
            footprint.weights.push_back(second);
    }
    return result;
}

} // namespace

Image fitImage(const Image& image, int width, int height) {
    CHECK(!image.empty());
    if (image.width() == width && image.height() == height)
        return image;
    const bool decode = image.encoding() == ColorEncoding::Srgb;
    const Image source =
        convertImage(image, PixelType::F32, decode ? ColorEncoding::Linear : image.encoding());
    Image result(width, height, image.channels(), PixelType::F32, source.encoding());
    result.setChannelNames(image.channelNames());

    const std::vector<Footprint> columns = fitted(image.width(), width);
    const std::vector<Footprint> rows = fitted(image.height(), height);
    const auto channels = static_cast<std::size_t>(image.channels());
    const std::size_t sourceRow = static_cast<std::size_t>(image.width()) * channels;
    const std::size_t targetRow = static_cast<std::size_t>(width) * channels;
    const std::span<const float> in = source.f32();
    const std::span<float> out = result.f32();
    std::vector<float> row(sourceRow); // of the target's height, the source's width
    for (std::size_t y = 0; y < rows.size(); ++y) {
        std::fill(row.begin(), row.end(), 0.0f);
        for (std::size_t k = 0; k < rows[y].weights.size(); ++k) {
            const float* from =
                in.data() + (static_cast<std::size_t>(rows[y].first) + k) * sourceRow;
            for (std::size_t i = 0; i < sourceRow; ++i)
                row[i] += rows[y].weights[k] * from[i];
        }
        for (std::size_t x = 0; x < columns.size(); ++x)
            for (std::size_t k = 0; k < columns[x].weights.size(); ++k)
                for (std::size_t c = 0; c < channels; ++c)
                    out[y * targetRow + x * channels + c] +=
                        columns[x].weights[k] *
                        row[(static_cast<std::size_t>(columns[x].first) + k) * channels + c];
    }
    return decode ? convertImage(result, PixelType::F32, image.encoding()) : result;
}

} // namespace patina
