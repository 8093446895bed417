#include "core/codec/image/RadianceHdr.h"

#include "core/base/Limits.h"
#include "core/codec/Codec.h"
#include "core/codec/TokenReader.h"
#include "core/image/AreaFilter.h"
#include "core/math/Shading.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <string_view>

namespace patina::codec {

namespace {

using Pixel = std::array<std::uint8_t, 4>; // red, green, blue, exponent

// Run lengths by component exist for these widths only.
constexpr int kMinRunLength = 8, kMaxRunLength = 0x7fff;
constexpr int kMinRun = 4, kMaxRun = 127, kMaxLiterals = 128;

[[noreturn]] void cutShort(const std::string& detail) {
    throw Refusal("the file is damaged or cut short; save or download it again", "hdr: " + detail);
}

[[noreturn]] void badHeader(std::string_view line) {
    throw Refusal(fmt::format("the header line \"{}\" makes no sense; the file is damaged",
                              line.substr(0, 80)),
                  "hdr");
}

template <std::size_t N>
std::array<double, N> numbers(std::string_view text, std::string_view line) {
    TokenReader reader(text);
    std::array<double, N> result{};
    for (double& number : result) {
        const std::optional<double> read = reader.number();
        if (!read || !std::isfinite(*read))
            badHeader(line);
        number = *read;
    }
    return result;
}

void readVariable(std::string_view line, RadianceHeader& header) {
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos)
        return; // the command that made the picture
    std::string_view name = line.substr(0, equals);
    while (name.starts_with(' ') || name.starts_with('\t'))
        name.remove_prefix(1);
    const std::string_view value = line.substr(equals + 1);
    if (name == "FORMAT") {
        TokenReader reader(value);
        const std::string_view format = reader.word();
        header.xyze = format == "32-bit_rle_xyze";
        if (!header.xyze && format != "32-bit_rle_rgbe")
            throw Refusal(fmt::format("the format \"{}\" is not supported; save it as RGBE",
                                      format.substr(0, 80)),
                          "hdr");
    } else if (name == "EXPOSURE") {
        const double exposure = numbers<1>(value, line)[0];
        if (!(exposure > 0.0))
            badHeader(line);
        for (double& scale : header.scale)
            scale *= exposure;
    } else if (name == "COLORCORR") {
        const auto correction = numbers<3>(value, line);
        for (std::size_t c = 0; c < 3; ++c) {
            if (!(correction[c] > 0.0))
                badHeader(line);
            header.scale[c] *= correction[c];
        }
    } else if (name == "PRIMARIES") {
        const auto read = numbers<8>(value, line);
        header.primaries.emplace();
        std::transform(read.begin(), read.end(), header.primaries->begin(),
                       [](double v) { return static_cast<float>(v); });
    }
}

// "-Y 512 +X 1024": the slow axis first. X grows to the right, Y upwards; the sign says in which
// direction the file goes along it.
void readResolution(std::string_view line, RadianceHeader& header) {
    TokenReader reader(line);
    struct {
        std::string_view name;
        double count = 0;
    } axes[2];
    for (auto& axis : axes) {
        axis.name = reader.word();
        const std::optional<double> count = reader.number();
        if (axis.name.size() != 2 || (axis.name[0] != '+' && axis.name[0] != '-') || !count ||
            !(*count >= 1.0) || *count != std::floor(*count))
            badHeader(line);
        axis.count = *count;
    }
    const char slow = axes[0].name[1];
    const char fast = axes[1].name[1];
    if (!((slow == 'Y' && fast == 'X') || (slow == 'X' && fast == 'Y')))
        badHeader(line);
    if (std::max(axes[0].count, axes[1].count) > limits::kMaxImageSide)
        throw Refusal(fmt::format("the image has {} x {} pixels; the largest supported side is {}",
                                  axes[1].count, axes[0].count, limits::kMaxImageSide));
    header.columns = slow == 'X';
    header.scanlines = static_cast<int>(axes[0].count);
    header.length = static_cast<int>(axes[1].count);
    header.width = header.columns ? header.scanlines : header.length;
    header.height = header.columns ? header.length : header.scanlines;
    header.flipX = (header.columns ? axes[0] : axes[1]).name[0] == '-';
    header.flipY = (header.columns ? axes[1] : axes[0]).name[0] == '+';
}

class ScanlineReader {
  public:
    explicit ScanlineReader(std::span<const std::byte> bytes)
        : m_bytes(bytes) {}

