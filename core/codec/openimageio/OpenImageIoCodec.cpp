// The only file that sees OpenImageIO.
#include "core/codec/openimageio/OpenImageIoCodec.h"
#include "core/codec/image/DecodePicture.h"

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

OIIO::TypeDesc typeOf(SampleKind kind) {
    return kind == SampleKind::U8    ? OIIO::TypeDesc::UINT8
           : kind == SampleKind::U16 ? OIIO::TypeDesc::UINT16
                                     : OIIO::TypeDesc::FLOAT;
}

// What samples are handed over as: 8 and 16 bits stay, everything else becomes float.
SampleKind kindFor(const OIIO::ImageSpec& spec) {
    const bool mixed = std::any_of(spec.channelformats.begin(), spec.channelformats.end(),
                                   [&](const auto& f) { return f != spec.format; });
    if (!mixed && (spec.format == OIIO::TypeDesc::UINT8 || spec.format == OIIO::TypeDesc::INT8))
        return SampleKind::U8;
    if (!mixed && (spec.format == OIIO::TypeDesc::UINT16 || spec.format == OIIO::TypeDesc::INT16))
        return SampleKind::U16;
    return SampleKind::F32;
}

SampleKind kindNamed(const std::string& name) {
    return name == "u8" ? SampleKind::U8 : name == "u16" ? SampleKind::U16 : SampleKind::F32;
}

// What OpenImageIO makes of kEnvmap.
constexpr const char* kLatLongFormat = "LatLong Environment";
constexpr const char* kCubeFormat = "CubeFace Environment";

// String attributes that are part of the file's content rather than of how it is stored, and the
// exposure of photos, as text.
std::map<std::string, std::string> attributesOf(const OIIO::ImageSpec& spec) {
    std::map<std::string, std::string> result;
    for (const auto& attribute : spec.extra_attribs)
        if (const std::string name = attribute.name().string();
            !isStorage(name) && attribute.type() == OIIO::TypeDesc::STRING)
            result[name] = attribute.get_string();
    for (const char* name : kExposure)
        if (const float value = spec.get_float_attribute(name, 0.0f);
            std::isfinite(value) && value > 0.0f)
            result[name] = fmt::format("{}", value);
    // OpenEXR's own attributes, as text.
    const std::string_view kind = spec.get_string_attribute("textureformat");
    if (kind == kLatLongFormat || kind == kCubeFormat)
        result[kEnvmap] = kind == kCubeFormat ? "cube" : "latlong";
    constexpr OIIO::TypeDesc kEightFloats(OIIO::TypeDesc::FLOAT, 8);
    if (const auto* found = spec.find_attribute("chromaticities", kEightFloats))
        result["chromaticities"] = joined({static_cast<const float*>(found->data()), 8});
    return result;
}

class OpenImageIoReader : public PictureReader {
  public:
    // Throws Refusal when the file cannot be opened.
    OpenImageIoReader(std::string format, const std::string& file);

    const PictureSpec* part(int index) override;
    void read(int index, Channels channels, std::span<std::byte> pixels) override;
    void readRows(int index, Channels channels, int begin, int end,
                  std::span<float> samples) override;
    std::string problem() override { return m_input->geterror(); }

  private:
    void require(bool ok);

    std::string m_format;
    std::unique_ptr<OIIO::ImageInput> m_input;
    PictureSpec m_part;
};

OpenImageIoReader::OpenImageIoReader(std::string format, const std::string& file)
    : m_format(std::move(format))
    , m_input(OIIO::ImageInput::create(m_format)) {
    if (!m_input)
        throw Refusal("this image format is not supported", OIIO::geterror());
    // PNG, TIFF … store colour that is not multiplied by alpha; it is wanted as it is.
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    OIIO::ImageSpec first;
    if (m_input->open(file, first, config))
        return;
    const std::string error = m_input->geterror();
    // Luminance and chroma of OpenEXR have been read by the worker for images.
    if (m_format == "openexr" && error.find("Subsampled") != std::string::npos)
        throw Refusal("channels of the file are stored at a lower resolution than others, which is "
                      "not supported; save it without subsampling",
                      libraryText(m_format, error));
    throw Refusal("the file is damaged or not an image of this kind", libraryText(m_format, error));
}

