// The only file that sees OpenImageIO.
#include "core/codec/image/ImageCodec.h"
#include "core/base/Limits.h"
#include "core/codec/image/LuminanceChroma.h"
#include "core/image/AreaFilter.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <array>
#include <cmath>
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
constexpr std::array<const char*, 9> kReaders{"png", "jpeg", "openexr", "tiff", "targa",
                                              "psd", "dds",  "bmp",     "webp"};
constexpr std::array<const char*, 4> kWriters{"jpeg", "openexr", "tiff", "targa"};

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

// The attribute that says how a picture covers all directions ("latlong", "cube"), and what
// OpenImageIO makes of it.
constexpr const char* kEnvmap = "envmap";
constexpr const char* kLatLongFormat = "LatLong Environment";
constexpr const char* kCubeFormat = "CubeFace Environment";

// How a photo was exposed, in Exif: seconds, f-number, ISO. Names as OpenImageIO has them; the last
// two are the same tag, before and after Exif 2.3.
constexpr std::array<const char*, 4> kExposure{
    "ExposureTime", "FNumber", "Exif:PhotographicSensitivity", "Exif:ISOSpeedRatings"};

// String attributes that are part of the file's content rather than of how it is stored, and the
// exposure of photos, as text.
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
    for (const char* name : kExposure)
        if (const float value = spec.get_float_attribute(name, 0.0f);
            std::isfinite(value) && value > 0.0f)
            result[name] = fmt::format("{}", value);
    // OpenEXR's own attributes, as text.
    const std::string_view kind = spec.get_string_attribute("textureformat");
    if (kind == kLatLongFormat || kind == kCubeFormat)
        result[kEnvmap] = kind == kCubeFormat ? "cube" : "latlong";
    constexpr OIIO::TypeDesc kEightFloats(OIIO::TypeDesc::FLOAT, 8);
    if (const auto* found = spec.find_attribute("chromaticities", kEightFloats)) {
        const auto* values = static_cast<const float*>(found->data());
        result["chromaticities"] = fmt::format("{}", fmt::join(values, values + 8, " "));
    }
    return result;
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
    int firstChannel = 0, channels = 0; // what is wanted of it
    ImageSize target;                   // the frame's, or smaller
    std::size_t offset = 0, size = 0;

    [[nodiscard]] bool reduced() const { return target != ImageSize{frame.width, frame.height}; }
    [[nodiscard]] std::size_t pixelSize() const {
        return static_cast<std::size_t>(channels) * sample.size;
    }
};

json describe(const PartLayout& part) {
    const auto names = part.spec.channelnames.begin() + part.firstChannel;
    return {{"name", part.spec.get_string_attribute("oiio:subimagename")},
            {"width", part.target.width},
            {"height", part.target.height},
            {"channels", part.channels},
            {"channelNames", std::vector<std::string>(names, names + part.channels)},
            {"stored", part.spec.format.c_str()},
            {"attributes", attributesOf(part.spec)},
            {"type", part.sample.name},
            {"offset", part.offset}};
}

// Red, green and blue of a part, or its luminance: "R" "G" "B", also inside a layer
// ("beauty.R"), or "Y". Unnamed channels of other formats are colours from the first on.
bool selectColor(PartLayout& part, bool named) {
    if (!named) {
        part.channels = std::min(part.channels, part.channels < 3 ? 1 : 3);
        return true;
    }
    const std::vector<std::string>& names = part.spec.channelnames;
    const auto select = [&](std::initializer_list<const char*> wanted) {
        const std::size_t count = wanted.size();
        for (std::size_t i = 0; i + count <= names.size(); ++i) {
            const std::string layer = names[i].substr(0, names[i].rfind('.') + 1);
            if (std::equal(wanted.begin(), wanted.end(), names.begin() + static_cast<int>(i),
                           [&](const char* letter, const std::string& name) {
                               return name == layer + letter;
                           })) {
                part.firstChannel = static_cast<int>(i);
                part.channels = static_cast<int>(count);
                return true;
            }
        }
        return false;
    };
    const bool chroma = std::find(names.begin(), names.end(), "RY") != names.end();
    return select({"R", "G", "B"}) || (!chroma && select({"Y"})); // Y alone would lose the colours
}

[[noreturn]] void damaged(const std::string& format, OIIO::ImageInput& input) {
    throw Refusal("the file is damaged or cut short; save or download it again",
                  libraryText(format, input.geterror()));
}

