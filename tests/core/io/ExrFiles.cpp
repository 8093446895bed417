#include "tests/core/io/CommonImageFiles.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <cstdint>
#include <cstring>
#include <functional>
#include <map>

namespace patina::test {

namespace {

using ExrSetup = std::function<void(Imf::Header&)>;
using Layout = std::vector<std::pair<std::string, Imf::PixelType>>;

// Values for all channels of a header, over its data window, whatever their type.
class Pixels {
  public:
    explicit Pixels(const Imf::Header& header) {
        const Imath::Box2i window = header.dataWindow();
        const auto width = static_cast<std::size_t>(window.max.x - window.min.x + 1);
        const auto height = static_cast<std::size_t>(window.max.y - window.min.y + 1);
        std::uint32_t noise = 1;
        for (auto entry = header.channels().begin(); entry != header.channels().end(); ++entry) {
            const bool half = entry.channel().type == Imf::HALF;
            const std::size_t size = half ? 2 : 4;
            std::vector<char>& data = m_data[entry.name()];
            data.resize(width * height * size);
            for (std::size_t i = 0; i < width * height; ++i) {
                noise = noise * 1664525u + 1013904223u;
                const float value = static_cast<float>(noise >> 8u) / 65536.0f - 64.0f;
                const Imath::half narrow(value);
                std::memcpy(data.data() + i * size,
                            half ? static_cast<const void*>(&narrow)
                                 : static_cast<const void*>(&value),
                            size);
            }
            const auto origin =
                reinterpret_cast<std::uintptr_t>(data.data()) -
                static_cast<std::uintptr_t>(std::int64_t{window.min.x}) * size -
                static_cast<std::uintptr_t>(std::int64_t{window.min.y}) * size * width;
            m_frame.insert(entry.name(),
                           Imf::Slice(entry.channel().type, reinterpret_cast<char*>(origin), size,
                                      size * width));
        }
    }
    [[nodiscard]] const Imf::FrameBuffer& frame() const { return m_frame; }

  private:
    std::map<std::string, std::vector<char>> m_data;
    Imf::FrameBuffer m_frame;
};

constexpr std::size_t kLargest = std::size_t{1} << 20;

const Layout kRgb{{"R", Imf::HALF}, {"G", Imf::HALF}, {"B", Imf::HALF}};

// 45 x 37 pixels.
Imf::Header headerOf(const Layout& channels, const ExrSetup& setup = {}) {
    Imf::Header header(45, 37);
    for (const auto& [name, type] : channels)
        header.channels().insert(name, Imf::Channel(type));
    if (setup)
        setup(header);
    return header;
}

class Writer {
  public:
    explicit Writer(const std::filesystem::path& folder)
        : m_file((folder / "written.exr").string()) {}

    Bytes scanlines(const Imf::Header& header) const {
        const Pixels pixels(header);
        {
            Imf::OutputFile file(m_file.c_str(), header);
            file.setFrameBuffer(pixels.frame());
            const Imath::Box2i window = header.dataWindow();
            file.writePixels(window.max.y - window.min.y + 1);
        }
        return readFile(m_file, kLargest).value();
    }
    Bytes tiles(Imf::Header header, Imf::LevelMode mode) const {
        header.setTileDescription(Imf::TileDescription(16, 8, mode));
        const Pixels pixels(header);
        {
            Imf::TiledOutputFile file(m_file.c_str(), header);
            file.setFrameBuffer(pixels.frame());
            for (int y = 0; y < file.numYLevels(); ++y)
                for (int x = 0; x < file.numXLevels(); ++x)
                    if (file.isValidLevel(x, y))
                        file.writeTiles(0, file.numXTiles(x) - 1, 0, file.numYTiles(y) - 1, x, y);
        }
        return readFile(m_file, kLargest).value();
    }
    Bytes parts(std::vector<Imf::Header> headers) const {
        for (std::size_t i = 0; i < headers.size(); ++i) {
            headers[i].setName("part " + std::to_string(i));
            headers[i].setType(Imf::SCANLINEIMAGE);
        }
        {
            Imf::MultiPartOutputFile file(m_file.c_str(), headers.data(),
                                          static_cast<int>(headers.size()));
            for (int i = 0; i < static_cast<int>(headers.size()); ++i) {
                const Pixels pixels(file.header(i));
                Imf::OutputPart part(file, i);
                part.setFrameBuffer(pixels.frame());
                const Imath::Box2i window = file.header(i).dataWindow();
                part.writePixels(window.max.y - window.min.y + 1);
            }
        }
        return readFile(m_file, kLargest).value();
    }

