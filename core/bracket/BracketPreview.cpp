#include "core/bracket/BracketPreview.h"

#include "core/image/AreaFilter.h"
#include "core/image/Srgb.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace patina {

BracketPreview shrinkMerged(const MergedPhotos& merged, int maxSide) {
    const Image& image = merged.image;
    const ImageSize size = reducedSize({image.width(), image.height()}, maxSide);
    BracketPreview preview;
    preview.image = size.width < image.width() ? shrinkImage(image, maxSide) : image;
    const auto width = static_cast<std::size_t>(image.width());
    const auto height = static_cast<std::size_t>(image.height());
    const auto columns = static_cast<std::size_t>(preview.image.width());
    const auto rows = static_cast<std::size_t>(preview.image.height());
    preview.marks.resize(columns * rows);
    std::vector<float> counts(columns * rows);
    for (std::size_t at = 0; at < merged.marks.size(); ++at) {
        const std::size_t small =
            at / width * rows / height * columns + at % width * columns / width;
        const std::uint8_t mark = merged.marks[at];
        MarkedShares& shares = preview.marks[small];
        counts[small] += 1.0f;
        if ((mark & kClippedAbove) != 0)
            shares.above += 1.0f;
        else if ((mark & kClippedBelow) != 0)
            shares.below += 1.0f;
        else if ((mark & kDisagrees) != 0)
            shares.disagrees += 1.0f;
    }
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const float scale = 1.0f / std::max(counts[i], 1.0f);
        preview.marks[i].above *= scale;
        preview.marks[i].below *= scale;
        preview.marks[i].disagrees *= scale;
    }
    return preview;
}

Image drawPreview(const BracketPreview& preview, float exposureEv, bool marks,
                  const MarkColors& colors) {
    const Image& image = preview.image;
    Image result(image.width(), image.height(), 3, PixelType::U8, ColorEncoding::Srgb);
    const float scale = std::exp2(exposureEv);
    const std::span<const float> in = image.f32();
    const std::span<std::uint8_t> out = result.u8();
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = linearToSrgb8(scale * in[i]);
    if (!marks)
        return result;
    for (std::size_t i = 0; i < preview.marks.size(); ++i) {
        const MarkedShares& shares = preview.marks[i];
        const float sum = shares.sum();
        if (sum <= 0.0f)
            continue;
        // Half of the pixels are enough for all of the colour, so that a few are still seen.
        const float part = std::min(2.0f * sum, 1.0f);
        for (std::size_t c = 0; c < 3; ++c) {
            const float color = (shares.above * static_cast<float>(colors.above[c]) +
                                 shares.below * static_cast<float>(colors.below[c]) +
                                 shares.disagrees * static_cast<float>(colors.disagrees[c])) /
                                sum;
            std::uint8_t& sample = out[3 * i + c];
            sample = static_cast<std::uint8_t>(
                std::lround(part * color + (1.0f - part) * static_cast<float>(sample)));
        }
    }
    return result;
}

} // namespace patina
