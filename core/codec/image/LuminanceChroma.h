// OpenEXR files that keep luminance in full and colour in quarter resolution (channels Y, RY, BY),
// which OpenImageIO refuses. Read with OpenEXR's own reconstruction.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace patina::codec {

struct LuminanceChromaImage {
    int width = 0, height = 0;
    std::optional<std::array<float, 8>> chromaticities; // CIE xy of red, green, blue, white
    std::vector<float> rgb;                             // empty when only the header was wanted
};

// Nothing when the file is of another kind. Throws Refusal.
std::optional<LuminanceChromaImage> readLuminanceChroma(const std::string& file, bool headerOnly);

} // namespace patina::codec
