// How the surface shader fetches a material's maps. Maps of which it reads one channel (metallic,
// roughness, occlusion) and that lie at one place on the surface share a fetch: of the image that
// they share, or of a texture into which the channels of their images are packed. No OpenGL.
#pragma once

#include "core/image/Image.h"
#include "core/material/MaterialInput.h"

#include <optional>
#include <vector>

namespace patina {
struct Material;
}

namespace patina::render {

// What a texture keeps of a sample: integers as they are, floats of images with up to two channels
// whole, others as half floats. The latter are never packed: pictures then differed in last bits
// where images had three channels (Mesa 22.3), whose floats drivers need not round to halves as
// they round those of four.
enum class TexelPrecision { U8, U16, F16, F32 };
[[nodiscard]] TexelPrecision texelPrecision(const Image& image);

// A channel as the image stores it: 0…3, less than its number of channels.
struct ImageChannel {
    ImagePtr image;
    int channel = 0;
    friend bool operator==(const ImageChannel&, const ImageChannel&) = default;
};

// What a texture holds: all of an image, or two to four channels of at least two images, which have
// one size and one precision, not F16, and are not Srgb.
struct TexelSource {
    ImagePtr image;                   // null: packed
    std::vector<ImageChannel> packed; // in the order R, G, B, A
};

struct MapFetch {
    // Whose texture, unit and place on the surface are used: the input itself, or another one that
    // shares the fetch. Never Occlusion for another input, because bakes replace its map.
    MaterialInput owner = MaterialInput::BaseColor;
    int channel = 0;     // of an input that reads one: R, G, B or A of the owner's texture
    TexelSource texture; // of owners; empty for others
};

// Nothing for inputs without an image. What is packed reads the very numbers that textures of their
// own would give: each channel is filtered by itself, mipmaps included.
[[nodiscard]] PerInput<std::optional<MapFetch>> mapFetches(const Material& material);

} // namespace patina::render