    // As Radiance's freadcolrs(): two bytes 2 and a length below 2^15 announce new run lengths.
    void read(std::span<Pixel> scanline) {
        const std::size_t length = scanline.size();
        const bool mayRun = length >= kMinRunLength && length <= kMaxRunLength;
        if (mayRun && m_bytes.size() >= 4 && at(0) == 2 && at(1) == 2 && at(2) < 128) {
            if (static_cast<std::size_t>(at(2) * 256 + at(3)) != length)
                cutShort("a scanline of another length");
            m_bytes = m_bytes.subspan(4);
            for (std::size_t component = 0; component < 4; ++component)
                readComponent(scanline, component);
        } else {
            readOld(scanline);
        }
    }

  private:
    [[nodiscard]] std::uint8_t at(std::size_t i) const {
        return static_cast<std::uint8_t>(m_bytes[i]);
    }
    std::uint8_t byte() {
        if (m_bytes.empty())
            cutShort("pixels are missing");
        const std::uint8_t value = at(0);
        m_bytes = m_bytes.subspan(1);
        return value;
    }

    // A code above 128 repeats the byte that follows code - 128 times; others announce that many
    // bytes. 0 announces none and is legal: each costs a byte of the file, so that it ends.
    void readComponent(std::span<Pixel> scanline, std::size_t component) {
        for (std::size_t x = 0; x < scanline.size();) {
            const std::uint8_t code = byte();
            const bool run = code > kMaxLiterals;
            const std::size_t count = run ? code - kMaxLiterals : code;
            if (count > scanline.size() - x)
                cutShort("a run beyond the end of a scanline");
            const std::uint8_t repeated = run ? byte() : std::uint8_t{0};
            for (const std::size_t end = x + count; x < end; ++x)
                scanline[x][component] = run ? repeated : byte();
        }
    }

    // Flat, or with runs of whole pixels: 1, 1, 1, n repeats the one before n times; several in a
    // row are the bytes of a larger number, the lowest first.
    void readOld(std::span<Pixel> scanline) {
        int shift = 0;
        for (std::size_t x = 0; x < scanline.size();) {
            const Pixel pixel{byte(), byte(), byte(), byte()};
            if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
                scanline[x++] = pixel;
                shift = 0;
                continue;
            }
            constexpr int kMaxShift = 24;
            const std::size_t count = shift > kMaxShift ? 0 : std::size_t{pixel[3]} << shift;
            if (x == 0 || shift > kMaxShift || count > scanline.size() - x)
                cutShort("a run that does not fit its scanline");
            std::fill_n(scanline.begin() + static_cast<std::ptrdiff_t>(x), count, scanline[x - 1]);
            x += count;
            shift += 8;
        }
    }

    std::span<const std::byte> m_bytes;
};

// Bytes to radiance, as rgbeDecode() has it.
class PixelDecoder {
  public:
    explicit PixelDecoder(const RadianceHeader& header)
        : m_xyze(header.xyze) {
        for (std::size_t c = 0; c < 3; ++c)
            m_scale[static_cast<int>(c)] = 1.0 / header.scale[c];
    }
    [[nodiscard]] glm::vec3 operator()(const Pixel& p) const {
        glm::dvec3 v = shading::rgbeDecode(glm::vec4(p[0], p[1], p[2], p[3]));
        v *= m_scale; // in double: an exposure of 1e-30 is legal
        if (m_xyze)   // CIE XYZ to linear Rec.709, white D65 (IEC 61966-2-1, inverted)
            v = {3.2404542 * v.x - 1.5371385 * v.y - 0.4985314 * v.z,
                 -0.9692660 * v.x + 1.8760108 * v.y + 0.0415560 * v.z,
                 0.0556434 * v.x - 0.2040259 * v.y + 1.0572252 * v.z};
        return v;
    }

  private:
    bool m_xyze;
    glm::dvec3 m_scale{1.0};
};

// From the file's order to rows from the top left.
std::vector<float> upright(std::vector<float> scanned, const RadianceHeader& header, int width,
                           int height) {
    if (!header.columns && !header.flipX && !header.flipY)
        return scanned;
    std::vector<float> result(scanned.size());
    const auto length = static_cast<std::size_t>(header.columns ? height : width);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const int alongX = header.flipX ? width - 1 - x : x;
            const int alongY = header.flipY ? height - 1 - y : y;
            const auto scanline = static_cast<std::size_t>(header.columns ? alongX : alongY);
            const auto place = static_cast<std::size_t>(header.columns ? alongY : alongX);
            const float* from = scanned.data() + 3 * (scanline * length + place);
            std::copy_n(from, 3,
                        result.data() +
                            3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                 static_cast<std::size_t>(x)));
        }
    return result;
}

