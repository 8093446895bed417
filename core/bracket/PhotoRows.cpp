#include "core/bracket/PhotoRows.h"

#include "core/base/Check.h"
#include "core/bracket/ResponseCurve.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace patina {
namespace {

constexpr float kTop16 = 65535.0f;

float linearCode(float value, float white) {
    return std::clamp(value / white, 0.0f, 1.0f) * kTopCode;
}

std::size_t indexOf(const Photo& photo, int x, int y, int channel) {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(photo.image.width()) +
            static_cast<std::size_t>(x)) *
               static_cast<std::size_t>(photo.image.channels()) +
           static_cast<std::size_t>(channel);
}

} // namespace

double Photo::logExposure() const {
    return ev * std::numbers::ln2;
}

float whiteOf(const Image& linear) {
    // So many samples of the very largest value are a plateau: a picture's own maximum is one
    // pixel, or a few.
    constexpr std::size_t kPlateau = 16;
    constexpr float kHeadroom = 1.25f; // the largest value keeps a weight of 2/5
    const std::span<const float> samples = linear.f32();
    float largest = 0.0f;
    for (const float sample : samples)
        largest = std::max(largest, sample);
    if (largest <= 0.0f)
        return 1.0f;
    const auto count =
        static_cast<std::size_t>(std::count(samples.begin(), samples.end(), largest));
    return count >= kPlateau ? largest : kHeadroom * largest;
}

void codesOfRow(const Photo& photo, int y, std::span<float> codes) {
    const std::size_t begin = indexOf(photo, 0, y, 0);
    CHECK(codes.size() == indexOf(photo, 0, 1, 0));
    switch (photo.image.type()) {
    case PixelType::U8: {
        const std::span<const std::uint8_t> row = photo.image.u8().subspan(begin, codes.size());
        for (std::size_t i = 0; i < codes.size(); ++i)
            codes[i] = static_cast<float>(row[i]);
        break;
    }
    case PixelType::U16: {
        const std::span<const std::uint16_t> row = photo.image.u16().subspan(begin, codes.size());
        for (std::size_t i = 0; i < codes.size(); ++i)
            codes[i] = static_cast<float>(row[i]) * (kTopCode / kTop16);
        break;
    }
    case PixelType::F32: {
        const std::span<const float> row = photo.image.f32().subspan(begin, codes.size());
        for (std::size_t i = 0; i < codes.size(); ++i)
            codes[i] = linearCode(row[i], photo.white);
        break;
    }
    }
}

float codeAt(const Photo& photo, int x, int y, int channel) {
    const std::size_t at = indexOf(photo, x, y, channel);
    switch (photo.image.type()) {
    case PixelType::U8:
        return static_cast<float>(photo.image.u8()[at]);
    case PixelType::U16:
        return static_cast<float>(photo.image.u16()[at]) * (kTopCode / kTop16);
    case PixelType::F32:
        return linearCode(photo.image.f32()[at], photo.white);
    }
    return 0.0f;
}

} // namespace patina
