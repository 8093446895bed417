// The only file that sees OpenImageIO.
#include "core/base/Limits.h"
#include "core/worker/Codec.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <array>
#include <cstring>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/mman.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

namespace patina::codec {

namespace {

using nlohmann::json;

// The only formats whose readers are ever created, so that OpenImageIO never probes all of them.
constexpr std::array<const char*, 10> kReaders{"png",   "jpeg", "openexr", "hdr", "tiff",
                                               "targa", "psd",  "dds",     "bmp", "webp"};
constexpr std::array<const char*, 6> kWriters{"png", "jpeg", "openexr", "hdr", "tiff", "targa"};

// A few threads: a child works on one file, several children run at once.
void allowThreads() {
    const int count = static_cast<int>(std::min(4u, std::thread::hardware_concurrency()));
    OIIO::attribute("threads", std::max(1, count));
    OIIO::attribute("exr_threads", std::max(1, count));
}

struct Sample {
    const char* name;
    OIIO::TypeDesc type;
    std::size_t size;
};

// What samples are handed over as: 8 and 16 bits stay, everything else becomes float.
Sample sampleFor(const OIIO::ImageSpec& spec) {
    const bool mixed = std::any_of(spec.channelformats.begin(), spec.channelformats.end(),
                                   [&](const auto& f) { return f != spec.format; });
    if (!mixed && (spec.format == OIIO::TypeDesc::UINT8 || spec.format == OIIO::TypeDesc::INT8))
        return {"u8", OIIO::TypeDesc::UINT8, 1};
    if (!mixed && (spec.format == OIIO::TypeDesc::UINT16 || spec.format == OIIO::TypeDesc::INT16))
        return {"u16", OIIO::TypeDesc::UINT16, 2};
    return {"f32", OIIO::TypeDesc::FLOAT, 4};
}

Sample sampleNamed(const std::string& name) {
    if (name == "u8")
        return {"u8", OIIO::TypeDesc::UINT8, 1};
    if (name == "u16")
        return {"u16", OIIO::TypeDesc::UINT16, 2};
    return {"f32", OIIO::TypeDesc::FLOAT, 4};
}

// All parts of an OpenEXR file share one display window. Parts of different sizes are marked with
// this attribute: each has its data window's size.
constexpr const char* kOwnSize = "patina:size";

// The picture as it is to be shown: the display window where it differs from the data window.
struct Frame {
    int width = 0, height = 0;
    int left = 0, top = 0; // of the data window inside the frame
    bool cropped = false;
};

Frame frameOf(const OIIO::ImageSpec& spec) {
    Frame frame{spec.width, spec.height, 0, 0, false};
    if (!spec.get_string_attribute(kOwnSize).empty())
        return frame;
    if (spec.full_width > 0 && spec.full_height > 0 &&
        (spec.full_width != spec.width || spec.full_height != spec.height ||
         spec.full_x != spec.x || spec.full_y != spec.y)) {
        frame.width = spec.full_width;
        frame.height = spec.full_height;
        const auto offset = [](long long a, long long b) {
            return static_cast<int>(std::clamp<long long>(a - b, INT32_MIN, INT32_MAX));
        };
        frame.left = offset(spec.x, spec.full_x);
        frame.top = offset(spec.y, spec.full_y);
        frame.cropped = true;
    }
    return frame;
}

void checkSize(long long width, long long height, long long channels, std::size_t sampleSize) {
    if (width <= 0 || height <= 0 || channels <= 0)
        throw Refusal("the file claims a size that makes no sense; it is damaged",
                      fmt::format("{} x {} x {}", width, height, channels));
    if (width > limits::kMaxImageSide || height > limits::kMaxImageSide)
        throw Refusal(fmt::format("the image has {} x {} pixels; the largest supported side is {}",
                                  width, height, limits::kMaxImageSide));
    if (channels > limits::kMaxImageChannels)
        throw Refusal(fmt::format("the image has {} channels; at most {} are supported", channels,
                                  limits::kMaxImageChannels));
    const auto bytes = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                       static_cast<std::size_t>(channels) * sampleSize;
    if (bytes > limits::kMaxImageBytes)
        throw Refusal(fmt::format("the image needs {} MiB of memory; at most {} MiB are supported",
                                  bytes >> 20, limits::kMaxImageBytes >> 20));
}

// String attributes that are part of the file's content rather than of how it is stored.
json attributesOf(const OIIO::ImageSpec& spec) {
    json result = json::object();
    for (const auto& attribute : spec.extra_attribs) {
        const std::string name = attribute.name().string();
        const bool storage = name.starts_with("oiio:") || name.starts_with("openexr:") ||
                             name == "name" || name == "compression" || name == "textureformat" ||
                             name == "wrapmodes" || name == "ICCProfile" || name == "DateTime" ||
                             name == kOwnSize;
        if (!storage && attribute.type() == OIIO::TypeDesc::STRING)
            result[name] = attribute.get_string();
    }
    return result;
}

json describe(const OIIO::ImageSpec& spec) {
    const std::string pixelType = spec.format.c_str();
    const Frame frame = frameOf(spec);
    return {{"name", spec.get_string_attribute("oiio:subimagename")},
            {"width", frame.width},
            {"height", frame.height},
            {"channels", spec.nchannels},
            {"channelNames", spec.channelnames},
            {"stored", pixelType},
            {"attributes", attributesOf(spec)}};
}

// Radiance files may store their rows and columns in another order (Exif's orientations 1…4 are
// the ones without transposition); the picture is turned so that row 0 is the top.
void orient(std::span<std::byte> pixels, const Frame& frame, std::size_t pixelSize,
            int orientation) {
    const auto width = static_cast<std::size_t>(frame.width);
    const auto height = static_cast<std::size_t>(frame.height);
    const std::size_t row = width * pixelSize;
    if (orientation == 3 || orientation == 4)
        for (std::size_t y = 0; y < height / 2; ++y)
            std::swap_ranges(pixels.data() + y * row, pixels.data() + (y + 1) * row,
                             pixels.data() + (height - 1 - y) * row);
    if (orientation == 2 || orientation == 3)
        for (std::size_t y = 0; y < height; ++y)
            for (std::size_t x = 0; x < width / 2; ++x) {
                std::byte* a = pixels.data() + y * row + x * pixelSize;
                std::byte* b = pixels.data() + y * row + (width - 1 - x) * pixelSize;
                std::swap_ranges(a, a + pixelSize, b);
            }
}

// libjpeg fills what a cut-off file lacks with grey and calls it a warning; the end marker tells.
void requireJpegEnd(int fd) {
    struct stat status {};
    if (::fstat(fd, &status) != 0)
        return;
    constexpr off_t kTail = 1 << 16; // cameras append a little
    std::array<unsigned char, kTail> tail{};
    const off_t begin = std::max<off_t>(0, status.st_size - kTail);
    const ssize_t size = ::pread(fd, tail.data(), tail.size(), begin);
    for (ssize_t i = size - 2; i >= 0; --i)
        if (tail[static_cast<std::size_t>(i)] == 0xff &&
            tail[static_cast<std::size_t>(i) + 1] == 0xd9)
            return;
    throw Refusal("the file is damaged or cut short; save or download it again",
                  "jpeg: no end-of-image marker");
}

// The first line of what the library says: some repeat themselves for each row.
std::string libraryText(const std::string& format, std::string error) {
    constexpr std::size_t kLongest = 300;
    error.resize(std::min({error.size(), error.find('\n'), kLongest}));
    return error.empty() ? format : format + ": " + error;
}

struct PartLayout {
    OIIO::ImageSpec spec;
    Frame frame;
    Sample sample;
    std::size_t offset = 0, size = 0;
};

void readPart(OIIO::ImageInput& input, const std::string& format, int index, const PartLayout& part,
              std::span<std::byte> target) {
    // OpenImageIO 2.4 says of a TIFF with missing strips that it was read, but keeps the error.
    const auto read = [&](std::byte* pixels) {
        const bool ok =
            input.read_image(index, 0, 0, part.spec.nchannels, part.sample.type, pixels);
        if (!ok || input.has_error())
            throw Refusal("the file is damaged or cut short; save or download it again",
                          libraryText(format, input.geterror()));
    };
    const std::size_t pixelSize = static_cast<std::size_t>(part.spec.nchannels) * part.sample.size;
    if (!part.frame.cropped) {
        read(target.data());
        return;
    }
    checkSize(part.spec.width, part.spec.height, part.spec.nchannels, part.sample.size);
    std::vector<std::byte> data(static_cast<std::size_t>(part.spec.width) *
                                static_cast<std::size_t>(part.spec.height) * pixelSize);
    read(data.data());
    const long long left = std::max(0, part.frame.left);
    const long long right = std::min<long long>(
        part.frame.width, static_cast<long long>(part.frame.left) + part.spec.width);
    for (int y = 0; y < part.frame.height; ++y) {
        const long long sourceY = static_cast<long long>(y) - part.frame.top;
        if (sourceY < 0 || sourceY >= part.spec.height || left >= right)
            continue;
        const auto from =
            static_cast<std::size_t>(sourceY * part.spec.width + left - part.frame.left);
        const auto to =
            static_cast<std::size_t>(static_cast<long long>(y) * part.frame.width + left);
        std::memcpy(target.data() + to * pixelSize, data.data() + from * pixelSize,
                    static_cast<std::size_t>(right - left) * pixelSize);
    }
}

void shareDisplayWindow(std::vector<OIIO::ImageSpec>& specs) {
    int width = 0;
    int height = 0;
    bool differ = false;
    for (const OIIO::ImageSpec& spec : specs) {
        differ = differ || spec.width != specs[0].width || spec.height != specs[0].height;
        width = std::max(width, spec.width);
        height = std::max(height, spec.height);
    }
    if (!differ)
        return;
    for (OIIO::ImageSpec& spec : specs) {
        spec.full_width = width;
        spec.full_height = height;
        spec.attribute(kOwnSize, "data window");
    }
}

} // namespace

void prepareImageCodec() {
    // No threads before the fork.
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);
    for (const char* name : kReaders)
        (void)OIIO::ImageInput::create(name);
    (void)OIIO::geterror();
}

