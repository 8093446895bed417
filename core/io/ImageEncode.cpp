// The writing half of ImageIO.h: what each format stores is decided here, the worker only encodes.
// PNG, which renders and textures are most of the time, is encoded without it.
#include "core/base/Check.h"
#include "core/base/Limits.h"
#include "core/io/ImageIO.h"
#include "core/io/PngEncoder.h"
#include "core/worker/MemoryFile.h"
#include "core/worker/WorkerClient.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>
#include <utility>

namespace patina {

namespace {

using nlohmann::json;

constexpr float kMaxHalf = 65504.0f;

const char* pluginFor(ImageFileFormat format) {
    switch (format) {
    case ImageFileFormat::Jpeg:
        return "jpeg";
    case ImageFileFormat::Exr:
        return "openexr";
    case ImageFileFormat::Hdr:
        return "hdr";
    case ImageFileFormat::Tiff:
        return "tiff";
    case ImageFileFormat::Tga:
        return "targa";
    case ImageFileFormat::Png:
        break;
    }
    CHECK(false); // encodePng() does it
    return "";
}

// The same picture with other channels: grey is repeated, missing alpha is opaque, surplus is
// dropped.
Image withChannels(const Image& image, int channels) {
    if (image.channels() == channels)
        return image;
    const bool grey = image.channels() <= 2;
    const int alpha = image.channels() == 2 ? 1 : image.channels() == 4 ? 3 : -1;
    const Image floats = convertImage(image, PixelType::F32, image.encoding());
    Image result(image.width(), image.height(), channels, PixelType::F32, image.encoding());
    const auto from = floats.f32();
    const auto to = result.f32();
    const auto fromStep = static_cast<std::size_t>(image.channels());
    const auto toStep = static_cast<std::size_t>(channels);
    for (std::size_t pixel = 0; pixel * fromStep < from.size(); ++pixel)
        for (int c = 0; c < channels; ++c) {
            const bool toAlpha = channels == 4 && c == 3;
            const int source = toAlpha ? alpha : grey ? 0 : c;
            to[pixel * toStep + static_cast<std::size_t>(c)] =
                source < 0 ? 1.0f : from[pixel * fromStep + static_cast<std::size_t>(source)];
        }
    return convertImage(result, image.type(), image.encoding());
}

// 8 and 16 bits as they are where the format can; floats clamped, with the sRGB curve when Linear.
Image forIntegers(const Image& image, ImageFileFormat format) {
    Image result = image;
    const bool wide = format == ImageFileFormat::Png || format == ImageFileFormat::Tiff;
    if (image.type() == PixelType::F32)
        result = convertImage(image, PixelType::U8,
                              image.encoding() == ColorEncoding::Linear ? ColorEncoding::Srgb
                                                                        : image.encoding());
    else if (image.type() == PixelType::U16 && !wide)
        result = convertImage(image, PixelType::U8, image.encoding());
    if (format == ImageFileFormat::Jpeg)
        result = withChannels(result, result.channels() <= 2 ? 1 : 3);
    else if (format == ImageFileFormat::Tga && result.channels() == 2)
        result = withChannels(result, 4);
    return result;
}

Image forFloats(Image image, ImageFileFormat format, bool half) {
    const bool fits = image.type() == PixelType::F32 && image.encoding() == ColorEncoding::Linear;
    Image result =
        fits ? std::move(image) : convertImage(image, PixelType::F32, ColorEncoding::Linear);
    if (format == ImageFileFormat::Hdr) {
        result = withChannels(result, 3);
        sanitizeHdr(result); // RGBE knows neither sign nor NaN
    } else if (half) {
        for (float& sample : result.f32())
            if (!std::isnan(sample)) // beyond the largest half would become infinite
                sample = std::clamp(sample, -kMaxHalf, kMaxHalf);
    }
    return result;
}

std::vector<std::string> exrChannelNames(const Image& image) {
    if (!image.channelNames().empty())
        return image.channelNames();
    switch (image.channels()) {
    case 1:
        return {"Y"};
    case 2:
        return {"Y", "A"};
    case 3:
        return {"R", "G", "B"};
    case 4:
        return {"R", "G", "B", "A"};
    default:
        break;
    }
    std::vector<std::string> names;
    for (int c = 0; c < image.channels(); ++c)
        names.push_back(fmt::format("channel{:04}", c));
    return names;
}

bool distinct(const std::vector<std::string>& names) {
    const std::set<std::string> unique(names.begin(), names.end());
    return unique.size() == names.size() && !unique.contains("");
}

Error misuse(std::string message) {
    return {ErrorKind::Usage, std::move(message), {}, {}};
}

Error noMemory() {
    return {ErrorKind::Internal, "there is not enough memory to save the image", {}, {}};
}

// Images follow each other at multiples of 16 bytes.
std::size_t sizeOnWire(const Image& image) {
    return (image.bytes().size() + 15) / 16 * 16;
}

// The worker with OpenImageIO takes a quarter of a second to start. The other one writes the same
// OpenEXR files, unless an attribute has a meaning for the format.
WorkerKind workerFor(ImageFileFormat format, const std::vector<ImagePart>& parts) {
    const bool plain = std::ranges::all_of(parts, [](const ImagePart& part) {
        return std::ranges::all_of(part.attributes, [](const auto& attribute) {
            return attribute.first.starts_with("patina:");
        });
    });
    return format == ImageFileFormat::Hdr || (format == ImageFileFormat::Exr && plain)
               ? WorkerKind::Image
               : WorkerKind::OpenImageIo;
}

} // namespace

Result<Bytes> encodeImage(WorkerClient& worker, std::vector<ImagePart> parts,
                          ImageFileFormat format, const ImageSaveOptions& options) {
    const bool exr = format == ImageFileFormat::Exr;
    const bool floats = exr || format == ImageFileFormat::Hdr;
    if (parts.empty() || (parts.size() > 1 && !exr))
        return misuse("only OpenEXR files hold several images; save one image per file");
    if (parts.size() > static_cast<std::size_t>(limits::kMaxImageParts))
        return misuse(
            fmt::format("an OpenEXR file holds at most {} parts", limits::kMaxImageParts));

    json descriptions = json::array();
    std::vector<std::string> partNames;
    std::size_t payloadSize = 0;
    try {
        for (ImagePart& part : parts) {
            if (part.image.empty())
                return misuse("there is no image to save");
            if (part.image.channels() > 4 && !exr)
                return misuse("images with more than four channels are saved as OpenEXR");
            part.image = floats ? forFloats(std::move(part.image), format, options.half)
                                : forIntegers(part.image, format);
            const Image& image = part.image;
            std::vector<std::string> channelNames;
            if (exr) {
                channelNames = exrChannelNames(image);
                if (!distinct(channelNames))
                    return misuse("the channels of an OpenEXR file need names of their own");
            }
            partNames.push_back(part.name.empty() && parts.size() > 1
                                    ? fmt::format("part {}", partNames.size() + 1)
                                    : part.name);
            const char* type = image.type() == PixelType::U8    ? "u8"
                               : image.type() == PixelType::U16 ? "u16"
                                                                : "f32";
            descriptions.push_back({{"name", partNames.back()},
                                    {"width", image.width()},
                                    {"height", image.height()},
                                    {"channels", image.channels()},
                                    {"type", type},
                                    {"half", exr && options.half},
                                    {"channelNames", channelNames},
                                    {"attributes", part.attributes}});
            payloadSize += sizeOnWire(image);
            if (payloadSize > limits::kMaxImageBytes)
                return misuse(fmt::format("the image is larger than the supported {} MiB",
                                          limits::kMaxImageBytes >> 20));
        }
        if (format == ImageFileFormat::Png)
            return encodePng(parts.front().image);
        if (parts.size() > 1 && !distinct(partNames))
            return misuse("the parts of an OpenEXR file need names of their own");
        const json header = {{"op", "encodeImage"},
                             {"format", pluginFor(format)},
                             {"jpegQuality", std::clamp(options.jpegQuality, 1, 100)},
                             {"parts", std::move(descriptions)}};
        std::optional<MemoryFile> payload = MemoryFile::create(payloadSize);
        if (!payload)
            return noMemory();
        std::span<std::byte> rest = payload->writable();
        for (ImagePart& part : parts) {
            std::ranges::copy(part.image.bytes(), rest.begin());
            rest = rest.subspan(sizeOnWire(part.image));
            part.image = {}; // large bakes have no room for the same numbers twice
        }
        auto reply =
            worker.request(workerFor(format, parts), header.dump(), *std::move(payload), {});
        if (!reply) {
            Error error = reply.error();
            error.kind = ErrorKind::Internal; // our own pixels: no file is to blame
            return error;
        }
        const std::span<const std::byte> bytes = reply->payload.bytes();
        return Bytes(bytes.begin(), bytes.end());
    } catch (const json::exception& exception) {
        return Error{ErrorKind::Usage,
                     "a name or attribute of the image is no valid UTF-8 text",
                     {},
                     exception.what()};
    } catch (const std::bad_alloc&) {
        return noMemory();
    }
}

Result<Bytes> encodeImage(WorkerClient& worker, const Image& image, ImageFileFormat format,
                          const ImageSaveOptions& options) {
    std::vector<ImagePart> parts(1);
    parts[0].image = image;
    return encodeImage(worker, std::move(parts), format, options);
}

Result<void> saveImage(WorkerClient& worker, const Image& image, const std::filesystem::path& file,
                       const ImageSaveOptions& options) {
    const auto format = imageFormatForPath(file);
    if (!format)
        return format.error();
    const auto bytes = encodeImage(worker, image, *format, options);
    if (!bytes) {
        Error error = bytes.error();
        error.file = file;
        return error;
    }
    return writeFileAtomically(file, *bytes);
}

} // namespace patina
