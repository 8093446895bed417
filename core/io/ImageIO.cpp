#include "core/io/ImageIO.h"

#include "core/base/InputFile.h"
#include "core/base/Limits.h"
#include "core/base/LowerCase.h"
#include "core/worker/WorkerClient.h"
#include "core/worker/WorkerProtocol.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

namespace patina {

namespace {

using nlohmann::json;

// Compressed files beyond this hold more than the largest supported image.
constexpr std::size_t kMaxFileBytes = 2 * limits::kMaxImageBytes;

// A Targa file has no magic number: its name and a header that makes sense must do. Byte 1 is the
// kind of palette, byte 2 the kind of image, byte 16 the bits per pixel.
bool looksLikeTarga(std::string_view head, const std::string& extension) {
    constexpr std::size_t kHeader = 18;
    if (extension != ".tga" || head.size() < kHeader)
        return false;
    const int palette = head[1];
    const int kind = head[2];
    const int bits = head[16];
    const bool knownKind = (kind >= 1 && kind <= 3) || (kind >= 9 && kind <= 11);
    return (palette == 0 || palette == 1) && knownKind &&
           (bits == 8 || bits == 15 || bits == 16 || bits == 24 || bits == 32);
}

// The format by content, whatever the file is called; empty when it is none of ours.
std::string formatOf(std::string_view head, const std::string& extension) {
    using namespace std::string_view_literals;
    static constexpr std::array<std::pair<std::string_view, const char*>, 14> kMagic{{
        {"\x89PNG\r\n\x1a\n"sv, "png"},
        {"\xff\xd8\xff"sv, "jpeg"},
        {"\x76\x2f\x31\x01"sv, "openexr"},
        {"#?"sv, "hdr"},
        {"II*\0"sv, "tiff"},
        {"MM\0*"sv, "tiff"},
        {"II+\0"sv, "tiff"},
        {"8BPS"sv, "psd"},
        {"DDS "sv, "dds"},
        {"BM"sv, "bmp"},
        {"PF\n"sv, "pfm"},
        {"Pf\n"sv, "pfm"},
        {"PF\r"sv, "pfm"},
        {"Pf\r"sv, "pfm"},
    }};
    for (const auto& [magic, format] : kMagic)
        if (head.starts_with(magic))
            return format;
    if (head.starts_with("RIFF") && head.substr(8).starts_with("WEBP"))
        return "webp";
    return looksLikeTarga(head, extension) ? "targa" : std::string();
}

Error notAnImage(const std::filesystem::path& file) {
    return {ErrorKind::InputBroken,
            "this is no image of a supported kind (PNG, JPEG, TGA, TIFF, OpenEXR, Radiance HDR, "
            "PFM, PSD, DDS, BMP, WebP)",
            file,
            {}};
}

// One part of the answer, believed only as far as the bytes go.
ImagePart readPart(const json& entry, std::span<const std::byte> payload, bool floatIsLinear,
                   ColorEncoding integerEncoding) {
    const int width = entry.at("width");
    const int height = entry.at("height");
    const int channels = entry.at("channels");
    const auto offset = entry.at("offset").get<std::size_t>();
    const std::string typeName = entry.at("type");
    const PixelType type = typeName == "u8"    ? PixelType::U8
                           : typeName == "u16" ? PixelType::U16
                                               : PixelType::F32;
    const std::size_t sampleSize = type == PixelType::U8 ? 1 : type == PixelType::U16 ? 2 : 4;
    if (width <= 0 || height <= 0 || channels <= 0 || width > limits::kMaxImageSide ||
        height > limits::kMaxImageSide || channels > limits::kMaxImageChannels)
        throw std::runtime_error("a size out of range");
    const std::size_t size = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                             static_cast<std::size_t>(channels) * sampleSize;
    if (size > limits::kMaxImageBytes || offset > payload.size() || size > payload.size() - offset)
        throw std::runtime_error("pixels are missing");

    ImagePart part;
    part.name = entry.at("name");
    part.image =
        Image(width, height, channels, type,
              floatIsLinear && type == PixelType::F32 ? ColorEncoding::Linear : integerEncoding);
    std::memcpy(part.image.bytes().data(), payload.data() + offset, size);
    auto names = entry.at("channelNames").get<std::vector<std::string>>();
    if (names.size() == static_cast<std::size_t>(channels))
        part.image.setChannelNames(std::move(names));
    part.attributes = entry.at("attributes").get<std::map<std::string, std::string>>();
    return part;
}

using Send = std::function<Result<WorkerClient::Reply>(WorkerKind, const std::string& header)>;

// What the worker for images reads itself, unless there is something special about the file: the
// other one takes a quarter of a second to start.
bool isCommon(const std::string& format) {
    return format == "png" || format == "jpeg" || format == "openexr" || format == "hdr" ||
           format == "pfm";
}

json requestOf(const std::string& format, const ImageLoadOptions& options, bool inspect) {
    return {{"op", "decodeImage"},          {"format", format},
            {"allParts", options.allParts}, {"colorOnly", options.colorOnly},
            {"maxSide", options.maxSide},   {"inspect", inspect}};
}

Result<WorkerClient::Reply> decode(const Send& send, const std::string& format,
                                   const ImageLoadOptions& options, bool inspect) {
    const json header = requestOf(format, options, inspect);
    if (isCommon(format))
        if (auto reply = send(WorkerKind::Image, header.dump());
            !reply || reply->header != protocol::kHandOn)
            return reply;
    return send(WorkerKind::OpenImageIo, header.dump());
}

// What a request says about its answer: `use` may throw.
template <class T, class Use>
Result<T> believe(const std::string& header, const std::filesystem::path& file, Use use) {
    try {
        return use(json::parse(header));
    } catch (const std::bad_alloc&) {
        return Error{ErrorKind::Internal, "there is not enough memory for the image", file, {}};
    } catch (const std::exception& exception) {
        return Error{ErrorKind::InputBroken,
                     "the decoder gave an answer that makes no sense; the file is damaged", file,
                     exception.what()};
    }
}

Result<LoadedImage> loadedFrom(const std::string& answer, std::span<const std::byte> payload,
                               const std::string& format, const std::filesystem::path& file,
                               const ImageLoadOptions& options) {
    return believe<LoadedImage>(answer, file, [&](const json& header) {
        LoadedImage loaded;
        loaded.format = format;
        // Only files of floating-point formats name their channels on purpose.
        for (const json& entry : header.at("parts")) {
            ImagePart part = readPart(entry, payload, true, options.integerEncoding);
            if (format != "openexr")
                part.image.setChannelNames({});
            if (options.sanitize)
                loaded.sanitizedSamples += sanitizeHdr(part.image);
            loaded.parts.push_back(std::move(part));
        }
        if (loaded.parts.empty())
            throw std::runtime_error("no image");
        return loaded;
    });
}

Result<LoadedImage> load(const Send& send, const std::string& format,
                         const std::filesystem::path& file, const ImageLoadOptions& options) {
    const auto reply = decode(send, format, options, false);
    if (!reply)
        return reply.error();
    return loadedFrom(reply->header, reply->payload.bytes(), format, file, options);
}

std::string formatOf(std::span<const std::byte> data, const std::string& name) {
    constexpr std::size_t kHead = 64;
    return formatOf(
        std::string_view(reinterpret_cast<const char*>(data.data()), std::min(data.size(), kHead)),
        extensionOf(name));
}

// Several images of bytes to one child. Those that it does not answer for are empty.
std::vector<std::optional<Result<LoadedImage>>>
loadTogether(WorkerClient& worker, std::span<const ImageInMemory> images) {
    std::vector<std::optional<Result<LoadedImage>>> results(images.size());
    std::vector<std::byte> payload;
    json list = json::array();
    for (const ImageInMemory& image : images) {
        list.push_back(
            {{"size", image.data.size()},
             {"request", requestOf(formatOf(image.data, image.name), image.options, false)}});
        payload.insert(payload.end(), image.data.begin(), image.data.end());
    }
    const json header = {{"op", "decodeImages"}, {"images", std::move(list)}};
    const auto reply =
        worker.request(WorkerKind::Image, header.dump(), payload, images.front().name);
    if (!reply)
        return results; // one of them may be to blame: each is tried alone
    try {
        const json answer = json::parse(reply->header);
        std::span<const std::byte> rest = reply->payload.bytes();
        for (std::size_t i = 0; i < images.size(); ++i) {
            const json& one = answer.at("images").at(i);
            if (one.is_null())
                continue;
            const auto size = one.at("size").get<std::size_t>();
            if (size > rest.size())
                throw std::runtime_error("pixels are missing");
            const ImageInMemory& image = images[i];
            results[i] = loadedFrom(one.at("header").get<std::string>(), rest.first(size),
                                    formatOf(image.data, image.name), image.name, image.options);
            rest = rest.subspan(size);
        }
    } catch (const json::exception&) {
        results.assign(images.size(), std::nullopt);
    } catch (const std::runtime_error&) {
        results.assign(images.size(), std::nullopt);
    }
    return results;
}

} // namespace

Result<LoadedImage> loadImage(WorkerClient& worker, const std::filesystem::path& file,
                              const ImageLoadOptions& options, const JobContext& job) {
    const auto input = openInputFile(file, kMaxFileBytes);
    if (!input)
        return input.error();
    const std::string format = formatOf(input->head, extensionOf(file));
    if (format.empty())
        return notAnImage(file);
    return load(
        [&](WorkerKind kind, const std::string& header) {
            return worker.request(kind, header, input->fd.get(), file, job);
        },
        format, file, options);
}

Result<LoadedImage> loadImageFromMemory(WorkerClient& worker, std::span<const std::byte> data,
                                        const std::string& name, const ImageLoadOptions& options) {
    if (data.empty())
        return Error{ErrorKind::InputBroken, "the embedded image is empty", name, {}};
    const std::string format = formatOf(data, name);
    if (format.empty())
        return notAnImage(name);
    return load([&](WorkerKind kind,
                    const std::string& header) { return worker.request(kind, header, data, name); },
                format, name, options);
}

bool mayLoadTogether(const ImageInMemory& image) {
    constexpr std::size_t kSmall = std::size_t{64} << 10;
    const std::string format =
        image.data.empty() ? std::string() : formatOf(image.data, image.name);
    return image.data.size() <= kSmall && (format == "png" || format == "jpeg");
}

std::vector<Result<LoadedImage>> loadImagesFromMemory(WorkerClient& worker,
                                                      std::span<const ImageInMemory> images) {
    std::vector<std::optional<Result<LoadedImage>>> together(images.size());
    if (images.size() > 1 && std::ranges::all_of(images, mayLoadTogether))
        together = loadTogether(worker, images);
    std::vector<Result<LoadedImage>> results;
    for (std::size_t i = 0; i < images.size(); ++i) {
        const ImageInMemory& image = images[i];
        results.push_back(together[i]
                              ? *std::move(together[i])
                              : loadImageFromMemory(worker, image.data, image.name, image.options));
    }
    return results;
}

Result<ImageInfo> inspectImage(WorkerClient& worker, const std::filesystem::path& file) {
    const auto input = openInputFile(file, kMaxFileBytes);
    if (!input)
        return input.error();
    const std::string format = formatOf(input->head, extensionOf(file));
    if (format.empty())
        return notAnImage(file);
    const auto reply = decode(
        [&](WorkerKind kind, const std::string& header) {
            return worker.request(kind, header, input->fd.get(), file);
        },
        format, {}, true);
    if (!reply)
        return reply.error();
    return believe<ImageInfo>(reply->header, file, [&](const json& header) {
        ImageInfo info;
        info.format = format;
        const json& parts = header.at("parts");
        const json& first = parts.at(0);
        info.width = first.at("width");
        info.height = first.at("height");
        info.channels = first.at("channels");
        info.pixelType = first.at("stored");
        info.channelNames = first.at("channelNames").get<std::vector<std::string>>();
        info.attributes = first.at("attributes").get<std::map<std::string, std::string>>();
        for (const json& part : parts)
            info.partNames.push_back(part.at("name"));
        return info;
    });
}

Result<ImageFileFormat> imageFormatForPath(const std::filesystem::path& file) {
    static const std::map<std::string, ImageFileFormat> kFormats{
        {".png", ImageFileFormat::Png},   {".jpg", ImageFileFormat::Jpeg},
        {".jpeg", ImageFileFormat::Jpeg}, {".exr", ImageFileFormat::Exr},
        {".hdr", ImageFileFormat::Hdr},   {".tif", ImageFileFormat::Tiff},
        {".tiff", ImageFileFormat::Tiff}, {".tga", ImageFileFormat::Tga}};
    const auto it = kFormats.find(extensionOf(file));
    if (it == kFormats.end())
        return Error{ErrorKind::Usage,
                     "images are written as .png, .jpg, .exr, .hdr, .tif or .tga; choose one of "
                     "these endings",
                     file,
                     {}};
    return it->second;
}

bool isLinearFormat(ImageFileFormat format) {
    return format == ImageFileFormat::Exr || format == ImageFileFormat::Hdr;
}

} // namespace patina