Reply decodeImage(const json& request, int payloadFd) {
    const auto format = request.at("format").get<std::string>();
    if (std::find(kReaders.begin(), kReaders.end(), format) == kReaders.end())
        throw Refusal("this image format is not supported", format);
    allowThreads();
    auto input = OIIO::ImageInput::create(format);
    if (!input)
        throw Refusal("this image format is not supported", OIIO::geterror());

    // PNG, TIFF … store colour that is not multiplied by alpha; it is wanted as it is.
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    OIIO::ImageSpec first;
    if (!input->open(fmt::format("/proc/self/fd/{}", payloadFd), first, config))
        throw Refusal("the file is damaged or not an image of this kind",
                      libraryText(format, input->geterror()));

    const bool inspect = request.value("inspect", false);
    const bool allParts = inspect || (request.value("allParts", false) && format == "openexr");

    // Sizes first, of all parts, before anything is allocated.
    std::vector<PartLayout> parts;
    std::size_t total = 0;
    json descriptions = json::array();
    for (int index = 0; index == 0 || allParts; ++index) {
        if (!input->seek_subimage(index, 0))
            break;
        if (index >= limits::kMaxImageParts)
            throw Refusal(fmt::format("the file has more than {} parts", limits::kMaxImageParts));
        PartLayout part{input->spec(), {}, {}, 0, 0};
        part.frame = frameOf(part.spec);
        part.sample = sampleFor(part.spec);
        if (part.spec.deep)
            throw Refusal("deep images are not supported; flatten the file first");
        if (part.spec.depth > 1)
            throw Refusal("volume images are not supported");
        checkSize(part.spec.width, part.spec.height, part.spec.nchannels, part.sample.size);
        checkSize(part.frame.width, part.frame.height, part.spec.nchannels, part.sample.size);
        part.offset = total;
        part.size = static_cast<std::size_t>(part.frame.width) *
                    static_cast<std::size_t>(part.frame.height) *
                    static_cast<std::size_t>(part.spec.nchannels) * part.sample.size;
        if (!inspect) {
            total += (part.size + 15) / 16 * 16;
            if (total > limits::kMaxImageBytes)
                throw Refusal("the parts of the file together need too much memory");
        }
        json entry = describe(part.spec);
        entry["type"] = part.sample.name;
        entry["offset"] = part.offset;
        descriptions.push_back(std::move(entry));
        parts.push_back(std::move(part));
    }
    if (parts.empty())
        throw Refusal("the file holds no image", libraryText(format, input->geterror()));

    Reply reply;
    reply.header = toJsonText({{"format", format}, {"parts", descriptions}});
    reply.payload = allocate(total);
    if (inspect)
        return reply;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto target = reply.payload.writable().subspan(parts[i].offset, parts[i].size);
        readPart(*input, format, static_cast<int>(i), parts[i], target);
        if (format == "hdr")
            orient(target, parts[i].frame,
                   static_cast<std::size_t>(parts[i].spec.nchannels) * parts[i].sample.size,
                   parts[i].spec.get_int_attribute("Orientation", 1));
    }
    if (format == "jpeg")
        requireJpegEnd(payloadFd);
    return reply;
}

