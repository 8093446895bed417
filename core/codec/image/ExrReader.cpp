#include "core/codec/image/ExrReader.h"

#include "core/base/LowerCase.h"
#include "core/codec/image/DecodePicture.h"
#include "core/codec/image/HandOn.h"
#include "core/codec/image/PictureAttributes.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfEnvmapAttribute.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>
#include <OpenEXR/ImfTileDescriptionAttribute.h>
#include <algorithm>
#include <cstdint>
#include <map>
#include <string_view>
#include <thread>
#include <tuple>

namespace patina::codec {

namespace {

// A channel in OpenImageIO's order: by layer, in it colours first, then by name.
struct Channel {
    std::string name, layer, suffix;
    int rank = 0;

    explicit Channel(const std::string& full)
        : name(full)
        , layer(full.substr(0, full.rfind('.') + 1))
        , suffix(full.substr(layer.size())) {}
};

int rankOf(std::string_view suffix, std::span<const std::string_view> order) {
    const std::string lower = lowerCase(suffix);
    const auto found = std::find(order.begin(), order.end(), lower);
    constexpr int kUnknown = 10000;
    return found == order.end() ? kUnknown : static_cast<int>(found - order.begin());
}

// Where X, Y and Z are found together they are a position or a direction.
constexpr std::string_view kColours[] = {"r",    "red",  "g",  "green", "b",     "blue", "y",
                                         "real", "imag", "a",  "alpha", "ar",    "ra",   "ag",
                                         "ga",   "ab",   "ba", "z",     "depth", "zback"};
constexpr std::string_view kPositions[] = {"r",  "red", "g",    "green", "b",  "blue",  "x",
                                           "y",  "z",   "real", "imag",  "a",  "alpha", "ar",
                                           "ra", "ag",  "ga",   "ab",    "ba", "depth", "zback"};

void sortChannels(std::vector<Channel>& channels) {
    for (Channel& channel : channels) {
        const auto has = [&](const char* suffix) {
            return std::any_of(channels.begin(), channels.end(), [&](const Channel& other) {
                return other.layer == channel.layer && lowerCase(other.suffix) == suffix;
            });
        };
        const bool position = has("x") && (has("y") || has("z"));
        channel.rank =
            position ? rankOf(channel.suffix, kPositions) : rankOf(channel.suffix, kColours);
    }
    std::sort(channels.begin(), channels.end(), [](const Channel& a, const Channel& b) {
        return std::tie(a.layer, a.rank, a.suffix) < std::tie(b.layer, b.rank, b.suffix);
    });
}

// What OpenImageIO calls some attributes; empty: handled apart, or of no interest.
std::string nameOf(const std::string& attribute) {
    static const std::map<std::string, std::string> kNames{
        {"cameraTransform", "worldtocamera"},
        {"capDate", "DateTime"},
        {"comments", "ImageDescription"},
        {"owner", "Copyright"},
        {"pixelAspectRatio", "PixelAspectRatio"},
        {"xDensity", "XResolution"},
        {"expTime", "ExposureTime"},
        {"aperture", "FNumber"},
        {"chunkCount", "openexr:chunkCount"},
        {"maxSamplesPerPixel", "openexr:maxSamplesPerPixel"},
        {"dwaCompressionLevel", "openexr:dwaCompressionLevel"},
        {"channels", ""},
        {"compression", ""},
        {"dataWindow", ""},
        {"displayWindow", ""},
        {"envmap", ""},
        {"tiledesc", ""},
        {"tiles", ""},
        {"type", ""}};
    const auto found = kNames.find(attribute);
    return found == kNames.end() ? attribute : found->second;
}

// Attributes of a header, and those of them that are members of the spec.
void readAttributes(const Imf::Header& header, PictureSpec& spec) {
    PictureAttributes attributes;
    if (const auto* envmap = header.findTypedAttribute<Imf::EnvmapAttribute>("envmap"))
        attributes.set(kEnvmap, envmap->value() == Imf::ENVMAP_CUBE ? "cube" : "latlong");
    for (auto entry = header.begin(); entry != header.end(); ++entry) {
        const std::string original = entry.name();
        const std::string name = nameOf(original);
        const Imf::Attribute* attribute = &entry.attribute();
        if (name.empty())
            continue;
        if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(attribute)) {
            const std::string value = text->value().c_str(); // up to the first zero, as there
            if (text->value().empty())
                continue;
            if (name == "oiio:subimagename")
                spec.name = value;
            else if (name == kOwnSize)
                spec.hasOwnSize = !value.empty();
            else
                attributes.addText(name, value);
        } else if (const auto* number = dynamic_cast<const Imf::FloatAttribute*>(attribute)) {
            if (original == "xDensity" && number->value() != 0.0f)
                attributes.set("ResolutionUnit", "in");
            else if (original != "xDensity" && original != "pixelAspectRatio")
                attributes.addNumber(name, number->value());
        } else if (const auto* primaries =
                       dynamic_cast<const Imf::ChromaticitiesAttribute*>(attribute);
                   primaries != nullptr && name == "chromaticities") {
            const Imf::Chromaticities& c = primaries->value();
            const float values[] = {c.red.x,  c.red.y,  c.green.x, c.green.y,
                                    c.blue.x, c.blue.y, c.white.x, c.white.y};
            attributes.set("chromaticities", joined(values));
        } else if (!name.starts_with("oiio:")) {
            attributes.addOther(name);
        }
    }
    if (header.hasName() && !header.name().empty())
        spec.name = header.name();
    spec.attributes = attributes.content();
}

PictureSpec specOf(const Imf::Header& header) {
    const bool tiled =
        header.hasTileDescription() && header.type().find("tile") != std::string::npos;
    if (header.type().starts_with("deep"))
        throw HandOn{"deep"};
    if (const auto* envmap = header.findTypedAttribute<Imf::EnvmapAttribute>("envmap");
        envmap != nullptr && envmap->value() == Imf::ENVMAP_CUBE && tiled &&
        header.tileDescription().mode != Imf::ONE_LEVEL)
        throw HandOn{"levels of a cube"};

    const Imath::Box2i data = header.dataWindow();
    const Imath::Box2i display = header.displayWindow();
    PictureSpec spec;
    spec.x = data.min.x;
    spec.y = data.min.y;
    spec.width = data.max.x - data.min.x + 1;
    spec.height = data.max.y - data.min.y + 1;
    spec.fullX = display.min.x;
    spec.fullY = display.min.y;
    spec.fullWidth = display.max.x - display.min.x + 1;
    spec.fullHeight = display.max.y - display.min.y + 1;
    spec.kind = SampleKind::F32;
    spec.stored = "half";
    spec.tileHeight = tiled ? static_cast<int>(header.tileDescription().ySize) : 0;
    std::vector<Channel> channels;
    for (auto entry = header.channels().begin(); entry != header.channels().end(); ++entry) {
        const Imf::Channel& channel = entry.channel();
        if (channel.type != Imf::HALF && channel.type != Imf::FLOAT)
            throw HandOn{"integers"};
        if (channel.xSampling != 1 || channel.ySampling != 1)
            throw HandOn{"subsampled channels"};
        if (channel.type == Imf::FLOAT)
            spec.stored = "float";
        channels.emplace_back(entry.name());
    }
    if (channels.empty())
        throw HandOn{"no channels"};
    sortChannels(channels);
    for (Channel& channel : channels)
        spec.channelNames.push_back(std::move(channel.name));
    readAttributes(header, spec);
    return spec;
}

// A few: a child works on one file, several children run at once.
int threadCount() {
    return static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, 4u));
}

