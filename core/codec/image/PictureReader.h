// A picture file as decodePicture() sees it, whichever library reads it.
#pragma once

#include "core/image/AreaFilter.h"

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace patina::codec {

// What samples are handed over as.
enum class SampleKind { U8, U16, F32 };
[[nodiscard]] constexpr std::size_t sizeOf(SampleKind kind) {
    return kind == SampleKind::U8 ? 1 : kind == SampleKind::U16 ? 2 : 4;
}
[[nodiscard]] const char* nameOf(SampleKind kind);

// One part of a file, as OpenImageIO describes it: data window, display window, channels.
struct PictureSpec {
    int x = 0, y = 0, width = 0, height = 0;
    int fullX = 0, fullY = 0, fullWidth = 0, fullHeight = 0;
    bool hasOwnSize = false; // its display window is only that of the largest part (kOwnSize)
    SampleKind kind = SampleKind::U8;
    std::string stored; // the type in the file: "uint8", "half" …
    std::string name;
    std::vector<std::string> channelNames;
    std::map<std::string, std::string> attributes;
    int tileHeight = 0; // 0: not tiled

    [[nodiscard]] int channels() const { return static_cast<int>(channelNames.size()); }
};

struct Channels {
    int first = 0, count = 0;
};

// Throws Refusal and std::bad_alloc; those of the worker for images throw HandOn, too.
class PictureReader {
  public:
    PictureReader() = default;
    virtual ~PictureReader() = default;
    PictureReader(const PictureReader&) = delete;
    PictureReader& operator=(const PictureReader&) = delete;

    // Part `index` of the file; null where there is none. Valid until the next call.
    virtual const PictureSpec* part(int index) = 0;
    // All pixels of the data window, as the spec's kind.
    virtual void read(int index, Channels channels, std::span<std::byte> pixels) = 0;
    // Rows [begin, end) of the data window, from its top. Only of parts of kind F32.
    virtual void readRows(int index, Channels channels, int begin, int end,
                          std::span<float> samples) = 0;
    // What the library said last; may be empty.
    virtual std::string problem() { return {}; }
};

// All parts of an OpenEXR file share one display window. Parts of different sizes are marked with
// this attribute: each has its data window's size.
inline constexpr const char* kOwnSize = "patina:size";

// The attribute that says how a picture covers all directions ("latlong", "cube").
inline constexpr const char* kEnvmap = "envmap";

// How a photo was exposed, in Exif: seconds, f-number, ISO. Names as OpenImageIO has them; the last
// two are the same tag, before and after Exif 2.3.
inline constexpr const char* kExposure[] = {"ExposureTime", "FNumber",
                                            "Exif:PhotographicSensitivity", "Exif:ISOSpeedRatings"};

// Whether a text attribute is part of how a file is stored rather than of its content.
[[nodiscard]] bool isStorage(std::string_view attribute);

} // namespace patina::codec
