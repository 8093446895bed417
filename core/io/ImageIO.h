// Reading and writing image files. Files are guests: decoding happens in the isolated worker
// process (core/worker), and what comes back is validated before it is believed.
#pragma once

#include "core/base/AtomicFile.h"
#include "core/base/Result.h"
#include "core/image/Image.h"
#include "core/job/JobContext.h"

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace patina {

class WorkerClient;

// One part (EXR) of an image file with its string attributes ("patina:basis" …); OpenEXR's `envmap`
// ("latlong", "cube") and `chromaticities` (CIE xy of red, green, blue, white) are among them, and
// as text a photo's exposure (core/bracket/PhotoExposure.h). An envmap attribute is written, too.
// OpenEXR sorts the channels of a part: after reading they are found by name, not by place. Alpha
// is never multiplied into the colour, neither here nor there.
struct ImagePart {
    std::string name; // EXR part name, otherwise empty
    Image image;
    std::map<std::string, std::string> attributes;
};

struct LoadedImage {
    std::vector<ImagePart> parts;     // at least one
    std::size_t sanitizedSamples = 0; // NaN, Inf and negative samples replaced (sanitizeHdr)
    std::string format;               // "png", "openexr", "hdr" …
    [[nodiscard]] const Image& image() const { return parts.front().image; }
};

struct ImageLoadOptions {
    // Integer files get this encoding; floating-point files are always Linear.
    ColorEncoding integerEncoding = ColorEncoding::Data;
    // Colour and environment images: replace NaN, negative and infinite samples. Off for bake
    // files, whose coefficients are signed.
    bool sanitize = true;
    bool allParts = false; // read every EXR part, not only the first
    // Environment: of an EXR file the first part with colour (R, G, B or Y), of every file only
    // these channels.
    bool colorOnly = false;
    // Floating-point images with longer sides are averaged down to it while they are read, keeping
    // their proportions; 0: never.
    int maxSide = 0;
};

// PNG, JPEG, TGA, TIFF, OpenEXR, Radiance HDR, PFM, PSD, DDS, BMP, WebP; 8/16 bit integer, half,
// float. Errors: InputMissing, InputBroken (damaged, not an image, beyond the limits, decoder
// died), Cancelled.
Result<LoadedImage> loadImage(WorkerClient& worker, const std::filesystem::path& file,
                              const ImageLoadOptions& options = {}, const JobContext& job = {});
// The same from memory (textures embedded in a model); `name` stands in messages.
Result<LoadedImage> loadImageFromMemory(WorkerClient& worker, std::span<const std::byte> data,
                                        const std::string& name,
                                        const ImageLoadOptions& options = {});

struct ImageInMemory {
    std::span<const std::byte> data;
    std::string name; // stands in messages
    ImageLoadOptions options;
};
// Small images of the commonest formats, which cost less to decode than to start a process for.
[[nodiscard]] bool mayLoadTogether(const ImageInMemory& image);
// What loadImageFromMemory() says of each. One process decodes all of them where they may be loaded
// together, so they should be of one origin: a file that takes over its decoder sees the others.
std::vector<Result<LoadedImage>> loadImagesFromMemory(WorkerClient& worker,
                                                      std::span<const ImageInMemory> images);

struct ImageInfo {
    int width = 0, height = 0, channels = 0;
    std::string pixelType; // as stored in the file: "uint8", "half", "float" …
    std::string format;
    std::vector<std::string> channelNames;
    std::vector<std::string> partNames;
    std::map<std::string, std::string> attributes; // of the first part
};
Result<ImageInfo> inspectImage(WorkerClient& worker, const std::filesystem::path& file);

enum class ImageFileFormat { Png, Jpeg, Exr, Hdr, Tiff, Tga };
// By extension, case-insensitively; Usage error naming the supported ones otherwise.
Result<ImageFileFormat> imageFormatForPath(const std::filesystem::path& file);
[[nodiscard]] bool isLinearFormat(ImageFileFormat format); // its pictures are not tone mapped

struct ImageSaveOptions {
    bool half = false; // EXR: store 16-bit floats
    int jpegQuality = 92;
};
// Encodes in the worker, Png here. Png, Jpeg, Tga: U8 (Png, Tiff also U16) is stored as it is, F32
// is clamped and encoded as sRGB when Linear, taken as it is when Data. Exr, Hdr: linear floats.
Result<Bytes> encodeImage(WorkerClient& worker, std::vector<ImagePart> parts,
                          ImageFileFormat format, const ImageSaveOptions& options = {});
Result<Bytes> encodeImage(WorkerClient& worker, const Image& image, ImageFileFormat format,
                          const ImageSaveOptions& options = {});
// encodeImage + writeFileAtomically, format from the extension.
Result<void> saveImage(WorkerClient& worker, const Image& image, const std::filesystem::path& file,
                       const ImageSaveOptions& options = {});

} // namespace patina