  private:
    std::string m_file;
};

} // namespace

SampleFiles exrFiles(const std::filesystem::path& folder) {
    SampleFiles files;
    const Writer writer(folder);
    const auto read = [&](std::string name, Bytes bytes) {
        files.read.push_back({std::move(name), "openexr", std::move(bytes)});
    };
    const auto handedOn = [&](std::string name, Bytes bytes) {
        files.handedOn.push_back({std::move(name), "openexr", std::move(bytes)});
    };
    const auto plain = [&](const ExrSetup& setup) {
        return writer.scanlines(headerOf(kRgb, setup));
    };

    const Layout floats{{"R", Imf::FLOAT}, {"G", Imf::FLOAT}, {"B", Imf::FLOAT}};
    const Layout mixed{{"R", Imf::HALF}, {"G", Imf::HALF}, {"B", Imf::HALF}, {"Z", Imf::FLOAT}};
    for (int compression = 0; compression < Imf::NUM_COMPRESSION_METHODS; ++compression)
        for (const Layout& layout : {kRgb, floats, mixed}) {
            const Imf::Header header = headerOf(layout, [&](Imf::Header& h) {
                h.compression() = static_cast<Imf::Compression>(compression);
            });
            const std::string name = "compression " + std::to_string(compression) + ", " +
                                     std::to_string(layout.size()) + " channels, " +
                                     (layout[0].second == Imf::HALF ? "half" : "float");
            read(name, writer.scanlines(header));
            read(name + ", tiles", writer.tiles(header, Imf::ONE_LEVEL));
        }
    read("mip levels", writer.tiles(headerOf(kRgb), Imf::MIPMAP_LEVELS));
    read("rip levels", writer.tiles(headerOf(kRgb), Imf::RIPMAP_LEVELS));

    // Names decide the order of channels.
    for (const std::vector<std::string>& names :
         {std::vector<std::string>{"A", "B", "G", "R", "Z", "depth", "ZBack"},
          {"Y"},
          {"Y", "A"},
          {"X", "Y", "Z"},
          {"N.X", "N.Y", "N.Z", "R", "G", "B"},
          {"diffuse.R", "diffuse.G", "diffuse.B", "diffuse.a", "beauty.left.R", "beauty.left.g"},
          {"red", "Green", "BLUE", "alpha", "AR", "RA", "mask", "id.x"},
          {"u", "v", "real", "imag", "1", "."}}) {
        Layout layout;
        for (const std::string& name : names)
            layout.emplace_back(name, Imf::HALF);
        read("channels " + names.front() + " and so on", writer.scanlines(headerOf(layout)));
    }

    // Windows
    const Imath::Box2i shifted({-7, 5}, {20, 33});
    const Imath::Box2i wide({-100, -100}, {99, 99});
    read("shifted data", plain([&](Imf::Header& h) { h.dataWindow() = shifted; }));
    read("shifted both",
         plain([&](Imf::Header& h) { h.displayWindow() = h.dataWindow() = shifted; }));
    read("more data than display", plain([&](Imf::Header& h) { h.dataWindow() = wide; }));
    read("no data in display", plain([](Imf::Header& h) {
             h.dataWindow() = Imath::Box2i({1000, 1000}, {1003, 1004});
         }));
    read("shifted tiles",
         writer.tiles(headerOf(kRgb, [&](Imf::Header& h) { h.dataWindow() = shifted; }),
                      Imf::ONE_LEVEL));
    read("lines from below", plain([](Imf::Header& h) { h.lineOrder() = Imf::DECREASING_Y; }));

    // Attributes
    read("chromaticities", plain([](Imf::Header& h) {
             Imf::addChromaticities(h, Imf::Chromaticities({.68f, .32f}, {.265f, .69f},
                                                           {.15f, .06f}, {.3127f, .329f}));
         }));
    for (const Imf::Envmap kind : {Imf::ENVMAP_LATLONG, Imf::ENVMAP_CUBE})
        read("environment " + std::to_string(kind),
             plain([&](Imf::Header& h) { Imf::addEnvmap(h, kind); }));
    read("texts", plain([](Imf::Header& h) {
             Imf::addOwner(h, "somebody");
             Imf::addComments(h, "words\nand more");
             Imf::addCapDate(h, "2020:01:01 00:00:00");
             Imf::addWrapmodes(h, "periodic,clamp");
             h.insert("patina:basis", Imf::StringAttribute("real-sh-cs"));
             h.insert("empty", Imf::StringAttribute(""));
             h.insert("oiio:ColorSpace", Imf::StringAttribute("Linear"));
             h.insert("patina:size", Imf::StringAttribute("data window"));
         }));
    read("numbers", plain([](Imf::Header& h) {
             Imf::addExpTime(h, 0.125f);
             Imf::addAperture(h, 5.6f);
             Imf::addIsoSpeed(h, 400);
             Imf::addXDensity(h, 72);
             h.insert("a number", Imf::FloatAttribute(3));
             h.insert("a count", Imf::IntAttribute(3));
             h.pixelAspectRatio() = 2;
         }));
    read("without exposure", plain([](Imf::Header& h) { Imf::addExpTime(h, -1); }));

    // Parts
    const Imath::Box2i small({0, 0}, {9, 4});
    read("parts",
         writer.parts({headerOf(kRgb), headerOf(mixed), headerOf(floats, [&](Imf::Header& h) {
                           h.dataWindow() = small;
                           h.insert("view", Imf::StringAttribute("left"));
                       })}));

    handedOn("integers", writer.scanlines(headerOf({{"id", Imf::UINT}, {"R", Imf::HALF}})));
    handedOn(
        "levels of a cube",
        writer.tiles(headerOf(kRgb, [](Imf::Header& h) { Imf::addEnvmap(h, Imf::ENVMAP_CUBE); }),
                     Imf::MIPMAP_LEVELS));
    handedOn("two attributes of one name", plain([](Imf::Header& h) {
                 h.insert("Key", Imf::StringAttribute("one"));
                 h.insert("key", Imf::StringAttribute("two"));
             }));
    handedOn("exposure as text",
             plain([](Imf::Header& h) { h.insert("ExposureTime", Imf::StringAttribute("0.5")); }));
    handedOn("the kind of a texture", plain([](Imf::Header& h) {
                 h.insert("textureformat", Imf::StringAttribute("Plain Texture"));
             }));
    return files;
}

} // namespace patina::test