Reply encodeImage(const json& request, std::span<const std::byte> payload) {
    const auto format = request.at("format").get<std::string>();
    if (std::find(kWriters.begin(), kWriters.end(), format) == kWriters.end())
        throw Refusal("this image format cannot be written", format);
    allowThreads();

    std::vector<OIIO::ImageSpec> specs;
    std::vector<Sample> samples;
    for (const json& part : request.at("parts")) {
        const Sample sample = sampleNamed(part.at("type"));
        OIIO::ImageSpec spec(part.at("width"), part.at("height"), part.at("channels"),
                             part.at("half").get<bool>() ? OIIO::TypeDesc(OIIO::TypeDesc::HALF)
                                                         : sample.type);
        if (!part.at("channelNames").empty())
            spec.channelnames = part.at("channelNames").get<std::vector<std::string>>();
        spec.attribute("oiio:UnassociatedAlpha", 1);
        // Or it would be the time of writing: the same picture in other bytes.
        spec.attribute("DateTime", format == "tiff" ? "1970:01:01 00:00:00" : "");
        // PNG marks sRGB in a chunk. (In TIFF it would become an Exif directory, over which readers
        // stumble.)
        if (format == "png" && part.at("srgb").get<bool>())
            spec.attribute("oiio:ColorSpace", "sRGB");
        if (format == "openexr") {
            spec.attribute("compression", "zip");
            if (const auto name = part.at("name").get<std::string>(); !name.empty()) {
                spec.attribute("name", name);
                spec.attribute("oiio:subimagename", name);
            }
            for (const auto& [key, value] : part.at("attributes").items())
                spec.attribute(key, value.get<std::string>());
        } else if (format == "jpeg") {
            spec.attribute("Compression",
                           fmt::format("jpeg:{}", request.at("jpegQuality").get<int>()));
            spec.attribute("jpeg:subsampling", "4:4:4"); // no colour bleeding in textures
        } else if (format == "tiff") {
            spec.attribute("compression", "zip");
        }
        specs.push_back(std::move(spec));
        samples.push_back(sample);
    }

    shareDisplayWindow(specs);

    auto output = OIIO::ImageOutput::create(format);
    if (!output)
        throw Refusal("this image format cannot be written", OIIO::geterror());
    // OpenImageIO writes into memory, except OpenEXR files of several parts: those it opens by name
    // only, which here is the name of a memory file.
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput proxy(bytes);
    const bool byName = specs.size() > 1;
    FileDescriptor named;
    std::string name = "memory." + format;
    if (byName) {
        named = FileDescriptor(::memfd_create("patina-exr", MFD_CLOEXEC | MFD_ALLOW_SEALING));
        name = fmt::format("/proc/self/fd/{}", named.get());
    } else {
        output->set_ioproxy(&proxy);
    }
    const auto check = [&](bool ok) {
        if (!ok)
            throw Refusal("the image cannot be encoded", libraryText(format, output->geterror()));
    };
    if (specs.size() == 1)
        check(output->open(name, specs[0]));
    else
        check(output->open(name, static_cast<int>(specs.size()), specs.data()));
    std::size_t offset = 0;
    for (std::size_t i = 0; i < specs.size(); ++i) {
        if (i > 0)
            check(output->open(name, specs[i], OIIO::ImageOutput::AppendSubimage));
        const std::size_t size = static_cast<std::size_t>(specs[i].width) *
                                 static_cast<std::size_t>(specs[i].height) *
                                 static_cast<std::size_t>(specs[i].nchannels) * samples[i].size;
        if (offset + size > payload.size())
            throw Refusal("the image cannot be encoded", "pixels are missing");
        check(output->write_image(samples[i].type, payload.data() + offset));
        offset += (size + 15) / 16 * 16;
    }
    check(output->close());

    Reply reply;
    reply.header = "{}";
    if (byName) {
        struct stat status {};
        if (::fstat(named.get(), &status) != 0)
            throw std::bad_alloc();
        auto file =
            MemoryFile::open(std::move(named), static_cast<std::size_t>(status.st_size), false);
        if (!file)
            throw std::bad_alloc();
        reply.payload = std::move(*file);
        return reply;
    }
    reply.payload = allocate(bytes.size());
    if (!bytes.empty())
        std::memcpy(reply.payload.writable().data(), bytes.data(), bytes.size());
    return reply;
}

} // namespace patina::codec