void appendRuns(std::vector<std::byte>& out, std::span<const std::uint8_t> values) {
    const auto put = [&](std::size_t value) { out.push_back(static_cast<std::byte>(value)); };
    const auto runAt = [&](std::size_t begin) {
        std::size_t end = begin + 1;
        while (end < values.size() && end - begin < kMaxRun && values[end] == values[begin])
            ++end;
        return end - begin;
    };
    for (std::size_t at = 0; at < values.size();) {
        // Literals up to the next run that is worth its two bytes
        std::size_t runBegin = at, run = 0;
        while (runBegin < values.size() && (run = runAt(runBegin)) < kMinRun)
            runBegin += run;
        runBegin = std::min(runBegin, values.size());
        // A short run right here is still cheaper as a run than as literals.
        if (runBegin - at > 1 && runBegin - at < kMinRun && runAt(at) == runBegin - at) {
            put(kMaxLiterals + (runBegin - at));
            put(values[at]);
            at = runBegin;
        }
        while (at < runBegin) {
            const std::size_t count = std::min<std::size_t>(runBegin - at, kMaxLiterals);
            put(count);
            for (std::size_t i = 0; i < count; ++i)
                put(values[at++]);
        }
        if (runBegin < values.size()) {
            put(kMaxLiterals + run);
            put(values[runBegin]);
            at = runBegin + run;
        }
    }
}

} // namespace

RadianceHeader readRadianceHeader(std::span<const std::byte> file) {
    constexpr std::size_t kLongestHeader = std::size_t{1} << 20;
    const std::string_view text(reinterpret_cast<const char*>(file.data()),
                                std::min(file.size(), kLongestHeader));
    RadianceHeader header;
    TokenReader reader(text);
    static_cast<void>(reader.line()); // #?RADIANCE
    for (;;) {
        if (reader.rest().empty())
            cutShort("the header does not end");
        const std::string_view line = reader.line();
        if (line.empty())
            break;
        if (!line.starts_with('#'))
            readVariable(line, header);
    }
    readResolution(reader.line(), header);
    header.pixels = text.size() - reader.rest().size();
    return header;
}

std::vector<float> readRadiancePixels(std::span<const std::byte> file, const RadianceHeader& header,
                                      int width, int height) {
    // However runs shorten it, a scanline takes four bytes.
    if ((file.size() - header.pixels) / 4 < static_cast<std::size_t>(header.scanlines))
        cutShort("pixels are missing");
    ScanlineReader reader(file.subspan(header.pixels));
    const PixelDecoder decode(header);
    const bool whole = width == header.width && height == header.height;
    const auto length = static_cast<std::size_t>(header.length);
    std::vector<float> pixels;
    std::optional<RowReducer> reducer;
    if (whole)
        pixels.resize(3 * length * static_cast<std::size_t>(header.scanlines));
    else
        reducer.emplace(header.length, header.scanlines, header.columns ? height : width,
                        header.columns ? width : height, 3);
    std::vector<Pixel> scanline(length);
    std::vector<float> decoded(3 * length);
    for (int i = 0; i < header.scanlines; ++i) {
        reader.read(scanline);
        float* target =
            whole ? pixels.data() + static_cast<std::size_t>(i) * 3 * length : decoded.data();
        for (const Pixel& pixel : scanline) {
            const glm::vec3 value = decode(pixel);
            for (int c = 0; c < 3; ++c)
                *target++ = value[c];
        }
        if (!whole)
            reducer->addRow(decoded);
    }
    if (!whole)
        pixels.assign(reducer->result().begin(), reducer->result().end());
    return upright(std::move(pixels), header, width, height);
}

std::vector<std::byte> writeRadiance(int width, int height, std::span<const float> rgb) {
    const std::string header =
        fmt::format("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", height, width);
    std::vector<std::byte> out;
    out.reserve(header.size() + rgb.size() / 3 * 4);
    for (const char c : header)
        out.push_back(static_cast<std::byte>(c));
    const auto length = static_cast<std::size_t>(width);
    std::vector<std::uint8_t> components(4 * length); // one after the other
    for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y) {
        for (std::size_t x = 0; x < length; ++x) {
            const float* p = rgb.data() + 3 * (y * length + x);
            const glm::vec4 bytes = shading::rgbeEncode({p[0], p[1], p[2]});
            for (std::size_t c = 0; c < 4; ++c)
                components[c * length + x] = static_cast<std::uint8_t>(bytes[static_cast<int>(c)]);
        }
        if (width < kMinRunLength || width > kMaxRunLength) {
            for (std::size_t x = 0; x < length; ++x)
                for (std::size_t c = 0; c < 4; ++c)
                    out.push_back(static_cast<std::byte>(components[c * length + x]));
            continue;
        }
        for (const int byte : {2, 2, width >> 8, width & 255})
            out.push_back(static_cast<std::byte>(byte));
        for (std::size_t c = 0; c < 4; ++c)
            appendRuns(out, std::span(components).subspan(c * length, length));
    }
    return out;
}

} // namespace patina::codec
