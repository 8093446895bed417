#include "core/library/Surface.h"

#include "core/math/PortableMath.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace patina::library {

namespace {

std::uint8_t toByte(float x) {
    return static_cast<std::uint8_t>(saturate(x) * 255.0f + 0.5f);
}

// Linear to sRGB bytes (IEC 61966-2-1) by the 255 linear values half-way between two codes.
std::array<float, 255> srgbThresholds() {
    std::array<float, 255> result{};
    for (int i = 0; i < 255; ++i) {
        const double s = (i + 0.5) / 255.0;
        result[static_cast<std::size_t>(i)] =
            static_cast<float>(s <= 0.04045 ? s / 12.92 : powPortable((s + 0.055) / 1.055, 2.4));
    }
    return result;
}

template <class Body>
ImagePtr makeImage(int size, int channels, ColorEncoding encoding, const Body& body) {
    auto image = std::make_shared<Image>(size, size, channels, PixelType::U8, encoding);
    const std::span<std::uint8_t> bytes = image->u8();
    forRows(size, [&](int y) {
        std::uint8_t* out = bytes.data() + static_cast<std::ptrdiff_t>(y) * size * channels;
        for (int x = 0; x < size; ++x, out += channels)
            body(x, y, out);
    });
    return image;
}

ImagePtr scalarMap(const Field& field) {
    return makeImage(field.size(), 1, ColorEncoding::Data,
                     [&](int x, int y, std::uint8_t* out) { *out = toByte(field.row(y)[x]); });
}

ImagePtr colorMap(const Surface& s) {
    // Dielectrics reflect between 2 % (coal) and 90 % (fresh snow); darker or brighter base colours
    // break energy balance. Metals may be brighter: theirs is the specular reflectance.
    constexpr float kDarkest = 0.02f, kBrightest = 0.9f;
    const std::array<float, 255> thresholds = srgbThresholds();
    // A start index for every 1/1024 of the range keeps the search to a few steps.
    std::array<std::uint8_t, 1025> start{};
    for (std::size_t i = 0; i < start.size(); ++i)
        start[i] = static_cast<std::uint8_t>(std::lower_bound(thresholds.begin(), thresholds.end(),
                                                              static_cast<float>(i) / 1024.0f) -
                                             thresholds.begin());
    const auto encode = [&](float linear) {
        unsigned code = start[static_cast<std::size_t>(saturate(linear) * 1024.0f)];
        while (code < 255 && thresholds[code] <= linear)
            ++code;
        return static_cast<std::uint8_t>(code);
    };
    return makeImage(s.height.size(), 3, ColorEncoding::Srgb, [&](int x, int y, std::uint8_t* out) {
        const float brightest = mix(kBrightest, 1.0f, s.metallic.row(y)[x]);
        out[0] = encode(std::clamp(s.red.row(y)[x], kDarkest, brightest));
        out[1] = encode(std::clamp(s.green.row(y)[x], kDarkest, brightest));
        out[2] = encode(std::clamp(s.blue.row(y)[x], kDarkest, brightest));
    });
}

// Central differences. Image rows grow downwards, so that "up" is the row above.
ImagePtr normalMap(const Field& height) {
    const int n = height.size();
    const int mask = n - 1;
    const float slope = 0.5f * static_cast<float>(n); // height and side are in the same unit
    return makeImage(n, 3, ColorEncoding::Data, [&](int x, int y, std::uint8_t* out) {
        const float* row = height.row(y);
        const float nx = (row[(x - 1) & mask] - row[(x + 1) & mask]) * slope;
        const float ny = (height.row((y + 1) & mask)[x] - height.row((y - 1) & mask)[x]) * slope;
        const float scale = 0.5f / std::sqrt(nx * nx + ny * ny + 1.0f);
        out[0] = toByte(0.5f + nx * scale);
        out[1] = toByte(0.5f + ny * scale);
        out[2] = toByte(0.5f + scale);
    });
}

// How far a point lies below its surroundings, relative to their distance, stands for the part of
// the hemisphere they cover.
ImagePtr occlusionMap(const Surface& s) {
    const int n = s.height.size();
    const Field wide = blur(s.height, s.cavityRadius);
    const Field narrow = blur(s.height, std::max(1, s.cavityRadius / 4));
    const float perWide =
        s.cavityStrength * static_cast<float>(n) / static_cast<float>(s.cavityRadius);
    const float perNarrow = 2.0f * perWide;
    return makeImage(n, 1, ColorEncoding::Data, [&](int x, int y, std::uint8_t* out) {
        const float h = s.height.row(y)[x];
        const float covered = std::max(0.0f, (wide.row(y)[x] - h) * perWide) +
                              std::max(0.0f, (narrow.row(y)[x] - h) * perNarrow);
        *out = toByte(1.0f / (1.0f + covered));
    });
}

} // namespace

SurfaceMaps finishSurface(const Surface& surface) {
    SurfaceMaps maps;
    maps.baseColor = colorMap(surface);
    maps.normal = normalMap(surface.height);
    maps.perceptualRoughness = scalarMap(surface.roughness);
    maps.occlusion = occlusionMap(surface);

    const float first = surface.metallic.row(0)[0];
    bool constant = first == 0.0f || first == 1.0f;
    for (int y = 0; y < surface.metallic.size() && constant; ++y) {
        const float* row = surface.metallic.row(y);
        constant = std::all_of(row, row + surface.metallic.size(),
                               [first](float value) { return value == first; });
    }
    maps.constantMetallic = constant ? first : 1.0f;
    if (!constant)
        maps.metallic = scalarMap(surface.metallic);
    return maps;
}

} // namespace patina::library