// Starts them where that is worth its time.
void allowThreads(const PictureSpec& spec) {
    constexpr std::int64_t kWorthIt = 512 * 512;
    if (std::int64_t{spec.width} * spec.height * spec.channels() > 3 * kWorthIt)
        Imf::setGlobalThreadCount(threadCount());
}

class ExrReader final : public PictureReader {
  public:
    explicit ExrReader(const std::string& file)
        : m_file(file.c_str(), threadCount()) {}

    [[nodiscard]] bool isSubsampled() const {
        const Imf::ChannelList& channels = m_file.header(0).channels();
        for (auto entry = channels.begin(); entry != channels.end(); ++entry)
            if (entry.channel().xSampling != 1 || entry.channel().ySampling != 1)
                return true;
        return false;
    }

    const PictureSpec* part(int index) override;
    void read(int index, Channels channels, std::span<std::byte> pixels) override {
        readPixels(index, channels, 0, m_specs.at(index).height,
                   reinterpret_cast<char*>(pixels.data()));
    }
    void readRows(int index, Channels channels, int begin, int end,
                  std::span<float> samples) override {
        readPixels(index, channels, begin, end, reinterpret_cast<char*>(samples.data()));
    }

  private:
    void readPixels(int index, Channels channels, int begin, int end, char* target);

    Imf::MultiPartInputFile m_file;
    std::map<int, PictureSpec> m_specs;
    std::map<int, Imf::InputPart> m_parts;
};

const PictureSpec* ExrReader::part(int index) {
    if (index >= m_file.parts())
        return nullptr;
    const auto [entry, isNew] = m_specs.try_emplace(index);
    if (isNew) {
        entry->second = specOf(m_file.header(index));
        allowThreads(entry->second);
        m_parts.try_emplace(index, m_file, index);
    }
    return &entry->second;
}

void ExrReader::readPixels(int index, Channels channels, int begin, int end, char* target) {
    const PictureSpec& spec = m_specs.at(index);
    const std::size_t pixel = static_cast<std::size_t>(channels.count) * sizeof(float);
    const std::size_t row = pixel * static_cast<std::size_t>(spec.width);
    // OpenEXR wants the address that pixel (0, 0) would have.
    const auto origin = reinterpret_cast<std::uintptr_t>(target) -
                        static_cast<std::uintptr_t>(std::int64_t{spec.x}) * pixel -
                        static_cast<std::uintptr_t>(std::int64_t{spec.y} + begin) * row;
    Imf::FrameBuffer frame;
    for (int c = 0; c < channels.count; ++c) {
        const std::string& name = spec.channelNames[static_cast<std::size_t>(channels.first + c)];
        auto* base = reinterpret_cast<char*>(origin + static_cast<std::size_t>(c) * sizeof(float));
        frame.insert(name, Imf::Slice(Imf::FLOAT, base, pixel, row));
    }
    Imf::InputPart& part = m_parts.at(index);
    part.setFrameBuffer(frame);
    part.readPixels(spec.y + begin, spec.y + end - 1);
}

} // namespace

std::unique_ptr<PictureReader> readExr(const std::string& file) {
    auto reader = std::make_unique<ExrReader>(file);
    if (reader->isSubsampled())
        return nullptr;
    return reader;
}

void prepareExr() {
    Imf::staticInitialize();
}

} // namespace patina::codec