// Averages the picture down while it is read, a few rows at a time.
void readReduced(OIIO::ImageInput& input, const std::string& format, int index,
                 const PartLayout& part, std::span<std::byte> target) {
    const OIIO::ImageSpec& spec = part.spec;
    const int rows = spec.tile_width > 0 ? std::max(1, spec.tile_height) : 64;
    const auto row = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(part.channels);
    std::vector<float> samples(row * static_cast<std::size_t>(rows));
    RowReducer reducer(spec.width, spec.height, part.target.width, part.target.height,
                       part.channels);
    const int lastChannel = part.firstChannel + part.channels;
    for (int y = 0; y < spec.height; y += rows) {
        const int begin = spec.y + y;
        const int end = spec.y + std::min(y + rows, spec.height);
        const bool ok =
            spec.tile_width > 0
                ? input.read_tiles(index, 0, spec.x, spec.x + spec.width, begin, end, spec.z,
                                   spec.z + 1, part.firstChannel, lastChannel,
                                   OIIO::TypeDesc::FLOAT, samples.data())
                : input.read_scanlines(index, 0, begin, end, spec.z, part.firstChannel, lastChannel,
                                       OIIO::TypeDesc::FLOAT, samples.data());
        if (!ok || input.has_error())
            damaged(format, input);
        for (int i = 0; i < end - begin; ++i)
            reducer.addRow(std::span(samples).subspan(static_cast<std::size_t>(i) * row, row));
    }
    std::memcpy(target.data(), reducer.result().data(), reducer.result().size_bytes());
}

void readPart(OIIO::ImageInput& input, const std::string& format, int index, const PartLayout& part,
              std::span<std::byte> target) {
    if (part.reduced())
        return readReduced(input, format, index, part, target);
    // OpenImageIO 2.4 says of a TIFF with missing strips that it was read, but keeps the error.
    const auto read = [&](std::byte* pixels) {
        const bool ok =
            input.read_image(index, 0, part.firstChannel, part.firstChannel + part.channels,
                             part.sample.type, pixels);
        if (!ok || input.has_error())
            damaged(format, input);
    };
    const std::size_t pixelSize = part.pixelSize();
    if (!part.frame.cropped) {
        read(target.data());
        return;
    }
    checkImageSize(part.spec.width, part.spec.height, part.channels, part.sample.size);
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

// Files that OpenImageIO does not open because channels have resolutions of their own.
Reply decodeSubsampled(const std::string& file, bool inspect, const std::string& libraryError) {
    auto image = readLuminanceChroma(file, inspect);
    if (!image)
        throw Refusal("channels of the file are stored at a lower resolution than others, which is "
                      "not supported; save it without subsampling",
                      libraryText("openexr", libraryError));
    json attributes = json::object();
    if (image->chromaticities)
        attributes["chromaticities"] = fmt::format("{}", fmt::join(*image->chromaticities, " "));
    const json part = {{"name", ""},
                       {"width", image->width},
                       {"height", image->height},
                       {"channels", 3},
                       {"channelNames", {"R", "G", "B"}},
                       {"stored", "half"},
                       {"attributes", attributes},
                       {"type", "f32"},
                       {"offset", 0}};
    Reply reply;
    reply.header = toJsonText({{"format", "openexr"}, {"parts", json::array({part})}});
    reply.payload = allocate(image->rgb.size() * sizeof(float));
    if (!image->rgb.empty())
        std::memcpy(reply.payload.writable().data(), image->rgb.data(),
                    image->rgb.size() * sizeof(float));
    return reply;
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
    if (format == "hdr")
        return decodeRadiance(request, payloadFd);
    if (std::find(kReaders.begin(), kReaders.end(), format) == kReaders.end())
        throw Refusal("this image format is not supported", format);
    allowThreads();
    auto input = OIIO::ImageInput::create(format);
    if (!input)
        throw Refusal("this image format is not supported", OIIO::geterror());

    const bool inspect = request.value("inspect", false);
    const bool allParts = inspect || (request.value("allParts", false) && format == "openexr");
    const bool colorOnly = request.value("colorOnly", false) && !inspect;
    const int maxSide = inspect ? 0 : request.value("maxSide", 0);

    // PNG, TIFF … store colour that is not multiplied by alpha; it is wanted as it is.
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    OIIO::ImageSpec first;
    const std::string file = fmt::format("/proc/self/fd/{}", payloadFd);
    if (!input->open(file, first, config)) {
        const std::string error = input->geterror();
        if (format == "openexr" && error.find("Subsampled") != std::string::npos)
            return decodeSubsampled(file, inspect, error);
        throw Refusal("the file is damaged or not an image of this kind",
                      libraryText(format, error));
    }

    // Sizes first, of all parts, before anything is allocated.
    std::vector<PartLayout> parts;
    std::vector<int> indices;
    std::size_t total = 0;
    json descriptions = json::array();
    std::string skipped; // parts without colour
    for (int index = 0; index == 0 || allParts || (colorOnly && parts.empty()); ++index) {
        if (!input->seek_subimage(index, 0))
            break;
        if (index >= limits::kMaxImageParts)
            throw Refusal(fmt::format("the file has more than {} parts", limits::kMaxImageParts));
        PartLayout part;
        part.spec = input->spec();
        part.frame = frameOf(part.spec);
        part.sample = sampleFor(part.spec);
        part.channels = part.spec.nchannels;
        if (part.spec.deep)
            throw Refusal("deep images are not supported; flatten the file first");
        if (part.spec.depth > 1)
            throw Refusal("volume images are not supported");
        if (colorOnly && !selectColor(part, format == "openexr")) {
            skipped += fmt::format("{}{}", skipped.empty() ? "" : ", ",
                                   fmt::join(part.spec.channelnames, " "));
            continue;
        }
        part.target = {part.frame.width, part.frame.height};
        if (part.sample.type == OIIO::TypeDesc::FLOAT && !part.frame.cropped) {
            checkImageSize(part.frame.width, part.frame.height, 1, 1);
            part.target = reducedSize(part.target, maxSide);
        } else {
            checkImageSize(part.spec.width, part.spec.height, part.channels, part.sample.size);
        }
        checkImageSize(part.target.width, part.target.height, part.channels, part.sample.size);
        part.offset = total;
        part.size = static_cast<std::size_t>(part.target.width) *
                    static_cast<std::size_t>(part.target.height) * part.pixelSize();
        if (!inspect) {
            total += (part.size + 15) / 16 * 16;
            if (total > limits::kMaxImageBytes)
                throw Refusal("the parts of the file together need too much memory");
        }
        descriptions.push_back(describe(part));
        parts.push_back(std::move(part));
        indices.push_back(index);
    }
    if (parts.empty() && !skipped.empty())
        throw Refusal(fmt::format("the file holds no colours: it has the channels {} instead of R, "
                                  "G, B or Y; save its colours",
                                  skipped.substr(0, 200)));
    if (parts.empty())
        throw Refusal("the file holds no image", libraryText(format, input->geterror()));

    Reply reply;
    reply.header = toJsonText({{"format", format}, {"parts", descriptions}});
    reply.payload = allocate(total);
    if (inspect)
        return reply;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto target = reply.payload.writable().subspan(parts[i].offset, parts[i].size);
        readPart(*input, format, indices[i], parts[i], target);
    }
    if (format == "jpeg")
        requireJpegEnd(payloadFd);
    return reply;
}

