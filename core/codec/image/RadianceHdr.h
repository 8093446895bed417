// Radiance pictures (.hdr, .pic): Ward's shared-exponent colours, flat or with the old or the new
// run lengths, in all eight orientations. OpenImageIO ignores EXPOSURE, COLORCORR and the rotated
// orientations and knows no XYZE. G. Ward, "Radiance File Formats"; src/common/color.c.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace patina::codec {

struct RadianceHeader {
    int width = 0, height = 0; // as it is to be seen
    // The file holds `scanlines` runs of `length` pixels. Rows that begin at the top with their
    // leftmost pixel are the rule ("-Y H +X W").
    int scanlines = 0, length = 0;
    bool columns = false; // each scanline is a column ("+X W -Y H")
    bool flipX = false, flipY = false;
    bool xyze = false; // CIE XYZ instead of RGB
    // What pixels are to be divided by: the product of all EXPOSURE and COLORCORR lines.
    std::array<double, 3> scale{1.0, 1.0, 1.0};
    // "PRIMARIES=": CIE xy of red, green, blue and white.
    std::optional<std::array<float, 8>> primaries;
    std::size_t pixels = 0; // where they begin
};

// Throws Refusal, naming the line that makes no sense.
RadianceHeader readRadianceHeader(std::span<const std::byte> file);

// Radiance in linear RGB (Rec.709 for XYZE), row 0 at the top, `width` × `height` pixels, at most
// those of the header; averaged by area where they are fewer. Throws Refusal for runs that do not
// fit and for files that end early.
std::vector<float> readRadiancePixels(std::span<const std::byte> file, const RadianceHeader& header,
                                      int width, int height);

// With the new run lengths where the format has them (8…32767 pixels wide), "-Y H +X W".
std::vector<std::byte> writeRadiance(int width, int height, std::span<const float> rgb);

} // namespace patina::codec
