#include "core/compare/DifferencePicture.h"

#include "core/base/Check.h"

#include <algorithm>
#include <array>

namespace patina {

void hideInvisible(Image& values, const Image& flip, float threshold) {
    CHECK(values.channels() == 1 && flip.channels() == 1);
    const std::span<float> out = values.f32();
    const std::span<const float> seen = flip.f32();
    CHECK_EQ(out.size(), seen.size());
    for (std::size_t i = 0; i < out.size(); ++i)
        if (seen[i] < threshold)
            out[i] = 0.0f;
}

Image colorErrors(const Image& values, ColorMap map, float from, float to) {
    CHECK(values.channels() == 1);
    CHECK_LT(from, to);
    // More steps than a channel of 8 bits can show.
    constexpr int kSteps = 1024;
    std::array<std::array<std::uint8_t, 3>, kSteps + 1> colors{};
    for (int i = 0; i <= kSteps; ++i) {
        const glm::vec3 color = mapColor(map, static_cast<float>(i) / kSteps);
        for (int c = 0; c < 3; ++c)
            colors[static_cast<std::size_t>(i)][static_cast<std::size_t>(c)] =
                static_cast<std::uint8_t>(color[c] * 255.0f + 0.5f);
    }
    Image picture(values.width(), values.height(), 3, PixelType::U8, ColorEncoding::Srgb);
    const std::span<std::uint8_t> out = picture.u8();
    std::size_t i = 0;
    for (const float value : values.f32()) {
        const float share = std::clamp((value - from) / (to - from), 0.0f, 1.0f);
        for (const std::uint8_t channel : colors[static_cast<std::size_t>(share * kSteps + 0.5f)])
            out[i++] = channel;
    }
    return picture;
}

} // namespace patina