Reply encodeImage(const json& request, std::span<const std::byte> payload) {
    const auto format = request.at("format").get<std::string>();
    if (format == "hdr")
        return encodeRadiance(request, payload);
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
        if (format == "openexr") {
            spec.attribute("compression", "zip");
            if (const auto name = part.at("name").get<std::string>(); !name.empty()) {
                spec.attribute("name", name);
                spec.attribute("oiio:subimagename", name);
            }
            for (const auto& [key, value] : part.at("attributes").items())
                if (key == kEnvmap)
                    spec.attribute("textureformat", value == "cube" ? kCubeFormat : kLatLongFormat);
                else
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

    // OpenImageIO writes into memory, except OpenEXR files of several parts: those it opens by name
    // only, which here is the name of a memory file.
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput proxy(bytes); // outlives the output, whose end may write to it
    auto output = OIIO::ImageOutput::create(format);
    if (!output)
        throw Refusal("this image format cannot be written", OIIO::geterror());
    const bool byName = specs.size() > 1;
    FileDescriptor named;
    std::string name = "memory." + format;
    if (byName) {
        named = FileDescriptor(::memfd_create("patina-exr", MFD_CLOEXEC | MFD_ALLOW_SEALING));
        name = fmt::format("/proc/self/fd/{}", named.get());
    } else {
        output->set_ioproxy(&proxy);
    }
    // After a failure the output's end may use a stream that is gone; the process frees it.
    const auto fail = [&](const std::string& reason) {
        (void)output.release();
        throw Refusal("the image cannot be encoded", reason);
    };
    const auto check = [&](bool ok) {
        if (!ok)
            fail(libraryText(format, output->geterror()));
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
            fail("pixels are missing");
        check(output->write_image(samples[i].type, payload.data() + offset));
        offset += (size + 15) / 16 * 16;
    }
    check(output->close());
    output.reset(); // OpenEXR's environment maps are complete only now, however closed they are

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