const PictureSpec* OpenImageIoReader::part(int index) {
    if (!m_input->seek_subimage(index, 0))
        return nullptr;
    const OIIO::ImageSpec spec = m_input->spec();
    if (spec.deep)
        throw Refusal("deep images are not supported; flatten the file first");
    if (spec.depth > 1)
        throw Refusal("volume images are not supported");
    m_part = {spec.x,
              spec.y,
              spec.width,
              spec.height,
              spec.full_x,
              spec.full_y,
              spec.full_width,
              spec.full_height,
              !spec.get_string_attribute(kOwnSize).empty(),
              kindFor(spec),
              spec.format.c_str(),
              std::string(spec.get_string_attribute("oiio:subimagename")),
              spec.channelnames,
              attributesOf(spec),
              spec.tile_width > 0 ? std::max(1, spec.tile_height) : 0};
    return &m_part;
}

// OpenImageIO 2.4 says of a TIFF with missing strips that it was read, but keeps the error.
void OpenImageIoReader::require(bool ok) {
    if (!ok || m_input->has_error())
        throw Refusal("the file is damaged or cut short; save or download it again",
                      libraryText(m_format, m_input->geterror()));
}

void OpenImageIoReader::read(int index, Channels channels, std::span<std::byte> pixels) {
    require(m_input->seek_subimage(index, 0));
    const OIIO::TypeDesc type = typeOf(kindFor(m_input->spec()));
    require(m_input->read_image(index, 0, channels.first, channels.first + channels.count, type,
                                pixels.data()));
}

void OpenImageIoReader::readRows(int index, Channels channels, int begin, int end,
                                 std::span<float> samples) {
    require(m_input->seek_subimage(index, 0));
    const OIIO::ImageSpec spec = m_input->spec();
    const int lastChannel = channels.first + channels.count;
    require(spec.tile_width > 0
                ? m_input->read_tiles(index, 0, spec.x, spec.x + spec.width, spec.y + begin,
                                      spec.y + end, spec.z, spec.z + 1, channels.first, lastChannel,
                                      OIIO::TypeDesc::FLOAT, samples.data())
                : m_input->read_scanlines(index, 0, spec.y + begin, spec.y + end, spec.z,
                                          channels.first, lastChannel, OIIO::TypeDesc::FLOAT,
                                          samples.data()));
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

void prepareOpenImageIo() {
    // No threads before the fork.
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);
    for (const char* name : kReaders)
        (void)OIIO::ImageInput::create(name);
    (void)OIIO::geterror();
}

Reply decodeWithOpenImageIo(const json& request, int payloadFd) {
    const auto format = request.at("format").get<std::string>();
    if (std::find(kReaders.begin(), kReaders.end(), format) == kReaders.end())
        throw Refusal("this image format is not supported", format);
    allowThreads();
    OpenImageIoReader reader(format, fmt::format("/proc/self/fd/{}", payloadFd));
    return decodePicture(reader, request, payloadFd);
}

Reply encodeWithOpenImageIo(const json& request, std::span<const std::byte> payload) {
    const auto format = request.at("format").get<std::string>();
    if (std::find(kWriters.begin(), kWriters.end(), format) == kWriters.end())
        throw Refusal("this image format cannot be written", format);
    allowThreads();

    std::vector<OIIO::ImageSpec> specs;
    std::vector<SampleKind> samples;
    for (const json& part : request.at("parts")) {
        const SampleKind kind = kindNamed(part.at("type"));
        OIIO::ImageSpec spec(part.at("width"), part.at("height"), part.at("channels"),
                             part.at("half").get<bool>() ? OIIO::TypeDesc(OIIO::TypeDesc::HALF)
                                                         : typeOf(kind));
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
        samples.push_back(kind);
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
        named = MemoryFile::createGrowing();
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
                                 static_cast<std::size_t>(specs[i].nchannels) * sizeOf(samples[i]);
        if (offset + size > payload.size())
            fail("pixels are missing");
        check(output->write_image(typeOf(samples[i]), payload.data() + offset));
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
